# SPDX-License-Identifier: GPL-3.0-or-later
"""Exhibits of the looking glass; Cycles has none."""

import bpy
import parts
import shapes

from . import exhibit, stage
from .metals import metal

HERE, THERE = (0.45, 0.05, 0.04), (0.06, 0.22, 0.42)


def looking_glass(name, location, size=(2.0, 1.5), turn=0.0, roughness=0.0, dream=1):
    """An upright mirror that faces -Y and shows a dream."""
    material = parts.shader(f"{name} Silver", "BsdfGlossy",
                            {"Color": (0.94, 0.95, 0.94), "Roughness": roughness},
                            distribution='GGX')
    glass = shapes.plane(name, size, material, location=location,
                         rotation=parts.degrees(90, 0, turn))
    parts.make_looking_glass(glass)
    glass.tenniel.dream = dream
    rail = parts.principled("Frame", (0.20, 0.09, 0.03), 0.3, clearcoat=0.6)
    shapes.frame(f"{name} Frame", size, [(0.0, -0.03), (0.0, 0.03), (0.04, 0.06), (0.09, 0.03),
                                         (0.09, -0.03)], rail, location=location,
                 rotation=parts.degrees(0, 0, turn))
    return glass


def swapped_pawns(places):
    """At each place a red pawn on this side and a blue one behind the mirror."""
    here, there = parts.principled("Red", HERE, 0.25), parts.principled("Blue", THERE, 0.25)
    for x, y in places:
        stage.pawn(here, x, y, size=0.7)
    bpy.context.view_layer.update()
    for item in [item for item in bpy.context.scene.objects if item.name.startswith("Pawn")]:
        if item.data.materials[0] == here:
            item.tenniel.behind_material = there


@exhibit("Looking glass", "The red pawn is blue in the mirror, the golden ball has no reflection, "
                          "and the lamp of the dream stands on the table there only.",
         in_cycles=False)
def mirror_direct():
    stage.studio(3.4, 0.78, light=0.6)
    looking_glass("Mirror", (0.0, 1.0, 0.82))
    swapped_pawns([(-0.55, 0.0)])
    ball = shapes.sphere("Vampire", 0.26, metal("Gold", 0.15), location=(0.25, -0.1, 0.26))
    parts.keep_on_this_side(ball)
    lamp = shapes.sphere("Glow", 0.13, parts.emission("Glow", (1.0, 0.55, 0.2), 9.0),
                         location=(0.62, 0.25, 0.62))
    stand = shapes.lathe("Stand", [(0.0, 0.0), (0.16, 0.0), (0.16, 0.03), (0.02, 0.05),
                                   (0.02, 0.5), (0.0, 0.5)],
                         parts.principled("Brass", (0.7, 0.45, 0.15), 0.3, metallic=1.0),
                         location=(0.62, 0.25, 0.0))
    parts.send_behind_mirror(lamp, stand)


@exhibit("Mirror in mirror", "Two looking glasses face each other and toggle: in every other image "
                             "the pawns are those of this side.", in_cycles=False)
def mirror_nested():
    stage.studio(3.0, 0.55, light=0.8)
    for name, y, turn in (("Back", 1.1, 0.0), ("Front", -1.7, 180.0)):
        glass = looking_glass(name, (0.0, y, 0.78 if turn == 0.0 else 0.5),
                              (2.4, 1.4) if turn == 0.0 else (2.4, 0.9), turn)
        glass.tenniel.reenter = 'TOGGLE'
    swapped_pawns([(-0.5, -0.1), (0.5, -0.1)])
    parts.camera((0.75, -1.45, 1.35), (-0.15, 0.9, 0.62), focal_length=28.0)


@exhibit("Rough mirrors", "Roughness 0.1, 0.25 and 0.45: the dream blurs as any reflection does, "
                          "with its own light.", in_cycles=False)
def mirror_rough():
    stage.studio(3.6, 0.62, light=0.8)
    for roughness, x in zip((0.1, 0.25, 0.45), stage.row(3, 1.12)):
        looking_glass(f"Mirror {roughness}", (x, 0.75, 0.72), (0.9, 1.25), 0.0, roughness)
    swapped_pawns([(x, 0.15) for x in stage.row(3, 1.12)])


@exhibit("Two dreams", "Two looking glasses, two worlds: day in one, a night with glowing balls in "
                       "the other.", in_cycles=False)
def mirror_two_dreams():
    stage.studio(3.6, 0.65, light=0.7)
    scene = bpy.context.scene
    own = scene.world
    for name, color in (("Day", (0.45, 0.70, 1.0)), ("Night", (0.02, 0.02, 0.08))):
        dream = scene.tenniel.dreams.add()
        dream.name, dream.world = name, parts.set_world_color(color)
    scene.world = own
    looking_glass("Day Glass", (-0.85, 0.9, 0.85), (1.35, 1.5), 14.0, dream=1)
    looking_glass("Night Glass", (0.85, 0.9, 0.85), (1.35, 1.5), -14.0, dream=2)
    backdrop = scene.objects["Backdrop"]
    parts.keep_on_this_side(backdrop)
    for lamp in ("Key", "Rim", "Strip"):
        scene.objects[lamp].tenniel.side = 'THIS_SIDE'
    meadow = shapes.plane("Meadow", (40.0, 40.0), parts.diffuse("Grass", (0.10, 0.30, 0.05)),
                          location=(0.0, 0.0, 0.0))
    marble = shapes.plane("Marble", (40.0, 40.0), parts.principled("Marble", (0.3, 0.3, 0.35), 0.2),
                          location=(0.0, 0.0, 0.0))
    for item, number in ((meadow, '1'), (marble, '2')):
        item.tenniel.side, item.tenniel.dreams = 'BEHIND', {number}
    for index, (x, y) in enumerate(((-0.2, -0.6), (0.35, -1.1), (0.8, -0.3), (0.1, 0.2))):
        color = ((1.0, 0.4, 0.15), (0.3, 0.7, 1.0), (1.0, 0.8, 0.3), (0.7, 0.3, 1.0))[index]
        glow = shapes.sphere("Glow", 0.14, parts.emission("Glow", color, 5.0),
                             location=(x, y, 0.35 + 0.2 * index))
        glow.tenniel.side, glow.tenniel.dreams = 'BEHIND', {'2'}
    swapped_pawns([(0.0, 0.2)])
