# SPDX-License-Identifier: GPL-3.0-or-later
"""A candle that burns behind the mirror only, except in the evening."""

import parts
import shapes

from .layout import CANDLE


def build(looks, lit):
    x, y = CANDLE
    profile = shapes.smooth_profile(
        [(0.0, 0.0), (0.0, 0.0), (0.042, 0.0), (0.042, 0.0), (0.043, 0.006), (0.034, 0.011),
         (0.013, 0.018), (0.008, 0.030), (0.014, 0.044), (0.008, 0.056), (0.006, 0.085),
         (0.011, 0.102), (0.007, 0.112), (0.020, 0.124), (0.021, 0.128), (0.021, 0.128),
         (0.012, 0.128), (0.012, 0.128), (0.0, 0.126)])
    shapes.lathe("Candlestick", profile, looks.brass, location=(x, y, 0.0))
    wax = [(0.0, 0.0), (0.0102, 0.0), (0.0100, 0.11), (0.0094, 0.1125), (0.006, 0.1105),
           (0.0, 0.110)]
    shapes.lathe("Candle", wax, looks.wax, location=(x, y, 0.127))
    shapes.lathe("Wick", [(0.0, 0.0), (0.0008, 0.0), (0.0006, 0.010), (0.0, 0.0102)], looks.wick,
                 segments=12, location=(x, y, 0.2365))
    flame = shapes.lathe(
        "Flame", shapes.smooth_profile([(0.0, 0.0), (0.0042, 0.006), (0.0050, 0.012),
                                        (0.0030, 0.024), (0.0, 0.036)]),
        fire(), segments=24, location=(x, y, 0.242))
    glow = parts.point_light("Candle light", (x, y, 0.258), 0.007, power=12.0 if lit else 1.6,
                             color=(1.0, 0.58, 0.24))
    glow.visible_camera = False
    glow.visible_glossy = False
    flame.visible_shadow = False
    if not lit:
        parts.send_behind_mirror(flame, glow)


def fire():
    """Blue where it leaves the wick, then bright, orange at its tip and where it is seen aslant."""
    material, nodes = parts.new_material("Flame")
    height = nodes.add("SeparateXYZ", {0: nodes.add("TexCoord").outputs["Object"]}).outputs["Z"]
    ramp = nodes.add("ValToRGB", {"Fac": nodes.add("MapRange", {"Value": height,
                                                                "From Max": 0.036})})
    bands = ((0.0, (0.02, 0.05, 0.30)), (0.16, (0.60, 0.22, 0.04)), (0.40, (1.0, 0.52, 0.16)),
             (1.0, (0.80, 0.22, 0.02)))
    elements = ramp.color_ramp.elements
    while len(elements) < len(bands):
        elements.new(0.5)
    for element, (place, color) in zip(elements, bands):
        element.position, element.color = place, (*color, 1.0)
    aslant = nodes.add("LayerWeight", {"Blend": 0.5}).outputs["Facing"]
    strength = nodes.add("MapRange", {"Value": aslant, "From Min": 0.1, "From Max": 0.8,
                                      "To Min": 14.0, "To Max": 2.5})
    nodes.surface(nodes.add("Emission", {"Color": ramp, "Strength": strength}))
    return material
