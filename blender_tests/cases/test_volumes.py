# SPDX-License-Identifier: GPL-3.0-or-later
"""Participating media against Cycles: nodes, lamps in fog, glass, cameras inside, many objects."""
import math

from support import scene_factory
from support.case import RenderTestCase
from support.volume_case import VolumeCase, volume


class NodeTest(VolumeCase):

    def test_absorption(self):
        self.in_box("absorption", volume("ShaderNodeVolumeAbsorption", Color=(0.9, 0.5, 0.2),
                                         Density=1.5))

    def test_scatter(self):
        for g in (0.0, 0.7, -0.5):
            make = volume("ShaderNodeVolumeScatter", Color=(0.9, 0.5, 0.2), Density=1.0,
                          Anisotropy=g)
            self.in_box(f"scatter {g}", make)
        self.in_box("scatter often", make, volume_bounces=8)

    def test_principled(self):
        make = volume("ShaderNodeVolumePrincipled", Color=(0.8, 0.5, 0.3), Density=2.0,
                      Anisotropy=0.3, Absorption_Color=(0.1, 0.4, 0.6))
        self.in_box("principled", make, volume_bounces=4)
        make = volume("ShaderNodeVolumePrincipled", Color=(0.2, 0.2, 0.2), Density=0.5,
                      Emission_Strength=0.4, Emission_Color=(1.0, 0.5, 0.2),
                      Blackbody_Intensity=0.8, Temperature=1800.0, Blackbody_Tint=(0.9, 1.0, 0.8))
        self.in_box("principled glow", make)

    def test_emission(self):
        self.in_box("emission", volume("ShaderNodeEmission", Color=(0.3, 0.6, 0.9), Strength=0.5))

    def test_mix_and_add(self):
        """With one node that scatters: of several in one material, Cycles 3.4 adds up the phase
        functions without their weights in direct light."""
        def build(nodes):
            absorption = nodes.add("ShaderNodeVolumeAbsorption", None, {"Density": 2.0})
            scatter = nodes.add("ShaderNodeVolumeScatter", None, {"Density": 3.0})
            glow = nodes.add("ShaderNodeVolumePrincipled", None,
                             {"Color": (0, 0, 0), "Density": 1.0, "Emission Strength": 0.5})
            mixed = nodes.add("ShaderNodeMixShader", None, {0: 0.3, 1: absorption, 2: scatter})
            half = nodes.add("ShaderNodeMixShader", None, {0: 0.5, 1: mixed, 2: glow})
            return nodes.add("ShaderNodeAddShader", None, {0: half, 1: scatter})
        self.in_box("mix", lambda: scene_factory.volume_material("m", build))


class LampTest(VolumeCase):

    def test_lamps_in_fog(self):
        make = volume("ShaderNodeVolumeScatter", Color=(0.8, 0.8, 0.8), Density=0.15,
                      Anisotropy=0.3)
        for lamp in ("POINT", "SPOT", "AREA"):
            with self.subTest(lamp):
                self.setUp()
                self.room(lamp)
                scene_factory.box(self.scene, 30.0, make())
                self.agrees(f"{lamp} in fog", samples=512, volume_bounces=lamp != "SPOT",
                            max_noise=0.02)

    def test_mesh_light_and_world(self):
        make = volume("ShaderNodeVolumeScatter", Density=0.7)
        with self.subTest("mesh light"):
            self.setUp()
            self.room(energy=0.0)
            scene_factory.sphere(self.scene, 0.3, scene_factory.emission((1, 0.7, 0.4), 20.0),
                                 location=(0, 0, 1.6))
            scene_factory.box(self.scene, 2.0, make())
            self.agrees("mesh light")
        with self.subTest("world"):
            self.setUp()
            self.room(energy=0.0)
            scene_factory.set_world(self.scene, (0.4, 0.6, 0.9))
            scene_factory.box(self.scene, 2.0, make())
            self.agrees("world", volume_bounces=3)


