# SPDX-License-Identifier: GPL-3.0-or-later
"""Wallpaper: palmettes in a net of ogees, tone on tone, in half drop. The tile is 100 x 100."""

import math

from canvas import Canvas, disc, drop
from tools import fbm

GROUND = (0.105, 0.190, 0.175)
LEAF = (0.175, 0.285, 0.250)
LIGHT = (0.255, 0.375, 0.315)


class Tiled:
    """Draws around every point of the half drop, and over the edges of the tile."""

    def __init__(self, canvas):
        self.canvas = canvas
        self.places = [(x, y) for x in (-50.0, 50.0) for y in (-50.0, 50.0)] + [(0.0, 0.0)]
        self.places += [(x, y) for x in (-100.0, 0.0, 100.0) for y in (-100.0, 0.0, 100.0)
                        if (x, y) != (0.0, 0.0)]

    def fill(self, outlines, colour):
        for dx, dy in self.places:
            moved = [[(x + dx, y + dy) for x, y in outline] for outline in outlines]
            if any(abs(x) < 56.0 and abs(y) < 56.0 for outline in moved for x, y in outline):
                self.canvas.fill(moved, colour)

    def stroke(self, points, width, colour, taper=False):
        for dx, dy in self.places:
            self.canvas.stroke([(x + dx, y + dy) for x, y in points], width, colour, taper=taper)


def palmette(pen):
    base = (0.0, -13.0)
    for k in range(11):
        bend = (k - 5) / 5.0
        angle = math.pi / 2.0 + 1.45 * bend
        length = 31.0 * (1.0 - 0.42 * bend * bend)
        pen.fill([drop(base, angle, length, 6.4)], LEAF)
        vein = [(base[0] + t * length * math.cos(angle), base[1] + t * length * math.sin(angle))
                for t in (0.30, 0.55, 0.84)]
        pen.stroke(vein, 0.9, LIGHT, taper=True)
    pen.fill([drop((0.0, -15.0), math.pi / 2.0, 13.0, 7.0)], LIGHT)
    pen.fill([drop((0.0, -12.5), math.pi / 2.0, 8.0, 3.6)], GROUND)
    for side in (-1.0, 1.0):
        start = math.pi / 2.0 - side * math.pi / 2.0
        curl = [(side * 9.0 + (6.5 - 0.55 * k) * math.cos(start + math.pi + side * 0.55 * k),
                 -20.0 + (6.5 - 0.55 * k) * math.sin(start + math.pi + side * 0.55 * k))
                for k in range(11)]
        pen.stroke(curl, 1.5, LIGHT)
        pen.fill([drop((side * 2.0, -21.0), math.pi / 2.0 + side * 2.1, 13.0, 4.6)], LEAF)
    pen.fill([disc((0.0, -18.5), 1.9)], LIGHT)


def net(pen):
    """Stems that swing between the palmettes, with a leaf at every turn and berries."""
    for side in (-1.0, 1.0):
        stem = [(side * (25.0 + 19.0 * math.cos(2.0 * math.pi * y / 100.0)), float(y))
                for y in range(-50, 51, 2)]
        pen.stroke(stem, 1.7, LEAF)
        for y in (-36.0, -14.0, 14.0, 36.0):
            x = side * (25.0 + 19.0 * math.cos(2.0 * math.pi * y / 100.0))
            slope = -side * 19.0 * 2.0 * math.pi / 100.0 * math.sin(2.0 * math.pi * y / 100.0)
            along = math.atan2(1.0, slope)
            for turn in (-0.62, 0.62):
                pen.fill([drop((x, y), along + turn, 9.0, 3.6)], LEAF)
            pen.fill([disc((x, y), 1.25)], LIGHT)


def paint_wallpaper():
    canvas = Canvas(768, 768, 100.0, GROUND)
    pen = Tiled(canvas)
    net(pen)
    palmette(pen)
    for row, pixels in enumerate(canvas.rows):              # the grain of the paper
        for column, pixel in enumerate(pixels):
            grain = 0.94 + 0.12 * fbm(column / 768.0, row / 768.0, 96, 12, 2, 17)
            pixels[column] = tuple(c * grain for c in pixel)
    canvas.save("wallpaper")
