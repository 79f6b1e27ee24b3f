# SPDX-License-Identifier: GPL-3.0-or-later
"""Playing cards as they were printed about 1885: a back of open fans, faces without corner marks.

Lengths are millimetres about the middle of a card of 64 x 90.
"""

import math

from canvas import Canvas, arc, disc, drop, polar, rounded_box, sector, turned_left

CARD = (64.0, 90.0)
PAPER = (0.93, 0.895, 0.80)
INDIGO = (0.075, 0.125, 0.33)
RED = (0.62, 0.06, 0.06)
BLACK = (0.045, 0.045, 0.055)


# ------------------------------------------------------------------------------------- back

class Symmetric:
    """Draws everything twice: as told, and turned by half a turn."""

    def __init__(self, canvas):
        self.canvas = canvas

    def fill(self, outlines, colour):
        self.canvas.fill(outlines, colour)
        self.canvas.fill([[(-x, -y) for x, y in outline] for outline in outlines], colour)

    def stroke(self, points, width, colour):
        self.canvas.stroke(points, width, colour)
        self.canvas.stroke([(-x, -y) for x, y in points], width, colour)


def draw_fan(pen, pivot, radius, towards, spread, leaves):
    """An open fan: sticks up to 0.45 of the radius, above them the painted leaf with its rim."""
    low, high = towards - spread, towards + spread
    step = (high - low) / leaves
    pen.fill([sector(pivot, 0.0, radius * 1.09, low - 0.06, high + 0.06, 40)], INDIGO)
    rim = [disc(polar(pivot, radius * 0.985, low + (k + 0.5) * step), 0.5 * step * radius)
           for k in range(leaves)]
    pen.fill(rim, PAPER)
    pen.fill([sector(pivot, radius * 0.44, radius, low, high, 48)], PAPER)
    pen.fill([disc(polar(pivot, radius * 0.99, low + (k + 0.5) * step), 0.24 * step * radius)
              for k in range(leaves)], INDIGO)
    for share, width in ((0.47, 0.16), (0.50, 0.30), (0.86, 0.30), (0.89, 0.14)):
        pen.stroke(arc(pivot, radius * share, low, high, 40), width, INDIGO)
    for k in range(leaves + 1):
        angle = low + k * step
        pen.stroke([polar(pivot, radius * 0.44, angle), polar(pivot, radius * 0.98, angle)], 0.16,
                   INDIGO)
    for k in range(leaves):
        angle = low + (k + 0.5) * step
        width = 0.62 * step * radius
        pen.fill([drop(polar(pivot, radius * 0.53, angle), angle, radius * 0.21, width * 0.70)],
                 INDIGO)
        pen.fill([drop(polar(pivot, radius * 0.60, angle), angle, radius * 0.10, width * 0.28)],
                 PAPER)
        pen.fill([disc(polar(pivot, radius * 0.80, angle), 0.18 * width)], INDIGO)
        stick = drop(polar(pivot, radius * 0.10, angle), angle, radius * 0.33, width * 0.42)
        pen.fill([stick], PAPER)
        pen.fill([disc(polar(pivot, radius * 0.36, angle), 0.07 * width)], INDIGO)
    for angle in (low, high):
        pen.stroke([pivot, polar(pivot, radius * 1.02, angle)], 0.55, PAPER)


def draw_rosette(canvas, centre, radius):
    petals = 16
    canvas.fill([disc(centre, radius * 1.16, 48)], INDIGO)
    canvas.fill([disc(polar(centre, radius, 2.0 * math.pi * k / petals), 0.19 * radius)
                 for k in range(petals)], PAPER)
    canvas.fill([disc(centre, radius, 48)], PAPER)
    for k in range(petals):
        angle = 2.0 * math.pi * (k + 0.5) / petals
        canvas.fill([drop(polar(centre, radius * 0.42, angle), angle, radius * 0.50,
                          radius * 0.22)], INDIGO)
    canvas.fill([disc(centre, radius * 0.40, 32)], INDIGO)
    for k in range(8):
        angle = 2.0 * math.pi * k / 8
        canvas.fill([drop(polar(centre, radius * 0.05, angle), angle, radius * 0.30,
                          radius * 0.17)], PAPER)


def draw_ground(canvas):
    """The frame, and a field of stippled ogees."""
    canvas.fill([rounded_box(28.9, 41.9, 2.6)], INDIGO)
    canvas.fill([rounded_box(28.4, 41.4, 2.3)], PAPER)
    canvas.fill([rounded_box(27.9, 40.9, 2.0)], INDIGO)
    for half, fixed, upright in ((26.0, 39.6, False), (39.0, 26.6, True)):
        count = round(2.0 * half / 1.3)
        for k in range(count + 1):
            t = -half + 2.0 * half * k / count
            for sign in (-1.0, 1.0):
                spot = (sign * fixed, t) if upright else (t, sign * fixed)
                canvas.fill([disc(spot, 0.42, 12)], PAPER)
    for row in range(-25, 26):
        for column in range(-17, 18):
            x, y = column * 1.5 + 0.75 * (row % 2), row * 1.5
            if abs(x) < 24.6 and abs(y) < 37.6:
                canvas.fill([disc((x, y), 0.22 if (row + column) % 3 else 0.36, 8)], PAPER)


