# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures for people: a PNG writer and the HTML page of tested / reference / difference."""
import html
import os
import struct
import zlib

TABLE_SIZE = 4096


def _srgb_byte(value):
    value = min(max(value, 0.0), 1.0)
    encoded = 12.92 * value if value <= 0.0031308 else 1.055 * value ** (1.0 / 2.4) - 0.055
    return round(255.0 * encoded)


SRGB_TABLE = bytes(_srgb_byte(i / (TABLE_SIZE - 1)) for i in range(TABLE_SIZE))


def _to_byte(value):
    if not value > 0.0:
        return 0
    return 255 if value >= 1.0 else SRGB_TABLE[int(value * (TABLE_SIZE - 1) + 0.5)]


def write_png(path, picture):
    """Write `picture` (linear) as an 8-bit sRGB PNG without alpha, clipped to [0, 1]."""
    width, height, rgba = picture.width, picture.height, picture.rgba
    lines = []
    for y in range(height - 1, -1, -1):
        row = rgba[4 * y * width:4 * (y + 1) * width]
        line = bytearray(1 + 3 * width)
        for channel in range(3):
            line[1 + channel::3] = bytes(map(_to_byte, row[channel::4]))
        lines.append(bytes(line))

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data
                + struct.pack(">I", zlib.crc32(kind + data)))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    with open(path, "wb") as stream:
        stream.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                     + chunk(b"IDAT", zlib.compress(b"".join(lines), 6)) + chunk(b"IEND", b""))


class Report:
    """Collects rows of pictures below `folder`; `finish` writes index.html there."""

    STYLE = ("body{font-family:sans-serif;margin:2em}img{image-rendering:pixelated;width:256px}"
             "td,th{padding:4px 8px;vertical-align:top;text-align:left}.bad{background:#fdd}"
             "pre{white-space:pre-wrap;max-width:60em}")

    def __init__(self, folder, title):
        self.folder = folder
        self.title = title
        self.rows = []
        os.makedirs(folder, exist_ok=True)

    def add(self, name, tested, reference, text="", passed=True, gain=5.0):
        """Add one comparison; the difference is shown multiplied by `gain`."""
        stem = "".join(c if c.isalnum() or c in "._-" else "_" for c in name)[:150]
        stem = f"{len(self.rows):04d}_{stem}"
        cells = []
        pictures = (("tested", tested), ("reference", reference),
                    ("difference", tested.difference(reference, gain)))
        for kind, picture in pictures:
            file_name = f"{stem}.{kind}.png"
            write_png(os.path.join(self.folder, file_name), picture)
            cells.append(f'<td><img src="{file_name}" alt="{kind}"></td>')
        mark = "" if passed else ' class="bad"'
        self.rows.append(f"<tr{mark}><td>{html.escape(name)}<pre>{html.escape(text)}</pre></td>"
                         + "".join(cells) + "</tr>")

    def finish(self, summary=""):
        """Write index.html and return its path."""
        path = os.path.join(self.folder, "index.html")
        with open(path, "w", encoding="utf-8") as stream:
            stream.write(
                f"<!doctype html><meta charset='utf-8'><title>{html.escape(self.title)}</title>"
                f"<style>{self.STYLE}</style><h1>{html.escape(self.title)}</h1>"
                f"<p>{html.escape(summary)}</p><table><tr><th>what<th>tested<th>reference"
                f"<th>difference</tr>{''.join(self.rows)}</table>")
        return path
