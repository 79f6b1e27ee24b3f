# SPDX-License-Identifier: GPL-3.0-or-later
"""Read the OpenEXR files that the tests let Blender write.

Only scan-line files without compression and 32-bit channels are understood: the tests choose that
form, so that neither NumPy nor an image library is needed on either side of the process border.
"""
import struct
from array import array

MAGIC = 20000630
UNCOMPRESSED = 0
BYTES_PER_PIXEL_TYPE = {0: 4, 1: 2, 2: 4}
FLOAT_TYPE = 2


class ExrError(Exception):
    """The file is not an OpenEXR file of the form described above."""


def read_channels(path):
    """Return (width, height, {channel name: array('f')}, {attribute name: raw bytes}).

    Each array has width * height values, row 0 at the bottom as everywhere in Blender.
    """
    with open(path, "rb") as stream:
        data = stream.read()
    attributes, position = _read_header(data)
    if attributes["compression"][0] != UNCOMPRESSED:
        raise ExrError(f"{path} is compressed")
    x_min, y_min, x_max, y_max = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x_max - x_min + 1, y_max - y_min + 1
    channels = _read_channel_list(attributes["channels"])
    rows = {name: [None] * height for name, pixel_type in channels if pixel_type == FLOAT_TYPE}
    for offset in struct.unpack_from(f"<{height}Q", data, position):
        y, _ = struct.unpack_from("<2i", data, offset)
        cursor = offset + 8
        for name, pixel_type in channels:
            size = BYTES_PER_PIXEL_TYPE[pixel_type] * width
            if name in rows:
                rows[name][y_max - y] = data[cursor:cursor + size]
            cursor += size
    return width, height, {n: array("f", b"".join(r)) for n, r in rows.items()}, attributes


def _read_header(data):
    if len(data) < 8 or struct.unpack_from("<I", data)[0] != MAGIC:
        raise ExrError("not an OpenEXR file")
    attributes = {}
    position = 8
    while data[position] != 0:
        name, position = _read_string(data, position)
        _, position = _read_string(data, position)
        (size,) = struct.unpack_from("<i", data, position)
        attributes[name] = data[position + 4:position + 4 + size]
        position += 4 + size
    return attributes, position + 1


def _read_channel_list(data):
    channels = []
    position = 0
    while data[position] != 0:
        name, position = _read_string(data, position)
        (pixel_type,) = struct.unpack_from("<i", data, position)
        channels.append((name, pixel_type))
        position += 16
    return channels


def _read_string(data, position):
    end = data.index(b"\0", position)
    return data[position:end].decode("utf-8", "replace"), end + 1
