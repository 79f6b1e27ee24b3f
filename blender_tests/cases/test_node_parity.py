# SPDX-License-Identifier: GPL-3.0-or-later
"""Each node alone as emission, compared with the reference engine to 1e-4 (see tile_grid)."""
import itertools

import bpy

from support import scene_factory
from support.node_variants import COLORS, NODE_TABLE, VECTORS, fresnel_variants
from support.pattern_variants import PATTERN_TABLE
from support.parity import TILTED, ParityCase
from support.render import REFERENCE_ENGINE
from support.tile_grid import TileGrid, emission_of



class NodeParityTest(ParityCase):
    """Nodes that need nothing but their inputs; the methods come from NODE_TABLE
    and PATTERN_TABLE."""


def _table_test(make_variants):
    def test(self):
        grid = TileGrid(self.scene)
        for variant in make_variants():
            variant.add_to(grid)
        self.check_grid(grid)
    return test


for _name, _make in (NODE_TABLE | PATTERN_TABLE).items():
    setattr(NodeParityTest, f"test_{_name}", _table_test(_make))


class ReadoutTest(ParityCase):

    def test_reference_shows_attribute_values_unchanged(self):
        """The method itself: what goes in through an attribute is what the picture holds."""
        grid = TileGrid(self.scene)
        material = emission_of("Attribute", lambda n: n.add(
            "ShaderNodeAttribute", {"attribute_name": "v"}).outputs["Vector"])
        values = [(0.25, 0.5, 3.0), (-2.0, 0.0, 1e-3), (100.0, -7.5, 0.125)]
        for value in values:
            grid.add(str(value), material, attributes={"v": value})
        shown = grid.values(REFERENCE_ENGINE, grid.build())
        for actual, expected in zip(shown, values):
            self.assertEqual([round(a, 5) for a in actual], [round(e, 5) for e in expected])


