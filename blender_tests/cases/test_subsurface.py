# SPDX-License-Identifier: GPL-3.0-or-later
"""Subsurface scattering of the node and of Principled BSDF, against Cycles."""
import math

from support import scene_factory
from support.case import RenderTestCase
from support.render import render_pair

BURLEY, FIXED, WALK = METHODS = "BURLEY", "RANDOM_WALK_FIXED_RADIUS", "RANDOM_WALK"
NODE = "ShaderNodeSubsurfaceScattering"
SKIN = (0.8, 0.5, 0.3)


def node(method=WALK, **inputs):
    """Light of the default radius goes far in red and stays near in blue."""
    named = {"Color": SKIN, "Scale": 0.3, **inputs}
    return scene_factory.simple_material(NODE, None, {"falloff": method}, **named)


def principled(method=WALK, **inputs):
    named = {"Base_Color": (0.6, 0.6, 0.6), "Subsurface": 0.4, "Subsurface_Color": SKIN,
             "Specular": 0.0, **inputs}
    return scene_factory.simple_material("ShaderNodeBsdfPrincipled", None,
                                         {"subsurface_method": method}, **named)


class SubsurfaceCase(RenderTestCase):

    def ball(self, name, material, radius=1.0, world=(0.4, 0.4, 0.4), **arguments):
        """A ball lit by a lamp from the side and by the world."""
        with self.subTest(f"{name}, ball"):
            self.setUp()
            scene_factory.sphere(self.scene, radius, material(), 48, 24)
            self.light(world)
            scene_factory.camera(self.scene, (0, -5, 1.5), (0, 0, 0), lens=85.0)
            self.compare(name, **arguments)

    def edge(self, name, material, **arguments):
        """Slab on which a lamp's shadow has an edge: light seeps into the dark."""
        with self.subTest(f"{name}, slab"):
            self.setUp()
            scene_factory.box(self.scene, 2.0, material(), scale=(1, 1, 0.2))
            scene_factory.plane(self.scene, 2.0, scene_factory.diffuse((0, 0, 0)),
                                location=(1.1, 0, 0.6))
            self.light((0, 0, 0), rotation=(0, 0, 0))
            scene_factory.camera(self.scene, (0, -3, 5), (0, 0, 0.2), lens=85.0)
            self.compare(name, **arguments)

    def room(self, name, material):
        """Behind a diffuse bounce subsurface is plain diffuse."""
        scene_factory.box(self.scene, 4.0, scene_factory.diffuse((0.6, 0.6, 0.6)), inward=True)
        scene_factory.sphere(self.scene, 0.8, material)
        scene_factory.lamp(self.scene, "POINT", energy=60.0, location=(1, -1, 1.5),
                           shadow_soft_size=0.3)
        scene_factory.camera(self.scene, (0, -1.9, 0.6), (0, 0, 0), lens=25.0)
        self.compare(f"{name} in a room")

    def light(self, world, rotation=(0, 50, 20)):
        scene_factory.set_world(self.scene, world)
        scene_factory.lamp(self.scene, "SUN", energy=2.0, angle=math.radians(5), rotation=rotation)

    def compare(self, name, samples=192, block=8, relative=0.005, **arguments):
        """By blocks, and more sharply by the mean of the whole picture."""
        tested, reference = render_pair(3, samples=samples, resolution=(24, 24), **arguments)
        for size, max_noise in ((block, 0.02), (24, 0.006)):
            self.assert_pictures_agree(tested, reference, f"{name} in blocks of {size}", size,
                                       relative, 1e-3, max_noise)


