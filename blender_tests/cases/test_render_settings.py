# SPDX-License-Identifier: GPL-3.0-or-later
"""Output settings, passes, view layers, visibility and limits, against Cycles or known values."""
import itertools
import math

import bpy

from support import compare, scene_factory
from support.case import RenderTestCase
from support.render import (REFERENCE_ENGINE, TESTED_ENGINE, engine_settings, prepare, render,
                            render_as_is, render_pair)
from support.tile_grid import emission_of

ENGINES = (TESTED_ENGINE, REFERENCE_ENGINE)


class StillLife(RenderTestCase):
    """Floor, diffuse sphere, mirror sphere and glass sphere under an area lamp."""

    def still_life(self, world=(0.1, 0.12, 0.15)):
        scene_factory.plane(self.scene, 8.0, scene_factory.diffuse((0.7, 0.6, 0.5)), "Floor")
        glass = scene_factory.simple_material("ShaderNodeBsdfGlass",
                                              settings={"distribution": "SHARP"})
        for x, name, material in ((-1.0, "Diffuse", scene_factory.diffuse((0.2, 0.5, 0.8))),
                                  (0.0, "Mirror", scene_factory.mirror((0.9, 0.8, 0.6))),
                                  (1.0, "Glass", glass)):
            scene_factory.sphere(self.scene, 0.45, material, 24, 12, name=name,
                                 location=(x, 0, 0.5))
        scene_factory.lamp(self.scene, "AREA", 120.0, (0.5, -1.5, 3.0), (-25, 0, 0), size=1.5)
        scene_factory.set_world(self.scene, world)
        scene_factory.camera(self.scene, (0, -5, 2.0), (0, 0, 0.4), lens=45.0)

    def position_scene(self):
        """Noise-free: world position as emission on a floor."""
        material = emission_of("position", lambda n: n.add(
            "ShaderNodeNewGeometry").outputs["Position"])
        scene_factory.plane(self.scene, 20.0, material, location=(10, 10, 0))
        scene_factory.camera(self.scene, (5, 5, 9), (6, 7, 0), lens=35.0)

    def both(self, resolution=(32, 24), samples=64, multilayer=False, **settings):
        return [render(engine, samples, seed, resolution, multilayer, **settings)
                for engine, seed in zip(ENGINES, (0, 1000))]

    def assert_exact(self, first, second, tolerance=2e-3):
        self.assertEqual((first.width, first.height), (second.width, second.height))
        self.assert_pictures_agree([first], [second], block=4, relative=tolerance,
                                   absolute=tolerance)


