# SPDX-License-Identifier: GPL-3.0-or-later
"""Groups of measured metals and media: their values, how they are recognised, how they look."""
import math
import unittest

import bpy
from support import scene_factory
from support.case import RenderTestCase
from support.export_case import ExportTestCase
from support.render import TESTED_ENGINE, render
from tenniel.presets import groups, menu, tables

# Reflectance of the measured spectrum under D65 as linear sRGB: facing, and at acos(1/7).
SPECTRAL = {
    "Gold": ((1.02184, 0.78226, 0.34354), (0.98551, 0.8823, 0.62965)),
    "Silver": ((0.97151, 0.95994, 0.91529), (0.97023, 0.96769, 0.95436)),
    "Aluminium": ((0.91317, 0.9215, 0.92445), (0.8387, 0.86988, 0.89628)),
    "Copper": ((0.9551, 0.63768, 0.53814), (0.96254, 0.76694, 0.71623)),
    "Chromium": ((0.63467, 0.66221, 0.70456), (0.57554, 0.61177, 0.69654)),
    "Tungsten": ((0.51534, 0.49594, 0.46757), (0.53177, 0.53231, 0.53189)),
    "Mercury": ((0.78148, 0.77955, 0.77844), (0.71771, 0.75082, 0.7948)),
    "Nickel": ((0.65933, 0.60862, 0.5258), (0.67235, 0.67591, 0.66742)),
    "Titanium Nitride": ((0.61372, 0.46144, 0.23276), (0.71156, 0.70003, 0.60545)),
    "Iridium": ((0.70076, 0.69313, 0.65647), (0.65066, 0.67064, 0.68616)),
    "Potassium": ((0.94967, 0.93751, 0.9207), (0.98118, 0.98163, 0.9832)),
    "Lithium": ((0.91575, 0.88902, 0.80793), (0.94045, 0.93877, 0.92095)),
    "Beryllium": ((0.5391, 0.53789, 0.53698), (0.54674, 0.5522, 0.56591)),
}
# Gold's red is more than the screen can show; what its index gives is the mean over the red.
GOLD_RED_FACING = 0.96668

GRAZING = math.degrees(math.acos(1.0 / 7.0))


def metal_material(name, distribution='GGX', **inputs):
    """A material of one preset; `inputs` by name of the group's sockets: values or sockets."""
    def build(nodes):
        node = menu.add_metal(nodes.tree, name, distribution)
        for key, value in inputs.items():
            nodes.set(node.inputs[key], value(nodes) if callable(value) else value)
        return node
    return scene_factory.node_material(name, build)


@unittest.skipUnless(TESTED_ENGINE == "TENNIEL", "the core's conductor is Tenniel's")
class MetalTest(RenderTestCase):

    def row(self, materials, angle):
        """Flat squares side by side in a white world, a metre of the picture each, at `angle`."""
        count = len(materials)
        for i, material in enumerate(materials):
            scene_factory.plane(self.scene, 1.0, material, location=(0, i - 0.5 * (count - 1), 0),
                                scale=(200, 1, 1))
        scene_factory.set_world(self.scene, (1, 1, 1))
        theta = math.radians(angle)
        camera = scene_factory.camera(self.scene, (40 * math.sin(theta), 0, 40 * math.cos(theta)),
                                      type="ORTHO", ortho_scale=float(count))
        camera.rotation_euler = (theta, 0, math.pi / 2)
        return count

    def test_reflectance_of_the_spectrum(self):
        for angle in (0.0, GRAZING):
            self.setUp()
            names = list(tables.METALS)
            count = self.row([metal_material(name, Roughness=0.0) for name in names], angle)
            picture = render(TESTED_ENGINE, 4, 0, (count, 4))    # the lowest that Blender has
            for i, name in enumerate(names):
                with self.subTest(f"{name} at {angle:.1f}"):
                    expected = list(SPECTRAL[name][angle > 0.0])
                    if name == "Gold":
                        found = picture.pixel(i, 0)[0]
                        if angle == 0.0:
                            self.assertAlmostEqual(found, GOLD_RED_FACING, delta=1e-4)
                        else:
                            self.assertAlmostEqual(found, expected[0], delta=0.05)
                        expected[0] = found
                    self.assert_pixel(picture, i, 0, expected, 1e-3)

    def test_looks_as_in_cycles(self):
        names = ("Gold", "Aluminium", "Chromium", "Titanium Nitride")
        for distribution, roughness, angle, relative in (
                ('GGX', 0.0, 0.0, 1e-3), ('GGX', 0.0, 45.0, 1e-3), ('GGX', 0.0, 80.0, 1e-3),
                ('SHARP', 0.3, 60.0, 1e-3), ('GGX', 0.3, 0.0, 0.01), ('GGX', 0.3, 60.0, 0.02),
                ('BECKMANN', 0.3, 45.0, 0.02), ('GGX', 0.6, 30.0, 0.03)):
            with self.subTest(f"{distribution} {roughness} at {angle:g}"):
                self.setUp()
                count = self.row([metal_material(name, distribution, Roughness=roughness)
                                  for name in names], angle)
                self.assert_agrees(f"metal {distribution} {roughness} at {angle:g}", 16,
                                   relative=relative, resolution=(16 * count, 16), seeds=3,
                                   samples=64, max_noise=0.01)

    def test_linked_inputs(self):
        def linked_roughness(nodes):
            node = nodes.add("ShaderNodeValue")
            node.outputs[0].default_value = 0.35
            return node

        def tilted(nodes):
            return nodes.add("ShaderNodeCombineXYZ", None, {0: 0.3, 1: 0.0, 2: 0.95})
        pictures = []
        for inputs in ({"Roughness": 0.35}, {"Roughness": linked_roughness},
                       {"Roughness": 0.35, "Normal": tilted}):
            self.setUp()
            self.row([metal_material("Copper", **inputs)], 50.0)
            pictures.append(render(TESTED_ENGINE, 64, 0, (8, 8)))
        self.assert_bitwise_equal(pictures[0], pictures[1], "a linked roughness")
        self.assertFalse(pictures[0].rgba == pictures[2].rgba, "a linked normal changes nothing")


