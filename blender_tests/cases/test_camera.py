# SPDX-License-Identifier: GPL-3.0-or-later
"""Cameras: the position seen by each pixel, coded as colour, so that nothing is noisy."""
import itertools
import math

from support import scene_factory
from support.case import RenderTestCase
from support.render import REFERENCE_ENGINE, TESTED_ENGINE, render
from support.tile_grid import emission_of

RESOLUTIONS = {"landscape": (48, 27), "portrait": (27, 48), "square": (32, 32)}


class CameraCase(RenderTestCase):

    def setUp(self):
        super().setUp()
        material = emission_of("position", lambda n: n.add(
            "ShaderNodeVectorMath", {"operation": "ADD"}, {
                0: n.add("ShaderNodeNewGeometry").outputs["Position"],
                1: (60.0, 60.0, 60.0)}))
        # A tilted floor, so that a wrong scale cannot be made up for by a wrong shift.
        scene_factory.plane(self.scene, 100.0, material, rotation=(12, 7, 0), location=(0, 0, -6))

    def check(self, name, resolution=(48, 27), samples=64, absolute=2e-3, block=4, **settings):
        """Positions averaged over blocks agree to `absolute` metres or 0.1 %."""
        tested, reference = (
            [render(engine, samples, seed, resolution, **settings)]
            for engine, seed in ((TESTED_ENGINE, 0), (REFERENCE_ENGINE, 1000)))
        shown = reference[0]
        spread = shown.pixel(0, 0)[0] - shown.pixel(shown.width - 1, shown.height - 1)[0]
        self.assertGreater(abs(spread), 0.01, "the picture shows nothing")
        self.assert_pictures_agree(tested, reference, name, block, 1e-3, absolute)


class ProjectionTest(CameraCase):

    def test_perspective(self):
        for fit, (shape, resolution), shift in itertools.product(
                ("AUTO", "HORIZONTAL", "VERTICAL"), RESOLUTIONS.items(), ((0, 0), (0.3, -0.2))):
            with self.subTest(f"{fit} {shape} {shift}"):
                self.setUp()
                scene_factory.camera(self.scene, (1, -2, 5), (0.5, 0.5, -6), lens=35.0,
                                     sensor_fit=fit, sensor_width=36.0, sensor_height=20.0,
                                     shift_x=shift[0], shift_y=shift[1])
                self.check(f"{fit} {shape} {shift}", resolution)

    def test_orthographic(self):
        for fit, (shape, resolution), shift in itertools.product(
                ("AUTO", "HORIZONTAL", "VERTICAL"), RESOLUTIONS.items(), ((0, 0), (0.3, -0.2))):
            with self.subTest(f"{fit} {shape} {shift}"):
                self.setUp()
                scene_factory.camera(self.scene, (1, -2, 5), (0.5, 0.5, -6), type="ORTHO",
                                     ortho_scale=7.0, sensor_fit=fit, sensor_width=36.0,
                                     sensor_height=20.0, shift_x=shift[0], shift_y=shift[1])
                self.check(f"{fit} {shape} {shift}", resolution)

    def test_lens_and_field_of_view(self):
        for lens in (14.0, 50.0, 300.0):
            with self.subTest(lens):
                self.setUp()
                obj = scene_factory.camera(self.scene, (1, -2, 5), (0.5, 0.5, -6), lens=lens)
                self.check(str(lens), absolute=5e-3)
        obj.data.lens_unit = "FOV"
        obj.data.angle = math.radians(40)
        self.check("fov")

    def test_pixel_aspect(self):
        for (kind, aspect), (shape, resolution) in itertools.product(
                itertools.product(("PERSP", "ORTHO"), ((2.0, 1.0), (1.0, 1.6))),
                RESOLUTIONS.items()):
            with self.subTest(f"{kind} {aspect} {shape}"):
                self.setUp()
                scene_factory.camera(self.scene, (1, -2, 5), (0.5, 0.5, -6), type=kind,
                                     ortho_scale=7.0, shift_x=0.1)
                self.scene.render.pixel_aspect_x, self.scene.render.pixel_aspect_y = aspect
                self.check(f"{kind} {aspect} {shape}", resolution)

    def test_scaled_and_parented_camera(self):
        for scale in ((1, 1, 1), (3, 3, 3), (0.5, 2.0, 1.0)):
            with self.subTest(scale):
                self.setUp()
                parent = scene_factory.link(self.scene, None, "Parent", (1, 0, 0),
                                            (0, 0, 20), scale)
                obj = scene_factory.camera(self.scene, (1, -2, 5), (0.5, 0.5, -6), lens=35.0)
                obj.parent = parent
                self.check(str(scale))

    def test_resolution_percentage(self):
        scene_factory.camera(self.scene, (1, -2, 5), (0.5, 0.5, -6))
        self.scene.render.resolution_percentage = 50
        self.check("50 %", (65, 43))


