# SPDX-License-Identifier: GPL-3.0-or-later
"""Every kind of lamp, emissive meshes, the world: light on a white floor, and direct sight."""
import math

from support import scene_factory
from support.case import RenderTestCase
from support.render import REFERENCE_ENGINE, TESTED_ENGINE, render, render_seeds


def ring_pixel(x, y):
    """A sky with a bright sun of a few texels and a coloured gradient; linear values."""
    sun = 60.0 if abs(x - 20) <= 1 and abs(y - 24) <= 1 else 0.0
    return (0.2 + 0.02 * y + sun, 0.3 + 0.3 * math.sin(x * 0.4) ** 2 + sun, 0.8 - 0.01 * y, 1.0)


class LightCase(RenderTestCase):
    SAMPLES = 128

    def floor(self, occluder=False):
        """White 4 m floor seen from above; the occluder casts shadows and takes bounces."""
        scene_factory.plane(self.scene, 4.0, scene_factory.diffuse((1, 1, 1)))
        if occluder:
            scene_factory.box(self.scene, 0.5, scene_factory.diffuse((0.5, 0.7, 0.3)),
                              location=(0.4, -0.3, 0.45))
        scene_factory.top_camera(self.scene, 4.0)

    def check(self, name="", **arguments):
        arguments = {"samples": self.SAMPLES, "resolution": (32, 32), "block": 8, **arguments}
        self.assert_agrees(name, **arguments)

    def check_each(self, variants, occluder=False, **arguments):
        """`variants`: {name: function that adds the lamp}, each in its own scene."""
        for name, add_lamp in variants.items():
            with self.subTest(name):
                self.setUp()
                self.floor(occluder)
                add_lamp(self.scene)
                self.check(name, **arguments)


def lamp(kind, **settings):
    return lambda scene: scene_factory.lamp(scene, kind, **settings)


class PointTest(LightCase):

    def test_point(self):
        self.check_each({
            "radius 0": lamp("POINT", shadow_soft_size=0.0, location=(0.5, 0.3, 1.5)),
            "radius 0.1": lamp("POINT", shadow_soft_size=0.1, location=(0.5, 0.3, 1.5)),
            "radius 0.6": lamp("POINT", shadow_soft_size=0.6, location=(0.5, 0.3, 1.2)),
            "coloured": lamp("POINT", shadow_soft_size=0.2, color=(1.0, 0.4, 0.1),
                             location=(-0.5, 0.3, 1.5)),
            "scaled object": lamp("POINT", shadow_soft_size=0.3, scale=(2.0, 0.5, 1.5),
                                  location=(0, 0, 1.5)),
        })

    def test_point_with_shadow(self):
        self.check_each({
            "radius 0": lamp("POINT", shadow_soft_size=0.0, location=(0.5, 0.3, 1.9)),
            "radius 0.3": lamp("POINT", shadow_soft_size=0.3, location=(0.5, 0.3, 1.9)),
        }, occluder=True, samples=512)

    def test_no_shadow(self):
        def add(scene):
            scene_factory.lamp(scene, "POINT", location=(0.5, 0.3, 1.9)).data.use_shadow = False
        self.check_each({"use_shadow off": add}, occluder=True)


class SpotTest(LightCase):

    def test_spot(self):
        place = {"location": (0.3, 0.2, 2.0)}
        variants = {
            f"{size} deg blend {blend} radius {radius}": lamp(
                "SPOT", spot_size=math.radians(size), spot_blend=blend, shadow_soft_size=radius,
                **place)
            for size, blend, radius in ((60, 0.0, 0.0), (60, 0.15, 0.0), (60, 1.0, 0.0),
                                        (110, 0.5, 0.0), (60, 0.3, 0.3), (160, 0.7, 0.1))}
        variants["tilted"] = lamp("SPOT", spot_size=math.radians(50), spot_blend=0.4,
                                  shadow_soft_size=0.0, rotation=(35, 20, 0), **place)
        variants["scaled object"] = lamp("SPOT", spot_size=math.radians(60), spot_blend=0.4,
                                         shadow_soft_size=0.0, scale=(1.5, 1.5, 1.5), **place)
        self.check_each(variants, max_noise=0.01)


