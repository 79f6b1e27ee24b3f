# SPDX-License-Identifier: GPL-3.0-or-later
"""Shader trees: which output applies, what is copied, and how groups and the like dissolve."""
import sys

import bpy
from support import scene_factory
from support.export_case import ExportTestCase


def material_with(build):
    """Material whose tree `build(tree, nodes, emission)` completes; emission feeds the output."""
    material = bpy.data.materials.new("m")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    nodes = scene_factory.Nodes(tree)
    emission = nodes.add("ShaderNodeEmission")
    nodes.add("ShaderNodeOutputMaterial", None, {"Surface": emission})
    build(tree, nodes, emission)
    return material


def new_group(name, inputs=(), outputs=()):
    """Group tree with sockets [(name, type)]; returns (tree, Nodes, group input, group output)."""
    tree = bpy.data.node_groups.new(name, 'ShaderNodeTree')
    for socket, kind in inputs:
        tree.inputs.new(f"NodeSocket{kind}", socket)
    for socket, kind in outputs:
        tree.outputs.new(f"NodeSocket{kind}", socket)
    nodes = scene_factory.Nodes(tree)
    return tree, nodes, nodes.add("NodeGroupInput"), nodes.add("NodeGroupOutput")


def use_group(nodes, tree, inputs=None):
    return nodes.add("ShaderNodeGroup", {"node_tree": tree}, inputs)


class GraphCase(ExportTestCase):

    def graph_of(self, build):
        return self.material_graph(material_with(build))

    def assert_emission_color(self, graph, expected):
        emission, = graph.find("ShaderNodeEmission")
        self.assertIsNone(graph.source(emission, "Color"))
        self.assert_close(emission["inputs"]["Color"], expected)


class OutputTest(GraphCase):

    def outputs(self, *targets):
        def build(tree, nodes, _emission):
            tree.nodes.remove(next(n for n in tree.nodes if n.type == 'OUTPUT_MATERIAL'))
            for number, target in enumerate(targets):
                shader = nodes.add("ShaderNodeEmission", {"name": target},
                                   {"Strength": float(number)})
                nodes.add("ShaderNodeOutputMaterial", {"target": target}, {"Surface": shader})
        graph = self.graph_of(build)
        source = graph.source(graph.nodes[graph.output], "Surface")
        return source and source[0]["name"]

    def test_cycles_before_all(self):
        self.assertEqual(self.outputs('EEVEE', 'ALL', 'CYCLES'), "CYCLES")

    def test_all_before_none(self):
        self.assertEqual(self.outputs('EEVEE', 'ALL'), "ALL")

    def test_eevee_alone_is_nothing(self):
        self.assertIsNone(self.outputs('EEVEE'))

    def test_tree_without_output(self):
        material = material_with(lambda tree, nodes, emission: tree.nodes.clear())
        graph = self.material_graph(material)
        self.assertEqual([node["type"] for node in graph.nodes], ["ShaderNodeOutputMaterial"])

    def test_material_without_nodes_is_its_viewport_color(self):
        material = bpy.data.materials.new("plain")
        material.diffuse_color = (0.2, 0.4, 0.6, 1.0)
        graph = self.material_graph(material)
        diffuse, = graph.find("ShaderNodeBsdfDiffuse")
        self.assert_close(diffuse["inputs"]["Color"], (0.2, 0.4, 0.6, 1.0))
        self.assertEqual(graph.source(graph.nodes[graph.output], "Surface"), (diffuse, "BSDF"))

    def test_aov_outputs_of_the_tree_and_its_groups(self):
        """Several may bear the name of one pass; those of other names are left out."""
        def build(tree, nodes, _emission):
            inner = bpy.data.node_groups.new("inner", "ShaderNodeTree")
            group = nodes.add("ShaderNodeGroup")
            group.node_tree = inner
            for target, name in ((tree, "mask"), (tree, "mask"), (tree, "other"), (inner, "mask")):
                target.nodes.new("ShaderNodeOutputAOV").name = name
            bpy.context.view_layer.aovs.add().name = "mask"
        self.assertEqual(len(self.graph_of(build).aov_outputs), 3)

    def test_only_what_the_output_needs(self):
        def build(_tree, nodes, _emission):
            nodes.add("ShaderNodeTexChecker")
        self.assertEqual(self.graph_of(build).node_count, 2)