class PlaceTest(VolumeCase):

    def fog(self, density=0.3):
        return volume("ShaderNodeVolumeScatter", Color=(0.9, 0.7, 0.5), Density=density)()

    def test_inside_glass(self):
        def glass(nodes):
            return nodes.add("ShaderNodeBsdfGlass", {"distribution": "SHARP"}, {"IOR": 1.33})

        def build(nodes):
            return nodes.add("ShaderNodeVolumePrincipled", None,
                             {"Color": (0.3, 0.2, 0.1, 1), "Density": 2.0})
        self.room(angle=1.0)
        scene_factory.set_world(self.scene, (0.4, 0.5, 0.6))
        scene_factory.sphere(self.scene, 1.0, scene_factory.volume_material("m", build, glass),
                             48, 24)
        self.agrees("in glass", samples=512, volume_bounces=4)

    def test_camera_inside(self):
        self.room("AREA")
        scene_factory.box(self.scene, 25.0, self.fog(0.05))
        scene_factory.sphere(self.scene, 1.0, self.fog(1.0))
        self.agrees("camera inside", samples=512, volume_bounces=2)

    def test_overlapping(self):
        self.room()
        scene_factory.sphere(self.scene, 1.0, self.fog(0.6), location=(-0.4, 0, 0))
        scene_factory.box(self.scene, 1.5, volume("ShaderNodeVolumeAbsorption", Density=1.5)(),
                          location=(0.4, 0, 0))
        scene_factory.sphere(self.scene, 0.5, self.fog(2.0), location=(0, 0, 0.3))
        self.agrees("overlapping", volume_bounces=2)

    def test_many(self):
        self.room()
        material = self.fog(2.0)
        mesh = scene_factory.sphere(self.scene, 0.18, material, 12, 6, location=(0, 0, 3)).data
        for i in range(60):
            angle = 2.4 * i
            radius = 0.2 * math.sqrt(i)
            scene_factory.link(self.scene, mesh, f"s{i}", location=(
                radius * math.cos(angle), radius * math.sin(angle), 0.8 * math.sin(0.7 * i)))
        self.agrees("many", samples=384, volume_bounces=2)

    def test_world_volume(self):
        self.room("POINT")
        tree = self.scene.world.node_tree
        nodes = scene_factory.Nodes(tree)
        output = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeOutputWorld")
        scatter = nodes.add("ShaderNodeVolumeScatter", None, {"Density": 0.08, "Anisotropy": 0.4})
        tree.links.new(scatter.outputs[0], output.inputs["Volume"])
        self.agrees("world volume", samples=512, volume_bounces=1)

    def test_scale_does_not_thin(self):
        self.room()
        scene_factory.box(self.scene, 1.0, self.fog(1.0), scale=(2.0, 1.0, 1.5))
        self.agrees("scaled")

    def test_behind_alpha_in_shadow(self):
        """A transparent pane and the volume behind it dim the same light."""
        self.room(energy=6.0, rotation=(0, 0, 0))
        scene_factory.plane(self.scene, 3.0, scene_factory.simple_material(
            "ShaderNodeBsdfTransparent", Color=(0.8, 0.6, 0.4)), location=(0, 0, 1.8))
        scene_factory.box(self.scene, 2.0, self.fog(0.8))
        self.agrees("pane")

    def test_transparent_film(self):
        scene_factory.camera(self.scene, (0, -6, 1.5), (0, 0, 0), lens=50.0)
        scene_factory.lamp(self.scene, "SUN", energy=3.0, rotation=(35, 20, 0))
        scene_factory.box(self.scene, 2.0, self.fog(0.8))
        self.scene.render.film_transparent = True
        self.agrees("film")