class MetalExportTest(ExportTestCase):

    def conductors(self, material):
        return self.material_graph(material).find("TennielConductor")

    def test_values(self):
        for name, (eta, k) in tables.METALS.items():
            with self.subTest(name):
                self.setUp()
                node, = self.conductors(metal_material(name, 'BECKMANN', Roughness=0.25))
                self.assert_close(node["inputs"]["Eta"], eta)
                self.assert_close(node["inputs"]["K"], k)
                self.assert_close(node["inputs"]["Roughness"], (0.25,))
                self.assertNotIn("Normal", node["inputs"])
                self.assertEqual(node["settings"], {"distribution": 'BECKMANN'})

    def test_copies_and_new_names_are_known(self):
        material = metal_material("Gold")
        copy = groups.metal_group().copy()
        copy.name = "Something else"
        for node in copy.nodes:
            node.name, node.label = f"renamed {node.name}", "x"
            node.location = (0, 0)
        material.node_tree.nodes["Group"].node_tree = copy
        self.assertEqual(len(self.conductors(material)), 1)

    def test_inside_another_group(self):
        outer = bpy.data.node_groups.new("Outer", 'ShaderNodeTree')
        outer.outputs.new('NodeSocketShader', "Shader")
        outer.inputs.new('NodeSocketFloat', "Rough")
        nodes = scene_factory.Nodes(outer)
        metal = menu.add_metal(outer, "Silver")
        nodes.set(metal.inputs["Roughness"], nodes.add("NodeGroupInput").outputs[0])
        nodes.add("NodeGroupOutput", None, {0: metal})
        node, = self.conductors(scene_factory.node_material("m", lambda n: n.add(
            "ShaderNodeGroup", {"node_tree": outer}, {0: 0.625})))
        self.assert_close(node["inputs"]["Roughness"], (0.625,))

    def test_distribution_chosen_inside(self):
        material = metal_material("Gold")
        next(n for n in groups.metal_group().nodes
             if n.bl_idname == 'ShaderNodeBsdfGlossy').distribution = 'SHARP'
        node, = self.conductors(material)
        self.assertEqual(node["settings"]["distribution"], 'SHARP')

    def test_changed_inside_is_what_its_nodes_say(self):
        def other_value(tree):
            next(n for n in tree.nodes if n.bl_idname == 'ShaderNodeGamma'
                 ).inputs["Gamma"].default_value = 0.6

        def other_link(tree):
            glossy = next(n for n in tree.nodes if n.bl_idname == 'ShaderNodeBsdfGlossy')
            tree.links.remove(glossy.inputs["Color"].links[0])

        def other_closure(tree):
            for node in [n for n in tree.nodes if n.bl_idname == 'ShaderNodeBsdfGlossy']:
                tree.nodes.remove(node)
        for change in (other_value, other_link, other_closure):
            with self.subTest(change.__name__):
                self.setUp()
                material = metal_material("Gold")
                tree = groups.metal_group()
                change(tree)
                graph = self.material_graph(material)
                self.assertEqual(graph.find("TennielConductor"), [])
                self.assertEqual(len(graph.find("ShaderNodeBsdfGlossy")),
                                 change is not other_closure)
                self.assert_reported("group 'Metal'", "were changed")
                # The next preset is whole again.
                self.assertNotEqual(groups.metal_group(), tree)

    def test_one_group_for_all(self):
        trees = {menu.add_metal(metal_material("Gold").node_tree, name).node_tree
                 for name in tables.METALS}
        self.assertEqual(len(trees), 1)