class SocketTest(GraphCase):

    def test_values_and_settings(self):
        def build(_tree, nodes, emission):
            math = nodes.add("ShaderNodeMath", {"operation": 'POWER', "use_clamp": True},
                             {0: 2.0, 1: 3.0})
            nodes.set(emission.inputs["Strength"], math)
        graph = self.graph_of(build)
        math, = graph.find("ShaderNodeMath")
        self.assertEqual(math["settings"], {"operation": 'POWER', "use_clamp": True})
        self.assertEqual(math["inputs"], {"Value": (2.0,), "Value_001": (3.0,)})
        emission, = graph.find("ShaderNodeEmission")
        self.assertEqual(graph.source(emission, "Strength"), (math, "Value"))
        self.assertNotIn("Strength", emission["inputs"])

    def test_disabled_sockets_are_skipped(self):
        def build(_tree, nodes, emission):
            nodes.set(emission.inputs["Strength"], nodes.add("ShaderNodeMix"))
        mix, = self.graph_of(build).find("ShaderNodeMix")
        self.assertEqual(set(mix["inputs"]), {"Factor_Float", "A_Float", "B_Float"})

    def test_sockets_folded_away_still_count(self):
        def build(_tree, _nodes, emission):
            emission.inputs["Strength"].default_value = 7.0
            emission.inputs["Strength"].hide = True
        emission, = self.graph_of(build).find("ShaderNodeEmission")
        self.assertEqual(emission["inputs"]["Strength"], (7.0,))

    def test_implied_values_are_not_written(self):
        def build(_tree, nodes, emission):
            nodes.set(emission.inputs["Color"], nodes.add("ShaderNodeTexChecker"))
        checker, = self.graph_of(build).find("ShaderNodeTexChecker")
        self.assertNotIn("Vector", checker["inputs"])
        self.assertIn("Scale", checker["inputs"])

    def test_value_of_an_output(self):
        def build(_tree, nodes, emission):
            value = nodes.add("ShaderNodeValue")
            value.outputs[0].default_value = 4.5
            nodes.set(emission.inputs["Strength"], value)
        value, = self.graph_of(build).find("ShaderNodeValue")
        self.assertEqual(value["inputs"], {"Value": (4.5,)})

    def test_muted_link_is_no_link(self):
        def build(tree, nodes, emission):
            emission.inputs["Color"].default_value = (0.1, 0.2, 0.3, 1.0)
            nodes.set(emission.inputs["Color"], nodes.add("ShaderNodeTexChecker"))
            next(iter(emission.inputs["Color"].links)).is_muted = True
        self.assert_emission_color(self.graph_of(build), (0.1, 0.2, 0.3, 1.0))

    def test_unknown_node_stays_in_the_graph(self):
        def build(_tree, nodes, emission):
            nodes.set(emission.inputs["Color"], nodes.add("ShaderNodeTexMagic"))
        graph = self.graph_of(build)
        magic, = graph.find("ShaderNodeTexMagic")
        self.assertEqual(magic["inputs"], {})

    def test_chain_longer_than_the_stack(self):
        limit = sys.getrecursionlimit()
        self.addCleanup(sys.setrecursionlimit, limit)

        def build(_tree, nodes, emission):
            last = nodes.add("ShaderNodeValue")
            for _ in range(200):
                last = nodes.add("ShaderNodeMath", None, {0: last})
            nodes.set(emission.inputs["Strength"], last)
            # Blender takes minutes to link thousands of nodes; fewer do on a low stack.
            sys.setrecursionlimit(120)
        graph = self.graph_of(build)
        self.assertEqual(len(graph.find("ShaderNodeMath")), 200)

    def test_shared_node_appears_once(self):
        def build(_tree, nodes, emission):
            checker = nodes.add("ShaderNodeTexChecker")
            nodes.set(emission.inputs["Color"], checker)
            nodes.set(emission.inputs["Strength"], checker.outputs["Fac"])
        graph = self.graph_of(build)
        self.assertEqual(len(graph.find("ShaderNodeTexChecker")), 1)
        self.assertEqual(len(graph.links), 3)