class VisibilityTest(VolumeCase):

    def test_what_fog_sees(self):
        """A glowing ball beside fog, hidden from one kind of ray after the other. From scattering it
        is hidden in Tenniel alone: in Cycles 3.4 what the phase function meets still counts."""
        make = volume("ShaderNodeVolumeScatter", Density=1.2)
        for kind in ("visible_shadow", "visible_camera"):
            with self.subTest(kind):
                self.setUp()
                self.room(energy=0.5)
                ball = scene_factory.sphere(self.scene, 0.3, scene_factory.emission(strength=20.0),
                                            location=(0, 0, 1.6))
                setattr(ball, kind, False)
                scene_factory.box(self.scene, 2.0, make())
                self.agrees(kind, volume_bounces=2, samples=384)

    def test_lamp_and_world(self):
        make = volume("ShaderNodeVolumeScatter", Density=1.2)
        with self.subTest("lamp"):
            self.setUp()
            self.room("AREA")
            scene_factory.set_world(self.scene, (0.2, 0.3, 0.4))
            lamp, = (obj for obj in self.scene.objects if obj.type == 'LIGHT')
            lamp.visible_volume_scatter = False
            scene_factory.box(self.scene, 2.0, make())
            self.agrees("lamp", volume_bounces=2)
        with self.subTest("world"):
            self.setUp()
            self.room()
            scene_factory.set_world(self.scene, (0.4, 0.6, 0.8))
            self.scene.world.cycles_visibility.scatter = False
            scene_factory.box(self.scene, 2.0, make())
            self.agrees("world", volume_bounces=2)


class VaryingTest(VolumeCase):

    def textured(self, node, socket, texture, scale=1.0, **inputs):
        """Maker: `socket` of the volume node is a texture at object coordinates."""
        named = {key.replace("_", " "): value for key, value in inputs.items()}

        def build(nodes):
            coordinate = nodes.add("ShaderNodeTexCoord").outputs["Object"]
            value = nodes.add(texture, None, {"Vector": coordinate})
            if "Scale" in value.inputs:
                value.inputs["Scale"].default_value = scale
            strength = nodes.add("ShaderNodeMath", {"operation": "MULTIPLY"},
                                 {0: value.outputs["Fac"], 1: 3.0})
            return nodes.add(node, None, {**named, socket: strength})
        return lambda: scene_factory.volume_material("m", build)

    def test_density(self):
        make = self.textured("ShaderNodeVolumeAbsorption", "Density", "ShaderNodeTexNoise", 2.0,
                             Color=(0.2, 0.5, 0.9))
        self.in_box("absorbing noise", make)
        make = self.textured("ShaderNodeVolumeScatter", "Density", "ShaderNodeTexGradient")
        self.in_box("scattering gradient", make, volume_bounces=2)
        make = self.textured("ShaderNodeVolumePrincipled", "Density", "ShaderNodeTexNoise", 3.0,
                             Anisotropy=0.5)
        self.in_box("principled noise", make, "POINT", samples=512)

    def test_emission(self):
        make = self.textured("ShaderNodeVolumePrincipled", "Emission Strength",
                             "ShaderNodeTexChecker", Density=0.5)
        self.in_box("checkered glow", make)


    def test_step_rate(self):
        """Long steps blur what they miss; both engines' short ones see the same."""
        make_noise = self.textured("ShaderNodeVolumeAbsorption", "Density", "ShaderNodeTexNoise", 9.0,
                                   Color=(0.2, 0.5, 0.9))

        def make():
            material = make_noise()
            material.cycles.volume_step_rate = 0.5
            return material
        self.in_box("material", make, volume_step_rate=0.4)

    def test_world(self):
        self.setUp()
        self.room()
        tree = self.scene.world.node_tree
        nodes = scene_factory.Nodes(tree)
        output = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeOutputWorld")
        position = nodes.add("ShaderNodeNewGeometry").outputs["Position"]
        waves = nodes.add("ShaderNodeTexWave", None, {"Vector": position, "Scale": 0.3})
        density = nodes.add("ShaderNodeMath", {"operation": "MULTIPLY"},
                            {0: waves.outputs["Fac"], 1: 0.1})
        fog = nodes.add("ShaderNodeVolumeAbsorption", None, {"Density": density})
        tree.links.new(fog.outputs[0], output.inputs["Volume"])
        self.scene.world.cycles.volume_step_size = 0.25
        self.agrees("uneven World")


