# SPDX-License-Identifier: GPL-3.0-or-later
"""What every scene is made with: materials, lights, camera, settings, mirror tags.

Lengths are metres, angles radians, lamp powers watts. Colours are linear RGB.
"""

import math
import pathlib

import bpy
from mathutils import Vector

TEXTURES = pathlib.Path(__file__).resolve().parent.parent / "textures"


# -------------------------------------------------------------------------------- materials

class Nodes:
    """Writes a node tree: each `add` makes one node and sets or links its inputs."""

    def __init__(self, tree):
        self.tree = tree
        tree.nodes.clear()

    def add(self, kind, inputs=None, **settings):
        """Adds `ShaderNode<kind>`. `inputs` maps a socket's name or index to a value, to a socket
        or to a node, whose first output is then used. `settings` are properties of the node."""
        node = self.tree.nodes.new("ShaderNode" + kind)
        for name, value in settings.items():
            setattr(node, name, value)
        for key, value in (inputs or {}).items():
            self.connect(node.inputs[key], value)
        return node

    def connect(self, socket, value):
        if isinstance(value, bpy.types.ShaderNode):
            value = value.outputs[0]
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        elif isinstance(value, tuple) and socket.type == 'RGBA':
            socket.default_value = (*value, 1.0)
        else:
            socket.default_value = value

    def picture(self, name, data=False, **settings):
        """An Image Texture of textures/`name`.png; `data` reads it without colour conversion."""
        image = bpy.data.images.load(str(TEXTURES / f"{name}.png"), check_existing=True)
        image.colorspace_settings.name = 'Non-Color' if data else 'sRGB'
        return self.add("TexImage", image=image, **settings)

    def surface(self, shader, volume=None):
        """Ends the tree: `shader` is what the surface looks like, `volume` what is inside."""
        ends = {"Surface": shader}
        if volume is not None:
            ends["Volume"] = volume
        return self.add("OutputMaterial", ends)


def new_material(name):
    """A material and the writer of its tree."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    return material, Nodes(material.node_tree)


def shader(name, kind, inputs=None, **settings):
    """A material of a single shader node."""
    material, nodes = new_material(name)
    nodes.surface(nodes.add(kind, inputs, **settings))
    return material


def principled(name, color, roughness, **inputs):
    """A Principled material; other sockets by name with underscores: `clearcoat_roughness=0.1`."""
    named = {key.replace("_", " ").title(): value for key, value in inputs.items()}
    if "Ior" in named:
        named["IOR"] = named.pop("Ior")
    return shader(name, "BsdfPrincipled",
                  {"Base Color": color, "Roughness": roughness, **named})


def measured_metal(nodes, name, roughness, stand_in):
    """A node for a metal of the add-on's tables; without the add-on a metallic Principled of the
    colour `stand_in`. `roughness` may be a node."""
    try:
        from tenniel.presets import groups, tables
    except ImportError:
        return nodes.add("BsdfPrincipled", {"Base Color": stand_in, "Metallic": 1.0,
                                            "Roughness": roughness})
    index, extinction = tables.METALS[name]
    group = nodes.tree.nodes.new("ShaderNodeGroup")
    group.node_tree = groups.metal_group()
    for socket, value in (("Refractive Index", index), ("Extinction", extinction),
                          ("Roughness", roughness)):
        nodes.connect(group.inputs[socket], value)
    return group


def diffuse(name, color):
    return shader(name, "BsdfDiffuse", {"Color": color})


def emission(name, color, strength):
    """`strength` is in watts per square metre and steradian, as in Blender."""
    return shader(name, "Emission", {"Color": color, "Strength": strength})


# ---------------------------------------------------------------------------------- lighting

def set_world_color(color, strength=1.0):
    world, nodes = _new_world()
    background = nodes.add("Background", {"Color": color, "Strength": strength})
    nodes.add("OutputWorld", {"Surface": background})
    return world


def set_world_hdri(name, strength=1.0, turn=0.0):
    """One of Blender's own studio lights as environment, turned by `turn` about Z."""
    folder = next(path for kind in ('LOCAL', 'SYSTEM')
                  if (path := pathlib.Path(bpy.utils.resource_path(kind), "datafiles/studiolights"
                                           "/world")).is_dir())
    world, nodes = _new_world()
    coordinate = nodes.add("TexCoord")
    mapping = nodes.add("Mapping", {"Vector": coordinate.outputs["Generated"],
                                    "Rotation": (0.0, 0.0, turn)})
    image = bpy.data.images.load(str(folder / f"{name}.exr"), check_existing=True)
    texture = nodes.add("TexEnvironment", {"Vector": mapping}, image=image)
    background = nodes.add("Background", {"Color": texture, "Strength": strength})
    nodes.add("OutputWorld", {"Surface": background})
    return world