class MuteAndRerouteTest(GraphCase):

    def test_reroutes_dissolve(self):
        def build(_tree, nodes, emission):
            last = nodes.add("ShaderNodeTexChecker")
            for _ in range(3):
                last = nodes.add("NodeReroute", None, {0: last.outputs[0]})
            nodes.set(emission.inputs["Color"], last)
        graph = self.graph_of(build)
        checker, = graph.find("ShaderNodeTexChecker")
        emission, = graph.find("ShaderNodeEmission")
        self.assertEqual(graph.source(emission, "Color"), (checker, "Color"))
        self.assertEqual(graph.node_count, 3)

    def test_muted_node_passes_its_input_on(self):
        def build(_tree, nodes, emission):
            checker = nodes.add("ShaderNodeTexChecker")
            mixed = nodes.add("ShaderNodeMix", {"data_type": 'RGBA'}, {"A_Color": checker})
            mixed.mute = True
            nodes.set(emission.inputs["Color"], mixed)
        graph = self.graph_of(build)
        emission, = graph.find("ShaderNodeEmission")
        self.assertEqual(graph.source(emission, "Color")[0]["type"], "ShaderNodeTexChecker")
        self.assertEqual(graph.find("ShaderNodeMix"), [])

    def test_muted_node_passes_no_value_on(self):
        def build(_tree, nodes, emission):
            math = nodes.add("ShaderNodeMath", {"mute": True}, {0: 6.0})
            nodes.set(emission.inputs["Strength"], math)
        emission, = self.graph_of(build).find("ShaderNodeEmission")
        self.assertEqual(emission["inputs"]["Strength"], (0.0,))

    def test_muted_node_without_way_through(self):
        def build(_tree, nodes, emission):
            emission.inputs["Strength"].default_value = 2.0
            nodes.set(emission.inputs["Strength"], nodes.add("ShaderNodeValue", {"mute": True}))
        emission, = self.graph_of(build).find("ShaderNodeEmission")
        self.assertEqual(emission["inputs"]["Strength"], (2.0,))