class OutputTest(StillLife):

    def test_border_with_and_without_crop(self):
        for crop in (True, False):
            for box in ((0.25, 0.75, 0.1, 0.6), (0.0, 0.31, 0.47, 1.0)):
                with self.subTest(f"crop={crop} {box}"):
                    self.setUp()
                    self.position_scene()
                    settings = self.scene.render
                    settings.use_border, settings.use_crop_to_border = True, crop
                    (settings.border_min_x, settings.border_max_x, settings.border_min_y,
                     settings.border_max_y) = box
                    self.assert_exact(*self.both())

    def test_border_is_a_part_of_the_whole(self):
        """The bits of a cropped render are those of the whole picture."""
        self.still_life()
        whole = render(TESTED_ENGINE, 8, 0, (32, 24))
        settings = self.scene.render
        settings.use_border = settings.use_crop_to_border = True
        settings.border_min_x, settings.border_max_x = 0.25, 0.75
        settings.border_min_y, settings.border_max_y = 0.25, 0.75
        part = render(TESTED_ENGINE, 8, 0, (32, 24))
        self.assertEqual((part.width, part.height), (16, 12))
        if TESTED_ENGINE == "TENNIEL":
            for y in range(12):
                for x in range(16):
                    self.assertEqual(part.pixel(x, y), whole.pixel(x + 8, y + 6))

    def test_resolution_percentage(self):
        self.position_scene()
        for percentage in (50, 33, 150):
            self.scene.render.resolution_percentage = percentage
            tested, reference = self.both()
            self.assert_exact(tested, reference)

    def test_exposure(self):
        self.position_scene()
        plain = render(TESTED_ENGINE, 16, 0)
        doubled = render(TESTED_ENGINE, 16, 0, film_exposure=2.0)
        for a, b in zip(plain.rgba[0::4], doubled.rgba[0::4]):
            self.assertAlmostEqual(2.0 * a, b, delta=1e-4 * max(1.0, b))

    def test_view_settings_do_not_touch_float_files(self):
        self.position_scene()
        plain = render(TESTED_ENGINE, 4, 0)
        self.scene.view_settings.exposure = 2.0
        self.scene.view_settings.view_transform = "Filmic"
        self.assert_bitwise_equal(render(TESTED_ENGINE, 4, 0), plain, "view settings")

    def test_pixel_filters(self):
        """A bright edge blurred by each filter."""
        scene_factory.plane(self.scene, 2.0, scene_factory.emission(), location=(1.03, 1.03, 0))
        scene_factory.top_camera(self.scene, 1.2)
        for kind in ("BOX", "GAUSSIAN", "BLACKMAN_HARRIS"):
            for width in (1.0, 1.5, 4.0):
                with self.subTest(f"{kind} {width}"):
                    tested, reference = self.both((12, 12), 1024, pixel_filter_type=kind,
                                                  filter_width=width)
                    self.assert_pictures_agree([tested], [reference], f"{kind} {width}", 1, 0.0,
                                               0.02)


class AlphaTest(StillLife):

    def test_transparent_film(self):
        self.still_life()
        bpy.data.objects.remove(self.scene.objects["Floor"])
        self.scene.render.film_transparent = True
        self.assert_agrees("transparent film", 12, 0.01, seeds=3, samples=256,
                           resolution=(36, 24), max_noise=0.08, absolute=2e-3)

    def test_alpha_of_transparent_materials(self):
        """Premultiplied: colour and alpha of a half-transparent plane."""
        def build(nodes):
            glow = nodes.add("ShaderNodeEmission", None, {"Color": (0.5, 1.0, 0.25)})
            hole = nodes.add("ShaderNodeBsdfTransparent", None, {"Color": (1, 1, 1)})
            return nodes.add("ShaderNodeMixShader", None, {0: 0.5, 1: hole, 2: glow})
        scene_factory.plane(self.scene, 4.0, scene_factory.node_material("half", build))
        scene_factory.top_camera(self.scene, 2.0)
        self.scene.render.film_transparent = True
        for engine in ENGINES:
            picture = render(engine, 256, 0, (8, 8))
            for value, expected in zip(picture.mean(), (0.25, 0.5, 0.125, 0.5)):
                self.assertAlmostEqual(value, expected, delta=0.005)

    def test_opaque_film_has_alpha_one(self):
        self.still_life()
        self.assertEqual(set(render(TESTED_ENGINE, 1).rgba[3::4]), {1.0})

    def test_holdout(self):
        for transparent in (True, False):
            with self.subTest(f"transparent film={transparent}"):
                self.setUp()
                self.still_life()
                self.scene.render.film_transparent = transparent
                self.scene.objects["Diffuse"].is_holdout = True
                self.assert_agrees("holdout", 8, 0.01, seeds=3, samples=128, resolution=(32, 24),
                                   max_noise=0.02, absolute=2e-3)


