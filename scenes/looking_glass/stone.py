# SPDX-License-Identifier: GPL-3.0-or-later
"""Two marbles. The white one is lit from within: half of it is a medium that scatters light."""

import parts


def veins(nodes, scale, sharpness):
    """Thin lines where a warped noise crosses its middle; 1 on the line."""
    place = nodes.add("TexCoord").outputs["Object"]
    warp = nodes.add("TexNoise", {"Vector": place, "Scale": 0.7 * scale, "Detail": 5.0})
    moved = nodes.add("VectorMath", {0: place, 1: nodes.add(
        "VectorMath", {0: warp.outputs["Color"], "Scale": 1.1 / scale},
        operation='SCALE')}, operation='ADD')
    field = nodes.add("TexNoise", {"Vector": moved, "Scale": scale, "Detail": 3.0})
    off_middle = nodes.add("Math", {0: nodes.add("Math", {0: field, 1: 0.5}, operation='SUBTRACT')},
                           operation='ABSOLUTE')
    return nodes.add("MapRange", {"Value": off_middle, "From Min": 0.0, "From Max": sharpness,
                                  "To Min": 1.0, "To Max": 0.0})


def white_marble():
    """Polish over a surface that lets half of the light into the scattering medium inside. The
    light is not bent where it enters, so that lamps reach the inside directly."""
    material, nodes = parts.new_material("White marble")
    vein = veins(nodes, 38.0, 0.045)
    color = nodes.add("MixRGB", {"Fac": nodes.add("Math", {0: vein, 1: 0.75},
                                                  operation='MULTIPLY'),
                                 "Color1": (0.74, 0.72, 0.67), "Color2": (0.13, 0.14, 0.16)})
    crust = nodes.add("BsdfDiffuse", {"Color": color})
    clear = nodes.add("BsdfTransparent", {"Color": (1.0, 1.0, 1.0)})
    into = nodes.add("MixShader", {0: nodes.add("MapRange", {"Value": vein, "To Min": 0.55,
                                                             "To Max": 0.92}),
                                   1: clear, 2: crust})
    polish = nodes.add("BsdfGlossy", {"Color": (1.0, 1.0, 1.0), "Roughness": 0.10},
                       distribution='GGX')
    surface = nodes.add("MixShader", {0: nodes.add("Fresnel", {"IOR": 1.5}), 1: into, 2: polish})
    medium = nodes.add("VolumeScatter", {"Color": (0.97, 0.93, 0.86), "Density": 260.0,
                                         "Anisotropy": 0.2})
    nodes.surface(surface, volume=medium)
    return material


def dark_marble():
    material, nodes = parts.new_material("Dark marble")
    color = nodes.add("MixRGB", {"Fac": veins(nodes, 34.0, 0.022), "Color1": (0.016, 0.018, 0.020),
                                 "Color2": (0.42, 0.36, 0.26)})
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": color, "Roughness": 0.12,
                                               "Clearcoat": 0.4}))
    return material
