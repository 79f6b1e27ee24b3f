# SPDX-License-Identifier: GPL-3.0-or-later
"""Cameras, settings and the border."""
import math
import struct
import types
import unittest

from mathutils import Matrix
from support import scene_factory
from support.export_case import ExportTestCase
from tenniel import session
from tenniel.export import ExportError, View
from tenniel.export.camera import FromObject, set_projection
from tenniel.export.settings import render_seed


class FakeEngine:
    """What FromObject asks of a RenderEngine."""
    camera_override = None

    @staticmethod
    def camera_model_matrix(obj):
        location, rotation, _ = obj.matrix_world.decompose()
        return Matrix.LocRotScale(location, rotation, None)

    @staticmethod
    def camera_shift_x(obj):
        return obj.data.shift_x


class CameraTest(ExportTestCase):

    def camera(self, **settings):
        return scene_factory.camera(self.scene, **settings)

    def desc(self):
        return self.export(camera=FromObject(FakeEngine())).camera

    def test_lens_and_frame(self):
        self.camera(lens=35.0, sensor_width=30.0, sensor_height=20.0, sensor_fit='VERTICAL',
                    shift_x=0.1, shift_y=-0.2, clip_start=0.5, clip_end=70.0)
        self.scene.render.pixel_aspect_x = 2.0
        desc = self.desc()
        self.assertEqual((desc.type, desc.sensor_fit), ('PERSP', 'VERTICAL'))
        self.assert_close((desc.lens, desc.sensor_width, desc.sensor_height, desc.shift_x,
                           desc.shift_y, desc.clip_start, desc.clip_end, desc.pixel_aspect_x),
                          (35.0, 30.0, 20.0, 0.1, -0.2, 0.5, 70.0, 2.0))

    def test_scale_does_not_count(self):
        obj = self.camera(location=(1, 2, 3))
        obj.scale = (2, 2, 2)
        matrix = self.desc().camera_to_world
        self.assertAlmostEqual(math.hypot(*matrix[0::4]), 1.0, 5)
        self.assert_close(matrix[3::4], (1, 2, 3))

    def test_depth_of_field(self):
        data = self.camera(lens=50.0).data
        data.dof.use_dof = True
        data.dof.aperture_fstop = 2.0
        data.dof.focus_distance = 4.0
        data.dof.aperture_blades = 6
        desc = self.desc()
        self.assert_close((desc.aperture_radius, desc.focus_distance), (0.0125, 4.0))
        self.assertEqual(desc.aperture_blades, 6)

    def test_no_depth_of_field(self):
        self.camera().data.dof.aperture_fstop = 0.1
        self.assertEqual(self.desc().aperture_radius, 0.0)

    def test_orthographic_aperture(self):
        data = self.camera(type='ORTHO', ortho_scale=3.0).data
        data.dof.use_dof = True
        data.dof.aperture_fstop = 4.0
        desc = self.desc()
        self.assert_close((desc.ortho_scale, desc.aperture_radius), (3.0, 0.125))

    def test_focus_object_counts_along_the_axis(self):
        data = self.camera(location=(0, 0, 10)).data
        target = scene_factory.link(self.scene, None, "Target", location=(5, 5, 3))
        data.dof.use_dof = True
        data.dof.focus_object = target
        self.assertAlmostEqual(self.desc().focus_distance, 7.0, 4)

    def test_panorama(self):
        data = self.camera(type='PANO').data
        data.cycles.panorama_type = 'EQUIRECTANGULAR'
        data.cycles.longitude_max = 1.0
        desc = self.desc()
        self.assertEqual(desc.type, 'PANO')
        self.assertAlmostEqual(desc.longitude_max, 1.0, 5)
        self.assertEqual(self.report_texts(), [])

    def test_other_panoramas_are_reported(self):
        data = self.camera(type='PANO').data
        data.cycles.panorama_type = 'MIRRORBALL'
        self.desc()
        self.assert_reported("MIRRORBALL", "not supported")

    def test_no_camera(self):
        with self.assertRaisesRegex(ExportError, "no camera"):
            self.desc()

    def test_any_object_may_be_the_camera(self):
        self.scene.camera = scene_factory.link(self.scene, None, "Eye", location=(0, 0, 9))
        self.assertEqual(self.desc().camera_to_world[11], 9.0)