class GroupTest(GraphCase):

    def test_value_of_the_group_node(self):
        tree, inner, start, end = new_group("g", [("Tint", "Color")], [("Result", "Color")])
        inner.set(end.inputs["Result"], start.outputs["Tint"])

        def build(_tree, nodes, emission):
            nodes.set(emission.inputs["Color"],
                      use_group(nodes, tree, {"Tint": (0.3, 0.6, 0.9)}))
        self.assert_emission_color(self.graph_of(build), (0.3, 0.6, 0.9, 1.0))

    def test_value_of_the_group_output(self):
        tree, _inner, _start, end = new_group("g", [], [("Result", "Color")])
        end.inputs["Result"].default_value = (0.5, 0.4, 0.3, 1.0)

        def build(_tree, nodes, emission):
            nodes.set(emission.inputs["Color"], use_group(nodes, tree))
        self.assert_emission_color(self.graph_of(build), (0.5, 0.4, 0.3, 1.0))

    def test_two_uses_are_two_copies(self):
        tree, inner, start, end = new_group("g", [("Power", "Float")], [("Result", "Float")])
        math = inner.add("ShaderNodeMath", {"operation": 'POWER'}, {1: start.outputs["Power"]})
        inner.set(end.inputs["Result"], math)

        def build(_tree, nodes, emission):
            first = use_group(nodes, tree, {"Power": 2.0})
            nodes.set(emission.inputs["Strength"], first)
            nodes.set(emission.inputs["Color"], use_group(nodes, tree, {"Power": 3.0}))
        powers = [node["inputs"]["Value_001"] for node in
                  self.graph_of(build).find("ShaderNodeMath")]
        self.assertEqual(sorted(powers), [(2.0,), (3.0,)])

    def test_nested_groups(self):
        inside, inner, start, end = new_group("inside", [("In", "Float")], [("Out", "Float")])
        inner.set(end.inputs["Out"],
                  inner.add("ShaderNodeMath", {"operation": 'SINE'}, {0: start.outputs["In"]}))
        around, outer, start, end = new_group("around", [("In", "Float")], [("Out", "Float")])
        first = use_group(outer, inside, {"In": start.outputs["In"]})
        outer.set(end.inputs["Out"], use_group(outer, inside, {"In": first.outputs["Out"]}))

        def build(_tree, nodes, emission):
            value = nodes.add("ShaderNodeValue")
            nodes.set(emission.inputs["Strength"],
                      use_group(nodes, around, {"In": value.outputs[0]}))
        graph = self.graph_of(build)
        self.assertEqual(len(graph.find("ShaderNodeMath")), 2)
        emission, = graph.find("ShaderNodeEmission")
        second, _ = graph.source(emission, "Strength")
        first, _ = graph.source(second, "Value")
        self.assertEqual((first["type"], graph.source(first, "Value")[0]["type"]),
                         ("ShaderNodeMath", "ShaderNodeValue"))
        self.assertEqual(first["name"].count("/"), 2)

    def test_shader_through_a_group(self):
        tree, inner, _start, end = new_group("g", [], [("Shader", "Shader")])
        inner.set(end.inputs["Shader"], inner.add("ShaderNodeBsdfDiffuse"))

        def build(own, nodes, _emission):
            output = next(n for n in own.nodes if n.type == 'OUTPUT_MATERIAL')
            nodes.set(output.inputs["Surface"], use_group(nodes, tree))
        graph = self.graph_of(build)
        self.assertEqual(graph.source(graph.nodes[graph.output], "Surface")[0]["type"],
                         "ShaderNodeBsdfDiffuse")

    def test_unlinked_coordinate_of_a_group_stays_implied(self):
        tree, inner, start, end = new_group("g", [("Vector", "Vector")], [("Color", "Color")])
        tree.inputs["Vector"].hide_value = True
        inner.set(end.inputs["Color"],
                  inner.add("ShaderNodeTexChecker", None, {"Vector": start.outputs["Vector"]}))

        def build(_tree, nodes, emission):
            nodes.set(emission.inputs["Color"], use_group(nodes, tree))
        checker, = self.graph_of(build).find("ShaderNodeTexChecker")
        self.assertNotIn("Vector", checker["inputs"])

    def test_missing_group(self):
        def build(_tree, nodes, emission):
            group = nodes.add("ShaderNodeGroup")
            tree, *_ = new_group("gone", [], [("Result", "Color")])
            group.node_tree = tree
            nodes.set(emission.inputs["Color"], group)
            bpy.data.node_groups.remove(tree)
        graph = self.graph_of(build)
        self.assertEqual(graph.node_count, 2)

    def test_muted_group(self):
        tree, inner, start, end = new_group("g", [("In", "Color")], [("Out", "Color")])
        inner.set(end.inputs["Out"], inner.add("ShaderNodeTexChecker"))

        def build(_tree, nodes, emission):
            group = use_group(nodes, tree, {"In": (0.1, 0.2, 0.3)})
            group.mute = True
            nodes.set(emission.inputs["Color"], group)
        self.assert_emission_color(self.graph_of(build), (0.0, 0.0, 0.0, 1.0))


