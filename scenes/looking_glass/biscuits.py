# SPDX-License-Identifier: GPL-3.0-or-later
"""A plate of butter biscuits; two words are pressed into each."""

import math

import bmesh
import shapes

from .fallen import BISCUITS
from .layout import BISCUIT, PLATE, PLATE_PROFILE

# Strokes of the letters in a box one high, and how wide each is.
LETTERS = {
    "E": (0.58, [(0, 0, 0, 1), (0, 1, 0.58, 1), (0, 0.5, 0.48, 0.5), (0, 0, 0.58, 0)]),
    "A": (0.74, [(0, 0, 0.37, 1), (0.37, 1, 0.74, 0), (0.15, 0.38, 0.59, 0.38)]),
    "T": (0.70, [(0.35, 0, 0.35, 1), (0, 1, 0.70, 1)]),
    "M": (0.84, [(0, 0, 0, 1), (0, 1, 0.42, 0.3), (0.42, 0.3, 0.84, 1), (0.84, 1, 0.84, 0)]),
    " ": (0.16, []),
}
LETTER_HEIGHT, LETTER_GAP = 0.0120, 0.30
STROKE, DEPTH = 0.00085, 0.0016         # half the width of a stroke, and how deep it is pressed
COLUMNS, ROWS = 132, 92


def build(looks):
    place = (*PLATE, 0.0)
    shapes.lathe("Plate", shapes.smooth_profile(PLATE_PROFILE, steps=4), looks.china, segments=128,
                 location=place)
    mesh = biscuit_mesh("Biscuit")
    for number, (where, turn) in enumerate(BISCUITS):
        shapes.add_object("Biscuit", mesh, None if number else looks.biscuit, where, turn)


def text_strokes(text):
    """Line segments of the text about the origin, in metres."""
    width = sum(LETTERS[c][0] + LETTER_GAP for c in text) - LETTER_GAP
    x, strokes = -0.5 * width, []
    for c in text:
        advance, lines = LETTERS[c]
        strokes += [tuple(LETTER_HEIGHT * t for t in (x + x0, y0 - 0.5, x + x1, y1 - 0.5))
                    for x0, y0, x1, y1 in lines]
        x += advance + LETTER_GAP
    return strokes


def dimples():
    """A frame of small holes, as bakers prick them."""
    half_width, half_height = 0.39 * BISCUIT[0], 0.36 * BISCUIT[1]
    points = []
    for k in range(11):
        x = half_width * (k / 5.0 - 1.0)
        points += [(x, half_height), (x, -half_height)]
    for k in range(1, 6):
        y = half_height * (k / 3.0 - 1.0)
        points += [(half_width, y), (-half_width, y)]
    return points


def distance_to(stroke, x, y):
    x0, y0, x1, y1 = stroke
    dx, dy = x1 - x0, y1 - y0
    t = max(0.0, min(1.0, ((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy)))
    return math.hypot(x - x0 - t * dx, y - y0 - t * dy)


def pressed(x, y, strokes, holes):
    """How deep the stamp went here, from 0 to 1."""
    line = min(distance_to(stroke, x, y) for stroke in strokes) - STROKE
    hole = min(math.hypot(x - hx, y - hy) for hx, hy in holes) - 0.00075
    t = max(0.0, min(1.0, 0.5 - min(line, hole) / 0.0009))
    return t * t * (3.0 - 2.0 * t)


def scalloped(s, t):
    """From the square [-1, 1]^2 to the outline of the biscuit; teeth along the rim."""
    rim_s, rim_t = abs(s) ** 10, abs(t) ** 10
    x = s * (0.5 * BISCUIT[0] - 0.0011 * rim_s * (1.0 - abs(math.cos(math.pi * 4.5 * t))))
    y = t * (0.5 * BISCUIT[1] - 0.0011 * rim_t * (1.0 - abs(math.cos(math.pi * 6.5 * s))))
    return x * (1.0 - 0.035 * rim_t * s * s), y * (1.0 - 0.05 * rim_s * t * t)


def biscuit_mesh(name):
    """A grid for the top, a flat bottom and a wall between; `toast` on the points is how brown."""
    strokes, holes = text_strokes("EAT ME"), dimples()
    builder = bmesh.new()
    toast = builder.verts.layers.float.new("toast")
    half = 0.5 * BISCUIT[2]
    top = []
    for row in range(ROWS + 1):
        line = []
        for column in range(COLUMNS + 1):
            s, t = 2.0 * column / COLUMNS - 1.0, 2.0 * row / ROWS - 1.0
            x, y = scalloped(s, t)
            rim = max(abs(s), abs(t))
            depth = pressed(x, y, strokes, holes)
            vert = builder.verts.new((x, y, half * (1.0 - 0.75 * rim ** 22) - DEPTH * depth))
            vert[toast] = min(1.0, 0.85 * rim ** 7 + 0.5 * depth)
            line.append(vert)
        top.append(line)
    for low, high in zip(top, top[1:]):
        for k in range(COLUMNS):
            builder.faces.new([low[k], low[k + 1], high[k + 1], high[k]])
    edge = (top[0] + [row[-1] for row in top[1:]] + top[-1][-2::-1]
            + [row[0] for row in top[-2:0:-1]])
    foot = []
    for vert in edge:
        below = builder.verts.new((vert.co.x * 0.985, vert.co.y * 0.985, -half))
        below[toast] = 1.0
        foot.append(below)
    for k, vert in enumerate(edge):
        builder.faces.new([edge[k - 1], foot[k - 1], foot[k], vert])
    builder.faces.new(foot[::-1])
    return shapes.finished_mesh(name, builder, True)
