# SPDX-License-Identifier: GPL-3.0-or-later
"""Lamps and skies: afternoon or evening on this side, another sky in the dream."""

import bpy
import parts
import shapes
from mathutils import Euler, Vector
from parts import degrees


def build(scene, evening):
    if evening:
        evening_light()
    else:
        afternoon_light()
    dream_light(scene)
    scene.view_settings.look = 'Medium High Contrast'


def afternoon_light():
    """Low sun through a window at the left; the room answers with a little cool light."""
    parts.set_world_hdri("interior", strength=0.30, turn=degrees(200))
    window = parts.area_light("Window", (-1.25, -1.0, 0.95), (0.02, 0.05, 0.08), (0.5, 0.6),
                              power=9.0, color=(1.0, 0.83, 0.64))
    window.data.spread = degrees(130)
    sun = parts.area_light("Low sun", (-3.2, -2.6, 2.25), (0.05, 0.1, 0.12), (0.05, 0.05),
                           power=105.0, color=(1.0, 0.72, 0.42))
    sun.data.spread = degrees(40)
    window_bars((-1.60, -1.32, 1.17))
    parts.keep_on_this_side(window, sun)


def window_bars(centre, turn=-51.0):
    """A sash between sun and table, out of the picture: it throws its cross on wall and table."""
    wood = parts.diffuse("Sash", (0.5, 0.5, 0.5))
    facing = degrees(0, 0, turn)
    along = Euler(facing).to_matrix() @ Vector((1.0, 0.0, 0.0))
    made = []
    for k in range(-2, 3):
        made.append(shapes.box("Sash bar", (0.055, 0.01, 1.5), wood, rotation=facing,
                               location=Vector(centre) + 0.24 * k * along))
        made.append(shapes.box("Sash bar", (1.6, 0.01, 0.05), wood, rotation=facing,
                               location=Vector(centre) + Vector((0.0, 0.0, 0.20 * k))))
    for bar in made:
        bar.visible_camera = False
    parts.keep_on_this_side(*made)


def evening_light():
    """Night outside; candles, and a lamp in the next room."""
    parts.set_world_hdri("night", strength=0.5, turn=degrees(60))
    glow = parts.area_light("Ballroom", (1.3, -0.9, 0.8), (0.0, 0.0, 0.12), (0.5, 0.9), power=55.0,
                            color=(1.0, 0.55, 0.25))
    moon = parts.area_light("Moon", (-1.6, -0.9, 1.2), (0.0, 0.0, 0.1), (0.5, 0.8), power=14.0,
                            color=(0.35, 0.50, 1.0))
    parts.keep_on_this_side(glow, moon)


def dream_light(scene):
    """A low sun in front of those who look out of the mirror, and a sky of its own colours."""
    sun = bpy.data.lights.new("Dream sun", 'SUN')
    sun.energy, sun.color, sun.angle = 2.7, (1.0, 0.60, 0.30), degrees(3.0)
    item = bpy.data.objects.new("Dream sun", sun)
    item.rotation_euler = degrees(60, 0, 148)
    scene.collection.objects.link(item)
    parts.send_behind_mirror(item)
    sky = dream_sky()
    if hasattr(scene, "tenniel"):
        entry = scene.tenniel.dreams.add()
        entry.name, entry.world = "Behind the looking glass", sky


def dream_sky():
    """Dusk in bands, from apricot at the horizon to violet overhead."""
    world = bpy.data.worlds.new("Dream sky")
    world.use_nodes = True
    nodes = parts.Nodes(world.node_tree)
    height = nodes.add("SeparateXYZ", {0: nodes.add("TexCoord").outputs["Generated"]}).outputs["Z"]
    ramp = nodes.add("ValToRGB", {"Fac": height})
    bands = ((0.0, (1.00, 0.42, 0.10)), (0.06, (1.0, 0.24, 0.16)), (0.16, (0.60, 0.10, 0.34)),
             (0.34, (0.16, 0.07, 0.48)), (1.0, (0.05, 0.07, 0.30)))
    elements = ramp.color_ramp.elements
    while len(elements) < len(bands):
        elements.new(0.5)
    for element, (place, color) in zip(elements, bands):
        element.position, element.color = place, (*color, 1.0)
    nodes.add("OutputWorld", {0: nodes.add("Background", {"Color": ramp, "Strength": 0.75})})
    return world