class ProjectionTest(unittest.TestCase):
    """A 3D view's matrix gives the camera that has this matrix."""

    def test_perspective(self):
        desc = types.SimpleNamespace()
        # 90 degrees wide, twice as wide as high, the axis 1/4 of the width off the centre.
        projection = Matrix(((1, 0, 0.5, 0), (0, 2, -1.0, 0), (0, 0, -1, -1), (0, 0, -1, 0)))
        set_projection(desc, projection, True)
        self.assertEqual((desc.type, desc.sensor_fit), ('PERSP', 'HORIZONTAL'))
        self.assertAlmostEqual(2 * math.atan(desc.sensor_width / (2 * desc.lens)), math.pi / 2)
        self.assertAlmostEqual(desc.shift_x, 0.25)
        # Both shifts are in widths: half the height is a quarter of the width.
        self.assertAlmostEqual(desc.shift_y, -0.25)

    def test_orthographic(self):
        desc = types.SimpleNamespace()
        projection = Matrix(((0.5, 0, 0, -0.5), (0, 1.0, 0, 1.0), (0, 0, -1, 0), (0, 0, 0, 1)))
        set_projection(desc, projection, False)
        self.assertEqual((desc.type, desc.ortho_scale), ('ORTHO', 4.0))
        self.assertAlmostEqual(desc.shift_x, 0.25)
        self.assertAlmostEqual(desc.shift_y, -0.25)


class SettingsTest(ExportTestCase):

    def test_names_that_differ(self):
        source = self.scene.tenniel
        source.sample_clamp_direct, source.sample_clamp_indirect = 3.0, 4.0
        source.pixel_filter_type = 'GAUSSIAN'
        self.scene.render.film_transparent = True
        settings = self.export().settings
        self.assertEqual((settings.clamp_direct, settings.clamp_indirect, settings.pixel_filter,
                          settings.film_transparent), (3.0, 4.0, 'GAUSSIAN', True))

    def test_samples(self):
        self.scene.tenniel.samples = 10
        self.scene.tenniel.preview_samples = 3
        self.assertEqual(self.export().settings.samples, 10)
        self.assertEqual(self.export(View(8, 8, is_viewport=True)).settings.samples, 3)
        self.scene.view_layers[0].samples = 5
        self.assertEqual(self.export().settings.samples, 5)

    def test_threads(self):
        self.assertEqual(self.export().settings.threads, 0)
        self.scene.render.threads_mode = 'FIXED'
        self.scene.render.threads = 3
        self.assertEqual(self.export().settings.threads, 3)

    def test_animated_seed(self):
        self.assertEqual(render_seed(5, False, 7, 0.0), 5)
        seeds = {render_seed(5, True, frame, 0.0) for frame in range(20)}
        self.assertEqual(len(seeds), 20)
        self.assertNotEqual(render_seed(5, True, 1, 0.5), render_seed(5, True, 1, 0.0))


class BorderTest(unittest.TestCase):

    def rectangle(self, low, high, width, result_width):
        render = types.SimpleNamespace(use_border=True, border_min_x=low, border_max_x=high,
                                       border_min_y=0.0, border_max_y=1.0)
        return session.border_rectangle(render, width, 10, result_width, 10)

    def test_inside(self):
        self.assertEqual(self.rectangle(0.1, 0.7, 64, 38), (6, 0, 38, 10))

    def test_whole_picture(self):
        self.assertIsNone(self.rectangle(0.0, 1.0, 64, 64))

    def test_single_precision_decides(self):
        # 0.7 as a float is below 0.7, but times 10 it rounds to 7.
        seven_tenths = struct.unpack('f', struct.pack('f', 0.7))[0]
        self.assertLess(seven_tenths, 0.7)
        self.assertEqual(self.rectangle(seven_tenths, 1.0, 10, 3), (7, 0, 3, 10))


class StatusTest(unittest.TestCase):

    def line(self, **values):
        progress = types.SimpleNamespace(stage="Rendering", samples_done=12, samples_total=128,
                                         remaining=12.4, memory_bytes=123 << 20)
        progress.__dict__.update(values)
        return session.status_text(progress)

    def test_rendering(self):
        self.assertEqual(self.line(), "Sample 12/128 | Remaining 00:12 | Mem 123 MB")

    def test_unknown_and_long_times(self):
        self.assertEqual(self.line(remaining=-1.0), "Sample 12/128 | Mem 123 MB")
        self.assertIn("Remaining 1:01:05", self.line(remaining=3665.0))

    def test_other_stages(self):
        self.assertEqual(self.line(stage="Building BVH", samples_done=0),
                         "Building BVH | Mem 123 MB")
