# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of the scenes. Each function makes one object, links it to the scene and returns it.

Common arguments: `material` one material or a list of slots, `location`, `rotation` (XYZ Euler,
radians). Every mesh has UVs.
"""

import math

import bmesh
import bpy
from mathutils import Matrix, Vector


def add_object(name, mesh, material=None, location=(0, 0, 0), rotation=(0, 0, 0)):
    """Links `mesh` as an object. A shared mesh keeps its materials when `material` is None."""
    if material is not None:
        for slot in material if isinstance(material, (list, tuple)) else [material]:
            mesh.materials.append(slot)
    item = bpy.data.objects.new(name, mesh)
    item.location = location
    item.rotation_euler = rotation
    bpy.context.scene.collection.objects.link(item)
    return item


def copy_of(item, location, rotation=None, scale=1.0):
    """Another object with the same mesh: an instance."""
    other = add_object(item.name, item.data, None, location,
                       item.rotation_euler if rotation is None else rotation)
    other.scale = [scale * s for s in item.scale]
    return other


def finished_mesh(name, builder, smooth):
    """Mesh from a bmesh; `smooth` shades it so, up to the angle of auto smooth."""
    bmesh.ops.recalc_face_normals(builder, faces=builder.faces)
    mesh = bpy.data.meshes.new(name)
    builder.to_mesh(mesh)
    builder.free()
    if smooth:
        mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
        mesh.use_auto_smooth = True
        mesh.auto_smooth_angle = math.radians(40.0)
    return mesh


def plane(name, size, material, **placing):
    """A rectangle in the XY plane that faces +Z; UVs cover it once."""
    width, depth = size
    builder = bmesh.new()
    bmesh.ops.create_grid(builder, x_segments=1, y_segments=1, size=0.5, calc_uvs=False)
    layer = builder.loops.layers.uv.new("UVMap")
    for face in builder.faces:
        for loop in face.loops:
            loop[layer].uv = loop.vert.co.xy + Vector((0.5, 0.5))
    bmesh.ops.scale(builder, vec=(width, depth, 1.0), verts=builder.verts)
    mesh = bpy.data.meshes.new(name)
    builder.to_mesh(mesh)
    builder.free()
    return add_object(name, mesh, material, **placing)


def box(name, size, material, bevel=0.0, uv_scale=1.0, **placing):
    """A box about its centre, its edges rounded by `bevel`. UVs are metres times `uv_scale`,
    projected along the axis nearest to each face's normal; u and v follow the other two axes."""
    builder = bmesh.new()
    bmesh.ops.create_cube(builder, size=1.0)
    bmesh.ops.scale(builder, vec=size, verts=builder.verts)
    if bevel > 0.0:
        bmesh.ops.bevel(builder, geom=builder.edges[:], offset=bevel, segments=3, profile=0.5,
                        affect='EDGES')
    builder.normal_update()
    layer = builder.loops.layers.uv.new("UVMap")
    for face in builder.faces:
        axis = max(range(3), key=lambda k: abs(face.normal[k]))
        u, v = [k for k in range(3) if k != axis]
        for loop in face.loops:
            loop[layer].uv = (loop.vert.co[u] * uv_scale, loop.vert.co[v] * uv_scale)
    return add_object(name, finished_mesh(name, builder, bevel > 0.0), material, **placing)


def sphere(name, radius, material, segments=48, **placing):
    builder = bmesh.new()
    builder.loops.layers.uv.new("UVMap")
    bmesh.ops.create_uvsphere(builder, u_segments=segments, v_segments=segments // 2,
                              radius=radius, calc_uvs=True)
    item = add_object(name, finished_mesh(name, builder, True), material, **placing)
    item.data.use_auto_smooth = False
    return item