class PassTest(StillLife):

    def test_depth_and_normal(self):
        self.still_life()
        layer = self.scene.view_layers[0]
        layer.use_pass_z = layer.use_pass_normal = True
        tested, reference = self.both((32, 24), 16, multilayer=True)
        for name in ("Normal.X", "Normal.Y", "Normal.Z"):
            ours, theirs = (p.layers[f"ViewLayer.{name}"] for p in (tested, reference))
            far = sum(abs(a - b) > 0.15 for a, b in zip(ours, theirs))
            self.assertLess(far / len(ours), 0.02, f"{name}: {far} of {len(ours)} differ")
        ours, theirs = (p.layers["ViewLayer.Depth.Z"] for p in (tested, reference))
        far = sum(abs(a - b) > 0.02 * b for a, b in zip(ours, theirs))
        # Depth is that of one sample, so a pixel on a silhouette may see either surface.
        self.assertLess(far / len(ours), 0.1, f"depth: {far} of {len(ours)} differ")

    def test_depth_of_a_plane(self):
        scene_factory.plane(self.scene, 4.0, scene_factory.emission(), location=(1.0, 0, 1.0))
        scene_factory.top_camera(self.scene, 4.0)
        self.scene.view_layers[0].use_pass_z = True
        for engine in ENGINES:
            picture = render(engine, 4, 0, (8, 8), multilayer=True)
            depth = picture.layers["ViewLayer.Depth.Z"]
            self.assertAlmostEqual(depth[8 * 4 + 6], 9.0, places=4)
            self.assertGreater(depth[8 * 4 + 0], 1e9)

    def test_view_layers(self):
        """Two layers show two collections; a third is switched off."""
        names = ("Left", "Right")
        collections = []
        for x, name, color in ((-1.0, "Left", (1, 0.5, 0.25)), (1.0, "Right", (0.25, 0.5, 1))):
            collection = bpy.data.collections.new(name)
            self.scene.collection.children.link(collection)
            obj = scene_factory.plane(self.scene, 1.5, scene_factory.emission(color), name,
                                      location=(x, 0, 0))
            self.scene.collection.objects.unlink(obj)
            collection.objects.link(obj)
            collections.append(collection)
        scene_factory.top_camera(self.scene, 4.0)
        first = self.scene.view_layers[0]
        first.name = "Left"
        second = self.scene.view_layers.new("Right")
        self.scene.view_layers.new("Off").use = False
        for layer in (first, second):
            layer.layer_collection.children[names[1 - names.index(layer.name)]].exclude = True
        for engine in ENGINES:
            picture = render(engine, 4, 0, (16, 16), multilayer=True)
            self.assertFalse([n for n in picture.layers if n.startswith("Off.")])
            left, right = (picture.layers[f"{n}.Combined.R"] for n in names)
            index = 16 * 8
            self.assertAlmostEqual(left[index + 4], 1.0, places=5)
            self.assertEqual(left[index + 12], 0.0)
            self.assertAlmostEqual(right[index + 12], 0.25, places=5)
            self.assertEqual(right[index + 4], 0.0)


class DeterminismTest(StillLife):

    def test_same_seed_same_bits(self):
        self.still_life()
        first = render(TESTED_ENGINE, 8, 5)
        self.assert_bitwise_equal(render(TESTED_ENGINE, 8, 5), first, "again")
        self.assertNotEqual(render(TESTED_ENGINE, 8, 6).rgba, first.rgba, "the seed does nothing")

    def test_threads_do_not_matter(self):
        self.still_life()
        self.scene.render.threads_mode = "FIXED"
        pictures = []
        for threads in (1, 2, 3):
            self.scene.render.threads = threads
            pictures.append(render(TESTED_ENGINE, 8, 5, (48, 40)))
        for picture in pictures[1:]:
            self.assert_bitwise_equal(picture, pictures[0], "threads")

    def test_animated_seed(self):
        self.still_life()
        def at(frame, animated):
            self.scene.frame_set(frame)
            return render(TESTED_ENGINE, 4, 0, use_animated_seed=animated).rgba
        self.assertEqual(at(1, False), at(2, False))
        self.assertNotEqual(at(1, True), at(2, True))

    def test_settings_do_not_leak(self):
        """A render after one with another scene gives the same bits as before."""
        self.still_life()
        first = render(TESTED_ENGINE, 4, 0)
        for obj in self.scene.objects:
            obj.hide_render = obj.type == "MESH"
        render(TESTED_ENGINE, 4, 0)
        for obj in self.scene.objects:
            obj.hide_render = False
        self.assert_bitwise_equal(render(TESTED_ENGINE, 4, 0), first, "after another render")

    def test_more_samples_less_noise(self):
        self.still_life()
        few, many = (compare.relative_variance(render(TESTED_ENGINE, n, 0),
                                               render(TESTED_ENGINE, n, 1)) for n in (4, 64))
        self.assertLess(many, few / 4)


