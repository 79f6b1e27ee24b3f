# SPDX-License-Identifier: GPL-3.0-or-later
"""The magic mirror: each test proves one consequence of its definition.

`this` is an ordinary picture of this side, `dream` an ordinary picture of the world behind; the magic
picture must equal the one or the other, pixel region by pixel region.
"""
import math
import unittest
from array import array

import bpy
from mathutils import Matrix

from support import scene_factory
from support.case import RenderTestCase
from support.picture import Picture
from support.render import TESTED_ENGINE, render, render_seeds
from support.tile_grid import emission_of

MIRROR_Y = 2.0


def flat(picture, mask):
    """`picture` with everything outside `mask` (list of bool a pixel) black."""
    rgba = array("f", picture.rgba)
    for index, inside in enumerate(mask):
        if not inside:
            rgba[4 * index:4 * index + 4] = array("f", [0.0] * 4)
    return Picture(picture.width, picture.height, rgba)


def flipped(picture):
    """`picture` mirrored left to right."""
    rgba = array("f")
    for y in range(picture.height):
        for x in range(picture.width - 1, -1, -1):
            rgba.extend(picture.pixel(x, y))
    return Picture(picture.width, picture.height, rgba)


@unittest.skipUnless(TESTED_ENGINE == "TENNIEL", "only Tenniel has a magic mirror")
class MirrorCase(RenderTestCase):

    RESOLUTION = (48, 36)

    def looking_glass(self, material=None, **tags):
        """The mirror: a wall at y = MIRROR_Y that faces -Y."""
        obj = scene_factory.plane(self.scene, 3.0, material or scene_factory.mirror((0.9, 0.9, 0.9)),
                                  "Looking Glass", location=(0, MIRROR_Y, 1.2),
                                  rotation=(90, 0, 0))
        obj.tenniel.looking_glass = True
        for name, value in tags.items():
            setattr(obj.tenniel, name, value)
        return obj

    def room(self, mirror_material=None):
        """Floor, three spheres (of both sides, of this side, behind), lamp, mirror, camera."""
        scene_factory.plane(self.scene, 10.0, scene_factory.diffuse((0.8, 0.8, 0.8)), "Floor")
        for x, side, color in ((-0.9, "BOTH", (0.8, 0.1, 0.1)), (0.0, "THIS_SIDE", (0.1, 0.2, 0.8)),
                               (0.9, "BEHIND", (0.1, 0.7, 0.2))):
            obj = scene_factory.sphere(self.scene, 0.4, scene_factory.diffuse(color), 24, 12,
                                       name=side, location=(x, 0.6, 0.4))
            obj.tenniel.side = side
        scene_factory.lamp(self.scene, "AREA", 150.0, (0.5, -0.5, 4.0), size=1.5)
        scene_factory.set_world(self.scene, (0.1, 0.15, 0.2))
        scene_factory.camera(self.scene, (0.3, -4.0, 2.2), (0.0, 1.2, 0.7), lens=32.0)
        return self.looking_glass(mirror_material)

    def make_ordinary(self, keep):
        """Remove what does not exist in world `keep` ("this" or "dream") and all tags."""
        unwanted = "BEHIND" if keep == "this" else "THIS_SIDE"
        for obj in list(self.scene.objects):
            if obj.tenniel.side == unwanted:
                bpy.data.objects.remove(obj)
                continue
            obj.tenniel.side = "BOTH"
            obj.tenniel.looking_glass = False

    def coverage(self, name="Looking Glass"):
        """For each pixel how much of it shows object `name`, as seen by the camera (0..1).

        Everything else turns black and this object white; tags and lights play no part.
        """
        black, white = scene_factory.emission((0, 0, 0)), scene_factory.emission((1, 1, 1))
        slots = {}
        tags = {o: (o.tenniel.looking_glass, o.tenniel.side) for o in self.scene.objects}
        for obj, (_, side) in tags.items():
            obj.tenniel.looking_glass = False
            if obj.type == "MESH":
                slots[obj] = obj.data.materials[0]
                obj.data.materials[0] = white if obj.name == name else black
        world, self.scene.world = self.scene.world, None
        picture = render(TESTED_ENGINE, 64, 5, self.RESOLUTION, max_bounces=0)
        self.scene.world = world
        for obj, material in slots.items():
            obj.data.materials[0] = material
        for obj, (glass, side) in tags.items():
            obj.tenniel.looking_glass, obj.tenniel.side = glass, side
        return list(picture.rgba[0::4])

    def assert_region(self, first, second, mask, name, relative=0.01):
        """Means of 6x6 blocks of two lists of pictures agree inside `mask`."""
        self.assertGreater(sum(mask), 40, "the region is too small to prove anything")
        self.assert_pictures_agree([flat(p, mask) for p in first], [flat(p, mask) for p in second],
                                   name, 6, relative, 1e-4, max_noise=0.03)


