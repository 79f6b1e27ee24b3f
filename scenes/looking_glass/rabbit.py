# SPDX-License-Identifier: GPL-3.0-or-later
"""The White Rabbit, out of his engraving: late, and looking out at us. In centimetres, facing +Y,
under one scaled empty; every surface but his watch is cut in lines, his clothes tinted by hand."""

import bpy
import parts
import shapes
from mathutils import Euler, Vector
from parts import degrees

PLACE, SIZE, TURN = (0.018, -0.80, 0.0), 0.0137, -4.0
NECK, HEAD = Vector((0.0, 1.2, 16.2)), 1.2   # the head is larger than life


def build(looks):
    pieces = body(looks) + clothes(looks) + face(looks) + watch(looks)
    root = bpy.data.objects.new("Rabbit root", None)
    bpy.context.scene.collection.objects.link(root)
    root.location = PLACE
    root.rotation_euler = degrees(0, 0, TURN)
    root.scale = (SIZE, SIZE, SIZE)
    for piece in pieces:
        piece.parent = root
    parts.send_behind_mirror(*pieces)


def turned(*angles):
    return Euler(degrees(*angles)).to_quaternion()


def of_head(x, y, z):
    """A place on the head as drawn small, on the head as it is."""
    return NECK + HEAD * (Vector((x, y, z)) - NECK)


def body(looks):
    """Fur: feet, legs, head, ears, paws and tail melted into one."""
    balls = [((0, 0.4, 9.0), (4.0, 3.7, 6.5), None), ((0, 1.0, 15.2), (2.4, 2.4, 3.0), None),
             ((0, -4.6, 5.4), (1.9, 1.9, 1.9), None),
             ((-4.1, 4.9, 11.6), (1.15, 1.25, 1.15), None),
             ((3.5, 5.6, 13.4), (1.15, 1.25, 1.15), None)]
    head = [((0, 1.9, 19.6), (3.7, 4.0, 3.6), None), ((0, 4.9, 18.6), (2.0, 2.0, 1.7), None)]
    for side in (-1, 1):
        balls += [((side * 2.3, 2.4, 1.1), (1.35, 3.9, 1.15), None),
                  ((side * 2.5, 0.2, 4.2), (2.3, 2.9, 3.6), turned(12, 0, 0))]
        head += [((side * 1.5, 4.4, 18.0), (1.55, 1.7, 1.45), None),
                 ((side * 1.9, 0.7, 26.0), (1.25, 0.62, 4.6), turned(4, side * 10, side * -12)),
                 ((side * 1.6, 0.9, 22.6), (0.95, 0.7, 1.6), None)]
    balls += [(of_head(*centre), HEAD * Vector(radii), turn) for centre, radii, turn in head]
    made = [shapes.blend_of_spheres("Rabbit", balls, looks.fur, voxel=0.24)]
    for side in (-1, 1):
        inner = shapes.sphere("Inner ear", HEAD, looks.ear, 48,
                              location=of_head(side * 1.95, 1.18, 25.9))
        inner.scale = (0.62, 0.30, 3.5)
        inner.rotation_euler = degrees(4, side * 10, side * -12)
        made.append(inner)
    return made