class PanoramaTest(CameraCase):

    def room(self):
        """Everything around the camera is seen."""
        material = self.scene.objects["Plane"].data.materials[0]
        scene_factory.box(self.scene, 16.0, material, inward=True)

    def test_equirectangular(self):
        for name, settings in {
                "whole": {},
                "part": {"longitude_min": -1.0, "longitude_max": 2.0, "latitude_min": -0.7,
                         "latitude_max": 0.4}}.items():
            with self.subTest(name):
                self.setUp()
                self.room()
                obj = scene_factory.camera(self.scene, (1, -2, 2), (3, 4, 1), type="PANO")
                obj.data.cycles.panorama_type = "EQUIRECTANGULAR"
                for key, value in settings.items():
                    setattr(obj.data.cycles, key, value)
                self.check(name, (48, 24), samples=256, absolute=1e-2)


class ClipTest(CameraCase):

    def test_clip(self):
        for kind, (near, far) in itertools.product(("PERSP", "ORTHO"),
                                                   ((0.1, 100.0), (10.8, 11.4))):
            with self.subTest(f"{kind} {near} {far}"):
                self.setUp()
                obj = scene_factory.camera(self.scene, (0, 0, 5), (0, 0, -6), type=kind,
                                           ortho_scale=7.0, clip_start=near, clip_end=far)
                self.assertAlmostEqual(obj.data.clip_end, far, places=5)
                self.check(f"{kind} {near} {far}", samples=256, absolute=0.4)

    def test_clip_start_beyond_end(self):
        scene_factory.camera(self.scene, (0, 0, 5), (0, 0, -6), clip_start=50.0, clip_end=10.0)
        for engine in (TESTED_ENGINE, REFERENCE_ENGINE):
            self.assertEqual(render(engine, 4).mean()[:3], (0.0, 0.0, 0.0))


class DepthOfFieldTest(RenderTestCase):
    """Blurred discs of small emitters in front of and behind the focus plane."""

    def lights(self, kind, focus_object=False, **dof):
        for x, z, color in ((-1.2, 1.0, (8, 1, 1)), (0.0, 0.0, (1, 8, 1)), (1.2, -1.5, (1, 1, 8)),
                            (0.3, 2.0, (5, 5, 0))):
            scene_factory.plane(self.scene, 0.35, scene_factory.emission(color),
                                location=(x, 0.5 * z, z))
        obj = scene_factory.camera(self.scene, (0, 0, 6), (0, 0, 0), type=kind, lens=50.0,
                                   ortho_scale=4.5)
        obj.data.dof.use_dof = True
        obj.data.dof.focus_distance = 6.0
        for name, value in dof.items():
            setattr(obj.data.dof, name, value)
        if focus_object:
            obj.data.dof.focus_object = scene_factory.link(self.scene, None, "Focus", (0.5, 0, 1))

    def check(self, name):
        self.assert_agrees(name, block=8, samples=1024, seeds=3, resolution=(48, 32),
                           relative=0.01, absolute=2e-3, max_noise=0.05)

    def test_perspective(self):
        variants = {
            "disc": {"aperture_fstop": 0.1},
            "wide disc": {"aperture_fstop": 0.03},
            "five blades": {"aperture_fstop": 0.05, "aperture_blades": 5, "aperture_rotation": 0.4},
            "three blades": {"aperture_fstop": 0.05, "aperture_blades": 3},
            "anamorphic": {"aperture_fstop": 0.05, "aperture_ratio": 2.0},
            "near focus": {"aperture_fstop": 0.1, "focus_distance": 3.0},
            "focus object": {"aperture_fstop": 0.1, "focus_object": True},
        }
        for name, settings in variants.items():
            with self.subTest(name):
                self.setUp()
                self.lights("PERSP", **settings)
                self.check(name)

    def test_orthographic(self):
        self.lights("ORTHO", aperture_fstop=2.0)
        self.check("ortho")
