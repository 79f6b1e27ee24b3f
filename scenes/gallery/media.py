# SPDX-License-Identifier: GPL-3.0-or-later
"""Exhibits of participating media. The bodies are metres wide and stand for centimetres: Scale
thins the measured values by as much."""

import cloud as sky
import parts
import shapes
from mathutils import Euler
from tenniel.presets import menu

from . import exhibit, stage


def filled(name, medium, scale, ior, roughness=0.0, is_absorbing_only=False):
    """A clear boundary that holds a measured medium. Without scattering, what it scatters is lost
    as well: the law of Beer and Lambert."""
    material, nodes = parts.new_material(name)
    group = menu.add_medium(nodes.tree, medium)
    group.inputs["Scale"].default_value = scale
    if is_absorbing_only:
        scattering, absorption = group.inputs[0], group.inputs[1]
        absorption.default_value = [a + s for a, s in zip(absorption.default_value,
                                                          scattering.default_value)]
        scattering.default_value = (0.0, 0.0, 0.0)
    glass = nodes.add("BsdfGlass", {"IOR": ior, "Roughness": roughness}, distribution='GGX')
    nodes.surface(glass, group)
    return material


def bright_studio(width, height):
    """Wide lamps all round: light that has to find its way out of a boundary of glass again is
    noise where the lamps are small."""
    stage.sweep("Backdrop", parts.diffuse("Backdrop", stage.WARM_GREY))
    parts.set_world_color((0.80, 0.88, 1.0), 0.55)
    parts.area_light("Ceiling", (-1.5, -0.8, 4.0), (0.0, 0.0, 0.3), (5.0, 5.0), power=420.0,
                     color=(1.0, 0.93, 0.84))
    stage.view(width, height, 0.16)


def goblet(wine, x):
    """A glass with wine: the wine reaches a little into the wall, so that nothing lies between."""
    glass = parts.shader("Goblet", "BsdfGlass", {"IOR": 1.5, "Roughness": 0.0})
    outer = [(0.0, 0.0), (0.34, 0.0), (0.34, 0.0), (0.34, 0.02), (0.06, 0.07), (0.045, 0.40),
             (0.10, 0.46), (0.36, 0.66), (0.41, 0.90), (0.36, 1.22)]
    inner = [(0.34, 1.22), (0.385, 0.90), (0.335, 0.68), (0.10, 0.50), (0.0, 0.48)]
    rim = [(0.35, 1.23)]
    shapes.lathe("Goblet", shapes.smooth_profile(outer, 8) + rim + shapes.smooth_profile(inner, 8),
                 glass, segments=96, location=(x, 0.0, 0.0))
    body = [(0.0, 0.47), (0.105, 0.49), (0.345, 0.675), (0.39, 0.86)]
    shapes.lathe("Wine", shapes.smooth_profile(body, 8) + [(0.39, 0.86), (0.0, 0.86)], wine,
                 segments=96, location=(x, 0.0, 0.0))


@exhibit("Chardonnay", "Left: the measured wine, absorbing and scattering. Right: the same loss of "
                       "light without the scattered part, as Beer and Lambert have it.",
         samples=96)
def chardonnay():
    stage.studio(2.6, 0.66, backdrop=(0.55, 0.54, 0.52))
    goblet(filled("Chardonnay", "Chardonnay", 0.1, 1.33), -0.55)
    goblet(filled("Beer-Lambert", "Chardonnay", 0.1, 1.33, is_absorbing_only=True), 0.55)


@exhibit("Liquids", "Apple juice, cranberry juice, beer, milk and coffee by their measured values, "
                    "in drops of five centimetres.", samples=128)
def liquids():
    bright_studio(5.0, 0.45)
    names = ("Apple Juice", "Cranberry Juice", "Budweiser Beer", "Lowfat Soy Milk", "Espresso")
    for name, x in zip(names, stage.row(len(names), 0.9)):
        shapes.sphere(name, 0.42, filled(name, name, 0.06, 1.33), segments=96,
                      location=(x, 0.0, 0.42))


@exhibit("Marble", "Light that enters, wanders below the polish and leaves elsewhere: measured "
                   "marble, as pieces of two, one and half a centimetre.", samples=160)
def marble():
    bright_studio(3.0, 0.62)
    for scale, x in zip((0.02, 0.01, 0.005), stage.row(3, 1.0)):
        stage.pawn(filled("Marble", "Marble", scale, 1.5, 0.12), x)


@exhibit("Smoke", "The same puff with isotropic scattering and with g = 0.5 and 0.92, lit from "
                  "behind: the more forward it scatters, the more of the lamp comes through.",
         samples=96)
