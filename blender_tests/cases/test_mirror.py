# SPDX-License-Identifier: GPL-3.0-or-later
"""The magic mirror: each test proves one consequence of its definition.

An ordinary picture of this side and an ordinary one of the world behind are the references: the
magic picture must equal the one or the other, region by region.
"""
import math

import bpy
from mathutils import Matrix

from support import scene_factory
from support.mirror import MIRROR_Y, MirrorCase, coated, flipped
from support.render import TESTED_ENGINE, render, render_seeds
from support.tile_grid import emission_of


class ThreeScenesTest(MirrorCase):
    """Proof 1, and by it proof 4 for soft shadows."""

    def check(self, material_of, tag=None):
        self.room(material_of() if material_of else None)
        if tag:
            tag(self.scene)
        seen = self.coverage()
        outside = [c == 0.0 for c in seen]
        full = {"samples": 256, "resolution": self.RESOLUTION}
        # Without diffuse bounces no path from a diffuse surface can reach the mirror.
        direct = {**full, "diffuse_bounces": 0}
        magic = render_seeds(TESTED_ENGINE, 3, **full)
        magic_direct = render_seeds(TESTED_ENGINE, 3, **direct)
        self.setUp()
        self.room(material_of() if material_of else None)
        self.make_ordinary("dream")
        # In the ordinary picture what was behind now stands before the mirror as well.
        inside = [a > 0.999 and b > 0.999 for a, b in zip(seen, self.coverage())]
        self.assert_region(magic, render_seeds(TESTED_ENGINE, 3, 50, **full), inside,
                           "seen in the mirror = world 1")
        self.setUp()
        self.room(material_of() if material_of else None)
        self.make_ordinary("this")
        self.assert_region(magic_direct, render_seeds(TESTED_ENGINE, 3, 90, **direct), outside,
                           "seen directly = world 0")

    def test_perfect_mirror(self):
        self.check(None)

    def test_rough_mirror(self):
        self.check(lambda: scene_factory.mirror((0.9, 0.9, 0.9), 0.25))

    def test_plain_custom_properties(self):
        def retag(scene):
            for obj in scene.objects:
                if obj.tenniel.side == "BEHIND":
                    obj.tenniel.side = "BOTH"
                    obj["behind_mirror"] = 1
                if obj.tenniel.looking_glass:
                    obj.tenniel.looking_glass = False
                    obj["looking_glass"] = True
        self.room()
        by_tags = render(TESTED_ENGINE, 32, 3, self.RESOLUTION)
        retag(self.scene)
        by_properties = render(TESTED_ENGINE, 32, 3, self.RESOLUTION)
        self.assert_bitwise_equal(by_tags, by_properties, "custom properties against tags")
        for obj in self.scene.objects:
            for name in ("behind_mirror", "looking_glass"):
                if name in obj:
                    obj[name] = 0
        ordinary = render(TESTED_ENGINE, 32, 3, self.RESOLUTION)
        self.assertNotEqual(ordinary.rgba, by_tags.rgba, "the tags make no difference")


