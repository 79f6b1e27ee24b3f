# SPDX-License-Identifier: GPL-3.0-or-later
"""Particle hair, hair Curves and point clouds, and how they are shaded, against Cycles."""
import math
import random

import bpy

from support import scene_factory
from support.case import RenderTestCase
from support.tile_grid import emission_of
from cases.test_motion_blur import move, open_shutter


def principled_hair(**inputs):
    settings = {"parametrization": inputs.pop("parametrization", "COLOR")}
    return scene_factory.simple_material("ShaderNodeBsdfHairPrincipled", None, settings, **inputs)


class HairCase(RenderTestCase):

    def tuft(self, material, count=150, drawn="RIBBONS", **settings):
        """A patch that hair grows on: wavy by its parents' velocities, thick enough to see."""
        ground = scene_factory.plane(self.scene, 1.6, material, "Skin")
        system = ground.modifiers.new("Hair", "PARTICLE_SYSTEM").particle_system
        system.seed = 3
        part = system.settings
        part.type, part.count, part.hair_length = "HAIR", count, 1.0
        part.brownian_factor, part.factor_random = 0.3, 0.15
        part.root_radius, part.tip_radius, part.radius_scale = 1.0, 0.3, 0.1
        for name, value in settings.items():
            setattr(part, name, value)
        self.scene.cycles_curves.shape = drawn
        scene_factory.camera(self.scene, (0.0, -4.0, 2.0), (0.0, 0.0, 0.45))
        return ground

    def lamp(self, **settings):
        scene_factory.lamp(self.scene, "SUN", 3.0, rotation=(50, 10, 30), angle=0.0, **settings)

    def curves(self, material, count=60, keys=6, radius=0.04):
        """Hair Curves that lean over to all sides."""
        bpy.ops.object.curves_random_add()
        obj = bpy.context.object
        generator = random.Random(4)
        positions, radii = [], []
        for curve in obj.data.curves:
            x, y = generator.uniform(-0.8, 0.8), generator.uniform(-0.8, 0.8)
            a, b = generator.uniform(-1, 1), generator.uniform(-1, 1)
            for k in range(curve.points_length):
                t = k / (curve.points_length - 1)
                shown = curve.index < count
                positions += (x + a * t * t, y + b * t * t, t + (0.0 if shown else -50.0))
                radii.append(radius * (1.0 - 0.7 * t))
        obj.data.attributes["position"].data.foreach_set("vector", positions)
        obj.data.attributes["radius"].data.foreach_set("value", radii)
        obj.data.materials.append(material)
        obj.data.update_tag()
        scene_factory.camera(self.scene, (0.0, -4.0, 2.0), (0.0, 0.0, 0.45))
        return obj

    def check(self, name="", **arguments):
        options = {"samples": 64, "resolution": (48, 48), "block": 12, "seeds": 3,
                   "relative": 0.005, "absolute": 1e-3, "max_noise": 0.05, **arguments}
        self.assert_agrees(name, **options)


