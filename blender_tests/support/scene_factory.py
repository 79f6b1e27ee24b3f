# SPDX-License-Identifier: GPL-3.0-or-later
"""Small scenes for tests, made from data blocks only (no operators, no selection, no context)."""
import math

import bpy
from mathutils import Matrix, Vector


def empty_scene():
    """Load the factory file without objects; add-ons stay enabled. Returns the scene."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = bpy.context.scene
    scene.view_settings.view_transform = "Raw"
    scene.render.dither_intensity = 0.0
    set_world(scene, (0.0, 0.0, 0.0))
    return scene


def link(scene, data, name=None, location=(0, 0, 0), rotation=(0, 0, 0), scale=(1, 1, 1)):
    """A new object for `data` in the scene's master collection; rotation in degrees, XYZ order."""
    obj = bpy.data.objects.new(name or data.name, data)
    obj.location = location
    obj.rotation_euler = [math.radians(angle) for angle in rotation]
    obj.scale = scale
    scene.collection.objects.link(obj)
    return obj


def camera(scene, location=(0, 0, 10), look_at=(0, 0, 0), **settings):
    """Make the active camera; `settings` are attributes of the camera data."""
    data = bpy.data.cameras.new("Camera")
    for name, value in settings.items():
        setattr(data, name, value)
    obj = link(scene, data, location=location)
    aim(obj, look_at)
    scene.camera = obj
    return obj


def top_camera(scene, width, centre=(0, 0), height=10.0):
    """Orthographic camera looking down -Z with +Y up; `width` metres along the longer side."""
    return camera(scene, (centre[0], centre[1], height), (centre[0], centre[1], 0),
                  type="ORTHO", ortho_scale=width)


def aim(obj, target):
    """Point the object's -Z at `target` with +Y as much up (world Z) as possible."""
    direction = Vector(target) - obj.location
    if direction.xy.length < 1e-6:
        obj.rotation_euler = (0.0 if direction.z < 0.0 else math.pi, 0.0, 0.0)
    else:
        obj.rotation_euler = direction.to_track_quat("-Z", "Y").to_euler()


def mesh(name, vertices, faces, material=None, uv=None, smooth=False):
    """A mesh; `uv` is one (u, v) for each face corner."""
    data = bpy.data.meshes.new(name)
    data.from_pydata([tuple(v) for v in vertices], [], [tuple(f) for f in faces])
    if uv is not None:
        layer = data.uv_layers.new(name="UVMap")
        layer.data.foreach_set("uv", [c for pair in uv for c in pair])
    if smooth:
        data.polygons.foreach_set("use_smooth", [True] * len(data.polygons))
    if material is not None:
        data.materials.append(material)
    data.update()
    return data


def plane(scene, size=2.0, material=None, name="Plane", **placement):
    """Square in the XY plane facing +Z with UVs 0..1."""
    h = size / 2.0
    data = mesh(name, [(-h, -h, 0), (h, -h, 0), (h, h, 0), (-h, h, 0)], [(0, 1, 2, 3)],
                material, [(0, 0), (1, 0), (1, 1), (0, 1)])
    return link(scene, data, name, **placement)


def sphere(scene, radius=1.0, material=None, segments=32, rings=16, smooth=True, name="Sphere",
           **placement):
    """Closed UV sphere of quads with triangles at the poles."""
    vertices = [(0, 0, radius)]
    for i in range(1, rings):
        theta = math.pi * i / rings
        for j in range(segments):
            phi = 2.0 * math.pi * j / segments
            vertices.append((radius * math.sin(theta) * math.cos(phi),
                             radius * math.sin(theta) * math.sin(phi), radius * math.cos(theta)))
    vertices.append((0, 0, -radius))
    last = len(vertices) - 1
    faces = []
    for j in range(segments):
        k = (j + 1) % segments
        faces.append((0, 1 + j, 1 + k))
        for i in range(rings - 2):
            a, b = 1 + i * segments, 1 + (i + 1) * segments
            faces.append((a + j, b + j, b + k, a + k))
        a = 1 + (rings - 2) * segments
        faces.append((a + j, last, a + k))
    return link(scene, mesh(name, vertices, faces, material, smooth=smooth), name, **placement)