class TerminatorTest(LightCase):
    """Coarse smooth balls under a low lamp: where facets turn away before the normals do."""

    def ball(self, offset, placement, segments=16):
        ball = scene_factory.sphere(self.scene, 1.0, scene_factory.diffuse((1, 1, 1)),
                                    segments=segments, rings=segments // 2, **placement)
        ball.cycles.shadow_terminator_geometry_offset = offset
        scene_factory.top_camera(self.scene, 2.4)
        scene_factory.lamp(self.scene, "SUN", energy=3.0, rotation=(0, 75, 20), angle=0.0)

    def test_geometry_offset(self):
        for offset in (0.0, 0.1, 0.6):
            for name, placement in {"plain": {}, "scaled": {"scale": (1.0, 0.8, 1.2)}}.items():
                with self.subTest(offset=offset, placement=name):
                    self.setUp()
                    self.ball(offset, placement)
                    self.check(f"{name} {offset}")

    def test_offset_changes_the_picture(self):
        pictures = []
        for offset in (0.0, 0.1):
            self.setUp()
            self.ball(offset, {})
            pictures.append(render(TESTED_ENGINE, 32, resolution=(32, 32), scene=self.scene))
        self.assertGreater(pictures[1].mean()[0], 1.001 * pictures[0].mean()[0])


class AreaTest(LightCase):

    def test_shapes(self):
        place = {"location": (0.3, -0.2, 1.0)}
        self.check_each({
            "square": lamp("AREA", shape="SQUARE", size=0.8, **place),
            "rectangle": lamp("AREA", shape="RECTANGLE", size=1.5, size_y=0.4, **place),
            "disk": lamp("AREA", shape="DISK", size=0.9, **place),
            "ellipse": lamp("AREA", shape="ELLIPSE", size=1.4, size_y=0.5, **place),
            "tilted": lamp("AREA", shape="RECTANGLE", size=1.0, size_y=0.4, rotation=(50, 10, 30),
                           **place),
            "scaled object": lamp("AREA", shape="SQUARE", size=0.5, scale=(2.0, 0.6, 3.0), **place),
            "scaled ellipse": lamp("AREA", shape="ELLIPSE", size=0.7, size_y=1.0,
                                   scale=(2.0, 0.6, 1.0), rotation=(0, 0, 30), **place),
            "mirrored": lamp("AREA", shape="SQUARE", size=0.5, scale=(-1.0, 1.0, 1.0), **place),
        })

    def test_spread(self):
        self.check_each({
            f"{shape} {spread} deg": lamp("AREA", shape=shape, size=0.8, size_y=0.5,
                                          spread=math.radians(spread), location=(0.3, -0.2, 1.2))
            for shape in ("SQUARE", "RECTANGLE", "DISK", "ELLIPSE")
            for spread in (150, 90, 40)}, samples=256, max_noise=0.02)

    def test_facing_away(self):
        """One-sided: the back of the lamp gives nothing."""
        self.floor()
        scene_factory.lamp(self.scene, "AREA", size=1.0, location=(0, 0, 1), rotation=(180, 0, 0))
        scene_factory.lamp(self.scene, "POINT", energy=1.0, location=(1, 1, 1))
        self.check()

    def test_shadow(self):
        self.check_each({"square": lamp("AREA", size=1.0, location=(0.3, 0.2, 2.0))},
                        occluder=True, samples=512)


class SunTest(LightCase):

    def test_sun(self):
        self.check_each({
            f"{angle} deg tilted {tilt}": lamp("SUN", energy=2.0, angle=math.radians(angle),
                                               rotation=(tilt, 0, 20))
            for angle, tilt in ((0.0, 0), (0.0, 60), (0.526, 30), (10.0, 40), (60.0, 30),
                                (5.0, 88))})

    def test_sun_with_shadow(self):
        self.check_each({
            f"{angle} deg": lamp("SUN", energy=2.0, angle=math.radians(angle), rotation=(40, 0, 20))
            for angle in (0.0, 15.0)}, occluder=True, samples=512)


class WorldTest(LightCase):

    def test_color(self):
        scene_factory.set_world(self.scene, (0.2, 0.5, 1.5), 0.7)
        self.floor(occluder=True)
        self.check(samples=512)

    def test_old_world_without_nodes(self):
        self.scene.world.use_nodes = False
        self.scene.world.color = (0.2, 0.5, 0.3)
        self.floor(occluder=True)
        self.check(samples=512)

    def test_no_world(self):
        self.scene.world = None
        self.floor()
        scene_factory.lamp(self.scene, "POINT", location=(0, 0, 2))
        self.check()

    def image_world(self, rotation=(0, 0, 0), occluder=True):
        self.setUp()
        background = scene_factory.set_world(self.scene, (1, 1, 1))
        nodes = scene_factory.Nodes(self.scene.world.node_tree)
        image = scene_factory.generated_image("sky", 64, 32, ring_pixel, float_buffer=True)
        coordinates = nodes.add("ShaderNodeTexCoord").outputs["Generated"]
        mapping = nodes.add("ShaderNodeMapping", None, {
            "Vector": coordinates, "Rotation": [math.radians(angle) for angle in rotation]})
        texture = nodes.add("ShaderNodeTexEnvironment", {"image": image}, {"Vector": mapping})
        nodes.set(background.inputs["Color"], texture)
        self.floor(occluder)

    def test_image(self):
        for rotation in ((0, 0, 70), (30, 0, 0)):
            with self.subTest(rotation):
                self.image_world(rotation)
                self.check(str(rotation), samples=256, block=16)

    def test_image_without_importance_map(self):
        """sampling_method NONE: the same mean by chance hits alone."""
        self.image_world(occluder=False)
        self.scene.world.cycles.sampling_method = "NONE"
        self.check(samples=2048, relative=0.01, resolution=(16, 16), block=16, max_noise=0.02)

    def test_direct_sight(self):
        self.image_world()
        scene_factory.camera(self.scene, (0, -3, 1.5), (0, 0, 1.6), lens=18.0)
        self.check(samples=256, resolution=(48, 32), relative=0.01)


class MeshLightTest(LightCase):

    def test_shapes(self):
        def panel(scene):
            scene_factory.plane(scene, 0.8, scene_factory.emission((1, 0.6, 0.2), 5.0),
                                location=(0.3, 0.2, 1.0))

        def ball(scene):
            scene_factory.sphere(scene, 0.3, scene_factory.emission((0.3, 0.8, 1), 20.0),
                                 location=(0.3, 0.2, 1.0))

        def small_box(scene):
            scene_factory.box(scene, 0.3, scene_factory.emission((1, 1, 1), 20.0),
                              location=(0, 0, 1.2), rotation=(20, 30, 40), scale=(1, 2, 0.5))

        def not_sampled(scene):
            material = scene_factory.emission((1, 1, 1), 5.0)
            material.cycles.sample_as_light = False
            scene_factory.plane(scene, 1.5, material, location=(0, 0, 0.8))

        def principled(scene):
            material = scene_factory.simple_material(
                "ShaderNodeBsdfPrincipled", Base_Color=(0, 0, 0), Specular=0.0,
                Emission=(0.2, 0.5, 1.0), Emission_Strength=6.0)
            scene_factory.sphere(scene, 0.3, material, location=(0.3, 0.2, 1.0))

        self.check_each({f.__name__: f for f in (panel, ball, small_box, not_sampled,
                                                 principled)}, samples=512,
                        max_noise=0.01)

    def test_texture(self):
        """The reference must not aim at the mesh: where Cycles 3.4 samples the area of a triangle
        it takes the texture from another corner's weights."""
        image = scene_factory.generated_image(
            "glow", 4, 4, lambda x, y: (x / 3, y / 3, 0.5, 1.0), packed=True)
        material = scene_factory.node_material("glow", lambda n: n.add(
            "ShaderNodeEmission", None, {
                "Color": n.add("ShaderNodeTexImage", {"image": image}).outputs["Color"],
                "Strength": 10.0}))
        self.floor()
        scene_factory.plane(self.scene, 1.6, material, location=(0, 0, 0.6))
        arguments = {"resolution": (16, 16), "max_bounces": 1}
        tested = render_seeds(TESTED_ENGINE, samples=512, **arguments)
        material.cycles.sample_as_light = False
        reference = render_seeds(REFERENCE_ENGINE, first_seed=1000, samples=2048, **arguments)
        self.assert_pictures_agree(tested, reference, block=4, max_noise=0.01)

    def test_instances(self):
        """Four objects share one emissive mesh."""
        self.floor()
        first = scene_factory.plane(self.scene, 0.4, scene_factory.emission((1, 1, 1), 8.0),
                                    location=(-1, -1, 1))
        for place in ((1, -1, 1), (-1, 1, 0.8), (1, 1, 0.5)):
            scene_factory.link(self.scene, first.data, location=place, rotation=(30, 0, 0))
        self.check(samples=512)


class LampNodesTest(LightCase):

    def nodes_of(self, obj):
        obj.data.use_nodes = True
        tree = obj.data.node_tree
        return scene_factory.Nodes(tree), tree.nodes["Emission"]

    def test_emission_strength_and_color(self):
        self.floor()
        obj = scene_factory.lamp(self.scene, "AREA", size=0.6, location=(0, 0, 1.5))
        nodes, emission = self.nodes_of(obj)
        emission.inputs["Strength"].default_value = 2.5
        emission.inputs["Color"].default_value = (0.2, 0.9, 0.5, 1.0)
        self.check()

    def test_texture_over_area_lamp(self):
        """Colour by the lamp's parametric UV."""
        self.floor()
        obj = scene_factory.lamp(self.scene, "AREA", size=1.5, location=(0, 0, 0.6))
        nodes, emission = self.nodes_of(obj)
        nodes.set(emission.inputs["Color"],
                  nodes.add("ShaderNodeNewGeometry").outputs["Parametric"])
        self.check(samples=512)


    OUTPUTS = {
        "ShaderNodeNewGeometry": ("Position", "Normal", "True Normal", "Incoming", "Parametric",
                                  "Backfacing", "Random Per Island"),
        "ShaderNodeTexCoord": ("Generated", "Normal", "UV", "Object", "Camera", "Window",
                               "Reflection"),
        "ShaderNodeObjectInfo": ("Location", "Color", "Object Index", "Random"),
        "ShaderNodeCameraData": ("View Z Depth",),
    }
    # Cycles leaves random numbers in the parametric coordinates of a sun.
    WITHOUT_MEANING = {("SUN", "Parametric")}

    def sharp_lamp(self, kind):
        sizes = {"AREA": {"shape": "RECTANGLE", "size": 0.06, "size_y": 0.09},
                 "SPOT": {"spot_size": 3.0, "shadow_soft_size": 0.0},
                 "SUN": {"angle": 0.0}}.get(kind, {"shadow_soft_size": 0.0})
        return scene_factory.lamp(self.scene, kind, location=(-0.4, 0.5, 2.0), energy=10.0,
                                  rotation=(20, -35, 50), scale=(1.5, 0.8, 1.2), **sizes)

    def shown_by(self, engine, kind, node_type, output):
        """What the output gives in a lamp's tree, read off the light that the lamp casts."""
        lit = []
        for is_plain in (True, False):
            self.setUp()
            scene_factory.plane(self.scene, 4.0, scene_factory.diffuse((1, 1, 1)))
            scene_factory.top_camera(self.scene, 0.01, (0.3, 0.2), 0.5)
            nodes, emission = self.nodes_of(self.sharp_lamp(kind))
            if not is_plain:
                # Colours must stay positive to arrive.
                nodes.set(emission.inputs["Color"], nodes.add(
                    "ShaderNodeVectorMath", {"operation": "MULTIPLY_ADD"},
                    {0: nodes.add(node_type).outputs[output], 1: (0.1,) * 3, 2: (10.0,) * 3}))
            lit.append(render(engine, 64, 0, (4, 4)).pixel(2, 2)[:3])
        return [(value / plain - 10.0) / 0.1 for plain, value in zip(*lit)]

    def test_inputs_of_the_tree(self):
        for kind in ("POINT", "SPOT", "AREA", "SUN"):
            for node_type, outputs in self.OUTPUTS.items():
                for output in outputs:
                    if (kind, output) in self.WITHOUT_MEANING:
                        continue
                    with self.subTest(f"{kind} {output}"):
                        tested, reference = (self.shown_by(engine, kind, node_type, output)
                                             for engine in (TESTED_ENGINE, REFERENCE_ENGINE))
                        for t, r in zip(tested, reference):
                            self.assertAlmostEqual(t, r, delta=0.01 * max(1.0, abs(r)))


class SightAndManyTest(LightCase):

    def test_lamps_seen_by_camera(self):
        """visible_camera on (new lamps have it off in this Blender)."""
        lamps = {
            "point": ("POINT", {"shadow_soft_size": 0.5}),
            "spot": ("SPOT", {"shadow_soft_size": 0.5, "spot_size": 2.0}),
            "square": ("AREA", {"size": 1.0}),
            "ellipse": ("AREA", {"shape": "ELLIPSE", "size": 1.2, "size_y": 0.5}),
            "spread": ("AREA", {"size": 1.0, "spread": 1.2}),
            "sun": ("SUN", {"energy": 2.0, "angle": 0.5}),
        }
        for name, (kind, settings) in lamps.items():
            for visible in (True, False):
                with self.subTest(f"{name} visible={visible}"):
                    self.setUp()
                    self.floor()
                    obj = scene_factory.lamp(self.scene, kind, location=(0.2, 0.1, 1.0),
                                             rotation=(-25, 0, 0), **settings)
                    obj.visible_camera = visible
                    scene_factory.camera(self.scene, (0, 3.0, -0.2), (0, 0, 1.0), lens=35.0)
                    if kind == "SUN":
                        scene_factory.camera(self.scene, (0, -1.0, 1.0), (0.0, -1.5, 2.0),
                                             lens=20.0)
                    self.check(f"{name} {visible}", relative=0.01, max_noise=0.02)

    def test_new_lamp_default(self):
        """A lamp as the operator makes it."""
        import bpy
        self.floor()
        bpy.ops.object.light_add(type="AREA", radius=1.0, location=(0, 0, 1))
        self.check()

    def test_lamp_seen_in_mirror(self):
        self.floor()
        scene_factory.plane(self.scene, 3.0, scene_factory.mirror(), location=(0, 1.5, 0.5),
                            rotation=(70, 0, 0))
        lamp_object = scene_factory.lamp(self.scene, "AREA", size=1.0, location=(0, -1, 2),
                                         rotation=(-50, 0, 0))
        for visible in (True, False):
            lamp_object.visible_glossy = visible
            self.check(f"glossy={visible}", relative=0.01, max_noise=0.02, samples=512)

    def test_many_lamps(self):
        self.floor(occluder=True)
        for i in range(12):
            angle = i * 2.0 * math.pi / 12
            kind = ("POINT", "AREA", "SPOT")[i % 3]
            scene_factory.lamp(self.scene, kind, energy=5.0 + 10.0 * i,
                               location=(1.6 * math.cos(angle), 1.6 * math.sin(angle), 0.7))
        scene_factory.set_world(self.scene, (0.05, 0.05, 0.08))
        self.check(samples=2048, max_noise=0.01, relative=0.005)
