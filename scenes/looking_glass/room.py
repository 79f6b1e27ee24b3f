# SPDX-License-Identifier: GPL-3.0-or-later
"""The table, the wall, and what an ordinary mirror shows of the room."""

import parts
import shapes
from parts import degrees

FAR = -3.0                             # the wall behind the camera


def build(looks):
    shapes.box("Table", (1.9, 1.30, 0.04), looks.table, bevel=0.006,
               location=(0.0, -0.17, -0.02))
    wall = shapes.plane("Wall", (3.4, 1.7), looks.wallpaper, location=(0.0, 0.50, 0.55),
                        rotation=degrees(90, 0, 0))
    parts.keep_on_this_side(wall)          # it would shut the dream in


def build_opposite(looks):
    """The far end of the room: a window between its curtains over a panelled sill, and pictures."""
    middle, sill = -0.35, 0.10
    shapes.plane("Far wall", (3.2, 1.6), looks.wallpaper, location=(0.0, FAR, 0.2),
                 rotation=degrees(90, 0, 180))
    shapes.plane("Daylight", (0.62, 0.9), daylight(), location=(middle, FAR + 0.01, sill + 0.45),
                 rotation=degrees(90, 0, 180))
    frame = parts.principled("Window frame", (0.72, 0.69, 0.62), 0.35)
    for k in range(4):
        shapes.box("Upright", (0.03, 0.04, 0.9), frame,
                   location=(middle + 0.2 * (k - 1.5), FAR + 0.03, sill + 0.45))
        shapes.box("Crossbar", (0.62, 0.04, 0.03), frame,
                   location=(middle, FAR + 0.03, sill + 0.22 * k))
    shapes.box("Sill", (0.9, 0.14, 0.04), frame, location=(middle, FAR + 0.06, sill - 0.02))
    shapes.box("Panelling", (3.2, 0.03, 0.5), looks.walnut, location=(0.0, FAR + 0.01, -0.30))
    velvet = parts.principled("Curtain", (0.30, 0.03, 0.035), 0.8, sheen=0.6)
    for side in (-1.0, 1.0):
        for k in range(5):
            shapes.lathe("Fold", [(0.034, 0.0), (0.026, 0.6), (0.034, 1.2)], velvet, segments=24,
                         location=(middle + side * (0.32 + 0.05 * k), FAR + 0.09, sill - 0.15))
    for x, z, size in ((0.30, 0.56, (0.22, 0.18)), (0.31, 0.24, (0.18, 0.24))):
        shapes.plane("Picture", size, looks.engraving, location=(x, FAR + 0.02, z),
                     rotation=degrees(90, 0, 180))
        shapes.frame("Picture frame", size, [(0.0, -0.02), (0.0, 0.015), (0.02, 0.03),
                                             (0.035, 0.01), (0.035, -0.02)], looks.old_gold,
                     location=(x, FAR + 0.02, z), rotation=degrees(0, 0, 180))


def daylight():
    """The sky behind the panes, brighter towards the top."""
    material, nodes = parts.new_material("Daylight")
    height = nodes.add("SeparateXYZ", {0: nodes.add("TexCoord").outputs["UV"]}).outputs["Y"]
    color = nodes.add("MixRGB", {"Fac": height, "Color1": (1.0, 0.80, 0.55),
                                 "Color2": (0.62, 0.78, 1.0)})
    nodes.surface(nodes.add("Emission", {"Color": color, "Strength": 1.4}))
    return material
