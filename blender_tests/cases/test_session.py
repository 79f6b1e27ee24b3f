# SPDX-License-Identifier: GPL-3.0-or-later
"""The native module renders: a tiny picture, progress, cancel, close, written files."""
import math
import os
import tempfile
import threading
import time
import unittest

import bpy
from support.core_scene import SIZE, buffer, core, small_scene, triangle


class SessionTest(unittest.TestCase):

    def start(self, scene):
        session = core.RenderSession(scene)
        self.addCleanup(session.close)
        session.start()
        return session

    def endless(self):
        """A session that is rendering and will not end in the time of a test."""
        session = self.start(small_scene(samples=1_000_000_000))
        limit = time.monotonic() + 30
        while session.progress.generation == 0 and time.monotonic() < limit:
            session.wait(0.01)
        self.assertGreater(session.progress.generation, 0)
        return session

    def combined(self, session):
        pixels = core.FloatBuffer(4 * SIZE * SIZE)
        session.read_pass("Combined", pixels)
        return pixels

    def test_tiny_render(self):
        session = self.start(small_scene())
        self.assertTrue(session.wait(60))
        self.assertEqual(session.error, "")
        self.assertEqual([d.text for d in session.take_diagnostics()], [])
        progress = session.progress
        self.assertEqual((progress.stage, progress.samples_done, progress.samples_total),
                         ("Done", 8, 8))
        self.assertEqual((progress.fraction, progress.dropped_samples), (1.0, 0))
        self.assertGreaterEqual(progress.peak_memory_bytes, progress.memory_bytes)

        # Sun of pi W/m^2 from above on the default diffuse of 0.8: radiance 0.8.
        middle = 4 * (SIZE // 2 * SIZE + SIZE // 2)
        pixels = self.combined(session)
        for channel in range(3):
            self.assertAlmostEqual(pixels[middle + channel], 0.8, delta=1e-4)
        self.assertAlmostEqual(pixels[middle + 3], 1.0, delta=1e-5)
        # The triangle reaches further down than up at the sides: bottom row first.
        self.assertGreater(sum(pixels[i] for i in range(4 * SIZE) if i % 4 < 3),
                           sum(pixels[-1 - i] for i in range(4 * SIZE) if i % 4 > 0))

        depth = core.FloatBuffer(1)
        session.read_pass("Depth", depth, SIZE // 2, SIZE // 2, 1, 1)
        self.assertAlmostEqual(depth[0], 3.0, delta=0.01)
        normal = core.FloatBuffer(3)
        session.read_pass("Normal", normal, x=SIZE // 2, y=SIZE // 2, width=1, height=1)
        for value, expected in zip(normal, (0, 0, 1)):
            self.assertAlmostEqual(value, expected, delta=1e-5)

    def test_tiles_cover_the_picture(self):
        session = self.start(small_scene())
        self.assertTrue(session.wait(60))
        covered = set()
        for x, y, width, height in session.finished_tiles():
            covered |= {(i, j) for i in range(x, x + width) for j in range(y, y + height)}
        self.assertEqual(covered, {(i, j) for i in range(SIZE) for j in range(SIZE)})
        self.assertEqual(session.finished_tiles(), [])

    def test_rectangle_is_part_of_the_picture(self):
        session = self.start(small_scene())
        self.assertTrue(session.wait(60))
        whole = self.combined(session)
        part = core.FloatBuffer(4 * 5 * 3)
        session.read_pass("Combined", part, x=7, y=11, width=5, height=3)
        expected = [whole[4 * (SIZE * (11 + j) + 7 + i) + c]
                    for j in range(3) for i in range(5) for c in range(4)]
        self.assertEqual(list(part), expected)

    def test_read_pass_checks(self):
        session = self.start(small_scene())
        target = core.FloatBuffer(4 * SIZE * SIZE)
        for pattern, arguments in (("one of Combined, Depth, Normal", ("Mist", target)),
                                   (r"target needs 4096 values, not 3",
                                    ("Combined", core.FloatBuffer(3))),
                                   (r"\.x must be", ("Combined", target, -1)),
                                   (r"\.x must be", ("Combined", target, SIZE)),
                                   (r"\.height must be", ("Combined", target, 0, 1, 0, SIZE)),
                                   (r"\.width must be", ("Combined", target, 0, 0, -1, 1))):
            with self.assertRaisesRegex(ValueError, pattern):
                session.read_pass(*arguments)
        with self.assertRaises(TypeError):
            session.read_pass("Combined", core.IntBuffer(4 * SIZE * SIZE))

    def test_the_scene_is_taken(self):
        scene = small_scene()
        core.RenderSession(scene).close()
        self.assertEqual(scene.add_mesh(triangle()), 0)
        self.assertEqual(scene.settings.width, core.RenderSettings().width)

    def test_cancel(self):
        session = self.endless()
        self.assertFalse(session.wait(0))
        session.cancel()
        self.assertTrue(session.wait(10))
        self.assertEqual((session.progress.stage, session.error), ("Cancelled", ""))
        self.assertGreater(max(self.combined(session)), 0.1)

    def test_close_twice(self):
        session = self.endless()
        session.close()
        session.close()
        self.assertTrue(session.wait(0))
        self.assertEqual(session.finished_tiles(), [])
        with self.assertRaisesRegex(RuntimeError, "closed"):
            self.combined(session)

    def test_close_without_start(self):
        core.RenderSession(small_scene()).close()

    def test_dropped_while_rendering(self):
        before = threading.active_count()
        session = core.RenderSession(small_scene(samples=1_000_000_000))
        session.start()
        session.wait(0.05)
        del session
        self.assertEqual(threading.active_count(), before)

    def test_impossible_scene(self):
        scene = small_scene()
        scene.camera.camera_to_world = [math.nan] * 12
        session = self.start(scene)
        self.assertTrue(session.wait(30))
        self.assertEqual(session.progress.stage, "Failed")
        self.assertRegex(session.error, "^The camera.*not a number.*[.]$")

    def test_python_goes_on_during_wait(self):
        session = self.endless()
        count, stop = 0, threading.Event()

        def spin():
            nonlocal count
            while not stop.is_set():
                count += 1

        thread = threading.Thread(target=spin)
        thread.start()
        before = count
        self.assertFalse(session.wait(0.3))
        during = count - before
        stop.set()
        thread.join()
        # Holding the GIL for 0.3 s, at most the switch to this thread could have been counted.
        self.assertGreater(during, 10_000)

    def test_close_during_wait(self):
        session = self.endless()
        ended = []
        thread = threading.Thread(target=lambda: ended.append(session.wait(60)))
        thread.start()
        time.sleep(0.1)
        session.close()
        thread.join(10)
        self.assertEqual(ended, [True])


class WriteImageTest(unittest.TestCase):

    def test_written_image_reads_back(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "picture.exr")
            core.write_image(path, buffer(core.FloatBuffer, [0.25, 0.5, 2.0, 1.0] * 6), 3, 2)
            image = bpy.data.images.load(path)
            self.assertEqual(tuple(image.size), (3, 2))
            self.assertEqual(list(image.pixels[:4]), [0.25, 0.5, 2.0, 1.0])
            bpy.data.images.remove(image)

    def test_errors(self):
        pixels = core.FloatBuffer(4)
        with self.assertRaisesRegex(ValueError, "write_image.pixels"):
            core.write_image("/tmp/unused.exr", pixels, 2, 1)
        with self.assertRaisesRegex(OSError, "/nowhere/picture.exr"):
            core.write_image("/nowhere/picture.exr", pixels, 1, 1)