class ShapeTest(HairCase):

    def test_tuft_glows(self):
        """What is covered, without any light: shape, radius, steps, children."""
        for shape in ("RIBBONS", "THICK"):
            for name, settings in {
                    "plain": {},
                    "thin at once": {"shape": 0.6, "use_close_tip": False},
                    "thick for long": {"shape": -0.7, "render_step": 2},
                    "children": {"child_type": "SIMPLE", "rendered_child_count": 5, "count": 30},
                    "cut": {"child_type": "SIMPLE", "rendered_child_count": 5, "count": 30,
                            "child_length": 0.6, "child_length_threshold": 0.5},
                    "spiral": {"child_type": "SIMPLE", "rendered_child_count": 3, "count": 20,
                               "kink": "SPIRAL", "kink_extra_steps": 4}}.items():
                with self.subTest(f"{shape} {name}"):
                    self.setUp()
                    self.tuft(scene_factory.emission((0.2, 0.5, 1.0)), drawn=shape, **settings)
                    self.check(f"{shape} {name}", samples=16)

    def test_subdivisions_of_ribbons(self):
        for subdivisions in (0, 3):
            self.setUp()
            self.tuft(scene_factory.emission(), 40, render_step=1)
            self.scene.cycles_curves.subdivisions = subdivisions
            self.check(str(subdivisions), samples=16)

    def test_placed_and_instanced(self):
        """Scaled unevenly, turned, and as instances of a collection."""
        for shape in ("RIBBONS", "THICK"):
            self.setUp()
            skin = self.tuft(scene_factory.emission((0.2, 0.5, 1.0)), 60, drawn=shape)
            skin.scale, skin.rotation_euler = (1.0, 0.6, 0.7), (0.2, -0.1, 0.5)
            pelt = bpy.data.collections.new("Pelt")
            pelt.objects.link(skin)
            for x in (-0.8, 0.9):
                copy = scene_factory.link(self.scene, None, "Copy", (x, 0.5, 0.1), (0, 20, 40))
                copy.instance_type, copy.instance_collection = "COLLECTION", pelt
            self.check(shape, samples=16)

    def test_curves_object(self):
        for shape in ("RIBBONS", "THICK"):
            self.setUp()
            obj = self.curves(scene_factory.emission((0.2, 0.5, 1.0)))
            obj.rotation_euler = (0.1, 0.2, 0.3)
            self.scene.cycles_curves.shape = shape
            self.check(shape, samples=16)

    def test_point_cloud(self):
        self.points(emission_of("points", lambda n: n.add("ShaderNodeVectorMath", {
            "operation": "MULTIPLY_ADD"}, {0: n.add("ShaderNodeNewGeometry").outputs["Normal"],
                                           1: (0.4, 0.4, 0.4), 2: (0.5, 0.5, 0.5)})))
        self.check(samples=16)

    def test_point_info(self):
        for output in ("Position", "Radius", "Random"):
            with self.subTest(output):
                self.setUp()
                self.points(emission_of("points", lambda n, o=output: n.add(
                    "ShaderNodeVectorMath", {"operation": "ADD"}, {
                        0: n.add("ShaderNodePointInfo").outputs[o], 1: (2.0, 2.0, 2.0)})))
                self.check(output, samples=16)

    def points(self, material):
        tree = bpy.data.node_groups.new("Points", "GeometryNodeTree")
        tree.inputs.new("NodeSocketGeometry", "Geometry")
        tree.outputs.new("NodeSocketGeometry", "Geometry")
        source, output = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
        points = tree.nodes.new("GeometryNodeMeshToPoints")
        points.inputs["Radius"].default_value = 0.4
        paint = tree.nodes.new("GeometryNodeSetMaterial")
        paint.inputs["Material"].default_value = material
        tree.links.new(source.outputs[0], points.inputs[0])
        tree.links.new(points.outputs[0], paint.inputs["Geometry"])
        tree.links.new(paint.outputs[0], output.inputs[0])
        obj = scene_factory.plane(self.scene, 1.6)
        obj.rotation_euler = (0.3, 0.2, 0.1)
        obj.modifiers.new("Points", "NODES").node_group = tree
        scene_factory.camera(self.scene, (0.0, -4.0, 2.0), (0.0, 0.0, 0.2))