def _new_world():
    world = bpy.data.worlds.new("World")
    world.use_nodes = True
    bpy.context.scene.world = world
    return world, Nodes(world.node_tree)


def area_light(name, location, target, size, power, color=(1.0, 1.0, 1.0)):
    """A rectangular area lamp of `size` (width, height) that shines from location to target."""
    data = bpy.data.lights.new(name, 'AREA')
    data.shape = 'RECTANGLE'
    data.size, data.size_y = size
    data.energy = power
    data.color = color
    return _aimed(bpy.data.objects.new(name, data), location, target)


def point_light(name, location, radius, power, color=(1.0, 1.0, 1.0)):
    data = bpy.data.lights.new(name, 'POINT')
    data.shadow_soft_size = radius
    data.energy = power
    data.color = color
    light = bpy.data.objects.new(name, data)
    light.location = location
    bpy.context.scene.collection.objects.link(light)
    return light


# ------------------------------------------------------------------------ camera and settings

def camera(location, target, focal_length, f_stop=None, focus=None):
    """The scene's camera; `focal_length` in millimetres on a 36 mm sensor. With `f_stop` it has
    depth of field, sharp at the point `focus`."""
    data = bpy.data.cameras.new("Camera")
    data.lens = focal_length
    data.clip_start = 0.01
    view = _aimed(bpy.data.objects.new("Camera", data), location, target)
    if f_stop is not None:
        data.dof.use_dof = True
        data.dof.aperture_fstop = f_stop
        forward = (Vector(target) - Vector(location)).normalized()
        data.dof.focus_distance = (Vector(focus) - Vector(location)).dot(forward)
    bpy.context.scene.camera = view
    return view


def _aimed(item, location, target):
    item.location = location
    direction = Vector(target) - Vector(location)
    item.rotation_euler = direction.to_track_quat('-Z', 'Y').to_euler()
    bpy.context.scene.collection.objects.link(item)
    return item


# The same settings for both engines: nothing that trades truth for speed.
PLAIN_SETTINGS = {
    "max_bounces": 12,
    "diffuse_bounces": 6,
    "glossy_bounces": 8,
    "transmission_bounces": 12,
    "transparent_max_bounces": 8,
    "sample_clamp_direct": 0.0,
    "sample_clamp_indirect": 0.0,
    "blur_glossy": 0.0,
    "light_sampling_threshold": 0.0,
    "use_adaptive_sampling": False,
    "use_denoising": False,
}


def render_settings(scene, width, height, samples, **others):
    """Size, samples and limits, for every engine that is there; `others` override the limits."""
    scene.render.resolution_x = width
    scene.render.resolution_y = height
    scene.render.resolution_percentage = 100
    engines = [getattr(scene, name) for name in ("cycles", "tenniel") if hasattr(scene, name)]
    for settings in engines:
        for name, value in {**PLAIN_SETTINGS, "samples": samples, **others}.items():
            if hasattr(settings, name):
                setattr(settings, name, value)
    scene.render.engine = 'TENNIEL' if hasattr(scene, "tenniel") else 'CYCLES'


# -------------------------------------------------------------------------------- the mirror

def make_looking_glass(item):
    """Reflections in this object show the world behind the mirror."""
    item["looking_glass"] = True


def send_behind_mirror(*items):
    """These objects are seen in looking glasses only."""
    for item in items:
        item["behind_mirror"] = True


def keep_on_this_side(*items):
    """These objects have no reflection in looking glasses. Needs the add-on; else nothing."""
    for item in items:
        if hasattr(item, "tenniel"):
            item.tenniel.side = 'THIS_SIDE'


def degrees(*angles):
    """Degrees to radians: one number or a tuple."""
    radians = tuple(math.radians(angle) for angle in angles)
    return radians if len(radians) > 1 else radians[0]
