# SPDX-License-Identifier: GPL-3.0-or-later
"""Lets cards and biscuits fall, and writes where they come to rest into fallen.py.

blender -b --factory-startup --python scenes/looking_glass/drop.py

Blender's rigid bodies, in centimetres and a tenth of gravity: thin bodies need small steps. The
scene reads the numbers and never simulates, so that every machine has the same still life.
"""

import math
import pathlib
import random
import sys

import bpy

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER))
import layout  # noqa: E402  (beside this file, which Blender does not put on the path)

CM = 100.0
FRAMES = 260


def body(item, kind, shape, friction=0.5):
    bpy.context.view_layer.objects.active = item
    bpy.ops.rigidbody.object_add()
    settings = item.rigid_body
    settings.type = kind
    settings.collision_shape = shape
    settings.friction = friction
    settings.restitution = 0.02
    settings.use_margin = True
    settings.collision_margin = 0.0 if shape == 'BOX' else 0.004
    settings.linear_damping, settings.angular_damping = 0.12, 0.25
    return item


def cylinder(place, radius, height):
    bpy.ops.mesh.primitive_cylinder_add(radius=radius * CM, depth=height * CM, vertices=48,
                                        location=(place[0] * CM, place[1] * CM, height * CM / 2))
    body(bpy.context.object, 'PASSIVE', 'CONVEX_HULL')


def box(size, location, rotation, kind='ACTIVE', friction=0.5):
    bpy.ops.mesh.primitive_cube_add(size=1.0, location=location, rotation=rotation)
    item = bpy.context.object
    item.scale = size
    bpy.ops.object.transform_apply(location=False, rotation=False, scale=True)
    return body(item, kind, 'BOX', friction)


def plate():
    """The upper side of the plate as rings of triangles."""
    profile = [(r * CM, z * CM) for r, z in layout.PLATE_PROFILE[9:]][::-1]
    steps = 40
    points = [(r * math.cos(a), r * math.sin(a), z)
              for r, z in profile for a in (2 * math.pi * k / steps for k in range(steps))]
    faces = [(ring * steps + k, (ring + 1) * steps + k, (ring + 1) * steps + (k + 1) % steps,
              ring * steps + (k + 1) % steps)
             for ring in range(len(profile) - 1) for k in range(steps)]
    mesh = bpy.data.meshes.new("Plate")
    mesh.from_pydata(points, [], faces)
    item = bpy.data.objects.new("Plate", mesh)
    item.location = (layout.PLATE[0] * CM, layout.PLATE[1] * CM, 0.0)
    bpy.context.scene.collection.objects.link(item)
    body(item, 'PASSIVE', 'MESH', friction=0.7)


def still_things():
    box((200.0, 120.0, 4.0), (0.0, 0.0, -2.0), (0.0, 0.0, 0.0), 'PASSIVE')
    box((60.0, 4.0, 40.0), (0.0, 0.5, 20.0), (0.0, 0.0, 0.0), 'PASSIVE')
    for queen in (layout.WHITE_QUEEN, layout.DARK_QUEEN):
        cylinder(queen, layout.QUEEN_RADIUS, 0.10)
    cylinder(layout.BOTTLE, layout.BOTTLE_RADIUS, 0.12)
    cylinder(layout.CANDLE, layout.CANDLE_RADIUS, 0.02)
    cylinder(layout.PLATE, layout.PLATE_RADIUS * 0.62, 0.0030)
    plate()


def cards(dice):
    """A pack let slip: each a little further to the right and higher than the one before."""
    size = (layout.CARD[0] * CM, layout.CARD[1] * CM, 0.062)
    made = []
    for k in range(15):
        across, along = dice.gauss(0.0, 1.0), dice.gauss(0.0, 1.0)
        face_up = dice.random() < 0.40
        location = (2.5 + 5.6 * across, -27.5 + 2.2 * along, 2.0 + 1.9 * k)
        rotation = (dice.uniform(-0.5, 0.5) + (0.0 if face_up else math.pi),
                    dice.uniform(-0.5, 0.5), dice.uniform(-2.2, 2.2))
        made.append(box(size, location, rotation))
    return made


def biscuits(dice):
    size = tuple(length * CM for length in layout.BISCUIT)
    made = []
    for k, (dx, dy, turn) in enumerate(((-2.6, 2.0, 0.35), (3.0, 1.6, 1.75), (0.2, 2.6, -0.2),
                                        (0.4, 2.2, 0.3))):
        location = (layout.PLATE[0] * CM + dx, layout.PLATE[1] * CM + dy, 2.2 + 1.6 * k)
        made.append(box(size, location, (dice.uniform(-0.1, 0.1), dice.uniform(-0.1, 0.1), turn)))
    # The last one is leant against the others.
    leaning = (layout.PLATE[0] * CM - 0.8, layout.PLATE[1] * CM - 3.0, 3.6)
    made.append(box(size, leaning, (1.0, 0.0, -0.12), friction=0.9))
    return made


def resting(items):
    depsgraph = bpy.context.evaluated_depsgraph_get()
    for item in items:
        matrix = item.evaluated_get(depsgraph).matrix_world
        x, y, z = matrix.translation / CM
        yield (x, y, z), tuple(matrix.to_euler())


def written(name, items):
    lines = [f"{name} = ["]
    for place, turn in resting(items):
        numbers = [", ".join(f"{value:.5f}" for value in row) for row in (place, turn)]
        lines.append(f"    (({numbers[0]}), ({numbers[1]})),")
    return "\n".join(lines + ["]"])


def main():
    dice = random.Random(1865)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.gravity = (0.0, 0.0, -98.1)
    bpy.ops.rigidbody.world_add()
    world = scene.rigidbody_world
    world.substeps_per_frame = 60
    world.solver_iterations = 60
    world.point_cache.frame_end = FRAMES
    still_things()
    fallen = cards(dice), biscuits(dice)
    for frame in range(1, FRAMES + 1):
        scene.frame_set(frame)
    (FOLDER / "fallen.py").write_text(
        "# SPDX-License-Identifier: GPL-3.0-or-later\n"
        '"""Written by drop.py: where things came to rest. Place in metres, XYZ Euler angles."""\n'
        "\n" + written("CARDS", fallen[0]) + "\n\n" + written("BISCUITS", fallen[1]) + "\n")


if __name__ == "__main__":
    main()
