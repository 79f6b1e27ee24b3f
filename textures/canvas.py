# SPDX-License-Identifier: GPL-3.0-or-later
"""A small vector painter: filled polygons and strokes with soft edges.

Coordinates are those of the drawing (for a card: millimetres about its centre, y upwards); the
canvas knows how many pixels a unit is.
"""

import math

from tools import FOLDER, mix, to_byte, write_png

SUB_ROWS = 4                            # coverage: exact along x, this many samples along y


class Canvas:
    def __init__(self, width, height, units_wide, ground):
        self.width, self.height = width, height
        self.scale = width / units_wide
        self.rows = [[ground] * width for _ in range(height)]

    def fill(self, outlines, colour, strength=1.0):
        """Fills the union of outlines that all turn the same way (see `turned_left`)."""
        edges = [edge for outline in outlines for edge in self._edges(outline)]
        if not edges:
            return
        first = max(0, math.floor(min(edge[1] for edge in edges)))
        last = min(self.height, math.ceil(max(edge[3] for edge in edges)))
        buckets = [[] for _ in range(first, last)]
        for edge in edges:
            for row in range(max(first, math.floor(edge[1])), min(last, math.ceil(edge[3]))):
                buckets[row - first].append(edge)
        for row, bucket in enumerate(buckets, first):
            if bucket:
                self._fill_row(row, bucket, colour, strength)

    def stroke(self, points, width, colour, strength=1.0, taper=False):
        """A line through `points` with round ends; with `taper` it thins out towards both."""
        self.fill(stroke_outlines(points, width, taper), colour, strength)

    def save(self, name):
        write_png(FOLDER / f"{name}.png", self.width, self.height,
                  [bytes(to_byte(c) for pixel in row for c in pixel) for row in self.rows], 3)

    def _edges(self, outline):
        """(x at top, top, x at bottom, bottom, direction) in pixels, rows downwards."""
        pixels = [(self.width / 2.0 + x * self.scale, self.height / 2.0 - y * self.scale)
                  for x, y in outline]
        for (x0, y0), (x1, y1) in zip(pixels, pixels[1:] + pixels[:1]):
            if y0 < y1:
                yield x0, y0, x1, y1, 1
            elif y1 < y0:
                yield x1, y1, x0, y0, -1

    def _fill_row(self, row, edges, colour, strength):
        cover = {}
        for sub in range(SUB_ROWS):
            y = row + (sub + 0.5) / SUB_ROWS
            crossings = sorted((x0 + (x1 - x0) * (y - y0) / (y1 - y0), turn)
                               for x0, y0, x1, y1, turn in edges if y0 <= y < y1)
            winding, start = 0, 0.0
            for x, turn in crossings:
                if winding == 0:
                    start = x
                winding += turn
                if winding == 0:
                    self._add_span(cover, max(start, 0.0), min(x, float(self.width)))
        pixels = self.rows[row]
        for x, amount in cover.items():
            pixels[x] = mix(pixels[x], colour, min(1.0, amount / SUB_ROWS) * strength)

    @staticmethod
    def _add_span(cover, start, end):
        for x in range(int(start), math.ceil(end)):
            cover[x] = cover.get(x, 0.0) + min(end, x + 1.0) - max(start, float(x))


# ----------------------------------------------------------------------------------- shapes

def turned_left(outline):
    """The outline, counter-clockwise."""
    area = sum(x0 * y1 - x1 * y0
               for (x0, y0), (x1, y1) in zip(outline, outline[1:] + outline[:1]))
    return outline if area >= 0.0 else outline[::-1]


def polar(centre, radius, angle):
    return centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)


def arc(centre, radius, start, end, steps=24):
    return [polar(centre, radius, start + (end - start) * k / steps) for k in range(steps + 1)]


def disc(centre, radius, steps=20):
    return arc(centre, radius, 0.0, 2.0 * math.pi, steps)[:-1]


def sector(centre, inner, outer, start, end, steps=24):
    return turned_left(arc(centre, outer, start, end, steps)
                       + arc(centre, inner, end, start, steps))


def drop(centre, along, length, width):
    """A leaf or tear whose point is at `centre` and whose round end lies towards angle `along`."""
    points = []
    for k in range(17):
        angle = math.pi * (k / 8.0 - 1.0)
        reach = 0.5 * (1.0 + math.cos(angle))
        side = 0.5 * width * math.sin(angle) * math.sqrt(reach)
        x, y = reach * length, side
        points.append((centre[0] + x * math.cos(along) - y * math.sin(along),
                       centre[1] + x * math.sin(along) + y * math.cos(along)))
    return turned_left(points)


def rounded_box(half_width, half_height, radius):
    points = []
    for corner, (sx, sy) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        centre = sx * (half_width - radius), sy * (half_height - radius)
        points += arc(centre, radius, corner * math.pi / 2.0, (corner + 1) * math.pi / 2.0, 10)
    return points


def stroke_outlines(points, width, taper=False):
    """Quadrilaterals and joints that together are the line."""
    count = len(points)
    if taper:
        half = [0.5 * width * math.sin(math.pi * (0.04 + 0.92 * k / max(1, count - 1)))
                for k in range(count)]
    else:
        half = [0.5 * width] * count
    outlines = [disc(point, radius, 10) for point, radius in zip(points, half)]
    for (x0, y0), (x1, y1), h0, h1 in zip(points, points[1:], half, half[1:]):
        length = math.hypot(x1 - x0, y1 - y0)
        if length > 1e-9:
            nx, ny = (y0 - y1) / length, (x1 - x0) / length
            outlines.append(turned_left([(x0 + nx * h0, y0 + ny * h0), (x1 + nx * h1, y1 + ny * h1),
                                         (x1 - nx * h1, y1 - ny * h1),
                                         (x0 - nx * h0, y0 - ny * h0)]))
    return outlines
