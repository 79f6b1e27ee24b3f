# SPDX-License-Identifier: GPL-3.0-or-later
"""Four glossy plates of rising roughness under four spheres of equal power and rising size
(after Veach and Guibas 1995). Light sampling fails on the smooth plates, BSDF sampling on the
small lights; only both together are free of noise everywhere."""

import math

import parts
import shapes

ROUGHNESSES = (0.05, 0.1, 0.2, 0.4)
LIGHT_RADII = (0.035, 0.12, 0.32, 0.75)
LIGHT_COLORS = ((1.0, 0.45, 0.35), (1.0, 0.85, 0.4), (0.45, 0.9, 0.55), (0.45, 0.6, 1.0))
LIGHT_POWER = 40.0                      # watts each
CAMERA = (0.0, -12.0, 3.2)
LIGHT_HEIGHT, LIGHT_Y = 3.4, 2.0


def build(scene):
    parts.render_settings(scene, 960, 640, samples=64)
    parts.set_world_color((0.02, 0.02, 0.02))
    grey = parts.diffuse("Grey", (0.35, 0.35, 0.36))
    shapes.plane("Floor", (30.0, 20.0), grey, location=(0.0, 0.0, -2.2))
    shapes.plane("Wall", (30.0, 16.0), grey, location=(0.0, 3.6, 4.0),
                 rotation=parts.degrees(90, 0, 0))
    for index, roughness in enumerate(ROUGHNESSES):
        plate(index, roughness)
    for index, (radius, color) in enumerate(zip(LIGHT_RADII, LIGHT_COLORS)):
        # Power of a diffuse emitter: strength * pi * area.
        strength = LIGHT_POWER / (math.pi * 4.0 * math.pi * radius * radius)
        shapes.sphere(f"Light {index + 1}", radius,
                      parts.emission(f"Light {index + 1}", color, strength), segments=64,
                      location=(2.3 * (index - 1.5), LIGHT_Y, LIGHT_HEIGHT))
    parts.area_light("Fill", (0.0, -6.0, 9.0), (0.0, 0.0, 0.0), (4.0, 4.0), power=150.0)
    parts.camera(CAMERA, (0.0, 0.0, 0.7), focal_length=38.0)


def plate(index, roughness):
    """Each plate is tilted so that its middle reflects the row of lights into the camera."""
    y, z = 1.0 - 1.4 * index, 0.6 - 0.5 * index
    to_camera = math.atan2(CAMERA[2] - z, CAMERA[1] - y)
    to_light = math.atan2(LIGHT_HEIGHT - z, LIGHT_Y - y)
    normal = 0.5 * (to_camera + to_light)
    metal = parts.shader(f"Plate {roughness}", "BsdfGlossy",
                         {"Color": (0.75, 0.75, 0.75), "Roughness": roughness},
                         distribution='GGX')
    shapes.box(f"Plate {roughness}", (9.0, 1.15, 0.06), metal, location=(0.0, y, z),
               rotation=(normal - math.pi / 2.0, 0.0, 0.0))
