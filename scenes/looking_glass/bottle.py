# SPDX-License-Identifier: GPL-3.0-or-later
"""A bottle with a label, and what it says is in it."""

import math

import bmesh
import bpy
import shapes
from parts import degrees

from .layout import BOTTLE

# Outer wall from the foot up, then the inner wall down again; the foot has a kick.
OUTER = [(0.0, 0.005), (0.0, 0.005), (0.020, 0.002), (0.029, 0.0), (0.029, 0.0), (0.0330, 0.0015),
         (0.0340, 0.005), (0.0340, 0.085), (0.0340, 0.095), (0.0300, 0.112), (0.0190, 0.126),
         (0.0125, 0.136), (0.0115, 0.150), (0.0112, 0.166), (0.0112, 0.166), (0.0140, 0.1675),
         (0.0144, 0.1710), (0.0138, 0.1745), (0.0138, 0.1745), (0.0112, 0.1755)]
INNER = [(0.0112, 0.1755), (0.0094, 0.1750), (0.0090, 0.166), (0.0092, 0.150), (0.0102, 0.137),
         (0.0166, 0.128), (0.0276, 0.1135), (0.0314, 0.096), (0.0314, 0.085), (0.0314, 0.012),
         (0.0295, 0.0085), (0.0295, 0.0085), (0.018, 0.0085), (0.0, 0.0095)]
FILLED = 0.088                           # height of the liquid's surface
OVERLAP = 0.0004                         # how far the liquid reaches into the wall


def build(looks):
    place = (*BOTTLE, 0.0)
    wall = shapes.smooth_profile(OUTER) + shapes.smooth_profile(INNER)[1:]
    shapes.lathe("Bottle", wall, looks.bottle_glass, segments=96, location=place)
    liquid(looks, place)
    cork = [(0.0, 0.160), (0.0, 0.160), (0.0088, 0.160), (0.0091, 0.172), (0.0098, 0.186),
            (0.0098, 0.186), (0.0090, 0.188), (0.0090, 0.188), (0.0, 0.1882)]
    shapes.lathe("Cork", shapes.smooth_profile(cork), looks.cork, location=place)
    label(looks, place)


def liquid(looks, place):
    """Slightly larger than the hollow, so that glass and liquid share one surface without air
    between them; its surface climbs a little at the wall."""
    reach = 0.0314 + OVERLAP
    profile = shapes.smooth_profile([(0.0, 0.0091), (0.018, 0.0081), (0.0295, 0.0081),
                                     (0.0295, 0.0081), (reach, 0.012), (reach, 0.020)])
    profile += [(reach, FILLED + 0.0012), (reach - 0.0010, FILLED + 0.0003),
                (reach - 0.0026, FILLED), (0.0, FILLED)]
    shapes.lathe("Potion", profile, looks.potion, segments=96, location=place)


def label(looks, place, half_angle=62.0, low=0.026, high=0.080, steps=48):
    """A strip of paper on the wall, turned to the reader."""
    builder = bmesh.new()
    layer = builder.loops.layers.uv.new("UVMap")
    radius = 0.03415
    columns = []
    for k in range(steps + 1):
        angle = degrees(-90.0 + half_angle * (2.0 * k / steps - 1.0))
        x, y = radius * math.cos(angle), radius * math.sin(angle)
        columns.append([builder.verts.new((x, y, z)) for z in (low, high)])
    for k, (left, right) in enumerate(zip(columns, columns[1:])):
        face = builder.faces.new([left[0], right[0], right[1], left[1]])
        face.smooth = True
        for loop, uv in zip(face.loops, ((k, 0), (k + 1, 0), (k + 1, 1), (k, 1))):
            loop[layer].uv = (uv[0] / steps, uv[1])
    mesh = bpy.data.meshes.new("Label")
    builder.to_mesh(mesh)
    builder.free()
    shapes.add_object("Label", mesh, looks.label, place, degrees(0, 0, 20))
