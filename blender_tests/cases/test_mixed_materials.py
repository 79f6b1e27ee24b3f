# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole trees as artists make them (scenes/materials.py), in pictures, against Cycles."""
import pathlib
import sys

from support import scene_factory
from support.case import RenderTestCase

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "scenes"))
import materials  # noqa: E402  (needs the path set above)
import shapes  # noqa: E402


class MixedMaterialTest(RenderTestCase):

    def show(self, make):
        """A ball on a coloured ground, under a sun, a sky and what it reflects of itself."""
        material = make()
        shapes.sphere(material.name, 1.0, material, segments=64, rotation=(0.35, 0.17, 0.52))
        scene_factory.plane(self.scene, 20.0, scene_factory.diffuse((0.5, 0.35, 0.25)),
                            location=(0, 0, -1.0))
        scene_factory.lamp(self.scene, "SUN", 3.0, angle=0.1, rotation=(40, 25, 0))
        scene_factory.set_world(self.scene, (0.3, 0.4, 0.6))
        scene_factory.camera(self.scene, (0, -4.5, 1.2), (0, 0, 0), lens=70.0)
        self.assert_agrees(material.name, samples=96, resolution=(64, 48), block=16, seeds=3,
                           relative=0.005, absolute=2e-4, max_noise=0.01, max_bounces=4)


def _test_of(make):
    return lambda self: self.show(make)


for _make in materials.MATERIALS:
    setattr(MixedMaterialTest, f"test_{_make.__name__}", _test_of(_make))
