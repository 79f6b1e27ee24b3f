# SPDX-License-Identifier: GPL-3.0-or-later
"""Enabling: the core that fits is chosen, and one that does not is explained in a sentence."""
import os
import subprocess
import sys
import tempfile
import unittest

import bpy
from tenniel import native

V3 = frozenset({'ssse3', 'sse4_2', 'popcnt', 'avx2', 'bmi1', 'bmi2', 'fma', 'f16c', 'movbe', 'abm'})
V4 = V3 | {'avx512f', 'avx512bw', 'avx512cd', 'avx512dq', 'avx512vl'}

ATTEMPT = """
import addon_utils, bpy
enabled = addon_utils.enable('tenniel') is not None
print('ENABLED', enabled)
print('LEFT', hasattr(bpy.types.Scene, 'tenniel'), hasattr(bpy.types, 'TennielRenderEngine'),
      'TENNIEL' in bpy.types.RENDER_PT_color_management.COMPAT_ENGINES)
print('ALIVE')
"""


class LevelTest(unittest.TestCase):

    def test_best_level_first(self):
        self.assertEqual(native.fitting_levels(V4), ['v4', 'v3', 'v2'])
        self.assertEqual(native.fitting_levels(V3), ['v3', 'v2'])
        self.assertEqual(native.fitting_levels(V3 - {'fma'}), ['v2'])
        self.assertEqual(native.fitting_levels(V4 - {'abm'}), ['v2'])
        self.assertEqual(native.fitting_levels(frozenset({'sse2'})), [])
        self.assertEqual(native.fitting_levels(frozenset()), ['v2'])

    def test_flags_of_this_processor(self):
        self.assertIn('sse2', native.cpu_flags())
        self.assertEqual(native.cpu_flags('/nowhere'), frozenset())

    def test_core_in_use_fits(self):
        self.assertIn(native.core().isa, native.fitting_levels(native.cpu_flags()))


class MessageTest(unittest.TestCase):

    def test_missing_library_names_the_package(self):
        text = native.explain_import_error(
            "libembree3.so.3: cannot open shared object file: No such file or directory", "x.so")
        self.assertIn("libembree3.so.3", text)
        self.assertIn("apt install libembree3-3", text)

    def test_undefined_symbol(self):
        text = native.explain_import_error("x.so: undefined symbol: rtcFoo", "x.so")
        self.assertIn("rtcFoo", text)
        self.assertIn("tenniel build", text)

    def test_second_embree_in_the_process(self):
        line = "7f00-7f01 r-xp 00000000 08:01 42    {}\n"
        for library, refused in (("/lib/libembree4.so.4", True), ("/lib/libembree3.so.3", False),
                                 ("/lib/libtbb.so.12", False)):
            with self.subTest(library), tempfile.NamedTemporaryFile('w') as maps:
                maps.write(line.format(library))
                maps.flush()
                if not refused:
                    native._refuse_foreign_embree(maps.name)
                    continue
                with self.assertRaisesRegex(native.NativeModuleError, "libembree4.so.4"):
                    native._refuse_foreign_embree(maps.name)

    def test_processor_without_any_level(self):
        with self.assertRaisesRegex(native.NativeModuleError, "SSE 4.2"):
            native._load(os.path.dirname(__file__), frozenset({'sse2'}))


class FailedEnableTest(unittest.TestCase):
    """Each in a Blender of its own, which must go on without a trace of the add-on."""

    def attempt(self, files, **environment):
        """Output of an attempt to enable with `files` {name: bytes} where the core should be."""
        with tempfile.TemporaryDirectory() as folder:
            for name, content in files.items():
                with open(os.path.join(folder, name), 'wb') as file:
                    file.write(content)
            done = subprocess.run(
                [bpy.app.binary_path, '-b', '--factory-startup', '--python-expr', ATTEMPT],
                env={**os.environ, 'TENNIEL_CORE_DIR': folder, **environment},
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120,
                check=False)
        self.assertEqual(done.returncode, 0, done.stdout)
        for line in ("ENABLED False", "LEFT False False False", "ALIVE"):
            self.assertIn(line, done.stdout)
        return done.stdout

    def test_no_core(self):
        self.assertIn("render core is missing", self.attempt({}))

    def test_core_of_another_python(self):
        text = self.attempt({'_core_v2.cpython-39-x86_64-linux-gnu.so': b'\x7fELF'})
        self.assertIn("built for Python 3.9", text)
        self.assertIn(f"Python {sys.version_info[0]}.{sys.version_info[1]}", text)

    def test_core_of_a_better_processor(self):
        text = self.attempt({'_core_v9.so': b''})
        self.assertIn("only as _core_v9.so", text)

    def test_broken_core(self):
        text = self.attempt({'_core_v2.so': b'not a library'}, TENNIEL_ISA='v2')
        self.assertIn("_core_v2.so cannot be loaded", text)