class InfoTest(HairCase):
    """Outputs of nodes as emission."""

    def shown(self, node_type, outputs, **settings):
        for shape in ("RIBBONS", "THICK"):
            for output in outputs:
                with self.subTest(f"{shape} {output}"):
                    self.setUp()
                    # Lifted, so that what is negative shows.
                    material = emission_of("info", lambda n, o=output: n.add(
                        "ShaderNodeVectorMath", {"operation": "ADD"}, {
                            0: n.add(node_type).outputs[o], 1: (1.5, 1.5, 1.5)}))
                    skin = self.tuft(material, 60, drawn=shape, **settings)
                    skin.scale = (1.0, 0.8, 1.2)
                    self.check(f"{shape} {output}", samples=16)

    def test_hair_info(self):
        self.shown("ShaderNodeHairInfo", ("Is Strand", "Intercept", "Length", "Thickness",
                                          "Tangent Normal", "Random"))

    def test_geometry(self):
        self.shown("ShaderNodeNewGeometry", ("Position", "Normal", "Tangent", "True Normal",
                                             "Incoming", "Parametric", "Backfacing"))

    def test_hair_info_of_curves(self):
        for output in ("Intercept", "Length", "Thickness", "Random"):
            self.setUp()
            self.curves(emission_of("info", lambda n, o=output: n.add("ShaderNodeHairInfo")
                                    .outputs[o]))
            self.check(output, samples=16)

    def test_coordinates_of_the_root(self):
        for output in ("Generated", "UV", "Object"):
            with self.subTest(output):
                self.setUp()
                material = emission_of("root", lambda n, o=output: n.add(
                    "ShaderNodeVectorMath", {"operation": "ADD"}, {
                        0: n.add("ShaderNodeTexCoord").outputs[o], 1: (1.5, 1.5, 1.5)}))
                skin = self.tuft(material, 40, child_type="SIMPLE", rendered_child_count=3)
                layer = skin.data.uv_layers.new(name="Map")
                for i, corner in enumerate(layer.data):
                    corner.uv = ((0.1, 0.2), (0.9, 0.1), (0.8, 0.7), (0.3, 1.0))[i]
                self.check(output, samples=16)

    def test_colours_of_the_root(self):
        material = emission_of("root", lambda n: n.add(
            "ShaderNodeAttribute", {"attribute_name": "Paint"}).outputs["Color"])
        skin = self.tuft(material, 60)
        layer = skin.data.color_attributes.new("Paint", "BYTE_COLOR", "CORNER")
        for i, corner in enumerate(layer.data):
            corner.color = ((1, 0, 0, 1), (0, 0.5, 0, 1), (0.2, 0.2, 1, 1), (1, 1, 1, 1))[i]
        self.check(samples=16)


class ShadingTest(HairCase):

    def make(self, name):
        return {
            "principled": lambda: principled_hair(Color=(0.6, 0.3, 0.1), Offset=0.0),
            "diffuse": lambda: scene_factory.diffuse((0.7, 0.4, 0.2)),
            "glossy": lambda: scene_factory.mirror((0.7, 0.4, 0.2), roughness=0.5),
            "translucent": lambda: scene_factory.simple_material(
                "ShaderNodeBsdfTranslucent", Color=(0.7, 0.4, 0.2)),
            "hair": lambda: scene_factory.simple_material(
                "ShaderNodeBsdfHair", Color=(0.7, 0.4, 0.2), RoughnessU=0.3, RoughnessV=0.7,
                Offset=0.1),
            "hair transmission": lambda: scene_factory.simple_material(
                "ShaderNodeBsdfHair", None, {"component": "Transmission"}, Color=(0.7, 0.4, 0.2),
                RoughnessU=0.3, RoughnessV=0.7),
        }[name]()

    def lit(self, name, shape, world, **arguments):
        with self.subTest(f"{name} {shape} {'world' if world else 'sun'}"):
            self.setUp()
            self.tuft(self.make(name), drawn=shape)
            if world:
                scene_factory.set_world(self.scene, (1.0, 1.0, 1.0))
            else:
                self.lamp()
            self.check(f"{name} {shape} {world}", **arguments)

    def test_under_a_sun(self):
        for name, samples in (("diffuse", 48), ("glossy", 64), ("translucent", 160), ("hair", 96)):
            for shape in ("RIBBONS", "THICK"):
                self.lit(name, shape, False, samples=samples)

    def test_under_a_world(self):
        # Not the Hair BSDF: Blender draws more directions of it than it gives a value to, so that a
        # sampled World, which Cycles leaves to chance where it is uniform, finds 1 % less.
        for name in ("diffuse", "glossy", "translucent"):
            for shape in ("RIBBONS", "THICK"):
                self.lit(name, shape, True, samples=48, seeds=2)

    def test_principled_hair_under_a_world(self):
        for shape in ("RIBBONS", "THICK"):
            self.lit("principled", shape, True)

    def test_principled_hair_under_a_sun(self):
        for shape in ("RIBBONS", "THICK"):
            self.lit("principled", shape, False, max_bounces=0, samples=48, seeds=2)


