# SPDX-License-Identifier: GPL-3.0-or-later
"""RenderTestCase: unittest with an empty scene for each test and picture assertions."""
import os
import unittest

from . import compare, parity_log, report, scene_factory
from .render import REFERENCE_ENGINE, TESTED_ENGINE, render_pair

_report = None


def open_report(folder):
    """Collect all picture comparisons of this process below `folder`."""
    global _report
    _report = report.Report(folder, f"{TESTED_ENGINE} against {REFERENCE_ENGINE}")


def close_report():
    if _report is not None:
        _report.finish()


def show(name, tested, reference, text, passed):
    """Add a comparison to the report, if there is one."""
    if _report is not None:
        _report.add(name, tested, reference, text, passed)
        _report.finish(f"process {os.getpid()}")


class RenderTestCase(unittest.TestCase):
    """`self.scene` is new and empty (black world, no camera) in every test."""

    maxDiff = None

    def setUp(self):
        self.scene = scene_factory.empty_scene()

    def assert_agrees(self, name="", block=None, relative=0.005, seeds=4, absolute=1e-5,
                      max_noise=None, **arguments):
        """Render the scene in both engines and compare block means (whole picture: block=None)."""
        tested, reference = render_pair(seeds, **arguments)
        self.assert_pictures_agree(tested, reference, name, block, relative, absolute, max_noise)

    def assert_pictures_agree(self, tested, reference, name="", block=None, relative=0.005,
                              absolute=1e-5, max_noise=None):
        """Compare two lists of pictures (one a seed) by block means."""
        size = block or max(tested[0].width, tested[0].height)
        result = compare.compare_blocks(tested, reference, size, relative, absolute, max_noise)
        parity_log.picture(result.mean_excess, result.noise, bool(result))
        title = f"{self.id().split('.', 1)[-1]} {name}"
        show(title, tested[0].average_with(tested[1:]), reference[0].average_with(reference[1:]),
             str(result), bool(result))
        if not result:
            self.fail(f"{name}: {result}")

    def assert_pixel(self, picture, x, y, expected, delta=1e-4):
        """RGB of one pixel equals `expected` within delta * max(1, |value|)."""
        actual = picture.pixel(x, y)[:3]
        for a, e in zip(actual, expected):
            if not abs(a - e) <= delta * max(1.0, abs(e)):
                self.fail(f"pixel ({x},{y}) is {actual}, expected {tuple(expected)}")

    def assert_bitwise_equal(self, first, second, what=""):
        """The two pictures have the same bits."""
        if first.rgba.tobytes() != second.rgba.tobytes():
            count = sum(a != b for a, b in zip(first.rgba, second.rgba))
            self.fail(f"{what}: {count} of {len(first.rgba)} values differ, by at most "
                      f"{compare.max_abs_difference(first, second):.3g}")
