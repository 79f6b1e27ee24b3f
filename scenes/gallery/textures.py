# SPDX-License-Identifier: GPL-3.0-or-later
"""Exhibits of coordinates, patterns, pictures and relief."""

import math

import parts
import shapes

from . import exhibit, stage


# --------------------------------------------------------------------------------- mapping

def _mapped(projection, turn=(0.0, 0.0, 0.0)):
    """Three bodies without UVs that wear the test grid by a projection of the Image node."""
    material, nodes = parts.new_material(projection.title())
    # About the middle of the body, each side one unit away.
    centred = nodes.add("Mapping", {"Vector": nodes.add("TexCoord").outputs["Generated"],
                                    "Rotation": turn})
    grid = nodes.picture("uv_grid", projection=projection)
    nodes.connect(grid.inputs["Vector"], centred)
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": grid, "Roughness": 0.45}))
    stage.studio(3.3, 0.5)
    bodies = (
        shapes.box("Box", (0.75, 0.75, 0.75), material, bevel=0.04, location=(-1.1, 0.1, 0.375),
                   rotation=parts.degrees(0, 0, 28)),
        shapes.sphere("Ball", 0.48, material, location=(0.0, 0.0, 0.48)),
        shapes.lathe("Vase", shapes.smooth_profile(
            [(0.0, 0.0), (0.26, 0.0), (0.26, 0.0), (0.42, 0.35), (0.30, 0.75), (0.18, 0.95),
             (0.30, 1.10)]), material, location=(1.1, 0.0, 0.0)),
    )
    for body in bodies:
        while body.data.uv_layers:
            body.data.uv_layers.remove(body.data.uv_layers[0])


@exhibit("Plane mapping", "Meshes without UVs; the grid is laid on from the front and stretched "
                          "along the depth.")
def mapping_plane():
    _mapped('FLAT', parts.degrees(90, 0, 0))


@exhibit("Cylinder mapping", "The same meshes; the grid is wound about the upright axis.")
def mapping_cylinder():
    _mapped('TUBE')


@exhibit("Sphere mapping", "The same meshes; longitude and latitude about the middle.")
def mapping_sphere():
    _mapped('SPHERE')


@exhibit("Box mapping", "The same meshes; one picture from each of six sides, blended.")
def mapping_box():
    _mapped('BOX')


# -------------------------------------------------------------------------------- patterns

@exhibit("Bricks and wood", "Left: a procedural brick pattern on a matte ball. Right: boards with "
                            "pictures of colour, roughness and normals on a glossy one.")
def bricks_and_wood():
    stage.studio(2.5, 0.54)
    bricks, nodes = parts.new_material("Bricks")
    mapping = nodes.add("Mapping", {"Vector": nodes.add("TexCoord").outputs["UV"],
                                    "Scale": (12.0, 6.0, 1.0)})
    pattern = nodes.add("TexBrick", {"Vector": mapping, "Color1": (0.50, 0.13, 0.07),
                                     "Color2": (0.30, 0.07, 0.05), "Mortar": (0.62, 0.58, 0.52),
                                     "Scale": 1.6, "Mortar Size": 0.03})
    nodes.surface(nodes.add("BsdfDiffuse", {"Color": pattern.outputs["Color"], "Roughness": 0.6}))
    shapes.sphere("Brick Ball", 0.56, bricks, location=(-0.65, 0.0, 0.56),
                  rotation=parts.degrees(0, 0, 30))
    shapes.sphere("Wood Ball", 0.56, _wood(), location=(0.65, 0.0, 0.56),
                  rotation=parts.degrees(12, 18, 30))


def _wood():
    material, nodes = parts.new_material("Wood")
    mapping = nodes.add("Mapping", {"Vector": nodes.add("TexCoord").outputs["UV"],
                                    "Scale": (2.0, 1.0, 1.0)})
    albedo, rough, normal = (nodes.picture(f"wood_{name}", data=name != "albedo")
                             for name in ("albedo", "roughness", "normal"))
    for picture in (albedo, rough, normal):
        nodes.connect(picture.inputs["Vector"], mapping)
    relief = nodes.add("NormalMap", {"Color": normal, "Strength": 0.6})
    nodes.surface(nodes.add("BsdfPrincipled", {
        "Base Color": albedo, "Roughness": rough, "Normal": relief, "Clearcoat": 0.8,
        "Clearcoat Roughness": 0.06}))
    return material


@exhibit("Cards", "Pictures with alpha clipped by the outline; front, back and rim are three "
                  "materials.")
def cards():
    stage.studio(2.6, 0.55, backdrop=(0.05, 0.16, 0.11))
    names = ("card_spades_1", "card_hearts_7", "card_clubs_5", "card_diamonds_9", "card_back")
    width, height = 0.62, 0.62 * 90.0 / 64.0
    edge = parts.principled("Edge", (0.8, 0.78, 0.72), 0.6)
    for index, (name, x) in enumerate(zip(names, stage.row(len(names), 0.40))):
        faces = [_paper(picture) for picture in (name, "card_back")]
        shapes.outline("Card", shapes.rounded_rectangle(width, height, 0.04), 0.006,
                       [*faces, edge], (width, height),
                       location=(x, 0.22 * abs(x) - 0.05 * index, 0.5 * height + 0.02),
                       rotation=parts.degrees(80 - 2 * index, 10 * x, -22 * x))


