# SPDX-License-Identifier: GPL-3.0-or-later
"""Ten materials as they come from public libraries: trees of many nodes, nothing of one alone."""

import parts
import shapes

RADIUS = 0.5
SPACING = 1.15


def build(scene):
    parts.render_settings(scene, 1280, 640, samples=128)
    parts.set_world_hdri("courtyard", strength=0.7, turn=parts.degrees(60))
    parts.area_light("Key", (-4.0, -5.0, 6.0), (0.0, 0.0, 0.0), (1.5, 1.5), power=450.0,
                     color=(1.0, 0.94, 0.86))
    shapes.plane("Floor", (60.0, 60.0), parts.diffuse("Floor", (0.3, 0.3, 0.31)))
    for index, make in enumerate(MATERIALS):
        row, column = divmod(index, 5)
        material = make()
        shapes.sphere(material.name, RADIUS, material, segments=64,
                      location=(SPACING * (column - 2), 1.4 * SPACING * (0.5 - row), RADIUS),
                      rotation=parts.degrees(15, 10, 200))
    parts.camera((0.0, -8.5, 4.6), (0.0, 0.0, 0.4), focal_length=52.0)


def _coordinate(nodes, scale=(1.0, 1.0, 1.0), output="Object"):
    return nodes.add("Mapping", {"Vector": nodes.add("TexCoord").outputs[output], "Scale": scale})


def _ramp(nodes, factor, *stops, interpolation='LINEAR'):
    """Color Ramp of (position, (r, g, b)) stops."""
    node = nodes.add("ValToRGB", {"Fac": factor})
    ramp = node.color_ramp
    ramp.interpolation = interpolation
    while len(ramp.elements) < len(stops):
        ramp.elements.new(0.5)
    for element, (position, color) in zip(ramp.elements, stops):
        element.position = position
        element.color = (*color, 1.0)
    return node.outputs["Color"]


def _bump(nodes, height, distance, strength=1.0, normal=None):
    inputs = {"Height": height, "Distance": distance, "Strength": strength}
    if normal is not None:
        inputs["Normal"] = normal
    return nodes.add("Bump", inputs)


def wood():
    material, nodes = parts.new_material("Oak")
    place = _coordinate(nodes, (1.0, 1.0, 0.25))
    wave = nodes.add("TexWave", {"Vector": place, "Scale": 2.2, "Distortion": 7.0, "Detail": 3.0,
                                 "Detail Scale": 1.4}, wave_type='RINGS')
    pores = nodes.add("TexNoise", {"Vector": _coordinate(nodes, (60.0, 60.0, 3.0)), "Scale": 1.0,
                                   "Detail": 4.0})
    grain = nodes.add("MixRGB", {"Fac": 0.35, "Color1": wave.outputs["Color"],
                                 "Color2": pores.outputs["Fac"]}, blend_type='MULTIPLY')
    color = _ramp(nodes, grain, (0.0, (0.10, 0.04, 0.015)), (0.45, (0.36, 0.17, 0.06)),
                  (1.0, (0.62, 0.36, 0.16)))
    rough = nodes.add("MapRange", {"Value": pores.outputs["Fac"], "To Min": 0.35, "To Max": 0.6})
    nodes.surface(nodes.add("BsdfPrincipled", {
        "Base Color": color, "Roughness": rough, "Specular": 0.6,
        "Normal": _bump(nodes, grain, 0.02, 0.6)}))
    return material


def brick():
    material, nodes = parts.new_material("Brick Wall")
    place = _coordinate(nodes, (8.0, 4.0, 1.0), "UV")
    stones = nodes.add("TexBrick", {"Vector": place, "Color1": (0.45, 0.12, 0.06),
                                    "Color2": (0.25, 0.06, 0.04), "Mortar": (0.5, 0.47, 0.42),
                                    "Scale": 2.0, "Mortar Size": 0.03, "Mortar Smooth": 0.3})
    grit = nodes.add("TexMusgrave", {"Vector": place, "Scale": 9.0, "Detail": 6.0})
    color = nodes.add("HueSaturation", {
        "Color": stones.outputs["Color"], "Saturation": 0.9,
        "Value": nodes.add("MapRange", {"Value": grit, "To Min": 0.7, "To Max": 1.2})})
    relief = nodes.add("Math", {0: nodes.add("Math", {0: 1.0, 1: stones.outputs["Fac"]},
                                             operation='SUBTRACT'),
                                1: nodes.add("Math", {0: grit, 1: 0.15}, operation='MULTIPLY')})
    nodes.surface(nodes.add("BsdfPrincipled", {
        "Base Color": color, "Roughness": 0.85, "Specular": 0.3,
        "Normal": _bump(nodes, relief, 0.03)}))
    return material


