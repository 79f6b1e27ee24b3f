# SPDX-License-Identifier: GPL-3.0-or-later
"""A closed diffuse room with nine monkeys and one area lamp: the scene that is timed.

Nine meshes of 62 976 triangles each, none shared, so that neither engine can instance them.
"""

import bpy
from mathutils import Color

import parts
import shapes

ROOM = (6.0, 6.0, 3.2)


def build(scene):
    parts.render_settings(scene, 1280, 720, samples=64)
    parts.set_world_color((0.0, 0.0, 0.0))
    build_room()
    build_monkeys()
    parts.area_light("Ceiling lamp", (0.4, 0.2, ROOM[2] - 0.02), (0.4, 0.2, 0.0), (1.6, 1.0),
                     power=140.0, color=(1.0, 0.94, 0.86))
    parts.camera((0.0, -2.9, 1.85), (0.0, 0.2, 0.85), focal_length=22.0)


def build_room():
    width, depth, height = ROOM
    walls = parts.diffuse("White wall", (0.76, 0.74, 0.70))
    left = parts.diffuse("Red wall", (0.60, 0.16, 0.10))
    right = parts.diffuse("Blue wall", (0.12, 0.26, 0.55))
    floor = parts.diffuse("Floor", (0.42, 0.36, 0.30))
    quarter = parts.degrees(90)
    shapes.plane("Floor", (width, depth), floor)
    shapes.plane("Ceiling", (width, depth), walls, location=(0, 0, height),
                 rotation=(2 * quarter, 0, 0))
    shapes.plane("Back", (width, height), walls, location=(0, depth / 2, height / 2),
                 rotation=(quarter, 0, 0))
    shapes.plane("Front", (width, height), walls, location=(0, -depth / 2, height / 2),
                 rotation=(-quarter, 0, 0))
    shapes.plane("Left", (height, depth), left, location=(-width / 2, 0, height / 2),
                 rotation=(0, quarter, 0))
    shapes.plane("Right", (height, depth), right, location=(width / 2, 0, height / 2),
                 rotation=(0, -quarter, 0))


def build_monkeys():
    original = shapes.monkey_mesh("Monkey", levels=3)
    for row in range(3):
        for column in range(3):
            index = 3 * row + column
            color = Color()
            color.hsv = index / 9.0, 0.55, 0.72
            item = shapes.add_object(f"Monkey {index + 1}", original.copy(),
                                     parts.diffuse(f"Paint {index + 1}", tuple(color)))
            item.location = (1.45 * (column - 1), 1.3 * row - 0.6, 0.45 + 0.36 * row)
            item.rotation_euler = parts.degrees(-12, 0, 18 * (1 - column))
            item.scale = (0.46, 0.46, 0.46)
    bpy.data.meshes.remove(original)
