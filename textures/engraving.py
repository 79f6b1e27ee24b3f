# SPDX-License-Identifier: GPL-3.0-or-later
"""A portrait of the White Rabbit, engraved: the sitter is built of ellipsoids, and every line is
where a family of slanted planes cuts them, as thick as the form is dark there.

Units: the sheet is 96 x 128 about its centre, x right, y up, z towards the viewer.
"""

import math

from canvas import Canvas, arc, disc, polar
from tools import fbm, inside, mix, smoothstep

SHEET = (96.0, 128.0)
PIXELS = (768, 1024)
INK = (0.085, 0.07, 0.065)
PAPER = (0.80, 0.75, 0.62)
LIGHT = (-0.52, 0.58, 0.63)             # towards the lamp

FUR, SHADE, CLOTH, LINEN, DARK = 0.0, 0.42, 0.52, 0.0, 0.96

# Centre, radii, turn in the sheet (degrees), darkness of the stuff, slant of its lines (degrees).
PARTS = [
    ((2, -52, -6), (35, 33, 17), 0, CLOTH, 62),
    ((-27, -58, 1), (13, 24, 13), -12, CLOTH, 28), ((31, -58, 1), (13, 24, 13), 12, CLOTH, -28),
    ((-2, -48, 3), (15, 34, 12), 0, 0.22, 90),
    ((-15, -38, 9), (6.5, 27, 4), -17, 0.70, -50), ((13, -38, 9), (6.5, 27, 4), 17, 0.70, 50),
    ((0, -12, 3), (17, 8, 13), 0, LINEN, 80),
    ((-11, -16, 17), (8.5, 5.2, 3), -14, 0.72, 15), ((7, -16, 17), (8.5, 5.2, 3), 14, 0.72, -15),
    ((-2, -16, 19), (3.2, 3.6, 3), 0, 0.72, 90),
    ((-10, 41, -6), (6.4, 22, 4.5), 9, FUR, 30), ((13, 40, -7), (6.8, 22, 4.5), -15, FUR, -35),
    ((-10.6, 40, -3.6), (3.2, 17.5, 2.6), 9, SHADE, 60),
    ((11.2, 39, -4.6), (3.4, 17.5, 2.8), -15, SHADE, -60),
    ((1, 11, 0), (19.5, 17, 16), 0, FUR, 35),
    ((9, 2, 8), (11, 10, 9), 0, FUR, -25), ((-9, 1.5, 9), (9.5, 9, 9), 0, FUR, 50),
    ((-5, 5.5, 14), (7.5, 9.0, 7.5), 8, FUR, 10),
    ((-7.6, 0.0, 17.5), (5.2, 4.2, 4.5), 0, FUR, 40),
    ((-0.4, -0.4, 17), (5.4, 4.4, 4.5), 0, FUR, -30),
    ((-4.2, 4.6, 22.6), (2.9, 2.0, 2.0), 0, 0.80, 0),
    ((8.6, 14.2, 14.0), (3.9, 4.2, 3.0), 0, DARK, 0),
    ((-13.4, 13.8, 9.2), (2.7, 3.9, 3.0), 0, DARK, 0),
] + [((-1.5, -34.0 - 10.0 * k, 15.0), (1.7, 1.7, 1.7), 0, 0.55, 0) for k in range(3)]


# ------------------------------------------------------------------------------- the sitter

def nearest_part(x, y):
    """(part number, height z, normal) of what is seen at a point of the sheet; None if nothing."""
    found = None
    for number, ((cx, cy, cz), (ru, rv, rz), turn, _, _) in enumerate(PARTS):
        reach = max(ru, rv)
        if abs(x - cx) > reach or abs(y - cy) > reach:
            continue
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        u, v = ((x - cx) * c + (y - cy) * s) / ru, ((y - cy) * c - (x - cx) * s) / rv
        left = 1.0 - u * u - v * v
        if left <= 0.0:
            continue
        z = cz + rz * math.sqrt(left)
        if found is None or z > found[1]:
            n = u / ru, v / rv, math.sqrt(left) / rz
            length = math.sqrt(n[0] ** 2 + n[1] ** 2 + n[2] ** 2)
            found = number, z, ((n[0] * c - n[1] * s) / length, (n[0] * s + n[1] * c) / length,
                                n[2] / length)
    return found


def darkness(number, normal):
    stuff = PARTS[number][3]
    lit = max(0.0, sum(a * b for a, b in zip(normal, LIGHT)))
    shade = 0.92 * (1.0 - smoothstep(0.02, 0.86, lit)) ** 1.15
    return stuff + (1.0 - stuff) * shade