def smoke():
    lit_from_behind()
    for g, x in zip((0.0, 0.5, 0.92), stage.row(3, 1.3)):
        material, nodes = parts.new_material(f"Smoke {g}")
        nodes.add("OutputMaterial", {"Volume": nodes.add("VolumeScatter", {
            "Color": (0.93, 0.93, 0.95), "Density": 4.0, "Anisotropy": g})})
        puff(material, x)
    stage.view(3.9, 0.72, 0.06)


def lit_from_behind():
    """A dark stage and a warm lamp behind, which the camera does not see itself."""
    parts.set_world_color((0.45, 0.60, 0.85), 0.12)
    stage.sweep("Backdrop", parts.diffuse("Backdrop", (0.05, 0.05, 0.06)))
    parts.area_light("Behind", (0.0, 3.0, 2.0), (0.0, -0.5, 0.6), (3.0, 1.2), power=320.0,
                     color=(1.0, 0.75, 0.48))


@exhibit("Smoke in space", "Smoke whose density varies by noise and thins out from a bent axis, "
                           "lit from behind; isotropic, g = 0.5 and g = 0.92.", samples=96)
def smoke_varying():
    lit_from_behind()
    for g, x in zip((0.0, 0.5, 0.92), stage.row(3, 1.3)):
        shapes.box("Smoke", (1.2, 0.9, 1.5), rising_smoke(g), location=(x, 0.0, 0.76))
    stage.view(3.9, 0.72, 0.06)


def rising_smoke(g):
    """Density falls with the distance from an axis that noise bends; finer noise frays it."""
    material, nodes = parts.new_material(f"Rising Smoke {g}")

    def math(operation, *operands):
        return nodes.add("Math", dict(enumerate(operands)), operation=operation)

    place = nodes.add("TexCoord").outputs["Object"]
    bend = nodes.add("TexNoise", {"Vector": place, "Scale": 1.6, "Detail": 1.0})
    offset = nodes.add("VectorMath", {0: bend.outputs["Color"], 1: (0.5, 0.5, 0.5)},
                       operation='SUBTRACT')
    bent = nodes.add("SeparateXYZ", {0: nodes.add(
        "VectorMath", {0: offset, 1: (1.1, 1.1, 0.0), 2: place}, operation='MULTIPLY_ADD')})
    distance2 = math('ADD', math('MULTIPLY', bent.outputs["X"], bent.outputs["X"]),
                     math('MULTIPLY', bent.outputs["Y"], bent.outputs["Y"]))
    # From a thin foot to a wide head, which thins out; height is -0.75 to 0.75.
    height = bent.outputs["Z"]
    width = math('MULTIPLY_ADD', height, 0.18, 0.25)
    falloff = math('DIVIDE', distance2, math('MULTIPLY', width, width))
    fading = nodes.add("MapRange", {"Value": height, "From Min": 0.1, "From Max": 0.7,
                                    "To Min": 0.0, "To Max": 1.2})
    fray = nodes.add("TexNoise", {"Vector": place, "Scale": 4.5, "Detail": 6.0,
                                  "Distortion": 1.0})
    density = math('SUBTRACT', math('MULTIPLY_ADD', fray.outputs["Fac"], 5.0, -1.6),
                   math('ADD', falloff, fading))
    thick = math('MULTIPLY', math('MAXIMUM', density, 0.0), 8.0)
    nodes.add("OutputMaterial", {"Volume": nodes.add("VolumeScatter", {
        "Color": (0.93, 0.93, 0.95), "Density": thick, "Anisotropy": g})})
    return material


@exhibit("Cloud", "A volume object: geometry nodes fill 160 x 120 x 100 voxels, the sun does the rest.",
         samples=128)
def cloud():
    sky.add_cloud((160, 120, 100))
    stage.view(3.3, 0.12, -0.10)


def puff(material, x):
    """Balls melted into one cloud that leans with the wind."""
    turn = Euler((0.0, 0.0, 0.0)).to_quaternion()
    balls = [((0.0, 0.0, 0.30), 0.20), ((0.08, 0.04, 0.50), 0.24), ((-0.10, 0.0, 0.68), 0.25),
             ((0.14, -0.05, 0.80), 0.26), ((0.34, 0.05, 0.70), 0.18), ((-0.26, 0.08, 0.86), 0.18),
             ((0.02, 0.0, 1.00), 0.26), ((0.28, 0.0, 1.05), 0.22), ((-0.18, -0.06, 1.12), 0.17)]
    shapes.blend_of_spheres("Puff", [(centre, (radius,) * 3, turn) for centre, radius in balls],
                            material, 0.035, location=(x, 0.0, 0.0))