class AnimationTest(StillLife):

    def test_objects_move_between_frames(self):
        obj = scene_factory.plane(self.scene, 1.0, scene_factory.emission(), location=(-1, 0, 0))
        obj.keyframe_insert("location", frame=1)
        obj.location.x = 1.0
        obj.keyframe_insert("location", frame=2)
        scene_factory.top_camera(self.scene, 4.0)
        prepare(self.scene, TESTED_ENGINE, 4, 0, (16, 16))
        for frame, lit, dark in ((1, 4, 12), (2, 12, 4)):
            self.scene.frame_set(frame)
            picture = render_as_is(self.scene)
            self.assertAlmostEqual(picture.pixel(lit, 8)[0], 1.0, places=5)
            self.assertEqual(picture.pixel(dark, 8)[0], 0.0)


class VisibilityTest(StillLife):
    FLAGS = ("visible_camera", "visible_diffuse", "visible_glossy", "visible_transmission",
             "visible_shadow")

    def check(self, name):
        self.assert_agrees(name, 8, 0.01, seeds=3, samples=192, resolution=(32, 24),
                           max_noise=0.03, absolute=1e-3)

    def test_ray_visibility(self):
        for flag in self.FLAGS:
            with self.subTest(flag):
                self.setUp()
                self.still_life()
                setattr(self.scene.objects["Diffuse"], flag, False)
                self.check(flag)

    def test_ray_visibility_of_the_floor(self):
        for flag in self.FLAGS:
            with self.subTest(flag):
                self.setUp()
                self.still_life()
                setattr(self.scene.objects["Floor"], flag, False)
                self.check(f"floor {flag}")

    def test_ray_visibility_of_a_lamp(self):
        for flag in ("visible_diffuse", "visible_glossy", "visible_transmission"):
            with self.subTest(flag):
                self.setUp()
                self.still_life()
                setattr(self.scene.objects["Lamp"], flag, False)
                self.check(f"lamp {flag}")

    def test_ray_visibility_of_the_world(self):
        for flag in ("camera", "diffuse", "glossy", "transmission"):
            with self.subTest(flag):
                self.setUp()
                self.still_life((0.4, 0.5, 0.6))
                setattr(self.scene.world.cycles_visibility, flag, False)
                self.check(f"world {flag}")

    def test_hidden_objects(self):
        self.still_life()
        self.scene.objects["Mirror"].hide_render = True
        self.scene.objects["Glass"].hide_viewport = True
        self.check("hide_render")

    def test_indirect_only(self):
        self.still_life()
        collection = bpy.data.collections.new("Indirect")
        self.scene.collection.children.link(collection)
        obj = self.scene.objects["Diffuse"]
        self.scene.collection.objects.unlink(obj)
        collection.objects.link(obj)
        layer = self.scene.view_layers[0].layer_collection.children["Indirect"]
        for attribute in ("indirect_only", "holdout"):
            with self.subTest(attribute):
                setattr(layer, attribute, True)
                self.check(attribute)
                setattr(layer, attribute, False)


