# SPDX-License-Identifier: GPL-3.0-or-later
"""Exhibits of metals and glass, and of light from an environment."""

import parts
import shapes
from tenniel.presets import menu
from tenniel.presets.tables import METALS

from . import exhibit, stage

ROUGHNESSES = (0.1, 0.25, 0.4, 0.6)


def metal(name, roughness):
    """A material of one measured metal: the group of Add > Tenniel > Metal."""
    material, nodes = parts.new_material(name)
    group = menu.add_metal(nodes.tree, name)
    group.inputs["Roughness"].default_value = roughness
    nodes.surface(group)
    return material


def surroundings(name, strength=1.0, turn=0.0):
    """Light from one of Blender's studio pictures, and a floor that receives it."""
    parts.set_world_hdri(name, strength, parts.degrees(turn))
    stage.sweep("Backdrop", parts.diffuse("Backdrop", (0.20, 0.19, 0.18)))


@exhibit("Gold", "Smooth gold by its complex index: exact reflectance, no colour chosen by hand.")
def gold():
    stage.studio(2.5, 0.60, backdrop=(0.34, 0.26, 0.20), light=1.3)
    stage.pawn(metal("Gold", 0.03))


@exhibit("Rough gold", "The same gold at roughness 0.1, 0.25, 0.4 and 0.6.")
def gold_rough():
    stage.studio(3.9, 0.62)
    for roughness, x in zip(ROUGHNESSES, stage.row(4, 0.98)):
        stage.pawn(metal("Gold", roughness), x)


@exhibit("Rough aluminium", "Aluminium at roughness 0.1, 0.25, 0.4 and 0.6.")
def aluminium_rough():
    stage.studio(3.9, 0.62)
    for roughness, x in zip(ROUGHNESSES, stage.row(4, 0.98)):
        stage.pawn(metal("Aluminium", roughness), x)


@exhibit("Thirteen metals", "All that the add-on has measured: " + ", ".join(METALS) + ".")
def metals():
    surroundings("interior", 1.0, 150.0)
    names = list(METALS)
    for count, y in ((4, 0.9), (5, 0.0), (4, -0.9)):
        for x in stage.row(count, 0.95):
            name = names.pop(0)
            shapes.sphere(name, 0.41, metal(name, 0.12), location=(x, y, 0.41))
    stage.view(5.1, 0.40, 0.55)


@exhibit("Rough glass", "Glass of index 1.5 at roughness 0, 0.15, 0.3 and 0.5 before a grid.",
         samples=96)
def glass_rough():
    stage.studio(4.0, 0.62, light=1.1)
    grid, nodes = parts.new_material("Grid")
    mapping = nodes.add("Mapping", {"Vector": nodes.add("TexCoord").outputs["UV"],
                                    "Scale": (2.5, 0.8, 1.0)})
    picture = nodes.picture("uv_grid")
    nodes.connect(picture.inputs["Vector"], mapping)
    nodes.surface(nodes.add("BsdfDiffuse", {"Color": picture}))
    shapes.plane("Grid", (5.4, 1.7), grid, location=(0.0, 1.3, 0.85),
                 rotation=parts.degrees(90, 0, 0))
    for roughness, x in zip((0.0, 0.15, 0.3, 0.5), stage.row(4, 0.98)):
        shapes.sphere("Glass", 0.45, parts.shader(
            f"Glass {roughness}", "BsdfGlass", {"Roughness": roughness, "IOR": 1.5},
            distribution='GGX'), segments=96, location=(x, 0.0, 0.45))


@exhibit("Environment", "One picture of the surroundings is all the light: matte, lacquered, "
                        "polished and clear.")
def environment():
    surroundings("courtyard", 0.9, 200.0)
    materials = (parts.diffuse("Matte", (0.75, 0.73, 0.70)),
                 parts.principled("Lacquer", (0.45, 0.02, 0.02), 0.4, clearcoat=1.0),
                 metal("Chromium", 0.02),
                 parts.shader("Clear", "BsdfGlass", {"IOR": 1.5, "Roughness": 0.0}))
    core = parts.principled("Core", (0.60, 0.12, 0.05), 0.3)
    for material, x in zip(materials, stage.row(4, 0.98)):
        stage.pawn(material, x, core=core if material.name == "Clear" else None)
    stage.view(4.0, 0.62, 0.12)


@exhibit("Principled", "Plastic, clear coat, brushed metal, velvet sheen and thin glass.")
def principled():
    stage.studio(4.9, 0.62)
    looks = (parts.principled("Plastic", (0.05, 0.22, 0.45), 0.25),
             parts.principled("Lacquer", (0.42, 0.02, 0.03), 0.5, clearcoat=1.0,
                              clearcoat_roughness=0.03),
             parts.principled("Brushed", (0.80, 0.78, 0.74), 0.35, metallic=1.0, anisotropic=0.85),
             parts.principled("Velvet", (0.14, 0.04, 0.20), 1.0, specular=0.0, sheen=1.0,
                              sheen_tint=0.4),
             parts.principled("Ice", (0.85, 0.95, 1.0), 0.12, transmission=1.0, ior=1.31))
    core = parts.principled("Core", (0.60, 0.12, 0.05), 0.3)
    for material, x in zip(looks, stage.row(len(looks), 0.96)):
        stage.pawn(material, x, core=core if material.name == "Ice" else None)
