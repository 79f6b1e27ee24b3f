# SPDX-License-Identifier: GPL-3.0-or-later
"""What grows and flies in the dream: mushrooms and butterflies."""

import math

import bmesh
import bpy
import parts
import shapes
from mathutils import Vector
from parts import degrees


def build(looks):
    build_mushrooms(looks)
    build_butterflies(looks)


def build_mushrooms(looks):
    """(x, y, height) of each; caps carry spots on a golden spiral."""
    for x, y, height in ((-0.60, -1.65, 0.54), (0.300, -2.45, 0.60), (-0.395, -1.05, 0.15),
                         (-0.43, -0.92, 0.09), (0.235, -1.02, 0.15),
                         (0.185, -0.90, 0.085), (0.250, -0.86, 0.06)):
        build_mushroom(looks, (x, y, 0.0), height)


def build_mushroom(looks, location, height):
    """Proportions for a height of one, then scaled."""
    stalk = shapes.lathe("Stalk", shapes.smooth_profile(
        [(0.0, 0.0), (0.15, 0.0), (0.14, 0.10), (0.09, 0.35), (0.075, 0.65), (0.09, 0.74),
         (0.0, 0.76)]), looks.stalk, location=location)
    cap = shapes.lathe("Cap", shapes.smooth_profile(
        [(0.0, 0.70), (0.10, 0.70), (0.36, 0.66), (0.43, 0.67), (0.42, 0.74), (0.33, 0.87),
         (0.18, 0.97), (0.0, 1.0)]), looks.cap, location=location)
    made = [stalk, cap]
    spot = None
    for k in range(22):
        angle, t = k * math.pi * (3.0 - math.sqrt(5.0)), math.sqrt((k + 0.5) / 22)
        radius = 0.41 * t
        z = 1.0 - 0.9 * radius ** 2 - 3.2 * radius ** 4
        local = Vector((radius * math.cos(angle), radius * math.sin(angle), z))
        outwards = Vector((local.x, local.y, 0.25)).to_track_quat('Z', 'Y').to_euler()
        where = Vector(location) + local * height
        if spot is None:
            spot = shapes.sphere("Spot", 0.042, looks.spot, 20, location=where, rotation=outwards)
            spot.scale = (1.0, 1.0, 0.3)
            made.append(spot)
        else:
            made.append(shapes.copy_of(spot, where, outwards, 0.6 + 0.4 * math.cos(2.3 * k)))
    for piece in made:
        piece.scale = [height * s for s in piece.scale]
    parts.send_behind_mirror(*made)


def build_butterflies(looks):
    colors = ((0.10, 0.32, 0.95), (1.0, 0.48, 0.05), (0.85, 0.10, 0.50))
    meshes = [butterfly_mesh(f"Butterfly {k + 1}", wing(f"Wing {k + 1}", color), looks.ebony)
              for k, color in enumerate(colors)]
    for kind, location, turn in ((0, (-0.30, -0.80, 0.36), 30), (1, (-0.145, -0.62, 0.315), -40),
                                 (2, (-0.42, -1.05, 0.30), 75), (0, (0.00, -1.15, 0.47), -20),
                                 (2, (0.13, -0.72, 0.385), 50),
                                 (1, (-0.10, -0.62, 0.17), 120)):
        item = shapes.add_object(meshes[kind].name, meshes[kind], None, location,
                                 degrees(62, 12 * kind - 12, turn))
        parts.send_behind_mirror(item)


def wing(name, color):
    """Thin and lit from both sides."""
    material, nodes = parts.new_material(name)
    front = nodes.add("BsdfDiffuse", {"Color": color})
    through = nodes.add("BsdfTranslucent", {"Color": color})
    nodes.surface(nodes.add("MixShader", {0: 0.45, 1: front, 2: through}))
    return material


def butterfly_mesh(name, wing_look, body_look, fold=28.0):
    """Two pairs of wings, folded up by `fold` degrees from flat, and a body; 6 cm across."""
    builder = bmesh.new()
    layer = builder.loops.layers.uv.new("UVMap")
    upper = [(0.0, 0.002), (0.010, 0.014), (0.024, 0.024), (0.032, 0.022), (0.031, 0.010),
             (0.022, 0.001), (0.0, -0.002)]
    lower = [(0.0, -0.001), (0.018, -0.001), (0.025, -0.009), (0.021, -0.020), (0.012, -0.021),
             (0.004, -0.012), (0.0, -0.006)]
    for side in (-1.0, 1.0):
        for points in (upper, lower):
            verts = [builder.verts.new((side * x * math.cos(degrees(fold)), y,
                                        x * math.sin(degrees(fold)))) for x, y in points]
            face = builder.faces.new(verts if side > 0 else verts[::-1])
            for loop in face.loops:
                loop[layer].uv = loop.vert.co.xy * 15.0 + Vector((0.5, 0.5))
    before = len(builder.faces)
    bmesh.ops.create_uvsphere(builder, u_segments=12, v_segments=8, radius=0.0022)
    builder.faces.ensure_lookup_table()
    for face in builder.faces[before:]:
        face.material_index = 1
    for vert in {v for face in builder.faces[before:] for v in face.verts}:
        vert.co.y *= 6.0
    mesh = bpy.data.meshes.new(name)
    builder.to_mesh(mesh)
    builder.free()
    for material in (wing_look, body_look):
        mesh.materials.append(material)
    return mesh
