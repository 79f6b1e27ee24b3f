# SPDX-License-Identifier: GPL-3.0-or-later
"""One sphere for each closure, model and texture that the renderer knows, in rows by family."""

import math

import parts
import shapes

RADIUS = 0.42
SPACING = 1.05


def build(scene):
    parts.render_settings(scene, 1280, 800, samples=128)
    parts.set_world_hdri("courtyard", strength=0.9, turn=parts.degrees(40))
    parts.area_light("Key", (-5.0, -6.0, 7.0), (0.0, 0.0, 0.0), (2.5, 2.5), power=500.0,
                     color=(1.0, 0.93, 0.84))
    shapes.plane("Floor", (60.0, 60.0), floor_material(), location=(0.0, 0.0, 0.0))
    rows = [diffuse_row(), glossy_row(), transmission_row(), principled_row(), texture_row()]
    for row, materials in enumerate(rows):
        for column, material in enumerate(materials):
            x = SPACING * (column - 0.5 * (len(materials) - 1))
            y = 1.25 * SPACING * (2 - row)
            item = shapes.sphere(material.name, RADIUS, material, segments=64,
                                 location=(x, y, RADIUS), rotation=parts.degrees(0, 0, 200))
            item.pass_index = 10 * (row + 1) + column
    parts.camera((0.0, -11.0, 8.6), (0.0, -0.15, 0.2), focal_length=56.0)


def floor_material():
    material, nodes = parts.new_material("Floor")
    coordinate = nodes.add("TexCoord")
    checker = nodes.add("TexChecker", {"Vector": coordinate.outputs["Object"],
                                       "Color1": (0.34, 0.34, 0.35), "Color2": (0.22, 0.22, 0.23),
                                       "Scale": 1.0 / SPACING})
    nodes.surface(nodes.add("BsdfDiffuse", {"Color": checker}))
    return material


# ------------------------------------------------------------------------------- closures

def diffuse_row():
    red, sand = (0.55, 0.10, 0.07), (0.62, 0.52, 0.36)
    return [
        parts.shader("Diffuse", "BsdfDiffuse", {"Color": red}),
        parts.shader("Oren-Nayar 0.5", "BsdfDiffuse", {"Color": red, "Roughness": 0.5}),
        parts.shader("Oren-Nayar 1", "BsdfDiffuse", {"Color": red, "Roughness": 1.0}),
        parts.shader("Translucent", "BsdfTranslucent", {"Color": sand}),
        mixed("Mix half transparent", 0.5, ("BsdfDiffuse", {"Color": sand}),
              ("BsdfTransparent", {"Color": (0.9, 0.95, 1.0)})),
        added("Add diffuse and glow", ("BsdfDiffuse", {"Color": (0.05, 0.12, 0.3)}),
              ("Emission", {"Color": (0.15, 0.4, 1.0), "Strength": 0.25})),
        parts.emission("Emission", (1.0, 0.62, 0.25), 2.0),
    ]


def glossy_row():
    gold, steel = (1.0, 0.72, 0.32), (0.72, 0.74, 0.77)

    def glossy(name, color, roughness, distribution):
        return parts.shader(name, "BsdfGlossy", {"Color": color, "Roughness": roughness},
                            distribution=distribution)
    return [
        glossy("Glossy sharp", steel, 0.0, 'SHARP'),
        glossy("GGX 0.1", gold, 0.1, 'GGX'),
        glossy("GGX 0.3", gold, 0.3, 'GGX'),
        glossy("GGX 0.6", gold, 0.6, 'GGX'),
        glossy("Beckmann 0.1", steel, 0.1, 'BECKMANN'),
        glossy("Beckmann 0.3", steel, 0.3, 'BECKMANN'),
        glossy("Beckmann 0.6", steel, 0.6, 'BECKMANN'),
    ]


def transmission_row():
    clear, green = (1.0, 1.0, 1.0), (0.75, 0.95, 0.85)

    def glass(name, kind, color, roughness, distribution='GGX'):
        return parts.shader(name, kind, {"Color": color, "Roughness": roughness, "IOR": 1.45},
                            distribution=distribution)
    return [
        glass("Glass sharp", "BsdfGlass", clear, 0.0, 'SHARP'),
        glass("Glass GGX 0.1", "BsdfGlass", clear, 0.1),
        glass("Glass GGX 0.35", "BsdfGlass", green, 0.35),
        glass("Glass Beckmann 0.2", "BsdfGlass", green, 0.2, 'BECKMANN'),
        glass("Refraction sharp", "BsdfRefraction", clear, 0.0, 'SHARP'),
        glass("Refraction 0.25", "BsdfRefraction", green, 0.25),
        fresnel_coat("Fresnel coat"),
    ]