class VirtualImageTest(MirrorCase):
    """Proof 2: a flat perfect mirror shows what a mirrored camera sees of world 1."""

    def add_things(self, sides):
        position = emission_of("position", lambda n: n.add(
            "ShaderNodeVectorMath", {"operation": "ADD"}, {
                0: n.add("ShaderNodeNewGeometry").outputs["Position"], 1: (8, 8, 8)}))
        scene_factory.plane(self.scene, 60.0, position, "Floor", location=(0, 0, -0.5))
        scene_factory.plane(self.scene, 60.0, position, "Wall", location=(0, -9, 0),
                            rotation=(-90, 0, 0))
        for side, place in (("BEHIND", (0.7, -0.2, 0.8)), ("THIS_SIDE", (-0.7, -0.2, 0.8))):
            if side in sides:
                obj = scene_factory.sphere(self.scene, 0.5, position, location=place, name=side)
                obj.tenniel.side = side if len(sides) == 2 else "BOTH"

    def test_mirrored_camera(self):
        settings = {"samples": 256, "resolution": self.RESOLUTION}
        self.add_things(("BEHIND", "THIS_SIDE"))
        self.looking_glass(scene_factory.mirror((1, 1, 1)))
        scene_factory.camera(self.scene, (0.8, -2.5, 1.4), (0, MIRROR_Y, 1.1), lens=30.0)
        mask = [c > 0.999 for c in self.coverage()]
        magic = render(TESTED_ENGINE, **settings)
        self.setUp()
        self.add_things(("BEHIND",))
        camera = scene_factory.camera(self.scene, (0.8, -2.5, 1.4), (0, MIRROR_Y, 1.1), lens=30.0)
        bpy.context.view_layer.update()
        # The mirrored camera is left-handed; turning its x axis gives a camera whose picture is
        # flipped.
        reflected = scene_factory.reflect_across_plane(camera.matrix_world, (0, MIRROR_Y, 0),
                                                       (0, 1, 0))
        camera.matrix_world = reflected @ Matrix.Diagonal((-1, 1, 1, 1))
        virtual = flipped(render(TESTED_ENGINE, seed=7, **settings))
        inside = [magic.rgba[4 * i + c] for i, m in enumerate(mask) if m for c in range(3)]
        expected = [virtual.rgba[4 * i + c] for i, m in enumerate(mask) if m for c in range(3)]
        self.assertGreater(len(inside), 300)
        self.assertGreater(max(expected) - min(expected), 1.0)
        far = sum(abs(a - b) > 1e-3 * abs(b) + 0.02 for a, b in zip(inside, expected))
        # Silhouettes are sampled differently; everywhere else the two agree to 1e-3.
        self.assertLess(far / len(inside), 0.10)
        mean_error = abs(sum(inside) - sum(expected)) / sum(expected)
        self.assertLess(mean_error, 1e-3)


class EmissionTest(MirrorCase):
    """Proof 3."""

    RADIANCE = (2.0, 3.0, 5.0)
    REFLECTANCE = (0.9, 0.5, 0.25)

    def build(self, mirror):
        scene_factory.plane(self.scene, 10.0, scene_factory.diffuse((1, 1, 1)), "Floor")
        lit = scene_factory.sphere(self.scene, 0.6, scene_factory.emission(self.RADIANCE),
                                   location=(0, 0, 1.2))
        lit.tenniel.side = "BEHIND"
        glass = None
        if mirror:
            glass = self.looking_glass(scene_factory.mirror(self.REFLECTANCE))
        else:
            scene_factory.plane(self.scene, 3.0, scene_factory.diffuse((0, 0, 0)), "Wall",
                                location=(0, MIRROR_Y, 1.2), rotation=(90, 0, 0))
        scene_factory.camera(self.scene, (0.0, -3.0, 1.2), (0, MIRROR_Y, 1.2), lens=40.0)
        return glass

    def test_seen_only_in_the_mirror(self):
        self.build(mirror=True)
        picture = render(TESTED_ENGINE, 16, 0, (33, 33))
        expected = [e * r for e, r in zip(self.RADIANCE, self.REFLECTANCE)]
        self.assert_pixel(picture, 16, 16, expected)

    def test_no_light_without_the_mirror(self):
        self.build(mirror=False)
        picture = render(TESTED_ENGINE, 64, 0, (33, 33))
        self.assertEqual(picture.mean()[:3], (0.0, 0.0, 0.0))

    def test_lamp_behind(self):
        """A lamp is an object: one behind lights only what is seen through the glass."""
        self.build(mirror=True)
        bpy.data.objects.remove(self.scene.objects["Sphere"])
        lamp = scene_factory.lamp(self.scene, "POINT", 100.0, (0, -0.5, 2.0), shadow_soft_size=0.0)
        lamp.tenniel.side = "BEHIND"
        inside = self.coverage()
        picture = render(TESTED_ENGINE, 64, 0, self.RESOLUTION, diffuse_bounces=0)
        seen = picture.mean()
        self.assertGreater(seen[0], 1e-3)
        for index, covered in enumerate(inside):
            if covered == 0.0:
                self.assertEqual(max(picture.rgba[4 * index:4 * index + 3]), 0.0)