class MediumTest(unittest.TestCase):

    def setUp(self):
        self.scene = scene_factory.empty_scene()

    def coefficients(self, node):
        """sigma_s, sigma_a and g of a group node, by what Blender's nodes inside it mean."""
        sigma_s, sigma_a, g = [0.0] * 3, [0.0] * 3, [0.0] * 3
        for closure in node.node_tree.nodes:
            if closure.bl_idname not in {'ShaderNodeVolumeScatter', 'ShaderNodeVolumeAbsorption'}:
                continue
            density = self.value(closure.inputs["Density"], node)[0]
            color = self.value(closure.inputs["Color"], node)
            for c in range(3):
                if closure.bl_idname == 'ShaderNodeVolumeAbsorption':
                    sigma_a[c] += (1.0 - color[c]) * density
                    continue
                sigma_s[c] += color[c] * density
                if color[c] > 0.0:
                    g[c] = self.value(closure.inputs["Anisotropy"], node)[0]
        return sigma_s, sigma_a, g

    def value(self, socket, group):
        """Components of what feeds a socket inside `group`."""
        if not socket.is_linked:
            value = socket.default_value
            return list(value) if hasattr(value, '__iter__') else [value]
        source = socket.links[0].from_socket
        node = source.node
        if node.type == 'GROUP_INPUT':
            return self.value(group.inputs[list(node.outputs).index(source)], group)
        if node.bl_idname == 'ShaderNodeSeparateXYZ':
            return [self.value(node.inputs[0], group)['XYZ'.index(source.name)]]
        self.assertEqual(node.operation, 'MULTIPLY')
        a, b = (self.value(node.inputs[i], group) for i in (0, 1))
        size = max(len(a), len(b))
        a, b = (x * size if len(x) == 1 else x for x in (a, b))
        return [x * y for x, y in zip(a, b)]

    def test_values_per_metre(self):
        rows = {**tables.LIQUIDS, **tables.SOLIDS}
        self.assertEqual((len(tables.LIQUIDS), len(tables.SOLIDS), len(rows)), (35, 12, 47))
        tree = bpy.data.materials.new("m")
        tree.use_nodes = True
        for name, expected in rows.items():
            for scale in (1.0, 0.25):
                with self.subTest(f"{name} x {scale}"):
                    node = menu.add_medium(tree.node_tree, name)
                    node.inputs["Scale"].default_value = scale
                    found = self.coefficients(node)
                    for values, wanted, unit in zip(found, expected,
                                                    (1000 * scale, 1000 * scale, 1.0)):
                        for v, w in zip(values, wanted):
                            self.assertAlmostEqual(v, w * unit, delta=1e-5 * max(1.0, w * unit))

    def test_measured_values(self):
        """Rows of the papers, independently of the table."""
        self.assertEqual(tables.LIQUIDS["Chardonnay"],
                         ((0.00021, 0.00033, 0.00048), (0.01078, 0.01186, 0.024),
                          (0.914, 0.958, 0.975)))
        self.assertEqual(tables.SOLIDS["Marble"][:2],
                         ((2.19, 2.62, 3.0), (0.0021, 0.0041, 0.0071)))


class MediumRenderTest(RenderTestCase):
    """Slabs of measured liquids before a white world."""

    def slab(self, name, thickness):
        material = bpy.data.materials.new(name)
        material.use_nodes = True
        tree = material.node_tree
        tree.nodes.clear()
        output = tree.nodes.new('ShaderNodeOutputMaterial')
        tree.links.new(menu.add_medium(tree, name).outputs[0], output.inputs['Volume'])
        scene_factory.box(self.scene, 1.0, material, scale=(10, 10, thickness))
        scene_factory.set_world(self.scene, (1, 1, 1))
        scene_factory.top_camera(self.scene, 0.01)

    def test_absorption_is_that_of_the_table(self):
        """Merlot scatters red only: green and blue obey Beer and Lambert."""
        self.slab("Merlot", 0.005)
        found = render(TESTED_ENGINE, 256, 0, (16, 16), max_bounces=64).mean()
        for channel in (1, 2):
            expected = math.exp(-5.0 * tables.LIQUIDS["Merlot"][1][channel])
            self.assertAlmostEqual(found[channel], expected, delta=5e-4)

    def test_scattering_is_that_of_cycles(self):
        self.slab("Chardonnay", 0.05)
        self.assert_agrees("Chardonnay, 5 cm", None, relative=0.003, seeds=3, samples=256,
                           resolution=(16, 16), max_bounces=64)


class MenuTest(unittest.TestCase):

    def test_every_entry_can_be_added(self):
        scene_factory.empty_scene()
        for cls in (menu.TENNIEL_MT_metals, menu.TENNIEL_MT_liquids, menu.TENNIEL_MT_solids):
            group, name = cls.operator.split('.')
            self.assertTrue(hasattr(bpy.types, f"TENNIEL_OT_{name}"), group)
            tree = bpy.data.node_groups.new("t", 'ShaderNodeTree')
            add = menu.add_metal if cls is menu.TENNIEL_MT_metals else menu.add_medium
            for preset in cls.table:
                self.assertEqual(add(tree, preset).label, preset)

    def test_operators_refuse_outside_the_shader_editor(self):
        self.assertFalse(bpy.ops.tenniel.add_metal.poll())
        self.assertFalse(bpy.ops.tenniel.add_medium.poll())
