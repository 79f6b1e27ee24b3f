# SPDX-License-Identifier: GPL-3.0-or-later
"""The table and the wall."""

import parts
import shapes
from parts import degrees


def build(looks):
    shapes.box("Table", (1.9, 1.30, 0.04), looks.table, bevel=0.006,
               location=(0.0, -0.17, -0.02))
    wall = shapes.plane("Wall", (3.4, 1.7), looks.wallpaper, location=(0.0, 0.50, 0.55),
                        rotation=degrees(90, 0, 0))
    parts.keep_on_this_side(wall)          # it would shut the dream in
