# SPDX-License-Identifier: GPL-3.0-or-later
"""Sky Texture: each model as emission and as the world, against Cycles."""
import itertools
import math

from support import scene_factory
from support.case import RenderTestCase
from support.node_variants import TEXTURE_MAPPINGS, Variant
from support.parity import ParityCase
from support.tile_grid import TileGrid

NODE = "ShaderNodeTexSky"

DIRECTIONS = [(0.0, 0.0, 1.0), (0.3, 0.7, 0.6480741), (-0.8, 0.1, 0.5916080),
              (0.05, -0.99, 0.1319091), (-0.6, -0.8, 0.0), (0.7, 0.7, -0.1414214),
              (0.5, -0.2, -0.8426150), (0.6, 0.9, 1.4)]

NISHITA = {
    "default": {},
    "low sun": {"sun_elevation": math.radians(-3.0), "sun_rotation": 1.3},
    "high sun": {"sun_elevation": math.radians(72.0), "sun_rotation": -4.0},
    "over the zenith": {"sun_elevation": math.radians(130.0), "sun_rotation": 0.4},
    "mountain": {"altitude": 5000.0, "sun_elevation": 0.5},
    "space": {"altitude": 60000.0, "sun_elevation": 0.3},
    "thick": {"air_density": 3.0, "dust_density": 4.0, "ozone_density": 2.0},
    "clear": {"air_density": 0.0, "dust_density": 0.3, "ozone_density": 0.0},
}


def sky_world(scene, strength=0.1, **settings):
    """World that shows a sky; returns the node."""
    background = scene_factory.set_world(scene, (0, 0, 0), strength)
    nodes = scene_factory.Nodes(scene.world.node_tree)
    sky = nodes.add(NODE, settings)
    nodes.set(background.inputs["Color"], sky)
    return sky


class SkyParityTest(ParityCase):

    def add(self, grid, settings, note=""):
        Variant(NODE, settings, [{"Vector": d} for d in DIRECTIONS], "Color", note=note).add_to(grid)

    def test_analytic(self):
        grid = TileGrid(self.scene)
        suns = ((0.0, 0.0, 1.0), (0.6, -0.3, 0.4), (-0.2, 0.9, 0.02), (0.1, 0.5, -0.3))
        # At turbidity 1 the horizon of Preetham's sky leaves the range of float.
        for sun, turbidity in itertools.product(suns, (1.7, 2.2, 5.5, 10.0)):
            self.add(grid, {"sky_type": "PREETHAM", "sun_direction": sun, "turbidity": turbidity})
        for sun, turbidity, albedo in itertools.product(suns, (1.0, 2.2, 5.5, 10.0),
                                                        (0.0, 0.3, 1.0)):
            self.add(grid, {"sky_type": "HOSEK_WILKIE", "sun_direction": sun,
                            "turbidity": turbidity, "ground_albedo": albedo})
        self.check_grid(grid)

    def test_texture_mapping(self):
        grid = TileGrid(self.scene)
        for name in ("turned", "scaled", "swizzled"):
            self.add(grid, {"sky_type": "HOSEK_WILKIE", "sun_direction": (0.6, -0.3, 0.4),
                            **TEXTURE_MAPPINGS[name]}, name)
        self.check_grid(grid)

    def test_nishita_sky(self):
        grid = TileGrid(self.scene)
        for name, settings in NISHITA.items():
            self.add(grid, {"sky_type": "NISHITA", "sun_disc": False, **settings}, name)
        # Cycles adds up its steps in floats at the distance of the Earth's centre.
        self.check_grid(grid, 2e-4)


class SkyWorldTest(RenderTestCase):

    def look(self, elevation, azimuth, angle):
        """A camera whose picture is `angle` radians wide; azimuth from +Y toward +X."""
        horizontal = math.cos(elevation)
        scene_factory.camera(self.scene, (0, 0, 0), (
            horizontal * math.sin(azimuth), horizontal * math.cos(azimuth), math.sin(elevation)),
            angle=angle)

    def test_disc(self):
        """The sun itself, high, crossing the horizon, large, and turned by the node's mapping."""
        for name, settings in {
                "high": {"sun_elevation": 0.8, "sun_rotation": 0.7, "sun_size": 0.02},
                "horizon": {"sun_elevation": 0.004, "sun_rotation": 2.0, "sun_size": 0.03},
                "wide": {"sun_elevation": 0.3, "sun_size": 0.5, "sun_intensity": 0.4}}.items():
            with self.subTest(name):
                self.setUp()
                sky = sky_world(self.scene, 1e-4, sky_type="NISHITA", **settings)
                self.look(sky.sun_elevation, sky.sun_rotation, 1.4 * sky.sun_size)
                self.assert_agrees(name, samples=64, block=4, relative=0.003, max_noise=0.02,
                                   absolute=2e-3, seeds=3)

    def test_sun_lights_a_ball(self):
        """Light sampling finds the sun: its shadows are as bright and as sharp as in Cycles."""
        for name, settings, limit in (
                ("nishita", {"sky_type": "NISHITA", "sun_elevation": 0.6}, 0.01),
                ("hosek", {"sky_type": "HOSEK_WILKIE", "sun_direction": (0.4, 0.3, 0.5)}, 0.02)):
            with self.subTest(name):
                self.setUp()
                sky_world(self.scene, **settings)
                scene_factory.plane(self.scene, 8.0, scene_factory.diffuse())
                scene_factory.sphere(self.scene, 0.6, scene_factory.diffuse((0.6, 0.3, 0.2)),
                                     location=(0, 0, 0.7))
                scene_factory.camera(self.scene, (0, -5, 3), (0, 0, 0.4), lens=50.0)
                self.assert_agrees(name, samples=64, block=8, relative=0.01, max_noise=limit)
