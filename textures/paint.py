#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Paints the textures of the scenes: python3 textures/paint.py [NAME...]

Standard library only. Every pattern is a function of (u, v) in [0, 1), with v upwards, and tiles
where README.md says so; cards, label and engraving are drawn as shapes (canvas.py). The same
input gives the same file, byte for byte.
"""

import math
import sys

import drink_me
import engraving
import playing_cards
import wall
from tools import fbm, inside, lattice, mix, paint, paint_normal, smoothstep


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


def paint_wood(width=1792, height=896):
    paint("wood_albedo", width, height, wood_albedo)
    paint("wood_roughness", width, height, wood_roughness)
    paint_normal("wood_normal", width, height, wood_height, 1.6)


# ------------------------------------------------------------------------ grid and bricks

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
    cell = mix(tuple(c * level for c in colour), (1.0, 1.0, 1.0), line)
    return mix(cell, (0.05, 0.05, 0.06), corner)


def bricks_height(u, v):
    row = int(v * 8.0)
    x = (u * 4.0 + 0.5 * (row % 2)) % 1.0
    y = v * 8.0 - row
    edge = min(x * 2.0, (1.0 - x) * 2.0, y, 1.0 - y)
    return 6.0 * smoothstep(0.02, 0.16, edge) + 0.8 * fbm(u, v, 16, 16, 3, 77)


PICTURES = {
    "wood": paint_wood,
    "cards": playing_cards.paint_cards,
    "label": drink_me.paint_label,
    "rabbit": engraving.paint_rabbit,
    "wallpaper": wall.paint_wallpaper,
    "uv_grid": lambda: paint("uv_grid", 512, 512, uv_grid),
    "bricks": lambda: paint_normal("bricks_normal", 512, 512, bricks_height, 1.0),
}


def main():
    for name in sys.argv[1:] or PICTURES:
        PICTURES[name]()


if __name__ == "__main__":
    main()
