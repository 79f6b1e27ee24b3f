# SPDX-License-Identifier: GPL-3.0-or-later
"""The rabbit's portrait in a small standing frame. In the dream the sheet is blank: he is out."""

import bpy
import shapes
from parts import degrees

from .layout import PHOTOGRAPH

SHEET = (0.105, 0.140)
MOUNT = 0.010
RAIL = 0.014


def build(looks):
    stand = bpy.data.objects.new("Portrait", None)
    bpy.context.scene.collection.objects.link(stand)
    opening = (SHEET[0] + 2.0 * MOUNT, SHEET[1] + 2.0 * MOUNT)
    height = opening[1] + 2.0 * RAIL
    stand.location = (*PHOTOGRAPH, 0.5 * height)
    stand.rotation_euler = degrees(-9, 0, -22)
    upright = {"rotation": degrees(90, 0, 0)}
    profile = shapes.smooth_profile(
        [(-0.002, -0.006), (-0.002, 0.002), (-0.002, 0.002), (0.0015, 0.005), (0.004, 0.003),
         (0.004, 0.003), (0.008, 0.008), (0.012, 0.007), (0.014, 0.003), (0.014, 0.003),
         (0.014, -0.006)], steps=4)
    sheet = shapes.plane("Engraving", SHEET, looks.engraving, location=(0.0, -0.0006, 0.0),
                         **upright)
    if hasattr(sheet, "tenniel"):
        sheet.tenniel.behind_material = looks.mount
    pieces = [shapes.plane("Mount", opening, looks.mount, **upright), sheet,
              shapes.frame("Portrait frame", opening, profile, looks.old_gold),
              shapes.box("Portrait back", (opening[0] + 0.02, 0.003, opening[1] + 0.02),
                         looks.walnut, bevel=0.0008, location=(0.0, 0.0075, 0.0)),
              shapes.box("Strut", (0.030, 0.003, 0.15), looks.walnut, bevel=0.0008,
                         location=(0.0, 0.034, -0.014), rotation=degrees(18, 0, 0))]
    for piece in pieces:
        piece.parent = stand
