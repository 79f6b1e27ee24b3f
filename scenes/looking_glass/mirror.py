# SPDX-License-Identifier: GPL-3.0-or-later
"""The looking glass and its carved frame."""

import bpy
import parts
import shapes
from parts import degrees

from .layout import FRAME_WIDTH, MIRROR_LEAN, OPENING


def build(looks, dreaming):
    """The glass and its carved frame hang on one empty, which leans back a little."""
    stand = bpy.data.objects.new("Mirror", None)
    bpy.context.scene.collection.objects.link(stand)
    stand.location = (0.0, 0.0, FRAME_WIDTH + OPENING[1] / 2.0)
    stand.rotation_euler = degrees(-MIRROR_LEAN, 0, 0)

    glass = shapes.plane("Looking glass", OPENING, looks.mirror, location=(0.0, -0.004, 0.0),
                         rotation=degrees(90, 0, 0))
    if dreaming:
        parts.make_looking_glass(glass)
    profile = shapes.smooth_profile(
        [(-0.003, -0.012), (-0.003, 0.004), (-0.003, 0.004), (0.002, 0.010), (0.007, 0.006),
         (0.007, 0.006), (0.013, 0.009), (0.022, 0.021), (0.033, 0.025), (0.042, 0.020),
         (0.046, 0.013), (0.046, 0.013), (0.050, 0.011), (0.050, -0.012)], steps=4)
    pieces = [glass, shapes.frame("Frame", OPENING, profile, looks.walnut),
              shapes.box("Mirror back", (0.59, 0.006, 0.46), looks.walnut,
                         location=(0.0, 0.012, 0.0))]
    pieces += frame_rosettes(looks)
    parts.keep_on_this_side(*pieces[1:])   # they would throw their shadow into the dream
    pieces += frame_beads(looks)
    for piece in pieces:
        piece.parent = stand


def frame_beads(looks):
    """A row of beads around the opening; one mesh, many objects."""
    bead = shapes.sphere("Bead", 0.0042, looks.old_gold, segments=16)
    spots = around_opening(0.0045, 0.0107)
    bead.location = (spots[0][0], -0.0085, spots[0][1])
    return [bead] + [shapes.copy_of(bead, (x, -0.0085, z)) for x, z in spots[1:]]


def frame_rosettes(looks):
    """Carved flowers along the frame and brass rosettes on its corners."""
    half_width = OPENING[0] / 2.0 + 0.5 * FRAME_WIDTH + 0.002
    half_height = OPENING[1] / 2.0 + 0.5 * FRAME_WIDTH + 0.002
    corner = shapes.rosette("Corner", 0.034, 8, 0.015, looks.gold,
                            location=(-half_width, -0.020, -half_height))
    made = [corner]
    made += [shapes.copy_of(corner, (sx * half_width, -0.020, sz * half_height))
             for sx, sz in ((1, -1), (1, 1), (-1, 1))]
    flower = None
    for x, z in around_opening(0.031, 0.0465):
        if abs(x) > half_width - 0.045 and abs(z) > half_height - 0.045:
            continue
        if flower is None:
            flower = shapes.rosette("Flower", 0.0135, 6, 0.006, looks.old_gold)
            flower.location = (x, -0.024, z)
            made.append(flower)
        else:
            made.append(shapes.copy_of(flower, (x, -0.024, z)))
    made.append(shapes.rosette("Crest", 0.044, 12, 0.022, looks.gold,
                               location=(0.0, -0.018, half_height + 0.016)))
    return made


def around_opening(outwards, spacing):
    """Points (x, z) at even steps around the opening, `outwards` from its edge."""
    half_width, half_height = OPENING[0] / 2.0 + outwards, OPENING[1] / 2.0 + outwards
    points = []
    for half, other, swap in ((half_width, half_height, False), (half_height, half_width, True)):
        count = round(2.0 * half / spacing)
        for k in range(count if not swap else count - 1):
            t = -half + 2.0 * half * (k + (0.0 if not swap else 1.0)) / count
            points += [(other, t), (-other, t)] if swap else [(t, other), (-t, -other)]
    return points