class NodeTest(SubsurfaceCase):

    def test_methods(self):
        for method in METHODS:
            self.ball(f"node {method}", lambda: node(method))
            self.edge(f"node {method}", lambda: node(method))

    def test_anisotropy(self):
        for anisotropy in (0.5, 0.9):
            self.ball(f"anisotropy {anisotropy}", lambda: node(Anisotropy=anisotropy))

    def test_radius(self):
        for radius in ((0.02, 0.02, 0.02), (1.0, 0.0, 0.1), (5.0, 5.0, 5.0)):
            for method in METHODS:
                self.ball(f"radius {radius} {method}",
                          lambda: node(method, Radius=radius, Scale=1.0))

    def test_flat(self):
        """A half-space in a uniform world: the albedo, and where it is not the colour."""
        for method, color, anisotropy in ((BURLEY, 0.8, 0.0), (WALK, 0.8, 0.0), (WALK, 1.0, 0.0),
                                          (FIXED, 1.0, 0.0), (WALK, 0.8, 0.8)):
            with self.subTest(f"{method} {color} {anisotropy}"):
                self.setUp()
                make = node(method, Color=(color, color, color), Anisotropy=anisotropy)
                scene_factory.plane(self.scene, 100.0, make, location=(20, 7, 0))
                scene_factory.set_world(self.scene, (0.7, 0.7, 0.7))
                scene_factory.camera(self.scene, (1, 0, 4), (0, 0, 0), type="ORTHO",
                                     ortho_scale=0.01)
                self.compare(f"flat {method}", block=24)

    def test_slab_in_uniform_light(self):
        for method in METHODS:
            with self.subTest(method):
                self.setUp()
                scene_factory.box(self.scene, 2.0, node(method), scale=(1, 1, 0.1))
                scene_factory.set_world(self.scene, (0.5, 0.5, 0.5))
                scene_factory.camera(self.scene, (0, -3, 2), (0, -0.7, 0), lens=85.0)
                self.compare(f"slab {method}", block=12)

    def test_ior(self):
        self.ball("ior 1.01", lambda: node(IOR=1.0))
        self.ball("ior 2.5", lambda: node(IOR=2.5))

    def test_dark_color(self):
        self.ball("dark", lambda: node(Color=(0.2, 0.05, 0.0)))

    def test_inside_of_a_diffuse_room(self):
        self.room("node", node())

    def test_mixed_with_glossy(self):
        def mixed():
            def build(n):
                below = n.add(NODE, {"falloff": WALK}, {"Color": SKIN, "Scale": 0.3})
                glossy = n.add("ShaderNodeBsdfGlossy", None, {"Roughness": 0.4})
                return n.add("ShaderNodeMixShader", None, {0: 0.3, 1: below, 2: glossy})
            return scene_factory.node_material("mixed", build)
        self.ball("mixed", mixed)

    def test_bump(self):
        """The normal of the shader where light leaves is the one that counts."""
        def bumpy():
            def build(n):
                noise = n.add("ShaderNodeTexNoise", None, {"Scale": 4.0})
                bump = n.add("ShaderNodeBump", None, {"Height": noise, "Distance": 0.3})
                return n.add(NODE, {"falloff": WALK}, {"Color": SKIN, "Scale": 0.3,
                                                       "Normal": bump})
            return scene_factory.node_material("bumpy", build)
        self.ball("bump", bumpy)

    def test_displacement_as_bump(self):
        def wavy():
            material = node()
            n = scene_factory.Nodes(material.node_tree)
            noise = n.add("ShaderNodeTexNoise", None, {"Scale": 3.0})
            displacement = n.add("ShaderNodeDisplacement", None, {"Height": noise, "Scale": 0.3})
            output = next(x for x in n.tree.nodes if x.type == "OUTPUT_MATERIAL")
            n.set(output.inputs["Displacement"], displacement)
            return material
        self.ball("displacement", wavy)

    def test_two_materials(self):
        """Light leaves through another material, whatever that is."""
        ball = scene_factory.sphere(self.scene, 1.0, node(), 48, 24)
        ball.data.materials.append(scene_factory.diffuse((0.1, 0.1, 0.9)))
        for polygon in ball.data.polygons:
            polygon.material_index = int(polygon.center.x > 0.0)
        self.light((0.4, 0.4, 0.4))
        scene_factory.camera(self.scene, (0, -5, 1.5), (0, 0, 0), lens=85.0)
        self.compare("two materials")

    def test_in_motion(self):
        ball = scene_factory.sphere(self.scene, 0.7, node(), 48, 24)
        for frame, x in ((0, -0.8), (2, 0.8)):
            ball.location.x = x
            ball.keyframe_insert("location", frame=frame)
        for curve in ball.animation_data.action.fcurves:
            for point in curve.keyframe_points:
                point.interpolation = "LINEAR"
        self.scene.frame_set(1)
        self.scene.render.use_motion_blur = True
        self.scene.render.motion_blur_shutter = 1.0
        self.light((0.4, 0.4, 0.4))
        scene_factory.camera(self.scene, (0, -5, 1.5), (0, 0, 0), lens=85.0)
        self.compare("motion")

    def test_in_fog(self):
        fog = scene_factory.volume_material(
            "fog", lambda n: n.add("ShaderNodeVolumeScatter", None, {"Density": 0.3}))
        scene_factory.box(self.scene, 4.0, fog)
        scene_factory.sphere(self.scene, 1.0, node(), 48, 24)
        self.light((0.4, 0.4, 0.4))
        scene_factory.camera(self.scene, (0, -5, 1.5), (0, 0, 0), lens=85.0)
        self.compare("fog", samples=256, volume_bounces=8)


class PrincipledTest(SubsurfaceCase):

    def test_methods(self):
        for method in METHODS:
            self.ball(f"principled {method}", lambda: principled(method))

    def test_roughness(self):
        """Retro-reflection stays at the entry; Fresnel dims the exit."""
        for roughness in (0.0, 1.0):
            self.ball(f"roughness {roughness}", lambda: principled(Roughness=roughness))

    def test_inside_of_a_diffuse_room(self):
        self.room("principled", principled(Base_Color=(0.1, 0.3, 0.8), Sheen=1.0, Sheen_Tint=1.0))

    def test_other_inputs(self):
        self.ball("inputs", lambda: principled(Subsurface_Anisotropy=0.6, Subsurface_IOR=1.8,
                                               Subsurface_Radius=(0.3, 0.3, 0.0), Metallic=0.3,
                                               Specular=0.5, Sheen=0.5))


class InstancesTest(SubsurfaceCase):

    def test_instances(self):
        """Balls of one mesh, one stretched, that overlap: each is below its own surface alone."""
        first = scene_factory.sphere(self.scene, 0.7, node(), location=(-0.7, 0, 0))
        scene_factory.link(self.scene, first.data, "second", location=(0.4, 0, 0))
        scene_factory.link(self.scene, first.data, "third", location=(0, 0, 0.9),
                           scale=(1.3, 0.8, 0.5), rotation=(20, 30, 40))
        self.light((0.4, 0.4, 0.4))
        scene_factory.camera(self.scene, (0, -5, 1.5), (0, 0, 0.2), lens=60.0)
        for method in METHODS:
            with self.subTest(method):
                first.data.materials[0] = node(method)
                self.compare(f"instances {method}")
