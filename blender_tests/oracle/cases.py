# SPDX-License-Identifier: GPL-3.0-or-later
"""What is rendered on both sides: a ball on a floor under an environment, described as plain data.

Neither Blender nor Mitsuba is named here; in_blender.py and in_mitsuba.py each build a scene from
the same words. World: Z up, metres.
"""

import importlib.util
import math
import pathlib
from typing import NamedTuple, Optional

WIDTH, HEIGHT = 160, 120
FIELD_OF_VIEW = math.radians(30.0)    # of the width
CAMERA = (0.0, -6.0, 1.6)
TARGET = (0.0, 0.0, 0.2)              # the middle of the ball
RADIUS = 1.0
FLOOR_HALF_WIDTH, FLOOR_HEIGHT = 6.0, -0.8
FLOOR_COLOR = (0.45, 0.40, 0.35)
MAX_BOUNCES = 64
ENVIRONMENT_SIZE = (512, 256)


class Medium(NamedTuple):
    """Coefficients per metre and the mean cosine, each (red, green, blue)."""
    scattering: tuple
    absorption: tuple
    anisotropy: tuple


class Surface(NamedTuple):
    """kind: matte, metal, glass or none. roughness: alpha is its square, 0 is smooth. color: of a
    matte one. eta, k: of a metal, by channel. ior: of glass."""
    kind: str
    roughness: float = 0.0
    distribution: str = "GGX"
    color: tuple = (1.0, 1.0, 1.0)
    eta: tuple = (0.0, 0.0, 0.0)
    k: tuple = (1.0, 1.0, 1.0)
    ior: float = 1.5


class Case(NamedTuple):
    """limit: largest relative difference of a mean; None where the conventions differ."""
    name: str
    surface: Surface
    medium: Optional[Medium] = None
    limit: Optional[float] = 0.01
    samples: int = 64


def _tables():
    """The add-on's measured materials, without the add-on."""
    path = (pathlib.Path(__file__).resolve().parents[2] / "addon/tenniel/presets/tables.py")
    spec = importlib.util.spec_from_file_location("tables", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


_TABLES = _tables()


def _metal(name, roughness=0.0, distribution="GGX"):
    eta, k = _TABLES.METALS[name]
    return Surface("metal", roughness, distribution, eta=eta, k=k)


def _liquid(name, scale):
    """`scale`: millimetres of the liquid in one metre of the scene."""
    scattering, absorption, anisotropy = _TABLES.LIQUIDS[name]
    return Medium(tuple(scale * s for s in scattering), tuple(scale * a for a in absorption),
                  anisotropy)


_SMOKE = Medium((1.5, 1.5, 1.5), (0.3, 0.4, 0.5), (0.5, 0.5, 0.5))

CASES = (
    Case("environment_matte", Surface("matte", color=(0.75, 0.55, 0.35))),
    Case("environment_mirror", Surface("metal")),
    Case("gold", _metal("Gold")),
    Case("gold_rough", _metal("Gold", 0.3)),
    Case("aluminium_rough", _metal("Aluminium", 0.55)),
    Case("copper_beckmann", _metal("Copper", 0.4, "BECKMANN")),
    Case("chromium_rough", _metal("Chromium", 0.2)),
    Case("glass", Surface("glass")),
    Case("glass_rough", Surface("glass", 0.35), limit=None),
    Case("glass_rough_multiple", Surface("glass", 0.1, "MULTI_GGX"), samples=192),
    Case("chardonnay", Surface("glass", ior=1.33), _liquid("Chardonnay", 60.0)),
    Case("apple_juice_matched", Surface("none"), _liquid("Apple Juice", 60.0)),
    Case("smoke", Surface("none"), _SMOKE),
)


def ball(rings=96, segments=192):
    """(vertices, triangles) of the ball about the origin."""
    vertices = [(0.0, 0.0, RADIUS)]
    for ring in range(1, rings):
        theta = math.pi * ring / rings
        for segment in range(segments):
            phi = 2.0 * math.pi * segment / segments
            vertices.append((RADIUS * math.sin(theta) * math.cos(phi),
                             RADIUS * math.sin(theta) * math.sin(phi), RADIUS * math.cos(theta)))
    vertices.append((0.0, 0.0, -RADIUS))
    last = len(vertices) - 1

    def at(ring, segment):
        return 1 + (ring - 1) * segments + segment % segments

    triangles = []
    for segment in range(segments):
        triangles.append((0, at(1, segment), at(1, segment + 1)))
        triangles.append((last, at(rings - 1, segment + 1), at(rings - 1, segment)))
        for ring in range(1, rings - 1):
            low, high = at(ring + 1, segment), at(ring, segment)
            low_next, high_next = at(ring + 1, segment + 1), at(ring, segment + 1)
            triangles += [(high, low, low_next), (high, low_next, high_next)]
    return vertices, triangles


def environment(x, y, z):
    """Radiance of the surroundings from direction (x, y, z): a sky, a ground and three windows. It
    is smooth, so that how a picture of it is interpolated does not matter."""
    up = 1.0 / (1.0 + math.exp(-6.0 * z))
    sky, ground = (0.35, 0.45, 0.60), (0.20, 0.16, 0.12)
    total = [up * s + (1.0 - up) * g for s, g in zip(sky, ground)]
    windows = (((0.60, -0.60, 0.53), 30.0, (9.0, 8.0, 6.0)),
               ((-0.80, 0.10, 0.59), 60.0, (3.0, 5.0, 9.0)),
               ((0.25, 0.90, 0.36), 90.0, (7.0, 2.0, 1.5)))
    for (a, b, c), sharpness, color in windows:
        share = math.exp(sharpness * (a * x + b * y + c * z - math.sqrt(a * a + b * b + c * c)))
        total = [t + share * value for t, value in zip(total, color)]
    return total