class TreeParityTest(ParityCase):
    """What belongs to trees rather than to nodes."""

    def setUp(self):
        super().setUp()
        self.grid = TileGrid(self.scene)

    def add(self, label, build, **attributes):
        self.grid.add(label, emission_of(label, build), attributes=attributes)

    @staticmethod
    def attribute(nodes, name="v", output="Vector"):
        return nodes.add("ShaderNodeAttribute", {"attribute_name": name}).outputs[output]

    def test_conversions(self):
        """Value, vector and colour linked to each other's sockets."""
        def to_value(nodes, source):
            return nodes.add("ShaderNodeMath", {"operation": "ADD"}, {0: source, 1: 0.0})

        def to_vector(nodes, source):
            return nodes.add("ShaderNodeVectorMath", {"operation": "ADD"}, {0: source})

        def to_color(nodes, source):
            return nodes.add("ShaderNodeGamma", None, {"Color": source, "Gamma": 1.0})

        for output, convert in itertools.product(("Fac", "Vector", "Color"),
                                                 (to_value, to_vector, to_color)):
            for value in VECTORS + COLORS:
                self.add(f"{output} {convert.__name__} {value}",
                         lambda n, o=output, c=convert: c(n, self.attribute(n, "v", o)), v=value)
        for convert in (to_value, to_vector, to_color):
            self.add(f"constant {convert.__name__}", lambda n, c=convert: c(
                n, n.add("ShaderNodeCombineXYZ", None, {0: 0.2, 1: 0.7, 2: -0.4})))
        self.check_grid(self.grid)

    def group(self, name, factor, inner=None):
        """Group (Vector, Scale = `factor`) -> Vector * Scale, through `inner` first if given."""
        tree = bpy.data.node_groups.new(name, "ShaderNodeTree")
        tree.inputs.new("NodeSocketVector", "Vector")
        tree.inputs.new("NodeSocketFloat", "Scale").default_value = factor
        tree.outputs.new("NodeSocketVector", "Result")
        nodes = scene_factory.Nodes(tree)
        entry = nodes.add("NodeGroupInput")
        vector = entry.outputs["Vector"]
        if inner is not None:
            vector = nodes.add("ShaderNodeGroup", {"node_tree": inner},
                               {"Vector": vector}).outputs["Result"]
        scaled = nodes.add("ShaderNodeVectorMath", {"operation": "SCALE"},
                           {"Vector": vector, "Scale": entry.outputs["Scale"]})
        nodes.add("NodeGroupOutput", None, {"Result": scaled})
        return tree

    def test_groups(self):
        inner = self.group("Inner", 3.0)
        outer = self.group("Outer", 0.5, inner)
        outermost = self.group("Outermost", 1.5, outer)
        value = (0.3, -0.7, 1.1)
        for tree in (inner, outer, outermost):
            self.add(f"{tree.name} linked", lambda n, t=tree: n.add(
                "ShaderNodeGroup", {"node_tree": t}, {"Vector": self.attribute(n)}), v=value)
            self.add(f"{tree.name} constant", lambda n, t=tree: n.add(
                "ShaderNodeGroup", {"node_tree": t}, {"Vector": value, "Scale": 0.2}))
        twice = self.group("Twice", 2.0)

        def chain(nodes):
            first = nodes.add("ShaderNodeGroup", {"node_tree": twice},
                              {"Vector": self.attribute(nodes)})
            return nodes.add("ShaderNodeGroup", {"node_tree": twice}, {"Vector": first})
        self.add("same group twice", chain, v=value)
        self.add("no tree", lambda n: n.add("ShaderNodeVectorMath", {"operation": "ADD"}, {
            0: self.attribute(n), 1: (0.5, 0.5, 0.5)}), v=value)
        self.check_grid(self.grid)

    def test_reroutes(self):
        def reroutes(nodes, count):
            source = self.attribute(nodes)
            for _ in range(count):
                reroute = nodes.tree.nodes.new("NodeReroute")
                nodes.tree.links.new(source, reroute.inputs[0])
                source = reroute.outputs[0]
            return nodes.add("ShaderNodeGamma", None, {"Color": source, "Gamma": 2.0})
        for count in range(4):
            self.add(f"{count} reroutes", lambda n, c=count: reroutes(n, c), v=(0.3, 0.7, 1.1))

        def dangling(nodes):
            reroute = nodes.tree.nodes.new("NodeReroute")
            gamma = nodes.add("ShaderNodeGamma", None, {"Color": (0.2, 0.4, 0.6)})
            nodes.tree.links.new(reroute.outputs[0], gamma.inputs["Color"])
            return gamma
        self.add("reroute without source", dangling)
        self.check_grid(self.grid)

    def test_muted(self):
        def muted(nodes, kind, settings, inputs):
            node = nodes.add(kind, settings, inputs)
            node.mute = True
            return node
        value = (0.3, 0.7, 1.1)
        self.add("gamma", lambda n: muted(n, "ShaderNodeGamma", None, {
            "Color": self.attribute(n), "Gamma": 3.0}), v=value)
        self.add("gamma unlinked", lambda n: muted(n, "ShaderNodeGamma", None, {
            "Color": (0.2, 0.4, 0.6), "Gamma": 3.0}))
        self.add("mix", lambda n: muted(n, "ShaderNodeMix", {"data_type": "RGBA"}, {
            "Factor_Float": 0.8, "A_Color": self.attribute(n), "B_Color": (1, 0, 0)}), v=value)
        self.add("mix second linked", lambda n: muted(n, "ShaderNodeMix", {"data_type": "RGBA"}, {
            "Factor_Float": 0.8, "B_Color": self.attribute(n)}), v=value)
        self.add("vector math", lambda n: muted(n, "ShaderNodeVectorMath", {
            "operation": "CROSS_PRODUCT"}, {0: self.attribute(n), 1: (1, 2, 3)}), v=value)
        self.add("group", lambda n: muted(n, "ShaderNodeGroup", {
            "node_tree": self.group("G", 3.0)}, {"Vector": self.attribute(n)}), v=value)
        self.add("group unlinked", lambda n: muted(n, "ShaderNodeGroup", {
            "node_tree": self.group("G", 3.0)}, {"Vector": (0.1, 0.2, 0.3)}))
        self.add("mapping before a texture", lambda n: n.add("ShaderNodeTexChecker", None, {
            "Vector": muted(n, "ShaderNodeMapping", None, {}), "Scale": 3.7}))
        self.add("bump before a fresnel", lambda n: n.add("ShaderNodeFresnel", None, {
            "Normal": muted(n, "ShaderNodeBump", None, {})}))
        self.add("texture", lambda n: muted(n, "ShaderNodeTexChecker", None, {
            "Vector": self.attribute(n)}).outputs["Color"], v=value)

        def muted_link(nodes):
            gamma = nodes.add("ShaderNodeGamma", None, {"Color": self.attribute(nodes),
                                                        "Gamma": 2.0})
            gamma.inputs["Color"].links[0].is_muted = True
            return gamma
        self.add("link", muted_link, v=value)
        self.check_grid(self.grid)

    def test_several_outputs(self):
        """The active Material Output counts; one for another engine does not."""
        def build(nodes):
            other = nodes.add("ShaderNodeOutputMaterial", {"target": "EEVEE"})
            red = nodes.add("ShaderNodeEmission", None, {"Color": (1, 0, 0)})
            nodes.set(other.inputs["Surface"], red)
            return nodes.add("ShaderNodeRGB")
        self.add("eevee output", build)
        self.check_grid(self.grid)


class IncidenceParityTest(ParityCase):
    """Fresnel and Layer Weight on tilted faces."""

    def test_fresnel_and_layer_weight(self):
        grid = TileGrid(self.scene)
        for variant, normal in itertools.product(fresnel_variants(), TILTED):
            variant.add_to(grid, normal=normal)
        self.check_grid(grid)