class ShadowTest(MirrorCase):
    """Proof 4 with a sharp sun and known values."""

    def test_shadows(self):
        albedo, strength = 0.5, 2.0
        scene_factory.plane(self.scene, 20.0, scene_factory.diffuse((albedo,) * 3), "Floor")
        for x, side in ((-1.0, "THIS_SIDE"), (1.0, "BEHIND")):
            obj = scene_factory.plane(self.scene, 1.0, scene_factory.diffuse((0, 0, 0)),
                                      name=side, location=(x, 0, 3.0))
            obj.tenniel.side = side
        scene_factory.lamp(self.scene, "SUN", strength, (0, 0, 5), angle=0.0)
        self.looking_glass(scene_factory.mirror((1, 1, 1)))
        lit = (albedo * strength / math.pi,) * 3
        dark = (0.0,) * 3
        settings = {"samples": 16, "resolution": (8, 8), "diffuse_bounces": 0}
        # Towards the two shadows, directly and by way of the mirror (image at 2 * MIRROR_Y - y).
        for x, direct, mirrored in ((-1.0, dark, lit), (1.0, lit, dark)):
            for y, z, expected in ((0.0, 0.0, direct), (2 * MIRROR_Y, 0.0, mirrored)):
                scene_factory.camera(self.scene, (x, -3.0, 2.0), (x, y, z), lens=600.0)
                with self.subTest(f"x = {x}, y = {y}"):
                    self.assert_pixel(render(TESTED_ENGINE, **settings), 4, 4, expected)


class FurnaceTest(MirrorCase):
    """Proof 5: white things under a uniform sky vanish, in every world."""

    def white_things(self):
        white = scene_factory.diffuse((1, 1, 1))
        for x, side in ((-1.0, "BOTH"), (0.0, "THIS_SIDE"), (1.0, "BEHIND")):
            # Flat faces: interpolated normals lose energy where they and the surface disagree.
            obj = scene_factory.sphere(self.scene, 0.4, white, smooth=False, name=side,
                                       location=(x, 0.5, 0.8))
            obj.tenniel.side = side
        scene_factory.set_world(self.scene, (1, 1, 1))
        scene_factory.camera(self.scene, (0.0, -3.0, 1.2), (0, MIRROR_Y, 1.0), lens=25.0)

    def check(self, name):
        picture = render(TESTED_ENGINE, 128, 0, self.RESOLUTION, max_bounces=1024,
                         diffuse_bounces=1024, glossy_bounces=1024)
        furthest = max(abs(mean[0] - 1.0) for _, _, mean in picture.block_means(6))
        self.assertLess(furthest, 2e-3, name)

    def test_furnace(self):
        self.white_things()
        self.looking_glass(scene_factory.mirror((1, 1, 1)))
        self.check("this side and dream 1")

    def test_every_world(self):
        """Each dream, with the same sky and with one of its own."""
        for own_sky in (False, True):
            for number in range(1, 5):
                with self.subTest(f"dream {number}, {'own' if own_sky else 'shared'} sky"):
                    self.setUp()
                    self.white_things()
                    for _ in range(4):
                        dream = self.scene.tenniel.dreams.add()
                        dream.world = self.scene.world.copy() if own_sky else None
                    self.looking_glass(scene_factory.mirror((1, 1, 1)), dream=number)
                    self.check(f"dream {number}")

    def test_mirror_between_two_dreams(self):
        self.white_things()
        for number in (1, 2):
            self.scene.tenniel.dreams.add()
        self.looking_glass(scene_factory.mirror((1, 1, 1)))
        other = scene_factory.plane(self.scene, 3.0, scene_factory.mirror((1, 1, 1)), "Facing",
                                    location=(0, -1.0, 3.2), rotation=(-60, 0, 0))
        other.tenniel.looking_glass, other.tenniel.dream = True, 2
        other.tenniel.reenter = 'TOGGLE'
        self.check("two dreams")


