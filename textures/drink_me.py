# SPDX-License-Identifier: GPL-3.0-or-later
"""The label of the bottle: two words in fat-face capitals on old paper."""

import math

from canvas import Canvas, arc, disc, drop, rounded_box, sector, turned_left
from tools import fbm, mix

INK = (0.10, 0.055, 0.04)
PAPER = (0.86, 0.77, 0.56)
STEM, HAIR = 0.21, 0.045                # widths of thick and thin strokes; capitals are 1 high
TRACKING = 0.07


def bar(x0, y0, x1, y1):
    return turned_left([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def slanted(x0, y0, x1, y1, width):
    return turned_left([(x0 - width / 2, y0), (x0 + width / 2, y0), (x1 + width / 2, y1),
                        (x1 - width / 2, y1)])


def upright(x, width=STEM):
    """A stem with hairline serifs above and below; `x` is its left edge."""
    return [bar(x, 0.0, x + width, 1.0), bar(x - 0.07, 0.0, x + width + 0.07, HAIR),
            bar(x - 0.07, 1.0 - HAIR, x + width + 0.07, 1.0)]


def bowl(x, low, high, reach):
    """The round side of D and R: thin where it meets the stem, thick at its belly."""
    middle, radius = 0.5 * (low + high), 0.5 * (high - low)
    outer = [(x + reach * math.cos(a), middle + radius * math.sin(a))
             for a in (math.pi * (k / 20 - 0.5) for k in range(21))]
    inner = [(x + (reach - STEM * 1.05) * math.cos(a), middle + (radius - HAIR) * math.sin(a))
             for a in (math.pi * (k / 20 - 0.5) for k in range(21))]
    return [turned_left(outer + inner[::-1])]


LETTERS = {                             # outlines and advance
    "D": (upright(0.0) + bowl(0.20, 0.0, 1.0, 0.52), 0.88),
    "R": (upright(0.0) + bowl(0.20, 0.46, 1.0, 0.44)
          + [slanted(0.72, 0.0, 0.40, 0.48, 0.24), bar(0.56, 0.0, 0.90, HAIR)], 0.92),
    "I": (upright(0.0), 0.36),
    "N": (upright(0.0, HAIR * 1.3) + upright(0.66, HAIR * 1.3)
          + [slanted(0.60, 0.0, 0.11, 1.0, STEM)], 0.86),
    "K": (upright(0.0) + [slanted(0.24, 0.42, 0.66, 1.0, 0.06),
                          slanted(0.68, 0.0, 0.38, 0.58, 0.24), bar(0.50, 0.0, 0.86, HAIR),
                          bar(0.50, 1.0 - HAIR, 0.80, 1.0)], 0.88),
    "M": (upright(0.0, HAIR * 1.3) + upright(0.80)
          + [slanted(0.45, 0.0, 0.10, 1.0, STEM), slanted(0.45, 0.0, 0.84, 1.0, 0.06)], 1.16),
    "E": (upright(0.0) + [bar(0.2, 0.0, 0.62, HAIR), bar(0.2, 1.0 - HAIR, 0.60, 1.0),
                          bar(0.2, 0.48, 0.46, 0.48 + HAIR), bar(0.60, 0.0, 0.645, 0.24),
                          bar(0.575, 0.76, 0.62, 1.0), bar(0.44, 0.38, 0.485, 0.63)], 0.76),
}


def word(text, height, centre):
    """Outlines of the word about `centre`."""
    width = sum(LETTERS[letter][1] + TRACKING for letter in text) - 0.14 - TRACKING
    outlines, x = [], -0.5 * width
    for letter in text:
        shapes, advance = LETTERS[letter]
        outlines += [[(centre[0] + height * (x + px), centre[1] + height * (py - 0.5))
                      for px, py in shape] for shape in shapes]
        x += advance + TRACKING
    return outlines


def old_paper(canvas):
    """Stains and browned edges, under what is printed."""
    for row, pixels in enumerate(canvas.rows):
        v = row / canvas.height
        for column in range(canvas.width):
            u = column / canvas.width
            edge = min(u, 1.0 - u, v, 1.0 - v)
            stain = fbm(u, v, 5, 4, 4, 91)
            tone = 1.08 - 0.22 * stain - 0.22 * math.exp(-edge / 0.035)
            pixels[column] = tuple(min(1.0, c * t) for c, t in
                                   zip(PAPER, (tone, tone * 0.985, tone * (1.02 - 0.12 * stain))))


def flourish(canvas, y, flip):
    """A spray of leaves around a dot."""
    for side in (-1, 1):
        for k in range(6):
            x = side * (2.0 + 2.6 * k)
            lift = flip * 0.9 * math.sin(k * 0.6)
            angle = math.pi / 2.0 * (1 - side) + side * flip * 0.55
            size = 3.0 - 0.32 * k
            canvas.fill([drop((x, y + lift), angle, size, size * 0.42)], INK)
            canvas.fill([drop((x, y + lift), -angle if side > 0 else 2 * math.pi - angle, size,
                              size * 0.42)], INK)
    canvas.fill([disc((0.0, y), 0.9)], INK)


def paint_label():
    """60 x 40 units, wrapped around a third of the bottle."""
    canvas = Canvas(900, 600, 60.0, PAPER)
    old_paper(canvas)
    for inset, width in ((1.6, 0.7), (2.9, 0.22)):
        outline = rounded_box(30.0 - inset, 20.0 - inset, 2.2)
        canvas.stroke(outline + outline[:1], width, INK)
    for sx in (-1, 1):
        for sy in (-1, 1):
            corner = (sx * 25.6, sy * 15.6)
            canvas.fill([sector(corner, 0.0, 1.9, k * math.pi / 2, k * math.pi / 2 + 0.9)
                         for k in range(4)], INK)
    flourish(canvas, 13.0, 1.0)
    canvas.fill(word("DRINK", 11.0, (0.0, 3.6)), INK)
    canvas.fill(word("ME", 9.6, (0.0, -9.4)), INK)
    for side in (-1, 1):
        canvas.stroke([(side * 12.5, -9.4), (side * 23.5, -9.4)], 0.8, INK, taper=True)
        canvas.stroke(arc((side * 17.5, -9.4), 2.2, 0.0, 2 * math.pi), 0.4, INK)
    for row in canvas.rows:                                   # ink a little worn
        for column, pixel in enumerate(row):
            row[column] = mix(pixel, PAPER, 0.06)
    canvas.save("drink_me")
