# SPDX-License-Identifier: GPL-3.0-or-later
"""Balls and planks with Principled materials that pictures drive: colour, roughness and relief by a
normal map, as they come from public libraries."""

import parts
import shapes

RADIUS = 0.5
SPACING = 1.15


def build(scene):
    parts.render_settings(scene, 1280, 720, samples=128)
    parts.set_world_hdri("courtyard", strength=0.6, turn=parts.degrees(60))
    parts.area_light("Key", (-3.5, -5.0, 6.0), (0.0, 0.0, 0.3), (2.0, 2.0), power=350.0,
                     color=(1.0, 0.93, 0.84))
    planks()
    balls = [wood("Varnished", (2.0, 1.0), 0.3), wood("Raw", (3.0, 1.5), 1.0),
             paper("Wallpaper", "wallpaper", (4.0, 2.0)), wood("Turned", (1.0, 3.0), 0.6),
             paper("Cards", "card_back", (5.0, 2.0)), stones("Red bricks", (0.62, 0.22, 0.14)),
             paper("Grid", "uv_grid", (2.0, 1.0)), stones("Glazed", (0.12, 0.42, 0.45), 0.3)]
    for index, material in enumerate(balls):
        row, column = divmod(index, 4)
        shapes.sphere(material.name, RADIUS, material, segments=64,
                      location=(SPACING * (column - 1.5), 1.1 * SPACING * (0.5 - row), RADIUS),
                      rotation=parts.degrees(20, 10, 200))
    parts.camera((0.0, -5.6, 4.2), (0.0, -0.15, 0.35), focal_length=48.0)


def planks():
    board = wood("Boards", (0.5, 1.0), 0.7)
    for index in range(16):
        shapes.box(f"Board {index}", (9.0, 0.79, 0.1), board, bevel=0.008,
                   location=(0.37 * (index % 3), 0.8 * (index - 5), -0.05))


def picture(nodes, place, name, data=False):
    node = nodes.picture(name, data=data)
    nodes.connect(node.inputs["Vector"], place)
    return node


def placed(name, scale):
    material, nodes = parts.new_material(name)
    place = nodes.add("Mapping", {"Vector": nodes.add("TexCoord").outputs["UV"],
                                  "Scale": (*scale, 1.0)})
    return material, nodes, place


def wood(name, scale, dullness):
    material, nodes, place = placed(name, scale)
    relief = nodes.add("NormalMap", {"Color": picture(nodes, place, "wood_normal", True)})
    rough = nodes.add("Math", {0: picture(nodes, place, "wood_roughness", True), 1: dullness},
                      operation='MULTIPLY')
    nodes.surface(nodes.add("BsdfPrincipled", {
        "Base Color": picture(nodes, place, "wood_albedo"), "Roughness": rough,
        "Normal": relief}))
    return material


def paper(name, print_name, scale):
    """A print on fibres: the grain of the wood serves for both."""
    material, nodes, place = placed(name, scale)
    relief = nodes.add("NormalMap", {"Color": picture(nodes, place, "wood_normal", True),
                                     "Strength": 0.5})
    nodes.surface(nodes.add("BsdfPrincipled", {
        "Base Color": picture(nodes, place, print_name),
        "Roughness": picture(nodes, place, "wood_roughness", True), "Normal": relief}))
    return material


def stones(name, color, dullness=1.0):
    """Bricks by their relief alone; the picture of wood spots their colour."""
    material, nodes, place = placed(name, (4.0, 2.0))
    relief = nodes.add("NormalMap", {"Color": picture(nodes, place, "bricks_normal", True)})
    tint = nodes.add("MixRGB", {"Fac": 0.6, "Color1": color,
                                "Color2": picture(nodes, place, "wood_albedo")},
                     blend_type='MULTIPLY')
    rough = nodes.add("Math", {0: picture(nodes, place, "wood_roughness", True), 1: dullness},
                      operation='MULTIPLY')
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": tint, "Roughness": rough,
                                               "Normal": relief}))
    return material
