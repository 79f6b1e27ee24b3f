# SPDX-License-Identifier: GPL-3.0-or-later
"""What cannot be honoured is named once with its material and node, and marked when asked for."""
import unittest

import bpy
from support import scene_factory
from support.render import render
from tenniel import reports


class NodeMarksTest(unittest.TestCase):

    def setUp(self):
        self.scene = scene_factory.empty_scene()
        self.addCleanup(reports.clear)
        inner = bpy.data.node_groups.new("inner", "ShaderNodeTree")
        inner.outputs.new("NodeSocketColor", "Color")
        script = inner.nodes.new("ShaderNodeScript")
        script.name = "a/b"
        script.use_custom_color, script.color = True, (0.1, 0.2, 0.3)
        # OSL is in no build of Debian's: its sockets are made here by hand.
        script.outputs.new("NodeSocketColor", "Out")
        inner.links.new(inner.nodes.new("NodeGroupOutput").inputs[0], script.outputs[0])
        self.script, self.inner = script, inner

    def material(self, name):
        def build(nodes):
            group = nodes.add("ShaderNodeGroup")
            group.node_tree = self.inner
            group.name = "group"
            return nodes.add("ShaderNodeEmission", None, {"Color": group.outputs[0]})
        return scene_factory.node_material(name, build)

    def render(self):
        scene_factory.plane(self.scene, 2.0, self.material("first"))
        scene_factory.plane(self.scene, 2.0, self.material("second"), location=(0, 0, -1))
        scene_factory.top_camera(self.scene, 2.0)
        render("TENNIEL", samples=1, resolution=(4, 4))

    def looks(self):
        node = bpy.data.node_groups["inner"].nodes["a/b"]
        return node.use_custom_color, tuple(round(c, 4) for c in node.color)

    def test_osl_is_reported_once_a_material(self):
        self.render()
        rows = [row for row in reports.rows(self.scene.name) if "ShaderNodeScript" in row.text]
        self.assertEqual([(row.material, row.node, row.count) for row in rows],
                         [("first", "group/a/b", 1), ("second", "group/a/b", 1)])
        # Of each material: output, emission, script. The World's: output, background.
        nodes, reported = reports.coverage(self.scene.name)
        self.assertEqual(reported, 2)
        self.assertGreaterEqual(nodes, 6)

    def test_a_render_leaves_the_file_as_it_is(self):
        before = self.looks()
        self.render()
        self.assertEqual(self.looks(), before)
        self.assertNotIn("tenniel_mark", self.script)

    def test_mark_and_clear(self):
        before = self.looks()
        self.render()
        for _ in range(2):
            self.assertEqual(bpy.ops.tenniel.mark_nodes(), {'FINISHED'})
            self.assertNotEqual(self.looks(), before)
        bpy.ops.tenniel.clear_node_marks()
        self.assertEqual(self.looks(), before)
        self.assertNotIn("tenniel_mark", self.script)

    def test_undo(self):
        before = self.looks()
        self.render()
        bpy.ops.ed.undo_push(message="before")
        bpy.ops.tenniel.mark_nodes('EXEC_DEFAULT', True)
        self.assertNotEqual(self.looks(), before)
        bpy.ops.ed.undo()
        self.assertEqual(self.looks(), before)

    def test_world_and_lamp(self):
        lamp = bpy.data.lights.new("lamp data", 'POINT')
        lamp.use_nodes = self.scene.world.use_nodes = True
        scene_factory.link(self.scene, lamp, "lamp object")
        reports.begin(self.scene.name)
        reports.add('WARNING', "x", material=self.scene.world.name, node="Background")
        reports.add('WARNING', "x", material="lamp object", node="Emission")
        reports.add('WARNING', "x", material="gone", node="Emission")
        reports.add('WARNING', "x", material="lamp object", node="gone")
        bpy.ops.tenniel.mark_nodes()
        self.assertTrue(self.scene.world.node_tree.nodes["Background"].use_custom_color)
        self.assertTrue(lamp.node_tree.nodes["Emission"].use_custom_color)
        self.assertFalse(lamp.node_tree.nodes["Light Output"].use_custom_color)

    def test_nothing_to_mark(self):
        reports.begin(self.scene.name)
        self.assertFalse(bpy.ops.tenniel.mark_nodes.poll())