class LimitTest(StillLife):

    def check(self, name, **settings):
        self.still_life()
        self.assert_agrees(name, 8, 0.01, seeds=3, samples=192, resolution=(32, 24),
                           max_noise=0.03, absolute=1e-3, **settings)

    def test_bounce_limits(self):
        for settings in ({"max_bounces": 0}, {"max_bounces": 1}, {"max_bounces": 2},
                         {"diffuse_bounces": 0}, {"diffuse_bounces": 1}, {"glossy_bounces": 0},
                         {"glossy_bounces": 1}, {"transmission_bounces": 0},
                         {"transmission_bounces": 1}, {"transmission_bounces": 2}):
            with self.subTest(settings):
                self.setUp()
                self.check(str(settings), **settings)

    def test_caustics_switches(self):
        for settings in ({"caustics_reflective": False}, {"caustics_refractive": False}):
            with self.subTest(settings):
                self.setUp()
                self.check(str(settings), **settings)

    def test_transparent_limit(self):
        for limit in (0, 1, 2, 3, 8):
            with self.subTest(limit):
                self.setUp()
                clear = scene_factory.simple_material("ShaderNodeBsdfTransparent",
                                                      Color=(0.9, 0.8, 0.7))
                for i in range(4):
                    scene_factory.plane(self.scene, 2.0, clear, location=(0, 0, 1 + 0.2 * i))
                scene_factory.plane(self.scene, 6.0, scene_factory.diffuse())
                scene_factory.lamp(self.scene, "SUN", 3.0, (0, 0, 5), (20, 10, 0), angle=0.0)
                scene_factory.set_world(self.scene, (0.1, 0.1, 0.1))
                scene_factory.top_camera(self.scene, 5.0)
                self.assert_agrees(str(limit), 8, 0.01, seeds=2, samples=128, resolution=(32, 32),
                                   max_noise=0.02, transparent_max_bounces=limit)

    def test_transparent_limit_to_the_layer(self):
        """Behind the last transparent surface light is seen, but nothing is lit any more."""
        for limit, layers, lit in itertools.product((0, 2), (0, 1, 2), (False, True)):
            with self.subTest(limit=limit, layers=limit + layers, lit=lit):
                self.setUp()
                clear = scene_factory.simple_material("ShaderNodeBsdfTransparent",
                                                      Color=(1, 1, 1))
                for i in range(limit + layers):
                    scene_factory.plane(self.scene, 9.0, clear, location=(0, 0, 4 + 0.2 * i))
                scene_factory.plane(self.scene, 9.0, scene_factory.diffuse() if lit
                                    else scene_factory.emission())
                if lit:
                    scene_factory.lamp(self.scene, "SUN", 3.0, rotation=(10, 10, 0), angle=0.0)
                # The camera of the lit scene is below the layers: they are in the lamp's way alone.
                scene_factory.top_camera(self.scene, 0.1, height=2.0 if lit else 9.0)
                tested, reference = self.both((4, 4), 4, transparent_max_bounces=limit,
                                              max_bounces=0)
                self.assert_exact(tested, reference)

    def test_clamping(self):
        """Clamped means depend on the samples' spread: alike where each sample is alike."""
        scene_factory.plane(self.scene, 4.0, scene_factory.emission((4.0, 2.0, 1.0)))
        scene_factory.top_camera(self.scene, 2.0)
        tested, reference = self.both((8, 8), 4, sample_clamp_direct=1.5)
        self.assert_exact(tested, reference, 1e-4)

    def test_light_max_bounces(self):
        self.still_life()
        self.scene.objects["Lamp"].data.cycles.max_bounces = 0
        self.assert_agrees("max_bounces of lamp", 8, 0.01, seeds=3, samples=192,
                           resolution=(32, 24), max_noise=0.03, absolute=1e-3)

    def test_time_limit(self):
        """Stops early, with a whole picture."""
        self.still_life()
        prepare(self.scene, TESTED_ENGINE, 1000000, 0, (64, 64))
        engine_settings(self.scene, TESTED_ENGINE).time_limit = 1.0
        picture = render_as_is(self.scene)
        self.assertTrue(all(math.isfinite(v) for v in picture.rgba))
        self.assertGreater(min(picture.pixel(x, 2)[0] for x in range(64)), 0.0)


class WholePictureTest(StillLife):

    def test_still_life(self):
        self.still_life()
        tested, reference = render_pair(3, samples=512, resolution=(32, 24))
        self.assert_pictures_agree(tested, reference, "still life", 8, 0.005, 1e-3, max_noise=0.01)
