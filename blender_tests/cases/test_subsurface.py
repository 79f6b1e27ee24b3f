# SPDX-License-Identifier: GPL-3.0-or-later
"""Subsurface scattering of the node and of Principled BSDF, against Cycles."""
import math

from support import scene_factory
from support.case import RenderTestCase

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

    def light(self, world, rotation=(0, 50, 20)):
        scene_factory.set_world(self.scene, world)
        scene_factory.lamp(self.scene, "SUN", energy=2.0, angle=math.radians(5), rotation=rotation)

    def compare(self, name, samples=192, seeds=3, block=8, relative=0.005, **arguments):
        self.assert_agrees(name, samples=samples, resolution=(24, 24), block=block, seeds=seeds,
                           relative=relative, absolute=1e-3, max_noise=0.02, **arguments)


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

    def test_ior(self):
        self.ball("ior 1.01", lambda: node(IOR=1.0))
        self.ball("ior 2.5", lambda: node(IOR=2.5))

    def test_dark_color(self):
        self.ball("dark", lambda: node(Color=(0.2, 0.05, 0.0)))

    def test_inside_of_a_diffuse_room(self):
        """Behind a diffuse bounce subsurface is plain diffuse."""
        scene_factory.box(self.scene, 4.0, scene_factory.diffuse((0.6, 0.6, 0.6)), inward=True)
        scene_factory.sphere(self.scene, 0.8, node())
        scene_factory.lamp(self.scene, "POINT", energy=60.0, location=(1, -1, 1.5),
                           shadow_soft_size=0.3)
        scene_factory.camera(self.scene, (0, -1.9, 0.6), (0, 0, 0), lens=25.0)
        self.compare("room")

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


class PrincipledTest(SubsurfaceCase):

    def test_methods(self):
        for method in METHODS:
            self.ball(f"principled {method}", lambda: principled(method))

    def test_roughness(self):
        """Retro-reflection stays at the entry; Fresnel dims the exit."""
        for roughness in (0.0, 1.0):
            self.ball(f"roughness {roughness}", lambda: principled(Roughness=roughness))

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
