# SPDX-License-Identifier: GPL-3.0-or-later
"""A material that looks cut in wood: lines that run around the form, thicker where it is dark."""

import parts

PAPER = (0.86, 0.82, 0.71)
INK = (0.012, 0.010, 0.010)
LAMP = (0.50, 0.52, 0.69)              # where the engraver's light comes from; it is not a lamp
PITCH = 0.47                            # distance of the lines, in units of the object


def engraved(name, stuff, slant=(0.20, 0.42, 1.0), pitch=PITCH, paper=PAPER):
    """`stuff` is the darkness of the material itself, from 0 (white fur) to 1; `slant` the normal
    of the planes that cut the lines, `pitch` their distance. A `paper` of another colour is tinted
    by hand."""
    material, nodes = parts.new_material(name)
    tone = darkness(nodes, stuff)
    first = family(nodes, slant, pitch, tone, 0.0)
    second = family(nodes, (0.85, -0.3, 0.65), 1.15 * pitch, tone, 0.42)
    third = family(nodes, (-0.85, 0.3, 0.65), 1.15 * pitch, tone, 0.74)
    contour = step(nodes, nodes.add("LayerWeight", {"Blend": 0.5}).outputs["Facing"], 0.84, 0.90)
    ink = None
    for layer in (first, second, third, contour):
        ink = layer if ink is None else math(nodes, 'MAXIMUM', ink, layer)
    color = nodes.add("MixRGB", {"Fac": ink, "Color1": paper, "Color2": INK})
    nodes.surface(nodes.add("BsdfDiffuse", {"Color": color}))
    return material


def darkness(nodes, stuff):
    normal = nodes.add("NewGeometry").outputs["Normal"]
    lit = nodes.add("VectorMath", {0: normal, 1: LAMP}, operation='DOT_PRODUCT').outputs["Value"]
    return nodes.add("MapRange", {"Value": lit, "From Min": -0.35, "From Max": 0.86,
                                  "To Min": 0.96, "To Max": stuff}, interpolation_type='LINEAR')


def family(nodes, slant, pitch, tone, start):
    """Coverage by parallel lines whose width grows as the tone rises above `start`."""
    place = nodes.add("TexCoord").outputs["Object"]
    tremor = nodes.add("TexNoise", {"Vector": place, "Scale": 0.55, "Detail": 2.0})
    along = nodes.add("VectorMath", {0: place, 1: slant}, operation='DOT_PRODUCT').outputs["Value"]
    phase = math(nodes, 'MULTIPLY_ADD', along, 1.0 / pitch,
                 math(nodes, 'MULTIPLY', tremor, 1.3))
    off_centre = math(nodes, 'ABSOLUTE', math(nodes, 'SUBTRACT', math(nodes, 'FRACT', phase), 0.5))
    half_width = nodes.add("MapRange", {"Value": tone, "From Min": start, "From Max": start + 0.75,
                                        "To Min": -0.06, "To Max": 0.40})
    inside = math(nodes, 'SUBTRACT', half_width, off_centre)
    return step(nodes, inside, -0.04, 0.04)


def step(nodes, value, low, high):
    return nodes.add("MapRange", {"Value": value, "From Min": low, "From Max": high})


def math(nodes, operation, *values):
    return nodes.add("Math", dict(enumerate(values)), operation=operation)
