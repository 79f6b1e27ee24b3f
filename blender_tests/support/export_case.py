# SPDX-License-Identifier: GPL-3.0-or-later
"""ExportTestCase: the exporter on small scenes, with a core that keeps what it is given."""
import unittest

import bpy
from tenniel import reports
from tenniel.export import View, export_scene

from . import recording_core, scene_factory


class _CameraOfScene:
    """Camera source without a RenderEngine, which exists only while Blender renders."""

    def export(self, context):
        return context.core.CameraDesc()


class ExportTestCase(unittest.TestCase):
    """`self.scene` is new and empty; `self.export()` describes it as a render would."""

    def setUp(self):
        self.scene = scene_factory.empty_scene()
        self.core = recording_core.RecordingCore(recording_core.NODE_TYPES)

    def export(self, view=None, camera=None, test_break=lambda: False):
        """SceneDescription of the scene as it is now; reports start empty."""
        reports.begin(self.scene.name)
        # Settings of an add-on changed by a script reach the evaluated copies only when tagged; a
        # render evaluates everything anew.
        for item in (self.scene, *self.scene.objects, *bpy.data.materials):
            item.update_tag()
        depsgraph = bpy.context.evaluated_depsgraph_get()
        depsgraph.update()
        return export_scene(self.core, depsgraph, view or View(64, 32),
                            camera or _CameraOfScene(), test_break)

    def report_texts(self):
        return [f"{row.where()}: {row.text}" for row in reports.rows(self.scene.name)]

    def assert_reported(self, *parts):
        """One row holds all of `parts`."""
        texts = self.report_texts()
        self.assertTrue(any(all(part in text for part in parts) for text in texts),
                        f"{parts} not in {texts}")

    def assert_close(self, actual, expected, places=5):
        self.assertEqual(len(actual), len(expected))
        for a, e in zip(actual, expected):
            self.assertAlmostEqual(a, e, places)

    def material_graph(self, material):
        """NodeGraph of a material put on a plane."""
        scene_factory.plane(self.scene, 1.0, material)
        return self.export().materials[0].graph