def box(scene, size=2.0, material=None, name="Box", inward=False, **placement):
    """Closed cube; `inward` turns the normals to the inside."""
    h = size / 2.0
    vertices = [(x, y, z) for z in (-h, h) for y in (-h, h) for x in (-h, h)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    if inward:
        faces = [tuple(reversed(f)) for f in faces]
    return link(scene, mesh(name, vertices, faces, material), name, **placement)


def lamp(scene, kind, energy=100.0, location=(0, 0, 3), rotation=(0, 0, 0), color=(1, 1, 1),
         scale=(1, 1, 1), **settings):
    """A lamp; `settings` are attributes of the light data ("size", "spot_blend", ...)."""
    data = bpy.data.lights.new("Lamp", kind)
    data.energy = energy
    data.color = color
    for name, value in settings.items():
        setattr(data, name, value)
    return link(scene, data, location=location, rotation=rotation, scale=scale)


def set_world(scene, color, strength=1.0):
    """Constant environment; returns the Background node."""
    world = bpy.data.worlds.new("World")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (*color, 1.0)
    background.inputs["Strength"].default_value = strength
    scene.world = world
    return background


class Nodes:
    """Compact description of a node tree.

    `add("ShaderNodeMath", {"operation": "ADD"}, {0: 1.0, 1: other.outputs["Value"]})` makes a node,
    sets its attributes, then sets or links its inputs. A socket is named by identifier, name or
    index, in that order of trial; a value may be a socket (link), a node (its first output) or a
    plain value.
    """

    def __init__(self, tree):
        self.tree = tree

    def add(self, type_name, settings=None, inputs=None):
        node = self.tree.nodes.new(type_name)
        for name, value in (settings or {}).items():
            set_path(node, name, value)
        for key, value in (inputs or {}).items():
            self.set(find_socket(node.inputs, key), value)
        return node

    def set(self, socket, value):
        """Link or assign `value` to an input socket."""
        if isinstance(value, bpy.types.Node):
            value = next(s for s in value.outputs if s.enabled)
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        elif socket.type == "RGBA" and len(value) == 3:
            socket.default_value = (*value, 1.0)
        else:
            socket.default_value = value


def set_path(owner, path, value):
    """setattr with dots: set_path(node, "image_user.frame_current", 3)."""
    *parents, name = path.split(".")
    for parent in parents:
        owner = getattr(owner, parent)
    setattr(owner, name, value)


def find_socket(sockets, key):
    """The socket with this identifier, else this name (enabled ones first), else this index."""
    if isinstance(key, int):
        return sockets[key]
    matches = ([s for s in sockets if s.identifier == key]
               or sorted((s for s in sockets if s.name == key), key=lambda s: not s.enabled))
    if not matches:
        raise KeyError(f"no socket {key!r} among {[s.identifier for s in sockets]}")
    return matches[0]


def node_material(name, build):
    """Material whose surface is what `build(Nodes)` returns (a node or a shader socket)."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.node_tree.nodes.clear()
    nodes = Nodes(material.node_tree)
    nodes.add("ShaderNodeOutputMaterial", None, {"Surface": build(nodes)})
    return material


def volume_material(name, build_volume, build_surface=None):
    """Material whose volume is what `build_volume(Nodes)` returns; without a surface by default."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.node_tree.nodes.clear()
    nodes = Nodes(material.node_tree)
    inputs = {"Volume": build_volume(nodes)}
    if build_surface is not None:
        inputs["Surface"] = build_surface(nodes)
    nodes.add("ShaderNodeOutputMaterial", None, inputs)
    return material


def simple_material(node_type, name=None, settings=None, **inputs):
    """Material of one closure; inputs by name with _ for the space: `IOR=1.5`, `Base_Color=...`."""
    named = {key.replace("_", " "): value for key, value in inputs.items()}
    return node_material(name or node_type, lambda n: n.add(node_type, settings, named))


def diffuse(color=(0.8, 0.8, 0.8), roughness=0.0):
    return simple_material("ShaderNodeBsdfDiffuse", "Diffuse", Color=color, Roughness=roughness)


def emission(color=(1, 1, 1), strength=1.0):
    return simple_material("ShaderNodeEmission", "Emission", Color=color, Strength=strength)


def mirror(color=(1, 1, 1), roughness=0.0):
    """Glossy BSDF; sharp when the roughness is 0."""
    settings = {"distribution": "GGX" if roughness else "SHARP"}
    return simple_material("ShaderNodeBsdfGlossy", "Mirror", settings, Color=color,
                           Roughness=roughness)


def generated_image(name, width, height, pixel, float_buffer=False, alpha=True, packed=False,
                    colorspace=None):
    """Image with pixel(x, y) -> (r, g, b, a), row 0 at the bottom; `packed` stores it as PNG."""
    image = bpy.data.images.new(name, width, height, alpha=alpha, float_buffer=float_buffer)
    if colorspace:
        image.colorspace_settings.name = colorspace
    image.pixels.foreach_set([c for y in range(height) for x in range(width) for c in pixel(x, y)])
    image.update()
    if packed:
        image.pack()
    return image


def reflect_across_plane(matrix, point, normal):
    """`matrix` mirrored at the plane through `point` with unit `normal`."""
    n = Vector(normal).normalized()
    reflection = Matrix.Identity(4)
    for i in range(3):
        for j in range(3):
            reflection[i][j] -= 2.0 * n[i] * n[j]
        reflection[i][3] = 2.0 * n.dot(Vector(point)) * n[i]
    return reflection @ matrix