class ConversionTest(GraphCase):
    """A link changes its type at the border of a group as it would at a node's socket."""

    def through(self, kind, source, target):
        """Graph of emission.`target` fed by a `source` node through a group socket of `kind`."""
        tree, inner, start, end = new_group("g", [("In", kind)], [("Out", kind)])
        inner.set(end.inputs["Out"], start.outputs["In"])

        def build(_tree, nodes, emission):
            node = nodes.add(source)
            nodes.set(emission.inputs[target], use_group(nodes, tree, {"In": node.outputs[0]}))
        return self.graph_of(build)

    def test_color_as_number_and_back(self):
        graph = self.through("Float", "ShaderNodeTexChecker", "Color")
        emission, = graph.find("ShaderNodeEmission")
        grey, _ = graph.source(emission, "Color")
        self.assertEqual(grey["type"], "ShaderNodeRGBToBW")
        self.assertEqual(graph.source(grey, "Color")[0]["type"], "ShaderNodeTexChecker")

    def test_color_as_vector_then_number_is_the_mean(self):
        graph = self.through("Vector", "ShaderNodeTexChecker", "Strength")
        emission, = graph.find("ShaderNodeEmission")
        mean, socket = graph.source(emission, "Strength")
        self.assertEqual((mean["type"], socket), ("ShaderNodeVectorMath", "Value"))
        self.assertEqual(mean["settings"]["operation"], 'DOT_PRODUCT')

    def test_color_as_vector_and_back_needs_nothing(self):
        graph = self.through("Vector", "ShaderNodeTexChecker", "Color")
        self.assertEqual(graph.node_count, 3)

    def test_direct_link_is_left_to_the_core(self):
        graph = self.through("Color", "ShaderNodeTexChecker", "Strength")
        self.assertEqual(graph.node_count, 3)

    def test_constants(self):
        tree, inner, start, end = new_group("g", [("In", "Color")], [("Out", "Color")])
        inner.set(end.inputs["Out"], start.outputs["In"])

        def build(_tree, nodes, emission):
            group = use_group(nodes, tree, {"In": (1.0, 0.5, 0.0)})
            nodes.set(emission.inputs["Strength"], group)
        emission, = self.graph_of(build).find("ShaderNodeEmission")
        self.assert_close(emission["inputs"]["Strength"], (0.2126 + 0.5 * 0.7152,))


class ReaderTest(GraphCase):

    def node(self, node_type, prepare, target="Color"):
        def build(_tree, nodes, emission):
            node = nodes.add(node_type)
            prepare(node)
            nodes.set(emission.inputs[target], node)
        return self.graph_of(build).find(node_type)[0]

    def test_color_ramp(self):
        def prepare(node):
            scale = node.color_ramp
            scale.interpolation = 'CONSTANT'
            scale.elements[0].color = (1.0, 0.0, 0.0, 0.5)
            scale.elements[1].position = 0.5
        settings = self.node("ShaderNodeValToRGB", prepare)["settings"]
        self.assertEqual(settings["interpolation"], 'CONSTANT')
        self.assertEqual(len(settings["color_ramp"]), 4 * 256)
        self.assert_close(settings["color_ramp"][:4], (1.0, 0.0, 0.0, 0.5))
        self.assert_close(settings["color_ramp"][-4:], (1.0, 1.0, 1.0, 1.0))

    def test_color_curves(self):
        def prepare(node):
            red = node.mapping.curves[0]
            red.points[1].location = (1.0, 0.5)
            node.mapping.update()
        settings = self.node("ShaderNodeRGBCurve", prepare)["settings"]
        self.assertEqual(len(settings["mapping"]), 3 * 256)
        self.assert_close(settings["mapping"][-3:], (0.5, 1.0, 1.0), 3)
        self.assertEqual((settings["min_x"], settings["max_x"]), (0.0, 1.0))

    def test_texture_mapping(self):
        def prepare(node):
            node.texture_mapping.translation = (1.0, 2.0, 3.0)
            node.texture_mapping.scale = (2.0, 1.0, 1.0)
        settings = self.node("ShaderNodeTexChecker", prepare)["settings"]
        self.assert_close(settings["texture_mapping"], (2, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3))

    def test_identical_texture_mapping_is_left_out(self):
        settings = self.node("ShaderNodeTexChecker", lambda node: None)["settings"]
        self.assertNotIn("texture_mapping", settings)

    def test_coordinates_of_another_object(self):
        other = scene_factory.link(self.scene, None, "Other", location=(1, 2, 3), scale=(2, 2, 2))

        def prepare(node):
            node.object = other
        settings = self.node("ShaderNodeTexCoord", prepare)["settings"]
        self.assert_close(settings["object_transform"],
                          (0.5, 0, 0, -0.5, 0, 0.5, 0, -1, 0, 0, 0.5, -1.5))

    def test_driven_values(self):
        def prepare(node):
            driver = node.outputs[0].driver_add("default_value").driver
            driver.type = 'SUM'
            variable = driver.variables.new()
            variable.targets[0].id_type = 'SCENE'
            variable.targets[0].id = self.scene
            variable.targets[0].data_path = 'render.resolution_x'
        self.scene.render.resolution_x = 123
        node = self.node("ShaderNodeValue", prepare, "Strength")
        self.assertEqual(node["inputs"]["Value"], (123.0,))
