# SPDX-License-Identifier: GPL-3.0-or-later
"""ParityCase: assertions over grids of tiles, and what several parity tests share."""
from . import scene_factory
from .case import RenderTestCase
from .tile_grid import TOLERANCE

SHOWN_FAILURES = 60

# Normals of tilted faces, all in the upper half.
TILTED = ((0.0, 0.0, 1.0), (0.6, 0.0, 0.8), (-0.36, 0.48, 0.8), (0.1, -0.7, 0.7071068))


class ParityCase(RenderTestCase):

    def assert_same(self, failures, count):
        if failures:
            shown = "\n".join(failures[:SHOWN_FAILURES])
            self.fail(f"{len(failures)} of {count} differ:\n{shown}")

    def check_grid(self, grid, tolerance=TOLERANCE):
        self.assertTrue(grid.tiles)
        self.assert_same(grid.compare(tolerance), len(grid.tiles))

    def check_field(self, grid, tolerance=1e-4):
        self.assertTrue(grid.objects)
        self.assert_same(grid.compare(tolerance), len(grid.objects))


def pattern_pixel(x, y):
    """Colours without symmetry, alpha between 0.2 and 1."""
    return ((0.1 + 0.37 * x) % 1.0, (0.9 - 0.23 * y) % 1.0, (0.2 + 0.11 * x * y) % 1.0,
            0.2 + 0.8 * ((x + 2 * y) % 5) / 4)


def pattern_image(name="pattern", width=8, height=6, **options):
    """Generated image of `pattern_pixel`; options of scene_factory.generated_image."""
    return scene_factory.generated_image(name, width, height, pattern_pixel, **options)