def marble():
    material, nodes = parts.new_material("Marble")
    place = _coordinate(nodes)
    bend = nodes.add("TexNoise", {"Vector": place, "Scale": 2.0, "Detail": 6.0})
    bent = nodes.add("VectorMath", {0: place, 1: bend.outputs["Color"]})
    veins = nodes.add("TexNoise", {"Vector": bent, "Scale": 3.0, "Detail": 8.0, "Distortion": 0.6})
    thin = nodes.add("Math", {0: nodes.add("Math", {0: veins.outputs["Fac"], 1: 0.5},
                                           operation='SUBTRACT')}, operation='ABSOLUTE')
    color = _ramp(nodes, thin, (0.0, (0.12, 0.12, 0.14)), (0.05, (0.55, 0.54, 0.53)),
                  (0.2, (0.86, 0.85, 0.82)), interpolation='EASE')
    nodes.surface(nodes.add("BsdfPrincipled", {
        "Base Color": color, "Roughness": 0.12, "Specular": 0.6}))
    return material


def rust():
    material, nodes = parts.new_material("Rusty Paint")
    place = _coordinate(nodes)
    patches = nodes.add("TexMusgrave", {"Vector": place, "Scale": 2.5, "Detail": 8.0,
                                        "Dimension": 0.6})
    mask = _ramp(nodes, patches, (0.42, (0.0, 0.0, 0.0)), (0.5, (1.0, 1.0, 1.0)))
    grain = nodes.add("TexNoise", {"Vector": place, "Scale": 30.0, "Detail": 5.0})
    eaten = nodes.add("BsdfPrincipled", {
        "Base Color": _ramp(nodes, grain.outputs["Fac"], (0.3, (0.09, 0.02, 0.008)),
                            (0.6, (0.42, 0.13, 0.03))),
        "Roughness": 0.9, "Metallic": 0.3, "Normal": _bump(nodes, grain.outputs["Fac"], 0.03)})
    paint = nodes.add("BsdfPrincipled", {
        "Base Color": (0.05, 0.22, 0.25), "Roughness": 0.3, "Clearcoat": 0.5,
        "Normal": _bump(nodes, mask, 0.01, 0.5)})
    nodes.surface(nodes.add("MixShader", {0: mask, 1: paint, 2: eaten}))
    return material


def car_paint():
    material, nodes = parts.new_material("Car Paint")
    cells = nodes.add("TexVoronoi", {"Vector": _coordinate(nodes), "Scale": 120.0})
    flakes = nodes.add("VectorMath", {
        0: nodes.add("NewGeometry").outputs["Normal"], 1: nodes.add("VectorMath", {
            0: nodes.add("VectorMath", {0: cells.outputs["Color"], 1: (0.5, 0.5, 0.5)},
                         operation='SUBTRACT'), "Scale": 0.25}, operation='SCALE')})
    facing = nodes.add("LayerWeight", {"Blend": 0.35})
    color = _ramp(nodes, facing.outputs["Facing"], (0.0, (0.35, 0.01, 0.02)),
                  (1.0, (0.05, 0.0, 0.06)))
    metal = nodes.add("BsdfGlossy", {"Color": color, "Roughness": 0.35, "Normal": nodes.add(
        "VectorMath", {0: flakes}, operation='NORMALIZE')})
    coat = nodes.add("BsdfPrincipled", {"Base Color": color, "Roughness": 0.5, "Clearcoat": 1.0,
                                        "Clearcoat Roughness": 0.1})
    nodes.surface(nodes.add("MixShader", {0: 0.45, 1: coat, 2: metal}))
    return material


def fabric():
    material, nodes = parts.new_material("Fabric")
    place = _coordinate(nodes, (40.0, 20.0, 1.0), "UV")
    warp = nodes.add("TexWave", {"Vector": place, "Scale": 1.0, "Distortion": 0.4})
    weft = nodes.add("TexWave", {"Vector": place, "Scale": 1.0, "Distortion": 0.4},
                     bands_direction='Y')
    weave = nodes.add("Math", {0: warp.outputs["Fac"], 1: weft.outputs["Fac"]},
                      operation='MULTIPLY')
    color = _ramp(nodes, weave, (0.0, (0.02, 0.04, 0.12)), (1.0, (0.12, 0.2, 0.5)))
    normal = _bump(nodes, weave, 0.02, 0.8)
    cloth = nodes.add("BsdfDiffuse", {"Color": color, "Roughness": 0.8, "Normal": normal})
    fuzz = nodes.add("BsdfVelvet", {"Color": (0.5, 0.55, 0.7), "Sigma": 0.6, "Normal": normal})
    nodes.surface(nodes.add("MixShader", {0: 0.3, 1: cloth, 2: fuzz}))
    return material


