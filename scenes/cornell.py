# SPDX-License-Identifier: GPL-3.0-or-later
"""The Cornell box, with the measured room (Goral et al. 1984) at ten times its size and an
emissive rectangle as its light."""

import bmesh
import bpy

import parts
import shapes

# Millimetres of the original: x to the left, y away from the camera, z up.
FLOOR = [(552.8, 0, 0), (0, 0, 0), (0, 559.2, 0), (549.6, 559.2, 0)]
CEILING = [(556, 0, 548.8), (556, 559.2, 548.8), (0, 559.2, 548.8), (0, 0, 548.8)]
BACK = [(549.6, 559.2, 0), (0, 559.2, 0), (0, 559.2, 548.8), (556, 559.2, 548.8)]
GREEN_WALL = [(0, 559.2, 0), (0, 0, 0), (0, 0, 548.8), (0, 559.2, 548.8)]
RED_WALL = [(552.8, 0, 0), (549.6, 559.2, 0), (556, 559.2, 548.8), (556, 0, 548.8)]
LAMP = [(343, 227, 548.3), (343, 332, 548.3), (213, 332, 548.3), (213, 227, 548.3)]
SHORT_BLOCK = [(130, 65), (82, 225), (240, 272), (290, 114)]
TALL_BLOCK = [(423, 247), (265, 296), (314, 456), (472, 406)]

SCALE = 0.01


def build(scene):
    parts.render_settings(scene, 512, 512, samples=128)
    parts.set_world_color((0.0, 0.0, 0.0))
    white = parts.diffuse("White", (0.73, 0.73, 0.71))
    green = parts.diffuse("Green", (0.12, 0.45, 0.15))
    red = parts.diffuse("Red", (0.63, 0.065, 0.05))
    lamp = parts.emission("Lamp", (1.0, 0.71, 0.40), 26.0)
    for name, corners, material in (("Floor", FLOOR, white), ("Ceiling", CEILING, white),
                                    ("Back wall", BACK, white), ("Green wall", GREEN_WALL, green),
                                    ("Red wall", RED_WALL, red), ("Lamp", LAMP, lamp)):
        polygons(name, [corners], material)
    block("Short block", SHORT_BLOCK, 165, white)
    block("Tall block", TALL_BLOCK, 330, white)
    parts.camera(scaled((278, -800, 273)), scaled((278, 0, 273)), focal_length=50.0)


def scaled(point):
    """A point of the original in the scene, centred, with x to the right."""
    x, y, z = point
    return (278.0 - x) * SCALE, y * SCALE, z * SCALE


def polygons(name, faces, material):
    builder = bmesh.new()
    for corners in faces:
        builder.faces.new([builder.verts.new(scaled(corner)) for corner in corners])
    mesh = bpy.data.meshes.new(name)
    builder.to_mesh(mesh)
    builder.free()
    return shapes.add_object(name, mesh, material)


def block(name, base, height, material):
    top = [(x, y, height) for x, y in base]
    faces = [top]
    for (x0, y0), (x1, y1) in zip(base, base[1:] + base[:1]):
        faces.append([(x0, y0, 0), (x1, y1, 0), (x1, y1, height), (x0, y0, height)])
    return polygons(name, faces, material)