class GridTest(VolumeCase):

    def simulated(self, name, build, **arguments):
        with self.subTest(name):
            self.setUp()
            self.room()
            self.smoke(build)
            self.agrees(name, **arguments)

    def test_principled_smoke(self):
        self.simulated("density", lambda nodes: nodes.add("ShaderNodeVolumePrincipled", None, {
            "Density": 3.0, "Color Attribute": "color"}))
        self.simulated("fire", lambda nodes: nodes.add("ShaderNodeVolumePrincipled", None, {
            "Density": 1.0, "Blackbody Intensity": 1.0, "Temperature": 600.0}))

    def test_cubic_interpolation(self):
        self.setUp()
        self.room()
        self.smoke(lambda nodes: nodes.add("ShaderNodeVolumePrincipled", None, {"Density": 4.0}))
        domain = next(obj for obj in self.scene.objects if obj.modifiers and obj.data.materials)
        domain.data.materials[0].cycles.volume_interpolation = 'CUBIC'
        self.agrees("cubic smoke")

    def test_volume_info_and_attribute(self):
        def build(nodes):
            info = nodes.add("ShaderNodeVolumeInfo")
            heat = nodes.add("ShaderNodeAttribute", {"attribute_name": "heat"})
            smoke = nodes.add("ShaderNodeVolumeAbsorption", None, {
                "Color": info.outputs["Color"], "Density": info.outputs["Density"]})
            fire = nodes.add("ShaderNodeEmission", None, {
                "Color": (1.0, 0.5, 0.2), "Strength": info.outputs["Flame"]})
            warm = nodes.add("ShaderNodeEmission", None, {
                "Color": (0.1, 0.2, 0.9), "Strength": heat.outputs["Fac"]})
            both = nodes.add("ShaderNodeAddShader", None, {0: smoke, 1: fire})
            return nodes.add("ShaderNodeAddShader", None, {0: both, 1: warm})
        self.simulated("info", build)

    def points(self, space, interpolation):
        """Maker: how dense the corners of a box are."""
        source = scene_factory.box(self.scene, 1.0, location=(0.1, 0, 0), rotation=(0, 0, 10))
        source.hide_render = True

        def build(nodes):
            points = nodes.add("ShaderNodeTexPointDensity", {
                "point_source": "OBJECT", "object": source, "resolution": 12, "radius": 0.6,
                "space": space, "interpolation": interpolation})
            return nodes.add("ShaderNodeVolumeAbsorption", None, {
                "Color": (0.2, 0.5, 0.8), "Density": points.outputs["Density"]})
        return scene_factory.volume_material("points", build)

    def test_point_density(self):
        for space, interpolation in (("OBJECT", "Linear"), ("WORLD", "Linear"), ("WORLD", "Cubic"),
                                     ("WORLD", "Closest")):
            with self.subTest(f"{space} {interpolation}"):
                self.setUp()
                self.room()
                scene_factory.box(self.scene, 2.0, self.points(space, interpolation),
                                  rotation=(0, 0, 25))
                self.agrees(f"points {space} {interpolation}")


class AbsorptionOracleTest(RenderTestCase):

    def test_slab(self):
        """Straight through two metres: exp(-sigma d) in every pixel."""
        scene_factory.box(self.scene, 2.0, volume("ShaderNodeVolumeAbsorption", Density=0.7,
                                                  Color=(0.2, 0.5, 0.9))())
        scene_factory.set_world(self.scene, (1, 1, 1))
        scene_factory.top_camera(self.scene, 0.5)
        self.assert_agrees("slab", samples=4, resolution=(8, 8), relative=1e-5, seeds=2)
