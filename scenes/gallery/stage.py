# SPDX-License-Identifier: GPL-3.0-or-later
"""What the exhibits stand on: a backdrop, a soft light, a camera, and the pawn that wears them."""

import math

import bmesh
import bpy
import parts
import shapes

WARM_GREY = (0.42, 0.40, 0.37)


def studio(width=3.2, height=0.75, backdrop=WARM_GREY, light=1.0, elevation=0.16):
    """Backdrop, lamps and a camera that shows `width` metres about (0, 0, `height`)."""
    sweep("Backdrop", parts.diffuse("Backdrop", backdrop))
    parts.set_world_color((0.55, 0.62, 0.72), 0.25 * light)
    parts.area_light("Key", (-3.2, -3.4, 4.6), (0.0, 0.0, 0.4), (1.6, 1.6), power=330.0 * light,
                     color=(1.0, 0.92, 0.82))
    parts.area_light("Rim", (3.6, 1.6, 3.4), (0.0, 0.0, 0.6), (0.8, 2.2), power=150.0 * light,
                     color=(0.80, 0.88, 1.0))
    parts.area_light("Strip", (3.0, -4.2, 1.8), (0.0, 0.0, 0.6), (0.35, 2.6), power=60.0 * light)
    view(width, height, elevation)


def view(width, height, elevation=0.16):
    """A camera of 75 mm before the scene, `elevation` its slope."""
    distance = width * 75.0 / 36.0
    parts.camera((0.0, -distance, height + elevation * distance), (0.0, 0.0, height),
                 focal_length=75.0)


def sweep(name, material, width=24.0, radius=2.5, start=-8.0, end=4.5, height=8.0):
    """A floor that rises in a quarter circle to a wall. It lies a little below 0: what stands on it
    has a face there, and of two in one plane each engine meets another."""
    builder = bmesh.new()
    layer = builder.loops.layers.uv.new("UVMap")
    arc = [(end - radius + radius * math.sin(a), radius - radius * math.cos(a))
           for a in (math.pi / 2.0 * k / 16 for k in range(17))]
    profile = [(start, 0.0), *arc, (end, height)]
    rows = [[builder.verts.new((x, y, z)) for x in (-width / 2.0, width / 2.0)]
            for y, z in profile]
    for low, high in zip(rows, rows[1:]):
        face = builder.faces.new([low[0], low[1], high[1], high[0]])
        for loop in face.loops:
            loop[layer].uv = loop.vert.co.xy
    mesh = bpy.data.meshes.new(name)
    builder.to_mesh(mesh)
    builder.free()
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    return shapes.add_object(name, mesh, material, location=(0.0, 0.0, -0.002))


# The pawn: a ball with a groove on a stem with a collar.
_STEM = [(0.0, 0.0), (0.40, 0.0), (0.40, 0.0), (0.42, 0.03), (0.41, 0.08), (0.36, 0.11),
         (0.34, 0.11), (0.34, 0.14), (0.30, 0.18), (0.20, 0.30), (0.15, 0.44), (0.14, 0.52),
         (0.14, 0.52),
         (0.27, 0.55), (0.28, 0.58), (0.24, 0.60), (0.0, 0.60)]
_BALL_HEIGHT, _BALL_RADIUS = 0.90, 0.34
_GROOVE = math.radians(9.0)


def pawn(material, x=0.0, y=0.0, core=None, size=1.0):
    """A chess pawn as the body on which materials are shown: broad curves, a sharp edge, a rim
    that is seen at grazing angles, and a groove round the ball. A clear one may hold a smaller
    ball of another material, its `core`."""
    stem = shapes.lathe("Pawn", shapes.smooth_profile(_STEM), material)
    ball = shapes.lathe("Pawn Ball", _open_ball(), material, location=(0.0, 0.0, _BALL_HEIGHT))
    # The groove lies aslant, so that the camera looks into it.
    ball.rotation_euler.x = math.radians(24.0)
    items = [stem, ball]
    if core is not None:
        items.append(shapes.sphere("Pawn Core", 0.7 * _BALL_RADIUS, core,
                                   location=(0.0, 0.0, _BALL_HEIGHT)))
    for item in items:
        item.location = (x, y, size * item.location.z)
        item.scale = (size,) * 3
        item.rotation_euler.z = 0.4
    return stem


def _open_ball():
    """Outer wall of both halves and the walls of the groove between them."""
    def arc(radius, first, last, steps=24):
        return [(radius * math.cos(a), radius * math.sin(a))
                for a in (first + (last - first) * k / steps for k in range(steps + 1))]
    inside = 0.8 * _BALL_RADIUS
    half = math.pi / 2.0
    return (arc(_BALL_RADIUS, -half, -_GROOVE) + arc(inside, -_GROOVE, _GROOVE, 4)
            + arc(_BALL_RADIUS, _GROOVE, half))


def row(count, spacing):
    """Places along x, about 0."""
    return [spacing * (k - 0.5 * (count - 1)) for k in range(count)]
