# SPDX-License-Identifier: GPL-3.0-or-later
"""Ambient Occlusion and Bevel, against Cycles."""
from support import scene_factory
from support.case import RenderTestCase
from support.tile_grid import emission_of


class TracingTest(RenderTestCase):

    def corner(self, material):
        """Two boxes on a ground, one smooth ball: what is near and what is far."""
        scene_factory.plane(self.scene, 8.0, material)
        scene_factory.box(self.scene, 1.0, material, location=(0.2, 0.1, 0.5), rotation=(0, 0, 30))
        scene_factory.box(self.scene, 0.6, material, location=(-0.8, -0.3, 0.3))
        scene_factory.sphere(self.scene, 0.4, material, location=(0.9, -0.7, 0.4))
        scene_factory.camera(self.scene, (0, -4, 3), (0, 0, 0.3), lens=50.0)

    def check(self, name, material, relative=0.003, **arguments):
        with self.subTest(name):
            self.corner(material)
            self.assert_agrees(name, samples=64, resolution=(32, 32), block=8, seeds=3,
                               relative=relative, absolute=2e-3, max_noise=0.01, max_bounces=0,
                               **arguments)
            self.setUp()

    def test_ambient_occlusion(self):
        for settings in ({}, {"inside": True}, {"only_local": True},
                         {"inside": True, "only_local": True}, {"samples": 1}):
            for distance in (0.4, 5.0):
                self.check(f"{settings} {distance}", emission_of("ao", lambda n: n.add(
                    "ShaderNodeAmbientOcclusion", settings,
                    {"Color": (0.9, 0.5, 0.2), "Distance": distance})))
        self.check("factor", emission_of("ao", lambda n: n.add(
            "ShaderNodeAmbientOcclusion").outputs["AO"]))

    def test_distance_of_the_world(self):
        for distance in (0.3, 2.0):
            self.scene.world.light_settings.distance = distance
            self.check(f"world {distance}", emission_of("ao", lambda n: n.add(
                "ShaderNodeAmbientOcclusion", None, {"Distance": 0.0}).outputs["AO"]))

    def test_ambient_occlusion_of_a_given_normal(self):
        self.check("normal", emission_of("ao", lambda n: n.add(
            "ShaderNodeAmbientOcclusion", None,
            {"Normal": n.add("ShaderNodeCombineXYZ", None, {0: 0.6, 1: 0.0, 2: 0.8})})))

    def test_bevel(self):
        """The normal itself, positive by halves. The mean of unit vectors depends on how many
        samples each holds, so that both engines take the same."""
        def shown(nodes, node):
            return nodes.add("ShaderNodeVectorMath", {"operation": "MULTIPLY_ADD"}, {
                0: node, 1: (0.5, 0.5, 0.5), 2: (0.5, 0.5, 0.5)})
        for samples, radius in ((4, 0.1), (16, 0.1), (8, 0.3), (4, 0.0)):
            self.check(f"bevel {samples} {radius}", emission_of("bevel", lambda n: shown(n, n.add(
                "ShaderNodeBevel", {"samples": samples}, {"Radius": radius}))), relative=0.005)
        self.check("bevel of a normal", emission_of("bevel", lambda n: shown(n, n.add(
            "ShaderNodeBevel", None, {
                "Radius": 0.1,
                "Normal": n.add("ShaderNodeCombineXYZ", None, {0: 0.6, 1: 0.0, 2: 0.8})}))),
            relative=0.005)