def lathe(name, profile, material, segments=64, **placing):
    """A solid of revolution about Z. `profile` is a list of (radius, height) from bottom to top or
    along a closed wall; u goes around, v along the profile by length."""
    builder = bmesh.new()
    layer = builder.loops.layers.uv.new("UVMap")
    lengths = [0.0]
    for (r0, z0), (r1, z1) in zip(profile, profile[1:]):
        lengths.append(lengths[-1] + math.hypot(r1 - r0, z1 - z0))
    rings = []
    for radius, height in profile:
        if radius < 1e-6:
            rings.append([builder.verts.new((0.0, 0.0, height))] * segments)
        else:
            rings.append([builder.verts.new((radius * math.cos(a), radius * math.sin(a), height))
                          for a in (2.0 * math.pi * k / segments for k in range(segments))])
    for row, (low, high) in enumerate(zip(rings, rings[1:])):
        v0, v1 = lengths[row] / lengths[-1], lengths[row + 1] / lengths[-1]
        for k in range(segments):
            n = (k + 1) % segments
            corners = [(low[k], k, v0), (low[n], k + 1, v0), (high[n], k + 1, v1), (high[k], k, v1)]
            unique = [c for i, c in enumerate(corners) if c[0] is not corners[i - 1][0]]
            if len(unique) < 3:
                continue
            face = builder.faces.new([c[0] for c in unique])
            for loop, (_, column, v) in zip(face.loops, unique):
                loop[layer].uv = (column / segments, v)
    return add_object(name, finished_mesh(name, builder, True), material, **placing)


def smooth_profile(points, steps=6):
    """Catmull-Rom curve through (radius, height) points; a point given twice makes a crease."""
    curve = []
    for i in range(len(points) - 1):
        p0, p1 = Vector(points[max(i - 1, 0)]), Vector(points[i])
        p2, p3 = Vector(points[i + 1]), Vector(points[min(i + 2, len(points) - 1)])
        if (p2 - p1).length < 1e-9:
            continue
        for step in range(steps):
            t = step / steps
            point = 0.5 * (2.0 * p1 + (p2 - p0) * t + (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3) * t * t
                           + (3.0 * p1 - p0 - 3.0 * p2 + p3) * t * t * t)
            curve.append((max(point.x, 0.0), point.y))
    curve.append(tuple(points[-1]))
    return curve


def frame(name, size, profile, material, **placing):
    """A mitred frame in the XZ plane around an opening of `size`, its face towards -Y.
    `profile` is an open list of (outwards, forwards) that starts and ends at the back."""
    builder = bmesh.new()
    layer = builder.loops.layers.uv.new("UVMap")
    half_width, half_height = size[0] / 2.0, size[1] / 2.0
    rings = []
    for sx, sz in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        rings.append([builder.verts.new((sx * (half_width + out), -forward,
                                         sz * (half_height + out))) for out, forward in profile])
    for side in range(4):
        start, end = rings[side], rings[(side + 1) % 4]
        length = (end[0].co - start[0].co).length
        for k in range(len(profile)):
            n = (k + 1) % len(profile)
            face = builder.faces.new([start[k], end[k], end[n], start[n]])
            v0, v1 = k / len(profile), (k + 1) / len(profile)
            for loop, uv in zip(face.loops, ((0, v0), (length, v0), (length, v1), (0, v1))):
                loop[layer].uv = uv
    return add_object(name, finished_mesh(name, builder, True), material, **placing)


def outline(name, points, thickness, materials, uv_size, **placing):
    """A thin plate from a convex outline in XY about the origin. Slots: front (+Z), back, rim.
    UVs cover a rectangle of `uv_size` about the origin, on the back mirrored."""
    builder = bmesh.new()
    layer = builder.loops.layers.uv.new("UVMap")
    top = [builder.verts.new((x, y, thickness / 2.0)) for x, y in points]
    bottom = [builder.verts.new((x, y, -thickness / 2.0)) for x, y in points]
    faces = [builder.faces.new(top), builder.faces.new(bottom[::-1])]
    count = len(points)
    for k in range(count):
        faces.append(builder.faces.new([bottom[k], bottom[(k + 1) % count], top[(k + 1) % count],
                                        top[k]]))
    for index, face in enumerate(faces):
        face.material_index = min(index, 2)
        for loop in face.loops:
            x, y, _ = loop.vert.co
            loop[layer].uv = ((0.5 + x / uv_size[0]) if index != 1 else (0.5 - x / uv_size[0]),
                              0.5 + y / uv_size[1])
    return add_object(name, finished_mesh(name, builder, False), materials, **placing)


def rounded_rectangle(width, height, radius, steps=5):
    """Outline points, counter-clockwise, about the origin."""
    points = []
    for corner, (sx, sy) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        for step in range(steps + 1):
            angle = math.pi / 2.0 * (corner + step / steps)
            points.append((sx * (width / 2.0 - radius) + radius * math.cos(angle),
                           sy * (height / 2.0 - radius) + radius * math.sin(angle)))
    return points