class TransparentTest(HairCase):
    """Hair that lets light through: to the camera, and in its shadows."""

    @staticmethod
    def make(color, mixed=True):
        def closure(nodes):
            clear = nodes.add("ShaderNodeBsdfTransparent", None, {"Color": color})
            if not mixed:
                return clear
            lit = nodes.add("ShaderNodeBsdfDiffuse", None, {"Color": (0.6, 0.4, 0.3)})
            return nodes.add("ShaderNodeMixShader", None, {0: 0.5, 1: clear, 2: lit})
        return scene_factory.node_material("clear", closure)

    def over_floor(self, material, shape, **settings):
        """The tuft, and a floor under it that its shadows fall on."""
        skin = self.tuft(material, 120, drawn=shape, **settings)
        skin.location.z = 0.2
        scene_factory.plane(self.scene, 6.0, scene_factory.diffuse((0.8, 0.8, 0.8)), "Floor")
        return skin

    def test_seen_through(self):
        """Against a glowing World: what passes hairs on its way to the camera."""
        for shape in ("RIBBONS", "THICK"):
            with self.subTest(shape):
                self.setUp()
                self.tuft(self.make((0.9, 0.7, 0.4), mixed=False), drawn=shape)
                scene_factory.set_world(self.scene, (1.0, 1.0, 1.0))
                self.check(shape, samples=64, seeds=2)

    def test_shadows(self):
        for shape in ("RIBBONS", "THICK"):
            for mixed in (False, True):
                with self.subTest(f"{shape} {mixed}"):
                    self.setUp()
                    self.over_floor(self.make((0.9, 0.7, 0.4), mixed), shape)
                    self.lamp()
                    self.check(f"{shape} {mixed}", samples=32, max_bounces=0,
                               relative=0.01)


class PlaceTest(HairCase):
    """Hair as an object among others: it moves, and not every ray sees it."""

    def test_moving_object(self):
        for shape in ("RIBBONS", "THICK"):
            with self.subTest(shape):
                self.setUp()
                skin = self.tuft(scene_factory.emission((0.2, 0.5, 1.0)), 80, drawn=shape)
                move(skin, "location", at=[(-0.6, 0, 0), (0, 0, 0), (0.3, 0, 0.3)])
                open_shutter(self.scene)
                self.check(shape, seeds=2)

    def test_ray_visibility(self):
        """In a mirror below it, by its shadow on a wall, and seen as it is."""
        for hidden_from in ("camera", "glossy", "shadow"):
            with self.subTest(hidden_from):
                self.setUp()
                skin = self.tuft(scene_factory.diffuse((0.7, 0.4, 0.2)), 80)
                skin.location.z = 0.1
                setattr(skin, f"visible_{hidden_from}", False)
                scene_factory.plane(self.scene, 6.0, scene_factory.mirror((0.8, 0.8, 0.8)),
                                    "Floor")
                scene_factory.plane(self.scene, 6.0, scene_factory.diffuse(), "Wall",
                                    location=(0, 1.5, 0), rotation=(90, 0, 0))
                self.lamp()
                self.check(hidden_from, samples=128, seeds=2, relative=0.01, max_bounces=1)
