# SPDX-License-Identifier: GPL-3.0-or-later
"""What a shell or a farm sees: exit status, files written, signals, a module that misfits."""
import os
import pathlib
import shutil
import signal
import tempfile
import unittest

import bpy

from support import process, scene_factory
from support.case import RenderTestCase
from support.render import TESTED_ENGINE, engine_settings, prepare

# The interrupted render would take hours: that it ends at all is the proof, not how fast.
STOP_SECONDS = 30.0

RENDER_SCRIPT = """
import bpy, sys
print("BEGIN", flush=True)
bpy.ops.render.render(write_still=True)
"""


class ProcessCase(RenderTestCase):

    def setUp(self):
        super().setUp()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.blend = str(self.folder / "scene.blend")
        scene_factory.plane(self.scene, 4.0, scene_factory.diffuse(), "Floor")
        scene_factory.lamp(self.scene, "POINT", location=(0, 0, 2))
        scene_factory.top_camera(self.scene, 3.0)
        prepare(self.scene, TESTED_ENGINE, 4, 0, (16, 16))
        self.scene.render.filepath = str(self.folder / "out_")
        self.scene.render.image_settings.file_format = "PNG"

    def save(self):
        bpy.ops.wm.save_as_mainfile(filepath=self.blend, copy=True)

    def pictures(self):
        return sorted(p.name for p in self.folder.iterdir() if p.suffix in (".png", ".exr"))

    def render_frame(self, *arguments):
        self.save()
        return process.run(["-Y", "-E", str(TESTED_ENGINE), *arguments, "-f", "1"], self.blend)


class ExitStatusTest(ProcessCase):

    def test_good_render(self):
        outcome = self.render_frame()
        self.assertEqual(outcome.status, 0, str(outcome))
        self.assertEqual(self.pictures(), ["out_0001.png"])

    def test_no_camera(self):
        self.scene.camera = None
        outcome = self.render_frame()
        self.assertEqual(outcome.status, 1, str(outcome))
        self.assertIn("camera", outcome.output.lower())
        self.assertEqual(self.pictures(), [])

    def test_unknown_engine(self):
        self.save()
        outcome = process.run(["-E", "NO_SUCH_ENGINE", "-f", "1"], self.blend)
        self.assertEqual(outcome.status, 1, str(outcome))
        self.assertEqual(self.pictures(), [])

    def test_animation(self):
        self.scene.frame_start, self.scene.frame_end = 1, 2
        self.save()
        outcome = process.run(["-E", str(TESTED_ENGINE), "-a"], self.blend)
        self.assertEqual(outcome.status, 0, str(outcome))
        self.assertEqual(self.pictures(), ["out_0001.png", "out_0002.png"])

    @unittest.skipUnless(TESTED_ENGINE == "TENNIEL", "about our own code")
    def test_exception_in_a_callback(self):
        """Status 1, no picture, a sentence and the traceback."""
        self.save()
        script = self.folder / "break.py"
        script.write_text("import tenniel.session as s\n"
                          "def render_final(*a, **k): raise ValueError('injected fault')\n"
                          "s.render_final = render_final\n", encoding="utf-8")
        outcome = process.run(["--python", str(script), "-E", "TENNIEL", "-f", "1"], self.blend)
        self.assertEqual(outcome.status, 1, str(outcome))
        self.assertIn("injected fault", outcome.output)
        self.assertIn("Traceback", outcome.output)
        self.assertEqual(self.pictures(), [])

    @unittest.skipUnless(TESTED_ENGINE == "TENNIEL", "about our own code")
    def test_memory_limit(self):
        """Too large for the address space: a sentence or a refusal, never a signal."""
        self.scene.render.resolution_x = self.scene.render.resolution_y = 30000
        self.save()
        script = self.folder / "limit.py"
        script.write_text("import resource\n"
                          "limit = 4 << 30\n"
                          "resource.setrlimit(resource.RLIMIT_AS, (limit, limit))\n",
                          encoding="utf-8")
        outcome = process.run(["--python", str(script), "-E", "TENNIEL", "-f", "1"], self.blend)
        self.assertGreaterEqual(outcome.status, 0, str(outcome))
        self.assertNotEqual(outcome.status, 0, str(outcome))


