#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Paints the textures of the scenes: python3 textures/paint.py [NAME...]

Standard library only. Every pattern is a function of (u, v) in [0, 1), with v upwards, and tiles
where README.md says so. The same input gives the same file, byte for byte.
"""

import math
import pathlib
import struct
import sys
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


# ------------------------------------------------------------------------------------ wood

PLANKS = 4


def wood_grain(u, v):
    """(rings, pores, gap, plank): what the three maps of the table share. Boards run along u."""
    plank = int(v * PLANKS) % PLANKS
    across = v * PLANKS - math.floor(v * PLANKS)
    shifted = (u + lattice(plank, 7, 3)) % 1.0
    bend = fbm(shifted, v, 2, 8, 3, 11 + 5 * plank)
    rings = 0.5 + 0.5 * math.sin(2.0 * math.pi * (across * 5.0 + 7.0 * bend))
    pores = fbm(shifted, v, 6, 160, 3, 40 + plank)
    gap = smoothstep(0.012, 0.0, min(across, 1.0 - across))
    return rings, pores, gap, plank


def wood_albedo(u, v):
    rings, pores, gap, plank = wood_grain(u, v)
    tone = mix((0.50, 0.29, 0.15), (0.33, 0.165, 0.075), 0.65 * rings + 0.35 * pores)
    shade = 0.82 + 0.3 * lattice(plank, 3, 9)
    streak = 1.0 - 0.35 * smoothstep(0.5, 0.85, pores)
    return tuple(c * shade * streak * (1.0 - 0.8 * gap) for c in tone)


def wood_height(u, v):
    rings, pores, gap, _ = wood_grain(u, v)
    return 0.25 * rings - 0.6 * smoothstep(0.5, 0.85, pores) - 1.6 * gap


def wood_roughness(u, v):
    rings, pores, gap, _ = wood_grain(u, v)
    return 0.24 + 0.08 * rings + 0.22 * smoothstep(0.45, 0.8, pores) + 0.3 * gap


def paint_wood(width=1024, height=512):
    paint("wood_albedo", width, height, wood_albedo)
    paint("wood_roughness", width, height, wood_roughness)
    paint_normal("wood_normal", width, height, wood_height, 1.6)


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


# ----------------------------------------------------------------------------------- cards

CARD = (384, 540)                      # pixels; playing cards are 64 mm by 90 mm
PAPER = (0.93, 0.90, 0.82)
RED = (0.66, 0.07, 0.07)
BLACK = (0.05, 0.05, 0.06)


def rounded_box(x, y, half_width, half_height, radius):
    dx, dy = abs(x) - half_width + radius, abs(y) - half_height + radius
    return math.hypot(max(dx, 0.0), max(dy, 0.0)) + min(max(dx, dy), 0.0) - radius


def heart(x, y):
    """Signed distance (nearly) of a heart about one unit high."""
    x = abs(x)
    if x + y > 0.55:
        return math.hypot(x - 0.25, y - 0.3) - 0.3535
    low = max(0.5 * (x + y + 0.45), 0.0)
    return (math.copysign(1.0, x - y - 0.45)
            * min(math.hypot(x, y - 0.55), math.hypot(x - low, y + 0.45 - low)))


def spade(x, y):
    flare = 0.03 + 0.9 * max(0.0, -0.25 - y) ** 2
    stem = max(abs(x) - flare, abs(y + 0.34) - 0.24)
    return min(heart(x, 0.4 - y), stem)


def card_face(pip, colour):
    def pattern(u, v):
        x, y = (u - 0.5) * 0.64, (v - 0.5) * 0.90
        pixel = 0.64 / CARD[0]
        cover = inside(pip(x / 0.26, y / 0.26) * 0.26, pixel)
        if y < 0.0:
            x, y = -x, -y
        cover = max(cover, inside(pip((x + 0.25) / 0.07, (y - 0.285) / 0.07) * 0.07, pixel))
        # The A: two legs and a bar.
        ax, ay = abs(x + 0.25), y - 0.385
        leg = abs(ax - 0.028 * (0.04 - ay) / 0.08) - 0.0065
        bar = max(abs(ay + 0.012) - 0.005, ax - 0.018)
        cover = max(cover, inside(max(min(leg, bar), abs(ay) - 0.04), pixel))
        return mix(PAPER, colour, cover)
    return pattern


def card_back(u, v):
    """A rosette in a lattice of diamonds, inside a double frame; the same upside down."""
    x, y = (u - 0.5) * 0.64, (v - 0.5) * 0.90
    pixel = 0.64 / CARD[0]
    edge = rounded_box(x, y, 0.28, 0.41, 0.03)
    angle, radius = math.atan2(y, x), math.hypot(x, y)
    diamonds = abs((x * 14.0 + y * 14.0) % 1.0 - 0.5), abs((x * 14.0 - y * 14.0) % 1.0 - 0.5)
    thread = max(smoothstep(0.40, 0.45, d) for d in diamonds)
    bead = 1.0 - smoothstep(0.10, 0.16, math.hypot(*diamonds))
    ink = 1.0 - max(thread, bead)
    petal = 0.135 + 0.035 * math.cos(8.0 * angle)
    for ring, (size, wave) in enumerate(((1.0, 0.0), (0.72, 0.4), (0.42, 0.0))):
        limit = petal * size if not wave else 0.1 + 0.02 * math.cos(16.0 * angle)
        cover = inside(radius - limit, pixel)
        ink = mix(ink, ring % 2 ^ 1, cover)
        ink = mix(ink, ring % 2, inside(abs(radius - limit) - 0.004, pixel))
    ink = mix(ink, 0.0, inside(radius - 0.028, pixel))
    ink *= inside(edge, pixel)
    frame = inside(abs(rounded_box(x, y, 0.295, 0.425, 0.04)) - 0.0035, pixel)
    return mix(PAPER, (0.10, 0.16, 0.36), max(ink, frame))


def paint_cards():
    paint("card_back", *CARD, card_back)
    paint("card_heart", *CARD, card_face(heart, RED))
    paint("card_spade", *CARD, card_face(spade, BLACK))


# ----------------------------------------------------------------------- wallpaper and grid

def damask(u, v):
    """A half-drop pattern of leaves; tiles."""
    cover = 0.0
    pixel = 1.5 / 512
    for centre_x, centre_y in ((0.5, 0.5), (0.0, 0.0)):
        x = (u - centre_x + 0.5) % 1.0 - 0.5
        y = (v - centre_y + 0.5) % 1.0 - 0.5
        x = abs(x)
        angle, radius = math.atan2(x, y), math.hypot(x, y)
        leaf = 0.16 + 0.13 * abs(math.cos(2.5 * angle)) ** 0.7 + 0.05 * math.cos(angle)
        outline = inside(abs(radius - leaf) - 0.006, pixel)
        flower = inside(radius - leaf * 0.72, pixel)
        vein = inside(abs(x - 0.16 * math.sin(3.0 * y + 1.2) ** 2) - 0.004, pixel)
        heart_hole = inside(radius - leaf * 0.3, pixel)
        cover = max(cover, outline, flower * (1.0 - vein) * (1.0 - heart_hole))
    stripe = 0.5 + 0.5 * math.sin(2.0 * math.pi * 64.0 * u)
    ground = mix((0.075, 0.165, 0.170), (0.085, 0.185, 0.190), stripe)
    return mix(ground, (0.165, 0.300, 0.285), cover)


def uv_grid(u, v):
    """An 8 x 8 test grid: hue along u, brightness along v, white lines, one marked corner."""
    column, row = int(u * 8.0), int(v * 8.0)
    hue = column / 8.0 * 6.0
    colour = tuple(max(0.0, min(1.0, abs((hue + k) % 6.0 - 3.0) - 1.0)) for k in (0.0, 4.0, 2.0))
    colour = mix(colour, (0.5, 0.5, 0.5), 0.35)
    level = (0.35 + 0.6 * row / 7.0) * (1.0 if (column + row) % 2 else 0.7)
    fu, fv = u * 8.0 - column, v * 8.0 - row
    line = smoothstep(0.03, 0.015, min(fu, fv, 1.0 - fu, 1.0 - fv))
    corner = inside(math.hypot(u - 0.0625, v - 0.0625) - 0.035, 0.002)
    return mix(mix(tuple(c * level for c in colour), (1.0, 1.0, 1.0), line), BLACK, corner)


def bricks_height(u, v):
    row = int(v * 8.0)
    x = (u * 4.0 + 0.5 * (row % 2)) % 1.0
    y = v * 8.0 - row
    edge = min(x * 2.0, (1.0 - x) * 2.0, y, 1.0 - y)
    return 6.0 * smoothstep(0.02, 0.16, edge) + 0.8 * fbm(u, v, 16, 16, 3, 77)


PICTURES = {
    "wood": paint_wood,
    "cards": paint_cards,
    "wallpaper": lambda: paint("wallpaper", 512, 512, damask),
    "uv_grid": lambda: paint("uv_grid", 512, 512, uv_grid),
    "bricks": lambda: paint_normal("bricks_normal", 512, 512, bricks_height, 1.0),
}


def main():
    for name in sys.argv[1:] or PICTURES:
        PICTURES[name]()


if __name__ == "__main__":
    main()