def _paper(picture):
    material, nodes = parts.new_material(picture)
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": nodes.picture(picture),
                                               "Roughness": 0.38}))
    return material


# ---------------------------------------------------------------------------------- relief

def _tiles(materials):
    """Upright tiles in two rows under a light from the side, so that relief shows."""
    parts.set_world_color((0.5, 0.6, 0.75), 0.12)
    parts.area_light("Side", (-3.0, -1.6, 2.6), (0.0, 0.0, 0.0), (0.5, 0.5), power=160.0)
    stage.sweep("Backdrop", parts.diffuse("Backdrop", (0.12, 0.12, 0.13)))
    columns = (len(materials) + 1) // 2
    for index, material in enumerate(materials):
        x = stage.row(columns, 0.98)[index % columns]
        shapes.plane("Tile", (0.9, 0.9), material, rotation=parts.degrees(80, 0, 0),
                     location=(x, 0.12 - 0.12 * (index // columns),
                               1.55 - 0.98 * (index // columns)))
    stage.view(1.12 * columns, 1.05, 0.05)


@exhibit("Normal maps", "Above: strength 0.5, 1 and 2 of a map with green up. Below: the same for "
                        "the other convention, its green turned round by two nodes.")
def normal_map():
    def tile(strength, is_green_down):
        material, nodes = parts.new_material("Tile")
        picture = nodes.picture("bricks_normal", data=True)
        color = picture
        if is_green_down:
            # What a map of the other convention holds, and its repair.
            color = _green_turned(nodes, _green_turned(nodes, picture))
        relief = nodes.add("NormalMap", {"Color": color, "Strength": strength})
        nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": (0.50, 0.20, 0.13),
                                                   "Roughness": 0.5, "Normal": relief}))
        return material
    _tiles([tile(strength, down) for down in (False, True) for strength in (0.5, 1.0, 2.0)])


def _green_turned(nodes, color):
    split = nodes.add("SeparateColor", {"Color": color})
    turned = nodes.add("Math", {0: 1.0, 1: split.outputs["Green"]}, operation='SUBTRACT')
    return nodes.add("CombineColor", {"Red": split.outputs["Red"], "Green": turned,
                                      "Blue": split.outputs["Blue"]})


@exhibit("Bump", "Heights from Voronoi, wave and noise textures; below with the opposite sign.")
def bump():
    def tile(kind, inputs, output, is_inverted):
        material, nodes = parts.new_material("Tile")
        texture = nodes.add(kind, {"Vector": nodes.add("TexCoord").outputs["UV"], **inputs})
        relief = nodes.add("Bump", {"Height": texture.outputs[output], "Strength": 0.8,
                                    "Distance": 0.06}, invert=is_inverted)
        nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": (0.30, 0.38, 0.42),
                                                   "Roughness": 0.35, "Normal": relief}))
        return material
    heights = (("TexVoronoi", {"Scale": 7.0}, "Distance"),
               ("TexWave", {"Scale": 2.2, "Distortion": 3.0, "Detail": 2.0}, "Fac"),
               ("TexNoise", {"Scale": 6.0, "Detail": 5.0}, "Fac"))
    _tiles([tile(*height, inverted) for inverted in (False, True) for height in heights])


@exhibit("Noise family", "Noise, Musgrave, Voronoi, Wave and Magic through colour ramps.")
def noises():
    stage.studio(4.6, 0.42)
    kinds = (("TexNoise", {"Scale": 5.0, "Detail": 6.0}), ("TexMusgrave", {"Scale": 5.0}),
             ("TexVoronoi", {"Scale": 6.0}), ("TexWave", {"Scale": 3.0, "Distortion": 4.0}),
             ("TexMagic", {"Scale": 4.0, "Distortion": 1.4}))
    for (kind, inputs), x in zip(kinds, stage.row(len(kinds), 0.9)):
        material, nodes = parts.new_material(kind)
        texture = nodes.add(kind, {"Vector": nodes.add("TexCoord").outputs["Object"], **inputs})
        ramp = nodes.add("ValToRGB", {"Fac": texture.outputs["Distance" if kind == "TexVoronoi"
                                                             else "Fac"]})
        stops = ramp.color_ramp.elements
        stops[0].color, stops[1].color = (0.02, 0.07, 0.16, 1.0), (0.93, 0.80, 0.52, 1.0)
        stops.new(0.5).color = (0.45, 0.10, 0.12, 1.0)
        nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": ramp.outputs["Color"],
                                                   "Roughness": 0.3}))
        shapes.sphere(kind, 0.42, material, location=(x, 0.0, 0.42),
                      rotation=(0.0, 0.0, math.radians(20)))