def clothes(looks):
    """A coat open at the front, sleeves, a waistcoat with buttons, a collar and a bow."""
    coat = [((0, -0.5, 11.6), (4.4, 4.0, 5.0), None), ((0, -1.9, 7.6), (4.3, 3.1, 4.6), None)]
    for side in (-1, 1):
        coat += [((side * 3.5, 0.3, 14.2), (1.7, 1.8, 1.9), None),
                 ((side * 3.0, 1.1, 10.0), (1.75, 2.9, 4.6), turned(0, side * -5, 0)),
                 ((side * 2.6, -1.9, 4.6), (1.9, 1.7, 2.9), turned(-10, side * 8, 0))]
    coat += [((-4.6, 1.4, 12.4), (1.45, 1.6, 2.7), turned(-38, 0, 0)),
             ((-4.4, 3.5, 11.4), (1.4, 2.2, 1.4), turned(-4, 0, -14)),
             ((4.6, 1.5, 12.5), (1.45, 1.6, 2.7), turned(-38, 0, 0)),
             ((4.1, 3.7, 12.4), (1.4, 2.5, 1.4), turned(26, 0, 16))]
    made = [shapes.blend_of_spheres("Coat", coat, looks.coat, voxel=0.22)]
    waistcoat = [((0, 1.45, 11.4), (3.1, 3.1, 4.4), None), ((0, 1.6, 8.8), (2.9, 3.0, 2.4), None)]
    made.append(shapes.blend_of_spheres("Waistcoat", waistcoat, looks.waistcoat, voxel=0.2))
    for side in (-1, 1):
        lapel = shapes.sphere("Lapel", 1.0, looks.coat, 48, location=(side * 2.0, 3.35, 12.6))
        lapel.scale = (0.85, 0.55, 3.0)
        lapel.rotation_euler = degrees(-14, side * 20, side * -24)
        loop = shapes.sphere("Bow", 1.0, looks.bow, 48, location=(side * 1.5, 5.0, 15.0))
        loop.scale = (1.35, 0.55, 0.85)
        loop.rotation_euler = degrees(-10, side * 12, side * -14)
        made += [lapel, loop]
    made.append(shapes.sphere("Knot", 0.58, looks.bow, 32, location=(0, 5.4, 14.9)))
    collar = shapes.smooth_profile([(2.4, 14.9), (3.0, 14.8), (3.3, 15.6), (3.1, 16.5),
                                    (2.6, 16.7), (2.3, 16.2)])
    made.append(shapes.lathe("Collar", collar, looks.linen, location=(0, 1.2, 0),
                             rotation=degrees(-6, 0, 0)))
    for k in range(4):
        z = 13.2 - 1.75 * k
        made.append(shapes.sphere("Button", 0.30, looks.brass, 24,
                                  location=(0, 4.42 - 0.055 * (z - 11.0) ** 2, z)))
    return made


def face(looks):
    made = []
    for side in (-1, 1):
        made.append(shapes.sphere("Eye", 0.72 * HEAD, looks.eye, 32,
                                  location=of_head(side * 2.3, 4.45, 20.2)))
        made.append(shapes.sphere("Gleam", 0.2, looks.gleam, 16,
                                  location=of_head(side * 2.3 + 0.22, 5.06, 20.52)))
        for k in range(3):
            points = [of_head(side * 1.9, 5.6, 18.0 + 0.2 * k),
                      of_head(side * 3.8, 6.2, 18.2 + 0.55 * k),
                      of_head(side * 5.9, 5.7, 17.5 + 1.05 * k)]
            made.append(shapes.wire("Whisker", points, [0.06, 0.05, 0.02], looks.ebony))
    nose = shapes.sphere("Nose", 0.5 * HEAD, looks.eye, 24, location=of_head(0.0, 6.75, 19.15))
    nose.scale = (1.15, 0.8, 0.75)
    return made + [nose] + mouth(looks)


def mouth(looks):
    """A line down from the nose, and one to either side."""
    parting = of_head(0.0, 6.56, 17.75)
    lines = [[of_head(0.0, 6.88, 18.8), parting]]
    lines += [[parting, of_head(side * 0.75, 6.38, 17.35), of_head(side * 1.45, 6.06, 17.6)]
              for side in (-1, 1)]
    return [shapes.wire("Mouth", line, 0.09, looks.ebony) for line in lines]


def watch(looks):
    """The one thing in colour: gold, held up, its chain to the waistcoat."""
    centre = (3.1, 6.9, 14.9)
    case = shapes.lathe("Watch", shapes.smooth_profile(
        [(0.0, -0.30), (1.3, -0.30), (1.72, -0.10), (1.72, 0.10), (1.5, 0.30), (1.5, 0.30),
         (1.40, 0.22), (1.40, 0.22), (0.0, 0.22)]), looks.brass, location=centre,
        rotation=degrees(-80, 0, -8))
    dial = shapes.lathe("Dial", [(0.0, 0.0), (1.38, 0.0)], looks.linen_dial,
                        location=(centre[0] + 0.03, centre[1] + 0.24, centre[2] + 0.04),
                        rotation=degrees(-80, 0, -8))
    hands = [shapes.wire("Hand", [(centre[0] + 0.04, centre[1] + 0.30, centre[2] + 0.05), tip],
                         0.06, looks.ebony, smooth=False)
             for tip in ((centre[0] + 0.04, centre[1] + 0.12, centre[2] + 1.05),
                         (centre[0] - 0.60, centre[1] + 0.22, centre[2] + 0.45))]
    chain = [(3.0, 6.6, 13.3), (2.3, 6.2, 11.2), (1.2, 5.2, 9.9), (0.2, 4.6, 9.9)]
    return [case, dial, shapes.wire("Chain", chain, 0.13, looks.brass)] + hands
