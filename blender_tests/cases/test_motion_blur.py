# SPDX-License-Identifier: GPL-3.0-or-later
"""What moves while the shutter is open, against Cycles, and behind the mirror."""
import math

from support import scene_factory
from support.case import RenderTestCase
from support.mirror import MIRROR_Y, MirrorCase
from support.render import TESTED_ENGINE, engine_settings, render

RESOLUTION = (32, 24)


def open_shutter(scene, length=1.0, position='CENTER'):
    scene.render.use_motion_blur = True
    scene.render.motion_blur_shutter = length
    for engine in ("CYCLES", "TENNIEL"):
        engine_settings(scene, engine).motion_blur_position = position
    scene.frame_set(10)


def move(obj, path, **places):
    """Keys `path` of `obj` at frames 9, 10 and 11: a list of three values."""
    for frame, value in zip((9, 10, 11), places["at"]):
        setattr(obj, path, value)
        obj.keyframe_insert(path, frame=frame)
    for curve in obj.animation_data.action.fcurves:
        for key in curve.keyframe_points:
            key.interpolation = 'LINEAR'


class MotionBlurTest(RenderTestCase):

    def build(self):
        scene_factory.set_world(self.scene, (0.1, 0.15, 0.2))
        scene_factory.plane(self.scene, 8.0, scene_factory.diffuse((0.5, 0.5, 0.5)), "Floor")
        scene_factory.lamp(self.scene, "SUN", 2.0, (0, 0, 5), angle=0.1, rotation=(20, 10, 0))
        self.camera = scene_factory.camera(self.scene, (0, -1.0, 8), (0, 0, 0), lens=50.0)
        return scene_factory.box(self.scene, 1.2, scene_factory.diffuse((0.8, 0.2, 0.1)),
                                 location=(0, 0, 0.8))

    def check(self, name):
        self.assert_agrees(name, 8, relative=0.01, seeds=3, samples=128, resolution=RESOLUTION,
                           max_noise=0.02)

    def test_moving_object(self):
        for position in ('START', 'CENTER', 'END'):
            with self.subTest(position):
                self.setUp()
                move(self.build(), "location", at=[(-1.5, 0, 0.8), (0, 0, 0.8), (0, 1.5, 0.8)])
                open_shutter(self.scene, 1.0, position)
                self.check(f"moving, {position}")

    def test_turning_object(self):
        move(self.build(), "rotation_euler", at=[(0, 0, -1.2), (0, 0, 0), (0, 0, 1.2)])
        open_shutter(self.scene, 1.5)
        self.check("turning")

    def test_moving_camera(self):
        self.build()
        move(self.camera, "location", at=[(-1, -1, 8), (0, -1, 8), (1, -1, 7)])
        open_shutter(self.scene, 0.8)
        self.check("moving camera")

    def test_object_without_blur(self):
        obj = self.build()
        move(obj, "location", at=[(-1.5, 0, 0.8), (0, 0, 0.8), (1.5, 0, 0.8)])
        obj.cycles.use_motion_blur = obj.tenniel.use_motion_blur = False
        open_shutter(self.scene, 1.0)
        self.check("without blur")

    def test_still_scene_is_the_same(self):
        self.build()
        still = render(TESTED_ENGINE, 16, 3, RESOLUTION)
        open_shutter(self.scene, 1.0)
        self.assert_bitwise_equal(render(TESTED_ENGINE, 16, 3, RESOLUTION), still, "open shutter")
        self.assertEqual((self.scene.frame_current, self.scene.frame_subframe), (10, 0.0))


class MirrorMotionTest(MirrorCase):
    """Proof 9: what moves behind the mirror is blurred there, and nowhere else."""

    def test_ball_behind(self):
        ball = scene_factory.sphere(self.scene, 0.3, scene_factory.emission((1, 1, 1), 2.0),
                                    location=(0, 0, 1.2))
        ball.tenniel.side = "BEHIND"
        self.looking_glass(scene_factory.mirror((1, 1, 1)))
        scene_factory.camera(self.scene, (0.0, -3.0, 1.2), (0, MIRROR_Y, 1.2), lens=35.0)
        totals, widths = [], []
        for blurred in (False, True):
            move(ball, "location", at=[(-0.6, 0, 1.2), (0, 0, 1.2), (0.6, 0, 1.2)])
            open_shutter(self.scene, 1.0)
            self.scene.render.use_motion_blur = blurred
            picture = render(TESTED_ENGINE, 256, 0, self.RESOLUTION)
            totals.append(picture.mean()[0])
            row = [picture.pixel(x, self.RESOLUTION[1] // 2)[0] for x in range(picture.width)]
            widths.append(sum(value > 0.02 for value in row))
        # The light is spread out, not lost: the way is as long as the ball is wide.
        self.assertAlmostEqual(totals[1] / totals[0], 1.0, delta=0.02)
        self.assertGreater(widths[1], 1.7 * widths[0])
        self.assertLess(widths[1], 2.4 * widths[0])
        self.assertFalse(math.isnan(totals[1]))
