# SPDX-License-Identifier: GPL-3.0-or-later
"""The country behind the mirror: a chessboard from the table's edge to the hills, and a moon."""

import parts
import shapes

from .layout import seen_at

BOARD_SQUARE = 0.13


def build(looks):
    board()
    hills()
    moon()


def board():
    material, nodes = parts.new_material("Board")
    checker = nodes.add("TexChecker", {"Vector": nodes.add("TexCoord").outputs["Object"],
                                       "Color1": (0.84, 0.66, 0.38), "Color2": (0.02, 0.15, 0.17),
                                       "Scale": 1.0 / BOARD_SQUARE})
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": checker, "Roughness": 0.34,
                                               "Specular": 0.25}))
    plane = shapes.plane("Board", (40.0, 24.0), material, location=(0.0, -12.82, -0.001))
    parts.send_behind_mirror(plane)


def hills():
    """Round hills, the farther the bluer."""
    for x, y, radius, height, color in (
            (-5.0, -15.0, 4.8, 0.50, (0.05, 0.16, 0.10)),
            (2.8, -16.0, 5.2, 0.45, (0.06, 0.18, 0.09)),
            (-1.4, -20.5, 5.5, 0.78, (0.05, 0.12, 0.16)),
            (5.5, -22.0, 6.0, 0.95, (0.06, 0.11, 0.18))):
        look = parts.diffuse("Hill", color)
        hill = shapes.sphere("Hill", 1.0, look, 96, location=(x, y, -0.05))
        hill.scale = (radius, radius, height)
        parts.send_behind_mirror(hill)


def moon():
    """Larger than any real one, it rises behind the rabbit's ears; its seas are noise."""
    material, nodes = parts.new_material("Moon")
    seas = nodes.add("TexNoise", {"Vector": nodes.add("TexCoord").outputs["Object"], "Scale": 0.9,
                                  "Detail": 5.0})
    color = nodes.add("ValToRGB", {"Fac": seas})
    first, last = color.color_ramp.elements
    first.position, first.color = 0.40, (0.80, 0.40, 0.13, 1.0)
    last.position, last.color = 0.58, (1.0, 0.68, 0.28, 1.0)
    nodes.surface(nodes.add("Emission", {"Color": color, "Strength": 0.85}))
    disc = shapes.sphere("Moon", 1.4, material, 96, location=seen_at(0.066, 0.333, -30.0))
    parts.send_behind_mirror(disc)
