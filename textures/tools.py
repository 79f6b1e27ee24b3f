# SPDX-License-Identifier: GPL-3.0-or-later
"""Writing pictures, and the functions every painter uses: mixing, edges, noise."""

import math
import pathlib
import struct
import zlib

FOLDER = pathlib.Path(__file__).resolve().parent


# ------------------------------------------------------------------------------ image files

def write_png(path, width, height, rows, channels):
    """Writes 8-bit grey (channels 1) or RGB (3); `rows` are bytes, the top row first."""
    def chunk(tag, data):
        return (struct.pack(">I", len(data)) + tag + data
                + struct.pack(">I", zlib.crc32(tag + data)))

    colour_type = {1: 0, 3: 2}[channels]
    # Filter type 1 (difference to the left neighbour) suits smooth pictures.
    filtered = bytearray()
    for row in rows:
        filtered.append(1)
        filtered += row[:channels]
        filtered += bytes((a - b) & 255 for a, b in zip(row[channels:], row))
    path.write_bytes(b"\x89PNG\r\n\x1a\n"
                     + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, colour_type,
                                                  0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(bytes(filtered), 9))
                     + chunk(b"IEND", b""))


def paint(name, width, height, pattern):
    """Evaluates `pattern(u, v)` at pixel centres; it gives a grey value or an RGB triple."""
    rows = []
    channels = 1
    for y in range(height):
        row = bytearray()
        for x in range(width):
            value = pattern((x + 0.5) / width, 1.0 - (y + 0.5) / height)
            if isinstance(value, tuple):
                channels = 3
                row.extend(to_byte(c) for c in value)
            else:
                row.append(to_byte(value))
        rows.append(bytes(row))
    write_png(FOLDER / f"{name}.png", width, height, rows, channels)


def to_byte(value):
    return max(0, min(255, int(value * 255.0 + 0.5)))


# ----------------------------------------------------------------------------- small tools

def mix(a, b, t):
    if isinstance(a, tuple):
        return tuple(x + (y - x) * t for x, y in zip(a, b))
    return a + (b - a) * t


def smoothstep(low, high, x):
    t = max(0.0, min(1.0, (x - low) / (high - low)))
    return t * t * (3.0 - 2.0 * t)


def inside(distance, softness):
    """Coverage of a shape by its signed distance; the edge is `softness` wide."""
    return smoothstep(softness, -softness, distance)


def lattice(x, y, seed):
    """A value in [0, 1) for a lattice point: an integer hash."""
    h = (x * 374761393 + y * 668265263 + seed * 974634777) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    return ((h ^ (h >> 16)) & 0xFFFFFF) / 0x1000000


def noise(x, y, period_x, period_y, seed):
    """Value noise with quintic blending, periodic in both directions."""
    x0, y0 = math.floor(x), math.floor(y)
    fx, fy = x - x0, y - y0
    fx = fx * fx * fx * (fx * (fx * 6.0 - 15.0) + 10.0)
    fy = fy * fy * fy * (fy * (fy * 6.0 - 15.0) + 10.0)
    xa, xb = x0 % period_x, (x0 + 1) % period_x
    ya, yb = y0 % period_y, (y0 + 1) % period_y
    low = mix(lattice(xa, ya, seed), lattice(xb, ya, seed), fx)
    return mix(low, mix(lattice(xa, yb, seed), lattice(xb, yb, seed), fx), fy)


def fbm(u, v, frequency_u, frequency_v, octaves, seed):
    """Sum of octaves of noise(u, v), in [0, 1]; tiles over the unit square."""
    total, amplitude, norm = 0.0, 1.0, 0.0
    for octave in range(octaves):
        fu, fv = frequency_u << octave, frequency_v << octave
        total += amplitude * noise(u * fu, v * fv, fu, fv, seed + octave)
        norm += amplitude
        amplitude *= 0.5
    return total / norm


# ---------------------------------------------------------------------------------- normals

def paint_normal(name, width, height, height_at, strength):
    """Tangent-space normals (OpenGL convention, green up) of a height field."""
    heights = [[height_at((x + 0.5) / width, 1.0 - (y + 0.5) / height) for x in range(width)]
               for y in range(height)]
    rows = []
    for y in range(height):
        row = bytearray()
        above, below = heights[y - 1], heights[(y + 1) % height]
        for x in range(width):
            dx = (heights[y][(x + 1) % width] - heights[y][x - 1]) * strength
            dy = (above[x] - below[x]) * strength
            length = math.sqrt(dx * dx + dy * dy + 1.0)
            row.extend(to_byte(0.5 + 0.5 * c / length) for c in (-dx, -dy, 1.0))
        rows.append(bytes(row))
    write_png(FOLDER / f"{name}.png", width, height, rows, 3)