def leather():
    material, nodes = parts.new_material("Leather")
    place = _coordinate(nodes)
    cells = nodes.add("TexVoronoi", {"Vector": place, "Scale": 22.0}, feature='DISTANCE_TO_EDGE')
    wrinkles = nodes.add("TexNoise", {"Vector": place, "Scale": 4.0, "Detail": 5.0})
    crease = nodes.add("MapRange", {"Value": cells.outputs["Distance"], "From Max": 0.15},
                       interpolation_type='SMOOTHSTEP')
    color = nodes.add("MixRGB", {"Fac": crease, "Color1": (0.05, 0.015, 0.008),
                                 "Color2": (0.24, 0.085, 0.03)})
    normal = _bump(nodes, wrinkles.outputs["Fac"], 0.05, 0.4,
                   _bump(nodes, crease, 0.01, 0.7))
    rough = nodes.add("MapRange", {"Value": wrinkles.outputs["Fac"], "To Min": 0.3, "To Max": 0.65})
    nodes.surface(nodes.add("BsdfPrincipled", {
        "Base Color": color, "Roughness": rough, "Specular": 0.45, "Sheen": 0.2,
        "Normal": normal}))
    return material


def skin():
    material, nodes = parts.new_material("Skin")
    place = _coordinate(nodes)
    blotches = nodes.add("TexNoise", {"Vector": place, "Scale": 5.0, "Detail": 3.0})
    color = _ramp(nodes, blotches.outputs["Fac"], (0.3, (0.72, 0.42, 0.32)),
                  (0.7, (0.86, 0.60, 0.47)))
    pores = nodes.add("TexVoronoi", {"Vector": place, "Scale": 60.0})
    nodes.surface(nodes.add("BsdfPrincipled", {
        "Base Color": color, "Subsurface Color": color, "Subsurface": 0.8,
        "Subsurface Radius": (0.1, 0.035, 0.02), "Roughness": 0.45, "Specular": 0.4,
        "Normal": _bump(nodes, pores.outputs["Distance"], 0.01, 0.4)},
        subsurface_method='RANDOM_WALK'))
    return material


def foliage():
    material, nodes = parts.new_material("Foliage")
    place = _coordinate(nodes, (10.0, 5.0, 1.0), "UV")
    local = nodes.add("VectorMath", {0: nodes.add("VectorMath", {0: place}, operation='FRACTION'),
                                     1: (0.5, 0.5, 0.0)}, operation='SUBTRACT')
    stretched = nodes.add("VectorMath", {0: local, 1: (1.5, 1.0, 0.0)}, operation='MULTIPLY')
    length = nodes.add("VectorMath", {0: stretched}, operation='LENGTH').outputs["Value"]
    mask = nodes.add("Math", {0: length, 1: 0.46}, operation='LESS_THAN')
    spots = nodes.add("TexNoise", {"Vector": place, "Scale": 3.0})
    color = _ramp(nodes, spots.outputs["Fac"], (0.3, (0.04, 0.16, 0.02)), (0.7, (0.16, 0.36, 0.05)))
    back = nodes.add("MixRGB", {"Fac": nodes.add("NewGeometry").outputs["Backfacing"],
                                "Color1": color, "Color2": (0.25, 0.4, 0.18)})
    leaf = nodes.add("MixShader", {0: 0.35, 1: nodes.add("BsdfPrincipled", {
        "Base Color": back, "Roughness": 0.4}), 2: nodes.add("BsdfTranslucent", {"Color": back})})
    nodes.surface(nodes.add("MixShader", {0: mask, 1: nodes.add("BsdfTransparent"), 2: leaf}))
    return material


def wet_asphalt():
    material, nodes = parts.new_material("Wet Asphalt")
    place = _coordinate(nodes)
    stones = nodes.add("TexVoronoi", {"Vector": place, "Scale": 25.0})
    color = _ramp(nodes, stones.outputs["Color"], (0.2, (0.012, 0.012, 0.014)),
                  (0.9, (0.09, 0.088, 0.085)))
    puddles = nodes.add("TexNoise", {"Vector": place, "Scale": 1.8, "Detail": 2.0})
    wet = nodes.add("MapRange", {"Value": puddles.outputs["Fac"], "From Min": 0.45,
                                 "From Max": 0.55})
    rough = nodes.add("MapRange", {"Value": wet, "To Min": 0.8, "To Max": 0.05})
    dry = nodes.add("Math", {0: 1.0, 1: wet}, operation='SUBTRACT')
    nodes.surface(nodes.add("BsdfPrincipled", {
        "Base Color": color, "Roughness": rough, "Specular": 0.5,
        "Normal": _bump(nodes, stones.outputs["Distance"], 0.02, dry)}))
    return material


MATERIALS = (wood, brick, marble, rust, car_paint, fabric, leather, skin, foliage, wet_asphalt)
