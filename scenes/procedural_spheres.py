# SPDX-License-Identifier: GPL-3.0-or-later
"""Every procedural texture on a sphere of its own, through a Color Ramp into the colour and through
Bump into the relief: what is timed is the shading, so the light is plain."""

import parts
import shapes

RADIUS = 0.5
SPACING = 1.1
COLUMNS = 5

INK, SEA, MINT = (0.01, 0.02, 0.06), (0.03, 0.22, 0.30), (0.55, 0.85, 0.70)
SOOT, RUST, SAND = (0.03, 0.015, 0.01), (0.48, 0.14, 0.04), (0.90, 0.72, 0.45)
MOSS, LEAF, STRAW = (0.02, 0.05, 0.01), (0.16, 0.34, 0.06), (0.80, 0.76, 0.35)
PLUM, ROSE, PEARL = (0.09, 0.01, 0.10), (0.62, 0.10, 0.22), (0.92, 0.82, 0.78)


def build(scene):
    parts.render_settings(scene, 1280, 720, samples=128)
    parts.set_world_color((0.55, 0.66, 0.85), strength=0.5)
    parts.area_light("Key", (-3.5, -5.0, 6.0), (0.0, 0.0, 0.3), (2.0, 2.0), power=420.0,
                     color=(1.0, 0.93, 0.84))
    shapes.plane("Floor", (40.0, 40.0), parts.diffuse("Floor", (0.34, 0.33, 0.32)))
    for index, (name, texture, palette, distance) in enumerate(TEXTURES):
        row, column = divmod(index, COLUMNS)
        shapes.sphere(name, RADIUS, material(name, texture, palette, distance), segments=64,
                      location=(SPACING * (column - 0.5 * (COLUMNS - 1)), SPACING * (1.0 - row),
                                RADIUS),
                      rotation=parts.degrees(20, 10, 30))
    parts.camera((0.0, -6.6, 5.4), (0.0, -0.1, 0.3), focal_length=46.0)


def material(name, texture, palette, distance):
    """`texture` adds its node to a tree and returns the output that is shown."""
    made, nodes = parts.new_material(name)
    height = texture(nodes, nodes.add("TexCoord").outputs["Object"])
    ramp = nodes.add("ValToRGB", {"Fac": height})
    stops = ramp.color_ramp.elements
    stops.new(0.5)
    for stop, position, color in zip(stops, (0.15, 0.5, 0.85), palette):
        stop.position = position
        stop.color = (*color, 1.0)
    relief = nodes.add("Bump", {"Height": height, "Distance": distance, "Strength": 0.8})
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": ramp.outputs["Color"],
                                               "Roughness": 0.4, "Normal": relief}))
    return made


def plain(kind, output, inputs=None, **settings):
    """A texture node at the coordinate itself."""
    def add(nodes, place):
        return nodes.add(kind, {"Vector": place, **(inputs or {})}, **settings).outputs[output]
    return add


def shifted(kind, output, inputs=None, **settings):
    """A texture node that shall not see the middle of the sphere at its corner."""
    def add(nodes, place):
        moved = nodes.add("Mapping", {"Vector": place, "Location": (0.5, 0.5, 0.5)})
        return nodes.add(kind, {"Vector": moved, **(inputs or {})}, **settings).outputs[output]
    return add


def white_noise(nodes, place):
    """One value for each cube of a lattice; between them there is nothing to see."""
    cells = nodes.add("VectorMath", {0: place, 1: (0.14, 0.14, 0.14)}, operation='SNAP')
    return nodes.add("TexWhiteNoise", {"Vector": cells}).outputs["Value"]


TEXTURES = [
    ("Noise", plain("TexNoise", "Fac", {"Scale": 4.0, "Detail": 6.0}),
     (INK, SEA, MINT), 0.2),
    ("Noise 4D", plain("TexNoise", "Fac", {"Scale": 3.0, "Detail": 3.0, "Distortion": 1.0,
                                           "W": 0.7}, noise_dimensions='4D'),
     (SOOT, RUST, SAND), 0.15),
    ("Musgrave", plain("TexMusgrave", "Fac", {"Scale": 4.0, "Detail": 8.0, "Dimension": 0.8}),
     (MOSS, LEAF, STRAW), 0.06),
    ("Musgrave ridges", plain("TexMusgrave", "Fac", {"Scale": 2.5, "Detail": 5.0, "Offset": 0.8,
                                                     "Gain": 2.0},
                              musgrave_type='RIDGED_MULTIFRACTAL'),
     (PLUM, ROSE, PEARL), 0.06),
    ("White noise", white_noise, (INK, SEA, MINT), 0.02),
    ("Voronoi", plain("TexVoronoi", "Distance", {"Scale": 5.0}),
     (SAND, RUST, SOOT), 0.08),
    ("Voronoi smooth", plain("TexVoronoi", "Distance", {"Scale": 5.0, "Smoothness": 0.6},
                             feature='SMOOTH_F1'),
     (STRAW, LEAF, MOSS), 0.1),
    ("Voronoi cracks", plain("TexVoronoi", "Distance", {"Scale": 4.0},
                             feature='DISTANCE_TO_EDGE'),
     (PLUM, ROSE, PEARL), 0.1),
    ("Voronoi F2", plain("TexVoronoi", "Distance", {"Scale": 5.0}, feature='F2',
                         distance='CHEBYCHEV'),
     (INK, SEA, MINT), 0.08),
    ("Magic", shifted("TexMagic", "Fac", {"Scale": 1.6, "Distortion": 1.5}, turbulence_depth=4),
     (SOOT, RUST, SAND), 0.05),
    ("Wave bands", plain("TexWave", "Fac", {"Scale": 2.0, "Distortion": 6.0, "Detail": 3.0,
                                            "Detail Scale": 1.5}),
     (SOOT, RUST, SAND), 0.06),
    ("Wave rings", plain("TexWave", "Fac", {"Scale": 2.0, "Distortion": 2.0}, wave_type='RINGS',
                         rings_direction='Z'),
     (MOSS, LEAF, STRAW), 0.06),
    ("Brick", shifted("TexBrick", "Color", {"Scale": 3.0, "Mortar Size": 0.03,
                                            "Mortar Smooth": 0.4}),
     (PLUM, ROSE, PEARL), 0.03),
    ("Checker", shifted("TexChecker", "Fac", {"Scale": 6.0}), (INK, SEA, MINT), 0.02),
    ("Gradient", shifted("TexGradient", "Fac", gradient_type='EASING'), (RUST, SAND, SOOT), 0.2),
]