class ThreeScenesTest(MirrorCase):
    """Proof 1, and by it proof 4 for soft shadows."""

    def check(self, material_of, tag=None):
        self.room(material_of() if material_of else None)
        if tag:
            tag(self.scene)
        inside = [c > 0.999 for c in self.coverage()]
        outside = [c == 0.0 for c in self.coverage()]
        full = {"samples": 256, "resolution": self.RESOLUTION}
        # Without diffuse bounces no path from a diffuse surface can reach the mirror.
        direct = {**full, "diffuse_bounces": 0}
        magic = render_seeds(TESTED_ENGINE, 3, **full)
        magic_direct = render_seeds(TESTED_ENGINE, 3, **direct)
        self.setUp()
        self.room(material_of() if material_of else None)
        self.make_ordinary("dream")
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

    def test_furnace(self):
        white = scene_factory.diffuse((1, 1, 1))
        for x, side in ((-1.0, "BOTH"), (0.0, "THIS_SIDE"), (1.0, "BEHIND")):
            obj = scene_factory.sphere(self.scene, 0.4, white, name=side, location=(x, 0.5, 0.8))
            obj.tenniel.side = side
        self.looking_glass(scene_factory.mirror((1, 1, 1)))
        scene_factory.set_world(self.scene, (1, 1, 1))
        scene_factory.camera(self.scene, (0.0, -3.0, 1.2), (0, MIRROR_Y, 1.0), lens=25.0)
        picture = render(TESTED_ENGINE, 128, 0, self.RESOLUTION, max_bounces=1024,
                         diffuse_bounces=1024, glossy_bounces=1024)
        for x, y, mean in picture.block_means(6):
            self.assertAlmostEqual(mean[0], 1.0, delta=2e-3, msg=f"block {x},{y}")