class EstimatorTest(MirrorCase):
    """Proof 6: light sampling with MIS and chance hits alone have the same mean."""

    @staticmethod
    def half_there(nodes):
        transparent = nodes.add("ShaderNodeBsdfTransparent", None, {"Color": (1, 1, 1)})
        return nodes.add("ShaderNodeMixShader", None, {0: 0.5, 1: transparent,
                                                       2: coated(nodes)})

    MIRRORS = {
        "rough": lambda: scene_factory.mirror((0.9, 0.9, 0.9), 0.5),
        "diffuse coat": lambda: scene_factory.node_material("coat", coated),
        "alpha 0.5": lambda: scene_factory.node_material("alpha", EstimatorTest.half_there),
        "pane in front": lambda: scene_factory.mirror((0.9, 0.9, 0.9), 0.5),
    }

    def pictures(self, mirror, sampled, samples):
        self.setUp()
        lamp_material = scene_factory.emission((1, 1, 1), 4.0)
        lamp_material.cycles.sample_as_light = sampled
        for x, side, size in ((-1.2, "BOTH", 1.0), (0.0, "THIS_SIDE", 0.8), (1.2, "BEHIND", 1.2)):
            obj = scene_factory.plane(self.scene, size, lamp_material, name=side,
                                      location=(x, 0.0, 2.2), rotation=(-40, 0, 0))
            obj.tenniel.side = side
        scene_factory.plane(self.scene, 6.0, scene_factory.diffuse((0.6, 0.6, 0.6)), "Floor")
        self.looking_glass(self.MIRRORS[mirror]())
        if mirror == "pane in front":
            scene_factory.plane(self.scene, 3.0, scene_factory.simple_material(
                "ShaderNodeBsdfTransparent", Color=(0.8, 0.9, 0.7)), "Pane",
                location=(0, MIRROR_Y - 0.3, 1.2), rotation=(90, 0, 0))
        scene_factory.camera(self.scene, (0.0, -2.5, 1.0), (0, MIRROR_Y, 0.9), lens=28.0)
        return render_seeds(TESTED_ENGINE, 3, 0 if sampled else 500, samples=samples,
                            resolution=(24, 18))

    def test_strategies_agree(self):
        for mirror in self.MIRRORS:
            with self.subTest(mirror):
                mis = self.pictures(mirror, True, 512)
                chance = self.pictures(mirror, False, 2048)
                self.assert_pictures_agree(mis, chance, mirror, 6, 0.005, 1e-4, max_noise=0.03)


class FacingMirrorsTest(MirrorCase):
    """Proof 7: radiance reflectance^n tells how many reflections a path had."""

    REFLECTANCE = 0.5

    def build(self, reenter, left_dream=1):
        shown = emission_of("world", lambda n: n.add("ShaderNodeCombineXYZ", None, {
            0: 1.0,
            1: n.add("ShaderNodeAttribute", {"attribute_name": "behind_mirror"}).outputs["Fac"],
            2: n.add("ShaderNodeAttribute", {"attribute_name": "dream"}).outputs["Fac"]}))
        scene_factory.plane(self.scene, 30.0, shown, "End", location=(0, 12.0, 0),
                            rotation=(90, 0, 0))
        for x, turn in ((-1.0, 90), (1.0, -90)):
            obj = scene_factory.plane(self.scene, 40.0, scene_factory.mirror(
                (self.REFLECTANCE,) * 3), f"Mirror {x}", location=(x, 0, 0), rotation=(0, turn, 0))
            obj.tenniel.looking_glass = True
            obj.tenniel.reenter = reenter
            obj.tenniel.dream = left_dream if x < 0.0 else 1
        for _ in range(left_dream):
            self.scene.tenniel.dreams.add()
        scene_factory.camera(self.scene, (0.1, 0, 0), (0.75, 1.0, 0.02), lens=24.0)

    def check(self, world_at_depth):
        """world_at_depth(n) is the world seen after n reflections."""
        # Roulette would put the lost paths' radiance on the others, and hide their depth.
        picture = render(TESTED_ENGINE, 1, 0, (64, 8), max_bounces=64, glossy_bounces=64,
                         min_light_bounces=64)
        depths = set()
        for x in range(64):
            red = picture.pixel(x, 4)[0]
            if red == 0.0:
                continue
            depth = math.log(red) / math.log(self.REFLECTANCE)
            self.assertAlmostEqual(depth, round(depth), places=3)
            depth = round(depth)
            depths.add(depth)
            world = world_at_depth(depth)
            self.assert_pixel(picture, x, 4, (red, red * (world > 0), red * world))
        self.assertGreaterEqual(len(depths), 4, depths)
        self.assertIn(0, depths)

    def test_one_dream(self):
        for reenter, world_at_depth in (("STAY", lambda n: min(n, 1)), ("TOGGLE", lambda n: n % 2)):
            with self.subTest(reenter):
                self.setUp()
                self.build(reenter)
                self.check(world_at_depth)

    def test_two_dreams(self):
        """The innermost mirror wins: each leads into its own dream, whatever the path came from."""
        for reenter in ("STAY", "TOGGLE"):
            with self.subTest(reenter):
                self.setUp()
                self.build(reenter, left_dream=2)
                self.check(lambda n: 0 if n == 0 else 2 - n % 2)