def rosette(name, radius, petals, relief, material, **placing):
    """A round ornament in the XZ plane that bulges towards -Y, with `petals` lobes."""
    builder = bmesh.new()
    layer = builder.loops.layers.uv.new("UVMap")
    rings, segments = 14, petals * 10
    grid = []
    for ring in range(rings + 1):
        t = ring / rings
        row = []
        for k in range(segments):
            angle = 2.0 * math.pi * k / segments
            wave = abs(math.cos(0.5 * petals * angle))
            reach = radius * t * (0.82 + 0.18 * wave)
            dome = math.sqrt(max(0.0, 1.0 - t * t)) * (0.55 + 0.45 * wave * min(1.0, 3.0 * t))
            bud = 0.5 * math.exp(-(t / 0.22) ** 2)
            row.append(builder.verts.new((reach * math.cos(angle), -relief * (dome + bud),
                                          reach * math.sin(angle))))
        grid.append(row)
    for inner, outer in zip(grid, grid[1:]):
        for k in range(segments):
            n = (k + 1) % segments
            face = builder.faces.new([inner[k], outer[k], outer[n], inner[n]])
            for loop in face.loops:
                loop[layer].uv = (0.5 + loop.vert.co.x / (2 * radius),
                                  0.5 + loop.vert.co.z / (2 * radius))
    bmesh.ops.remove_doubles(builder, verts=builder.verts, dist=1e-6)
    item = add_object(name, finished_mesh(name, builder, True), material, **placing)
    item.data.use_auto_smooth = False
    return item


def blend_of_spheres(name, balls, material, voxel, **placing):
    """Ellipsoids (centre, radii, rotation) melted into one body by a remesh and a smooth modifier,
    which are left for the render to evaluate."""
    builder = bmesh.new()
    for centre, radii, rotation in balls:
        matrix = Matrix.LocRotScale(Vector(centre), rotation, Vector(radii))
        bmesh.ops.create_uvsphere(builder, u_segments=32, v_segments=16, radius=1.0, matrix=matrix)
    mesh = bpy.data.meshes.new(name)
    builder.to_mesh(mesh)
    builder.free()
    item = add_object(name, mesh, material, **placing)
    remesh = item.modifiers.new("Melt", 'REMESH')
    remesh.mode = 'VOXEL'
    remesh.voxel_size = voxel
    remesh.use_smooth_shade = True
    smoothing = item.modifiers.new("Smooth", 'SMOOTH')
    smoothing.factor = 0.5
    smoothing.iterations = 8
    return item


def monkey_mesh(name, levels):
    """Suzanne after `levels` of Catmull-Clark subdivision, applied."""
    builder = bmesh.new()
    builder.loops.layers.uv.new("UVMap")
    bmesh.ops.create_monkey(builder)
    base = finished_mesh(name, builder, True)
    base.use_auto_smooth = False
    item = add_object(name, base)
    modifier = item.modifiers.new("Subdivision", 'SUBSURF')
    modifier.levels = modifier.render_levels = levels
    depsgraph = bpy.context.evaluated_depsgraph_get()
    mesh = bpy.data.meshes.new_from_object(item.evaluated_get(depsgraph))
    bpy.data.objects.remove(item)
    bpy.data.meshes.remove(base)
    mesh.name = name
    return mesh


def wire(name, points, radius, material, smooth=True, **placing):
    """A round wire through `points`; `radius` is one number or one for each point."""
    curve = bpy.data.curves.new(name, 'CURVE')
    curve.dimensions = '3D'
    curve.bevel_depth = 1.0
    curve.bevel_resolution = 4
    curve.use_fill_caps = True
    radii = radius if isinstance(radius, (list, tuple)) else [radius] * len(points)
    spline = curve.splines.new('BEZIER' if smooth else 'POLY')
    knots = spline.bezier_points if smooth else spline.points
    knots.add(len(points) - 1)
    for knot, point, thickness in zip(knots, points, radii):
        knot.co = point if smooth else (*point, 1.0)
        knot.radius = thickness
        if smooth:
            knot.handle_left_type = knot.handle_right_type = 'AUTO'
    return add_object(name, curve, material, **placing)
