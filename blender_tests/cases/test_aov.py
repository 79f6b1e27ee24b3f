# SPDX-License-Identifier: GPL-3.0-or-later
"""Passes of the artist's own, against Cycles."""
import bpy

from support import parity_log, scene_factory
from support.case import RenderTestCase
from support.render import REFERENCE_ENGINE, TESTED_ENGINE, render

CHANNELS = ("color.R", "color.G", "color.B", "color.A", "value.X")


def diffuse(nodes):
    return nodes.add("ShaderNodeBsdfDiffuse")


def partly(alpha):
    return lambda nodes: nodes.add("ShaderNodeMixShader", None, {
        0: alpha, 1: nodes.add("ShaderNodeBsdfTransparent"), 2: diffuse(nodes)})


class AovTest(RenderTestCase):

    def setUp(self):
        super().setUp()
        for name, kind in (("color", "COLOR"), ("value", "VALUE")):
            aov = bpy.context.view_layer.aovs.add()
            aov.name, aov.type = name, kind
        scene_factory.top_camera(self.scene, 2.0)

    def square(self, shader, *outputs, size=2.0, **placement):
        """A square whose AOV Outputs are (name, inputs)."""
        material = scene_factory.node_material("m", shader)
        self.add_outputs(material.node_tree, *outputs)
        scene_factory.plane(self.scene, size, material, **placement)
        return material

    @staticmethod
    def add_outputs(tree, *outputs):
        for name, inputs in outputs:
            node = tree.nodes.new("ShaderNodeOutputAOV")
            node.name = name
            for socket, value in inputs.items():
                scene_factory.Nodes(tree).set(node.inputs[socket], value)

    def assert_same(self, title, tolerance=1e-4, samples=16):
        def means(engine):
            picture = render(engine, samples=samples, resolution=(8, 8), multilayer=True)
            return [[sum(values) / 64 for layer, values in picture.layers.items()
                     if layer.endswith(channel)] for channel in CHANNELS]
        for channel, tested, reference in zip(CHANNELS, means(TESTED_ENGINE),
                                              means(REFERENCE_ENGINE)):
            self.assertEqual(len(tested), 1, f"{title}: {channel}")
            difference = abs(tested[0] - reference[0]) / max(1.0, abs(reference[0]))
            parity_log.picture(difference, 0.0, difference <= tolerance)
            self.assertAlmostEqual(tested[0], reference[0], msg=f"{title}: {channel}",
                                   delta=tolerance * max(1.0, abs(reference[0])))

    def test_sockets(self):
        self.square(diffuse, ("color", {"Color": (0.1, 2.5, 0.3, 0.4), "Value": 3.0}),
                    ("value", {"Color": (5, 6, 7, 1), "Value": -0.7}))
        self.assert_same("each its own")

    def test_patterns(self):
        def checker(nodes):
            nodes.tree.nodes.new("ShaderNodeOutputAOV").name = "color"
            output = next(n for n in nodes.tree.nodes if n.type == "OUTPUT_AOV")
            vector = nodes.add("ShaderNodeTexCoord").outputs["Object"]
            nodes.set(output.inputs["Color"], nodes.add(
                "ShaderNodeTexChecker", None, {"Vector": vector, "Scale": 2.0}).outputs["Color"])
            return diffuse(nodes)
        self.square(checker, ("value", {"Value": 1.0}), size=1.0)
        self.assert_same("checker", tolerance=2e-3, samples=256)

    def test_transparent_surfaces_add_up(self):
        """Up to the first that is opaque enough for the other data passes, by the same threshold."""
        for alpha, threshold in ((0, 0.5), (0.5, 0.5), (0.75, 0.5), (0.75, 0.9), (0, 0)):
            self.setUp()
            bpy.context.view_layer.pass_alpha_threshold = threshold
            self.square(partly(alpha), ("value", {"Value": 1.0}), location=(0, 0, 1))
            self.square(diffuse, ("value", {"Value": 10.0}))
            self.assert_same(f"alpha {alpha}, {threshold}", tolerance=0.02, samples=256)

    def test_not_in_mirrors_nor_the_world(self):
        self.square(lambda n: n.add("ShaderNodeBsdfGlossy", {"distribution": "SHARP"}), size=1.0)
        self.square(diffuse, ("value", {"Value": 1.0}), location=(0, 0, 20))
        self.scene.world.use_nodes = True
        self.add_outputs(self.scene.world.node_tree, ("value", {"Value": 5.0}))
        self.assert_same("mirror")

    def test_groups_and_names(self):
        material = self.square(diffuse, ("value", {"Value": 2.0}), ("value", {"Value": 3.0}),
                               ("unknown", {"Value": 7.0}))
        inner = bpy.data.node_groups.new("inner", "ShaderNodeTree")
        self.add_outputs(inner, ("color", {"Color": (0.2, 0.4, 0.6, 1.0)}))
        material.node_tree.nodes.new("ShaderNodeGroup").node_tree = inner
        self.assert_same("groups")

    def test_muted(self):
        material = self.square(diffuse, ("value", {"Value": 2.0}))
        next(n for n in material.node_tree.nodes if n.type == "OUTPUT_AOV").mute = True
        self.assert_same("muted")

    def test_without_scattering(self):
        for shader in ("ShaderNodeEmission", "ShaderNodeHoldout"):
            self.setUp()
            self.square(lambda n, s=shader: n.add(s), ("value", {"Value": 2.0}))
            self.assert_same(shader)