# -------------------------------------------------------------------------------- the lines

def family(coordinate, width, softness):
    """Coverage by lines one unit apart, each `width` wide."""
    off_centre = abs(coordinate - math.floor(coordinate) - 0.5)
    return inside(off_centre - 0.5 * width, softness)


def hatching(x, y, z, slant, tone, tremor):
    """Up to three crossing families of lines; the second and third only in the shadows."""
    ink = 0.0
    for turn, start, pitch in ((0.0, 0.0, 1.55), (64.0, 0.46, 1.7), (-48.0, 0.76, 1.7)):
        width = 0.78 * smoothstep(start - 0.02, start + 0.62, tone)
        if width < 0.05:
            continue
        angle = math.radians(slant + turn)
        along = (-x * math.sin(angle) + y * math.cos(angle) + 0.55 * z) / pitch + tremor
        ink = max(ink, family(along, width, 0.06))
    return ink


def background(x, y, tremor):
    """Level strokes that fade outwards in an oval, darkest behind the light side."""
    oval = math.hypot((x + 2.0) / 43.0, (y - 2.0) / 59.0)
    tone = 0.52 * smoothstep(1.0, 0.55, oval) * (0.75 + 0.25 * smoothstep(20.0, -30.0, x))
    width = 0.85 * tone
    return family(y / 1.5 + tremor, width, 0.07) if width > 0.05 else 0.0


def ink_at(x, y, number, z, normal):
    tremor = 0.55 * (fbm(x / 96.0 + 0.5, y / 128.0 + 0.5, 7, 9, 2, 5) - 0.5)
    if number is None:
        return background(x, y, 0.5 * tremor)
    return hatching(x, y, z, PARTS[number][4], darkness(number, normal), tremor)


def strokes(canvas):
    """What is drawn and not shaded: whiskers, gleams in the eyes, mouth, watch chain."""
    for side, root in ((1, (3.0, 0.6)), (-1, (-10.5, 0.6))):
        for k in range(4):
            angle = (0.0 if side > 0 else math.pi) + side * (0.42 - 0.24 * k)
            tip = polar(root, 21.0 - 1.5 * k, angle)
            bend = polar(root, 11.0, angle + side * 0.10)
            canvas.stroke([root, bend, tip], 0.55, INK, taper=True)
    canvas.stroke([(-4.2, 3.0), (-4.1, -1.2)], 0.6, INK)
    for side in (-1, 1):
        canvas.stroke(arc((-4.1 + side * 2.6, -0.6), 2.6, math.pi, 2.0 * math.pi, 12), 0.6, INK)
    canvas.fill([disc((7.4, 15.8), 1.25), disc((-14.0, 15.4), 0.95)], PAPER)
    chain = [(-0.5 - 17.0 * t, -46.0 - 10.0 * math.sin(math.pi * t) - 3.0 * t)
             for t in (k / 16 for k in range(17))]
    canvas.stroke(chain, 1.5, PAPER)
    canvas.stroke(chain, 0.6, INK)


def paint_rabbit():
    canvas = Canvas(*PIXELS, SHEET[0], PAPER)
    scale = SHEET[0] / PIXELS[0]
    above = [None] * PIXELS[0]
    for row in range(PIXELS[1]):
        y = 0.5 * SHEET[1] - (row + 0.5) * scale
        seen = []
        for column in range(PIXELS[0]):
            x = (column + 0.5) * scale - 0.5 * SHEET[0]
            hit = nearest_part(x, y)
            seen.append(hit)
            ink = ink_at(x, y, *(hit or (None, 0.0, None)))
            if is_outline(hit, above[column], seen[column - 1] if column else None):
                ink = 1.0
            canvas.rows[row][column] = mix(PAPER, INK, ink)
        above = seen
    thicken_outlines(canvas)
    strokes(canvas)
    canvas.save("rabbit_engraving")


def is_outline(hit, upper, left):
    """Between two parts at different depth; where they melt into each other no line is drawn."""
    for other in (upper, left):
        if (hit is None) != (other is None):
            return True
        if hit and hit[0] != other[0] and abs(hit[1] - other[1]) > 1.4:
            return True
    return False


def thicken_outlines(canvas):
    """Full ink spreads by a pixel, to the right and down."""
    for row in range(PIXELS[1] - 1, 0, -1):
        above, pixels = canvas.rows[row - 1], canvas.rows[row]
        for column in range(PIXELS[0] - 1, 0, -1):
            if above[column] == INK or pixels[column - 1] == INK:
                pixels[column] = mix(pixels[column], INK, 0.75)