class EstimatorTest(MirrorCase):
    """Proof 6: light sampling with MIS and chance hits alone have the same mean."""

    @staticmethod
    def coated(nodes):
        diffuse = nodes.add("ShaderNodeBsdfDiffuse", None, {"Color": (0.7, 0.3, 0.2)})
        glossy = nodes.add("ShaderNodeBsdfGlossy", {"distribution": "GGX"},
                           {"Color": (0.9, 0.9, 0.9), "Roughness": 0.4})
        return nodes.add("ShaderNodeMixShader", None, {0: 0.5, 1: diffuse, 2: glossy})

    @classmethod
    def half_there(cls, nodes):
        transparent = nodes.add("ShaderNodeBsdfTransparent", None, {"Color": (1, 1, 1)})
        return nodes.add("ShaderNodeMixShader", None, {0: 0.5, 1: transparent,
                                                       2: cls.coated(nodes)})

    MIRRORS = {
        "rough": lambda: scene_factory.mirror((0.9, 0.9, 0.9), 0.5),
        "diffuse coat": lambda: scene_factory.node_material("coat", EstimatorTest.coated),
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

    def build(self, reenter):
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
        scene_factory.camera(self.scene, (0.1, 0, 0), (0.75, 1.0, 0.02), lens=24.0)

    def test_depth(self):
        for reenter in ("STAY", "TOGGLE"):
            with self.subTest(reenter):
                self.setUp()
                self.build(reenter)
                picture = render(TESTED_ENGINE, 1, 0, (64, 8), max_bounces=64, glossy_bounces=64)
                depths = set()
                for x in range(64):
                    red, green, blue, _ = picture.pixel(x, 4)
                    if red == 0.0:
                        continue
                    depth = math.log(red) / math.log(self.REFLECTANCE)
                    self.assertAlmostEqual(depth, round(depth), places=3)
                    depth = round(depth)
                    depths.add(depth)
                    behind = depth % 2 if reenter == "TOGGLE" else min(depth, 1)
                    self.assert_pixel(picture, x, 4, (red, red * behind, red * behind))
                self.assertGreaterEqual(len(depths), 4, depths)
                self.assertIn(0, depths)


class InstanceTest(MirrorCase):
    """Proof 9 for instances of several origins, materials, dreams and nodes."""

    RADIANCE = (1.0, 2.0, 4.0)

    def build(self, add, reflectance=1.0):
        add()
        self.looking_glass(scene_factory.mirror((reflectance,) * 3))
        scene_factory.camera(self.scene, (0.0, -3.0, 1.2), (0, MIRROR_Y, 1.2), lens=40.0)
        return render(TESTED_ENGINE, 16, 0, (33, 33))

    def ball(self, collection=None, side="BOTH"):
        """Emissive sphere on the line from the camera to the middle of the mirror."""
        obj = scene_factory.sphere(self.scene, 0.4, scene_factory.emission(self.RADIANCE),
                                   name="Ball")
        obj.tenniel.side = side
        if collection:
            self.scene.collection.objects.unlink(obj)
            collection.objects.link(obj)
        return obj

    def collection_instance(self, instancer_side, ball_side):
        collection = bpy.data.collections.new("Balls")
        self.ball(collection, ball_side)
        empty = scene_factory.link(self.scene, None, "Instancer", (0.0, -0.5, 1.2))
        empty.instance_type = "COLLECTION"
        empty.instance_collection = collection
        empty.tenniel.side = instancer_side

    def vertex_instance(self, instancer_side, ball_side):
        parent = scene_factory.link(self.scene, scene_factory.mesh("Dots", [(0, -0.5, 1.2)], []),
                                    "Instancer")
        parent.instance_type = "VERTS"
        parent.tenniel.side = instancer_side
        self.ball(side=ball_side).parent = parent

    def test_side_of_instancer_and_object(self):
        """Directly the ball hides the mirror's middle; behind it is seen there by reflection only."""
        direct, none = self.RADIANCE, (0.0, 0.0, 0.0)
        cases = {("BEHIND", "BOTH"): "behind", ("BOTH", "BEHIND"): "behind",
                 ("THIS_SIDE", "BOTH"): "this", ("BOTH", "THIS_SIDE"): "this",
                 ("THIS_SIDE", "BEHIND"): "this", ("BEHIND", "THIS_SIDE"): "behind"}
        for add in (self.collection_instance, self.vertex_instance):
            for (instancer, ball), seen in cases.items():
                with self.subTest(f"{add.__name__}: instancer {instancer}, object {ball}"):
                    self.setUp()
                    picture = self.build(lambda a=add, i=instancer, b=ball: a(i, b), 0.5)
                    expected = [0.5 * r for r in direct] if seen == "behind" else direct
                    self.assert_pixel(picture, 16, 16, expected)
                    # Beside the ball but inside the mirror: nothing shines in either world.
                    self.assert_pixel(picture, 2, 16, none)

    def test_behind_material(self):
        other = (4.0, 0.5, 0.25)
        for where in ("object", "material"):
            with self.subTest(where):
                self.setUp()

                def add():
                    obj = self.ball()
                    obj.location = (0.6, -0.5, 1.2)
                    look = scene_factory.emission(other)
                    owner = obj if where == "object" else obj.data.materials[0]
                    owner.tenniel.behind_material = look
                picture = self.build(add)
                colors = {tuple(round(v, 3) for v in picture.pixel(x, 16)[:3]) for x in range(33)}
                self.assertIn(self.RADIANCE, colors, "seen directly")
                self.assertIn(other, colors, "seen in the mirror")

    def test_attribute_node(self):
        def add():
            material = emission_of("world", lambda n: n.add("ShaderNodeCombineXYZ", None, {
                0: 1.0, 1: n.add("ShaderNodeAttribute", {
                    "attribute_name": "behind_mirror"}).outputs["Fac"]}))
            obj = self.ball()
            obj.data.materials[0] = material
            obj.location = (0.6, -0.5, 1.2)
        picture = self.build(add)
        colors = {tuple(round(v, 3) for v in picture.pixel(x, 16)[:3]) for x in range(33)}
        self.assertIn((1.0, 0.0, 0.0), colors)
        self.assertIn((1.0, 1.0, 0.0), colors)

    def test_two_dreams_with_their_own_worlds(self):
        """Two mirrors side by side show two skies; directly there is a third."""
        skies = ((0.25, 0.5, 1.0), (1.0, 0.5, 0.25))
        for index, sky in enumerate(skies):
            dream = self.scene.tenniel.dreams.add()
            dream.name = f"Dream {index + 1}"
            own = self.scene.world
            scene_factory.set_world(self.scene, sky)
            dream.world, self.scene.world = self.scene.world, own
        scene_factory.set_world(self.scene, (0.125, 0.125, 0.125))
        for index, x in enumerate((-1.0, 1.0)):
            obj = scene_factory.plane(self.scene, 1.8, scene_factory.mirror((1, 1, 1)),
                                      location=(x, MIRROR_Y, 1.2), rotation=(90, 0, 0))
            obj.tenniel.looking_glass = True
            obj.tenniel.dream = index + 1
        scene_factory.camera(self.scene, (0.0, -4.0, 1.2), (0, MIRROR_Y, 1.2), lens=40.0)
        picture = render(TESTED_ENGINE, 4, 0, (48, 36))
        self.assert_pixel(picture, 16, 18, skies[0])
        self.assert_pixel(picture, 32, 18, skies[1])
        self.assert_pixel(picture, 24, 1, (0.125, 0.125, 0.125))

    def test_object_in_one_dream_only(self):
        for name in ("First", "Second"):
            self.scene.tenniel.dreams.add().name = name
        items = [i.identifier for i in
                 bpy.types.TennielObjectSettings.bl_rna.properties["dreams"].enum_items]
        for wanted, expected in ((0, (0.0, 0.0, 0.0)), (1, self.RADIANCE)):
            with self.subTest(items[wanted]):
                self.setUp()
                for name in ("First", "Second"):
                    self.scene.tenniel.dreams.add().name = name
                obj = self.ball(side="BEHIND")
                obj.location = (0.0, -0.5, 1.2)
                obj.tenniel.dreams = {items[wanted]}
                glass = self.looking_glass(scene_factory.mirror((1, 1, 1)))
                glass.tenniel.dream = 2
                scene_factory.camera(self.scene, (0.0, -3.0, 1.2), (0, MIRROR_Y, 1.2), lens=40.0)
                self.assert_pixel(render(TESTED_ENGINE, 4, 0, (33, 33)), 16, 16, expected)

    def test_portal(self):
        """Entry by transmission: the other world is seen through the surface."""
        obj = self.ball(side="BEHIND")
        obj.location = (0.0, MIRROR_Y + 2.0, 1.2)
        for entry, expected in (("TRANSMISSION", self.RADIANCE), ("BOTH", self.RADIANCE),
                                ("REFLECTION", (0.0, 0.0, 0.0))):
            glass = self.looking_glass(scene_factory.simple_material(
                "ShaderNodeBsdfTransparent", Color=(1, 1, 1)), entry=entry)
            scene_factory.camera(self.scene, (0.0, -3.0, 1.2), (0, MIRROR_Y, 1.2), lens=40.0)
            with self.subTest(entry):
                self.assert_pixel(render(TESTED_ENGINE, 4, 0, (33, 33)), 16, 16, expected)
            bpy.data.objects.remove(glass)

    def test_first_seen_only(self):
        """The floor is not lit from behind when only the directly seen mirror is magic."""
        def floor_light(first_seen_only):
            self.setUp()
            scene_factory.plane(self.scene, 6.0, scene_factory.diffuse((1, 1, 1)), "Floor")
            obj = scene_factory.plane(self.scene, 2.0, scene_factory.emission((1, 1, 1), 5.0),
                                      location=(0, -1.0, 3.0))
            obj.tenniel.side = "BEHIND"
            self.looking_glass(scene_factory.mirror((1, 1, 1)), first_seen_only=first_seen_only)
            scene_factory.top_camera(self.scene, 1.0, (0, 0.5), 8.0)
            return render(TESTED_ENGINE, 256, 0, (8, 8)).mean()[0]
        self.assertGreater(floor_light(False), 0.01)
        self.assertEqual(floor_light(True), 0.0)


class NothingTaggedTest(MirrorCase):
    """Proof 10: without a difference between the worlds, not a bit changes."""

    def ordinary(self, material):
        self.setUp()
        glass = self.room(material)
        for name in ("BEHIND", "THIS_SIDE"):
            self.scene.objects[name].tenniel.side = "BOTH"
        return glass

    def test_tags_that_mean_nothing(self):
        glass = self.ordinary(scene_factory.mirror((0.9, 0.9, 0.9), 0.2))
        glass.tenniel.looking_glass = False
        plain = render(TESTED_ENGINE, 16, 3, self.RESOLUTION)
        glass["looking_glass"] = False
        self.scene.objects["Floor"]["behind_mirror"] = 0
        self.scene.tenniel.dreams.add().name = "unused"
        self.assert_bitwise_equal(render(TESTED_ENGINE, 16, 3, self.RESOLUTION), plain,
                                  "false tags")

    def test_looking_glass_into_an_equal_world(self):
        for roughness in (0.0, 0.2):
            with self.subTest(roughness):
                self.setUp()
                glass = self.ordinary(scene_factory.mirror((0.9, 0.9, 0.9), roughness))
                magic = render(TESTED_ENGINE, 16, 3, self.RESOLUTION)
                glass.tenniel.looking_glass = False
                self.assert_bitwise_equal(render(TESTED_ENGINE, 16, 3, self.RESOLUTION), magic,
                                          "empty dream")

    def test_mixed_lobes_into_an_equal_world(self):
        """With lobes that enter and lobes that stay the estimator differs, the mean does not."""
        self.ordinary(None)
        self.scene.objects["Looking Glass"].data.materials[0] = scene_factory.node_material(
            "coat", EstimatorTest.coated)
        settings = {"samples": 256, "resolution": self.RESOLUTION}
        magic = render_seeds(TESTED_ENGINE, 3, **settings)
        self.scene.objects["Looking Glass"].tenniel.looking_glass = False
        plain = render_seeds(TESTED_ENGINE, 3, 77, **settings)
        self.assert_pictures_agree(magic, plain, "mixed lobes", 6, 0.01, 1e-4, max_noise=0.03)


class MistakeTest(MirrorCase):
    """Section 4 of the definition: errors lose nothing."""

    def test_looking_glass_without_faces(self):
        self.room()
        obj = scene_factory.link(self.scene, scene_factory.mesh("Nothing", [], []))
        obj.tenniel.looking_glass = True
        render(TESTED_ENGINE, 1, 0, (8, 8))

    def test_dream_that_is_not_there(self):
        self.room().tenniel.dream = 4
        render(TESTED_ENGINE, 1, 0, (8, 8))

    def test_behind_object_without_looking_glass(self):
        self.room().tenniel.looking_glass = False
        render(TESTED_ENGINE, 1, 0, (8, 8))