def paint_back():
    canvas = Canvas(832, 1170, CARD[0], PAPER)
    draw_ground(canvas)
    pen = Symmetric(canvas)
    quarter = math.pi / 2.0
    draw_fan(pen, (24.9, 37.9), 15.0, -3 * math.pi / 4, 0.5 * quarter, 7)
    draw_fan(pen, (-24.9, 37.9), 15.0, -math.pi / 4, 0.5 * quarter, 7)
    draw_fan(pen, (24.9, 0.0), 10.2, math.pi, 0.94 * quarter, 9)
    draw_fan(pen, (0.0, 2.5), 26.0, quarter, 1.08, 13)
    draw_rosette(canvas, (0.0, 0.0), 5.6)
    for half_width, half_height, width in ((25.4, 38.4, 0.35), (24.7, 37.7, 0.16)):
        outline = rounded_box(half_width, half_height, 0.6)
        canvas.stroke(outline + outline[:1], width, PAPER)
    canvas.save("card_back")


# ------------------------------------------------------------------------------------- pips

def heart(size):
    points = []
    for k in range(96):
        t = 2.0 * math.pi * k / 96
        points.append((size * math.sin(t) ** 3 * 0.5,
                       size * (13.0 * math.cos(t) - 5.0 * math.cos(2 * t) - 2.0 * math.cos(3 * t)
                               - math.cos(4 * t) + 2.5) / 32.0))
    return [turned_left(points)]


def stem(size):
    side = [(0.02 + 0.14 * t ** 2.6, -0.08 - 0.44 * t) for t in (k / 10 for k in range(11))]
    outline = [(x, y) for x, y in side] + [(-x, y) for x, y in reversed(side)]
    return [turned_left([(x * size, y * size) for x, y in outline])]


def spade(size):
    return [turned_left([(x * 0.96, 0.10 * size - 0.92 * y) for x, y in heart(size)[0]])] \
        + stem(size)


def club(size):
    leaves = [disc((0.0, 0.25 * size), 0.225 * size, 32)]
    leaves += [disc((side * 0.245 * size, -0.06 * size), 0.225 * size, 32) for side in (-1, 1)]
    return leaves + [disc((0.0, 0.04 * size), 0.14 * size)] + stem(size)


def diamond(size):
    points = []
    for sx, sy in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
        side = [(0.40 * (1.0 - t) ** 1.12, 0.5 * t ** 1.12) for t in (k / 8 for k in range(8))]
        side = side if sx == sy else [(0.40 * t ** 1.12, 0.5 * (1.0 - t) ** 1.12)
                                      for t in (k / 8 for k in range(8))]
        points += [(sx * x * size, sy * y * size) for x, y in side]
    return [turned_left(points)]


PIPS = {"hearts": (heart, RED), "spades": (spade, BLACK), "clubs": (club, BLACK),
        "diamonds": (diamond, RED)}
LEFT, RIGHT = -15.5, 15.5
LAYOUTS = {
    1: [(0, 0)],
    2: [(0, 28), (0, -28)],
    3: [(0, 28), (0, 0), (0, -28)],
    5: [(LEFT, 28), (RIGHT, 28), (0, 0), (LEFT, -28), (RIGHT, -28)],
    7: [(LEFT, 28), (RIGHT, 28), (0, 14), (LEFT, 0), (RIGHT, 0), (LEFT, -28), (RIGHT, -28)],
    9: [(x, y) for x in (LEFT, RIGHT) for y in (28, 9.5, -9.5, -28)] + [(0, 0)],
}


def moved(outlines, dx, dy, upside_down):
    sign = -1.0 if upside_down else 1.0
    return [[(dx + sign * x, dy + sign * y) for x, y in outline] for outline in outlines]


def paint_face(suit, number):
    pip, colour = PIPS[suit]
    canvas = Canvas(480, 675, CARD[0], PAPER)
    canvas.fill([rounded_box(29.6, 42.6, 2.6)], tuple(0.75 * c for c in PAPER))
    canvas.fill([rounded_box(29.4, 42.4, 2.5)], PAPER)
    size = 34.0 if number == 1 else 13.5
    for x, y in LAYOUTS[number]:
        canvas.fill(moved(pip(size), x, y, y < 0), colour)
    if number == 1:
        engrave_ace(canvas, pip, size, colour)
    canvas.save(f"card_{suit}_{number}")


def engrave_ace(canvas, pip, size, colour):
    """The great pip carries a smaller one in outline and a little fan of drops."""
    canvas.fill(moved(pip(size * 0.80)[:1], 0.0, 0.3, False), PAPER)
    canvas.fill(moved(pip(size * 0.75)[:1], 0.0, 0.3, False), colour)
    for k in range(7):
        angle = math.pi / 2.0 + (k - 3) * 0.36
        canvas.fill([drop(polar((0.0, -4.2), 2.6, angle), angle, 7.0, 1.9)], PAPER)
    canvas.fill([disc((0.0, -4.2), 1.5)], PAPER)
    canvas.fill([disc((0.0, -4.2), 0.8)], colour)


FACES = (("hearts", 1), ("spades", 1), ("hearts", 7), ("diamonds", 9), ("spades", 3), ("clubs", 2),
         ("clubs", 5), ("clubs", 7))


def paint_cards():
    paint_back()
    for suit, number in FACES:
        paint_face(suit, number)
