# SPDX-License-Identifier: GPL-3.0-or-later
"""The comparisons themselves: they must notice what they are there to notice."""
from support import compare, scene_factory
from support.case import RenderTestCase
from support.render import REFERENCE_ENGINE, render, render_seeds


class HarnessTest(RenderTestCase):

    def lit_plane(self):
        scene_factory.plane(self.scene, 4.0, scene_factory.diffuse())
        scene_factory.lamp(self.scene, "AREA", 50.0, (0, 0, 2), size=1.0)
        scene_factory.top_camera(self.scene, 3.0)

    def test_engine_agrees_with_itself(self):
        self.lit_plane()
        first = render_seeds(REFERENCE_ENGINE, 4, 0, samples=64)
        second = render_seeds(REFERENCE_ENGINE, 4, 100, samples=64)
        result = compare.compare_blocks(first, second, 8)
        self.assertTrue(result, str(result))
        self.assertLess(result.largest_relative, 0.02)

    def test_two_percent_are_noticed(self):
        self.lit_plane()
        first = render_seeds(REFERENCE_ENGINE, 4, 0, samples=64, film_exposure=1.02)
        second = render_seeds(REFERENCE_ENGINE, 4, 100, samples=64)
        self.assertFalse(compare.compare_blocks(first, second, 8))
        self.assertFalse(compare.compare_means(first, second))

    def test_noise_without_power_is_refused(self):
        self.lit_plane()
        first = render_seeds(REFERENCE_ENGINE, 2, 0, samples=1)
        second = render_seeds(REFERENCE_ENGINE, 2, 100, samples=1)
        result = compare.compare_blocks(first, second, 2, relative=0.001)
        self.assertTrue(result.weak)
        self.assertFalse(result)

    def test_exr_reader_sees_what_blender_wrote(self):
        scene_factory.plane(self.scene, 8.0, scene_factory.emission((0.25, 0.5, 3.0)))
        scene_factory.top_camera(self.scene, 2.0)
        picture = render(REFERENCE_ENGINE, samples=1, resolution=(6, 4))
        self.assertEqual((picture.width, picture.height), (6, 4))
        self.assert_pixel(picture, 5, 3, (0.25, 0.5, 3.0))