class SignalTest(ProcessCase):

    def long_render(self, faces=0):
        """A render that would take minutes; `faces` > 0 adds a mesh that takes time to export."""
        engine_settings(self.scene, TESTED_ENGINE).samples = 1000000
        self.scene.render.resolution_x = self.scene.render.resolution_y = 512
        if faces:
            side = int(faces ** 0.5)
            data = bpy.data.meshes.new("Grid")
            data.from_pydata([(0.01 * x, 0.01 * y, 0) for y in range(side + 1)
                              for x in range(side + 1)], [],
                             [(y * (side + 1) + x, y * (side + 1) + x + 1,
                               (y + 1) * (side + 1) + x + 1, (y + 1) * (side + 1) + x)
                              for y in range(side) for x in range(side)])
            scene_factory.link(self.scene, data)
        self.save()
        script = self.folder / "render.py"
        script.write_text(RENDER_SCRIPT, encoding="utf-8")
        return ["--python-exit-code", "3", "--python", str(script)]

    def check_stop(self, number, delays, faces=0):
        arguments = self.long_render(faces)
        for delay in delays:
            with self.subTest(f"after {delay} s"):
                outcome = process.interrupt(arguments, self.blend, "BEGIN", delay, number)
                self.assertNotEqual(outcome.status, 0, str(outcome))
                self.assertNotIn(-outcome.status, (signal.SIGSEGV, signal.SIGABRT, signal.SIGKILL),
                                 str(outcome))
                self.assertLess(outcome.seconds, STOP_SECONDS, str(outcome))
                self.assertEqual(self.pictures(), [])

    def test_sigterm_while_rendering(self):
        self.check_stop(signal.SIGTERM, (1.5,))

    @unittest.skipUnless(TESTED_ENGINE == "TENNIEL", "other engines take half a minute")
    def test_sigint_while_rendering(self):
        self.check_stop(signal.SIGINT, (1.5,))

    def test_sigterm_at_each_stage(self):
        """Export, build and render of a mesh with a million faces."""
        self.check_stop(signal.SIGTERM, (0.02, 0.2, 0.5, 1.0), faces=1000000)


@unittest.skipUnless(TESTED_ENGINE == "TENNIEL", "about our own package")
class MisfitTest(ProcessCase):
    """A native module that cannot be loaded: one sentence, and nothing half registered."""

    def scripts_with(self, change):
        """Copy of the installed add-on after `change(folder)`; returns the scripts folder."""
        import tenniel
        source = pathlib.Path(tenniel.__file__).resolve().parent
        target = self.folder / "scripts" / "addons" / "tenniel"
        shutil.copytree(source, target)
        for module in target.glob("_core*.so"):
            change(module)
        return str(self.folder / "scripts")

    def check(self, change):
        environment = {"BLENDER_USER_SCRIPTS": self.scripts_with(change)}
        environment["TENNIEL_CORE_DIR"] = ""
        outcome = process.run_script(
            "import bpy\n"
            "names = [c.bl_idname for c in bpy.types.RenderEngine.__subclasses__()]\n"
            "print('ENGINE', 'TENNIEL' in names, hasattr(bpy.types.Scene, 'tenniel'))\n",
            environment=environment)
        self.assertIn("ENGINE False False", outcome.output, str(outcome))
        self.assertRegex(outcome.output, "(?i)tenniel")
        self.assertGreaterEqual(outcome.status, 0, str(outcome))

    def test_broken_module(self):
        self.check(lambda module: module.write_bytes(b"not a library"))

    def test_no_module(self):
        self.check(os.unlink)