def principled_row():
    blue, ivory = (0.06, 0.16, 0.42), (0.75, 0.68, 0.55)
    return [
        parts.principled("Plastic", blue, 0.25),
        parts.principled("Metallic", (0.91, 0.53, 0.40), 0.2, metallic=1.0),
        parts.principled("Anisotropic", (0.8, 0.8, 0.82), 0.3, metallic=1.0, anisotropic=0.9),
        parts.principled("Clearcoat", (0.45, 0.02, 0.03), 0.55, clearcoat=1.0,
                         clearcoat_roughness=0.05),
        parts.principled("Sheen", (0.16, 0.05, 0.20), 0.9, specular=0.1, sheen=1.0,
                         sheen_tint=0.6),
        parts.principled("Transmission", (0.95, 0.98, 1.0), 0.05, transmission=1.0, ior=1.5),
        parts.principled("Alpha", ivory, 0.4, alpha=0.55),
    ]


# -------------------------------------------------------------------------------- textures

def texture_row():
    return [
        textured("Image", lambda n: n.picture("uv_grid")),
        textured("Image box", lambda n: n.picture(
            "card_back", projection='BOX', projection_blend=0.25), coordinate="Generated"),
        textured("Checker", lambda n: n.add(
            "TexChecker", {"Color1": (0.7, 0.7, 0.66), "Color2": (0.04, 0.05, 0.06),
                           "Scale": 12.0})),
        ramp("Color ramp"),
        bump("Bump"),
        normal_map("Normal map"),
        layer_weight("Layer weight"),
    ]


def textured(name, texture, coordinate="UV"):
    material, nodes = parts.new_material(name)
    picture = texture(nodes)
    nodes.connect(picture.inputs["Vector"], nodes.add("TexCoord").outputs[coordinate])
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": picture, "Roughness": 0.5}))
    return material


def ramp(name):
    """Height in object space through a colour ramp of four stops."""
    material, nodes = parts.new_material(name)
    axes = nodes.add("SeparateXYZ", {0: nodes.add("TexCoord").outputs["Generated"]})
    node = nodes.add("ValToRGB", {"Fac": axes.outputs["Z"]})
    stops = node.color_ramp.elements
    stops[0].color = (0.02, 0.05, 0.20, 1.0)
    stops[1].color = (1.0, 0.85, 0.45, 1.0)
    stops.new(0.4).color = (0.45, 0.06, 0.16, 1.0)
    stops.new(0.7).color = (0.95, 0.35, 0.08, 1.0)
    nodes.surface(nodes.add("BsdfDiffuse", {"Color": node.outputs["Color"]}))
    return material


def bump(name):
    """Rings from a sine of the object's height."""
    material, nodes = parts.new_material(name)
    axes = nodes.add("SeparateXYZ", {0: nodes.add("TexCoord").outputs["Object"]})
    phase = nodes.add("Math", {0: axes.outputs["Z"], 1: 20.0 * math.pi}, operation='MULTIPLY')
    height = nodes.add("Math", {0: phase}, operation='SINE')
    relief = nodes.add("Bump", {"Strength": 0.6, "Distance": 0.015, "Height": height})
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": (0.30, 0.42, 0.20), "Roughness": 0.35,
                                               "Normal": relief}))
    return material


def normal_map(name):
    material, nodes = parts.new_material(name)
    mapping = nodes.add("Mapping", {"Vector": nodes.add("TexCoord").outputs["UV"],
                                    "Scale": (4.0, 2.0, 1.0)})
    picture = nodes.picture("bricks_normal", data=True)
    nodes.connect(picture.inputs["Vector"], mapping)
    relief = nodes.add("NormalMap", {"Color": picture, "Strength": 1.0})
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": (0.42, 0.16, 0.10), "Roughness": 0.6,
                                               "Normal": relief}))
    return material


def layer_weight(name):
    """Two colours by the angle of view."""
    material, nodes = parts.new_material(name)
    weight = nodes.add("LayerWeight", {"Blend": 0.4})
    mixed_color = nodes.add("MixRGB", {"Fac": weight.outputs["Facing"],
                                       "Color1": (0.02, 0.10, 0.12), "Color2": (0.55, 0.95, 0.70)})
    nodes.surface(nodes.add("BsdfDiffuse", {"Color": mixed_color}))
    return material


# ------------------------------------------------------------------------------- mixtures

def mixed(name, factor, first, second):
    material, nodes = parts.new_material(name)
    nodes.surface(nodes.add("MixShader", {0: factor, 1: nodes.add(*first), 2: nodes.add(*second)}))
    return material


def added(name, first, second):
    material, nodes = parts.new_material(name)
    nodes.surface(nodes.add("AddShader", {0: nodes.add(*first), 1: nodes.add(*second)}))
    return material


def fresnel_coat(name):
    """A sharp coat over a diffuse base, mixed by the Fresnel node."""
    material, nodes = parts.new_material(name)
    base = nodes.add("BsdfDiffuse", {"Color": (0.03, 0.22, 0.12)})
    coat = nodes.add("BsdfGlossy", {"Roughness": 0.0}, distribution='SHARP')
    nodes.surface(nodes.add("MixShader", {0: nodes.add("Fresnel", {"IOR": 1.6}), 1: base, 2: coat}))
    return material
