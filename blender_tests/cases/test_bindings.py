# SPDX-License-Identifier: GPL-3.0-or-later
"""The native module as the exporter meets it: buffers, and checks at the border."""
import os
import time
import unittest

import bpy
import mathutils
from support.core_scene import core, triangle


class ModuleTest(unittest.TestCase):

    def test_attributes(self):
        self.assertTrue(core.version)
        self.assertIn(core.isa, ('v2', 'v3', 'v4'))
        self.assertRegex(core.python_version, r'^3\.\d+$')
        self.assertRegex(core.embree_version, r'^3\.\d+\.\d+')
        self.assertRegex(core.oiio_version, r'^2\.\d+\.\d+$')

    def test_passes(self):
        found = [(p.name, p.channels, p.channel_ids) for p in core.passes()]
        self.assertEqual(found, [("Combined", 4, "RGBA"), ("Depth", 1, "Z"), ("Normal", 3, "XYZ"),
                                 ("Mirror World", 1, "X"), ("Mirror Coverage", 1, "X"),
                                 ("Dream", 3, "RGB")])

    def test_node_types_are_those_of_blender(self):
        kinds = {'boolean', 'integer', 'number', 'choice', 'text', 'table', 'image', 'attribute',
                 'aov', 'grid'}
        types = core.node_types()
        self.assertIn('ShaderNodeBsdfDiffuse', types)
        for idname, info in types.items():
            with self.subTest(idname):
                # The core's own nodes stand for groups that the add-on brings.
                self.assertTrue(idname.startswith('Tenniel') or hasattr(bpy.types, idname))
                self.assertLessEqual(set(info.settings.values()), kinds)
        self.assertIn('Color', types['ShaderNodeBsdfDiffuse'].inputs)
        self.assertIn('BSDF', types['ShaderNodeBsdfDiffuse'].outputs)


class BufferTest(unittest.TestCase):
    KINDS = ((core.FloatBuffer, 'f', 4), (core.UIntBuffer, 'I', 4), (core.IntBuffer, 'I', 4),
             (core.ByteBuffer, '?', 1))

    def test_format_length_and_zeros(self):
        for kind, form, size in self.KINDS:
            with self.subTest(kind.__name__):
                view = memoryview(kind(5))
                self.assertEqual((view.format, view.itemsize, view.shape), (form, size, (5,)))
                self.assertFalse(view.readonly)
                self.assertEqual(list(kind(5)), [0] * 5)
                self.assertEqual(len(kind(0)), 0)
                self.assertEqual(len(memoryview(kind(0))), 0)

    def test_indexing(self):
        values = core.IntBuffer(3)
        memoryview(values)[0] = 7
        values[-1] = 9
        self.assertEqual((values[0], values[-1], values[-3]), (7, 9, 7))
        for i in (3, -4, 1 << 40):
            with self.assertRaises(IndexError):
                values[i]
            with self.assertRaises(IndexError):
                values[i] = 1
        with self.assertRaises(TypeError):
            values[0] = 0.5

    def test_impossible_sizes(self):
        for kind, _, _ in self.KINDS:
            with self.assertRaisesRegex(ValueError, f"{kind.__name__}.size"):
                kind(-1)
            with self.assertRaisesRegex(TypeError, f"{kind.__name__}.size"):
                kind(1.5)
        with self.assertRaises((MemoryError, ValueError)):
            core.FloatBuffer(1 << 58)

    def test_view_keeps_the_memory(self):
        view = memoryview(core.FloatBuffer(1000))
        view[999] = 0.5
        self.assertEqual(view[999], 0.5)

    def test_blender_fills_them(self):
        mesh = bpy.data.meshes.new("Filled")
        mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 2, 0), (0, 2, 3)], [], [(0, 1, 2, 3)])
        mesh.calc_loop_triangles()
        mesh.polygons[0].use_smooth = True
        mesh.polygons[0].material_index = 5
        positions = core.FloatBuffer(12)
        mesh.vertices.foreach_get('co', positions)
        self.assertEqual(list(positions), [0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 2, 3])
        corners = core.UIntBuffer(4)
        mesh.loops.foreach_get('vertex_index', corners)
        self.assertEqual(list(corners), [0, 1, 2, 3])
        triangles = core.UIntBuffer(6)
        mesh.loop_triangles.foreach_get('loops', triangles)
        self.assertEqual(sorted(set(triangles)), [0, 1, 2, 3])
        for name, kind, expected in (('loop_start', core.IntBuffer, 0),
                                     ('loop_total', core.IntBuffer, 4),
                                     ('material_index', core.IntBuffer, 5),
                                     ('use_smooth', core.ByteBuffer, 1)):
            values = kind(1)
            mesh.polygons.foreach_get(name, values)
            self.assertEqual(values[0], expected, name)

    def test_other_formats_are_filled_too(self):
        mesh = bpy.data.meshes.new("Filled")
        mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 2, 0)], [], [(0, 1, 2)])
        values = core.FloatBuffer(1)
        mesh.polygons.foreach_get('loop_total', values)
        self.assertEqual(values[0], 3)

    def test_foreach_get_copies_at_once(self):
        """Blender takes a buffer of its own element type as a block: no item is ever set."""

        def counting(kind, size):
            class Counting(kind):
                items_set = 0

                def __setitem__(self, index, value):
                    Counting.items_set += 1
                    super().__setitem__(index, value)
            return Counting(size)

        mesh = bpy.data.meshes.new("Small")
        self.addCleanup(bpy.data.meshes.remove, mesh)
        mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 2, 3)], [], [(0, 1, 2)])
        # Other properties have no plain array in Blender: there its getter takes the time.
        for items, name, kind, expected in (
                (mesh.vertices, 'co', core.FloatBuffer, [0, 0, 0, 1, 0, 0, 1, 2, 3]),
                (mesh.loops, 'vertex_index', core.UIntBuffer, [0, 1, 2]),
                (mesh.polygons, 'loop_start', core.IntBuffer, [0])):
            values = counting(kind, len(expected))
            items.foreach_get(name, values)
            self.assertEqual(values.items_set, 0, name)
            self.assertEqual([values[i] for i in range(len(expected))], expected)
        # The count does count: a buffer of another element type is filled item by item.
        wrong = counting(core.FloatBuffer, 3)
        mesh.loops.foreach_get('vertex_index', wrong)
        self.assertEqual(wrong.items_set, 3)


class FieldTest(unittest.TestCase):

    def assert_refused(self, error, pattern, owner, name, value):
        before = getattr(owner, name)
        with self.assertRaisesRegex(error, pattern):
            setattr(owner, name, value)
        self.assertEqual(getattr(owner, name), before)

    def test_values_come_back(self):
        instance = core.InstanceDesc()
        for name, value in (('name', "Alice"), ('mesh', 3), ('worlds', 0xffffffff), ('dream', 4),
                            ('entry', 'BOTH'), ('first_seen_only', True), ('materials', [2, -1]),
                            ('object_to_world', tuple(map(float, range(12)))),
                            ('attributes', {"hue": (1.0, 2.0, 3.0, 4.0)})):
            setattr(instance, name, value)
            self.assertEqual(getattr(instance, name), value, name)

    def test_lists_are_copies(self):
        instance = core.InstanceDesc()
        instance.materials.append(1)
        self.assertEqual(instance.materials, [])

    def test_sequences_of_blender(self):
        light = core.LightDesc()
        light.color = mathutils.Color((0.25, 0.5, 1.0))
        self.assertEqual(light.color, (0.25, 0.5, 1.0))
        instance = core.InstanceDesc()
        instance.generated = mathutils.Vector((1, 2, 3))
        self.assertEqual(instance.generated, (1, 2, 3))
        instance.color = bpy.data.objects.new("Coloured", None).color
        self.assertEqual(instance.color, (1, 1, 1, 1))
        matrix = mathutils.Matrix.Translation((5, 6, 7))
        light.object_to_world = [value for row in matrix[:3] for value in row]
        self.assertEqual(light.object_to_world[3::4], (5, 6, 7))

    def test_wrong_types(self):
        light, mesh = core.LightDesc(), core.MeshDesc()
        self.assert_refused(TypeError, "LightDesc.energy must be a number, not str",
                            light, 'energy', "10")
        self.assert_refused(TypeError, "LightDesc.type must be text, not int", light, 'type', 3)
        self.assert_refused(TypeError, "LightDesc.use_mis", light, 'use_mis', 1)
        self.assert_refused(TypeError, "LightDesc.max_bounces", light, 'max_bounces', 1.0)
        self.assert_refused(TypeError, "LightDesc.color", light, 'color', "red")
        self.assert_refused(TypeError, "LightDesc.color", light, 'color', (1, None, 1))
        self.assert_refused(TypeError, "LightDesc.color", light, 'color', 1.0)
        self.assert_refused(TypeError, "MeshDesc.positions must be FloatBuffer, not IntBuffer",
                            mesh, 'positions', core.IntBuffer(3))
        self.assert_refused(TypeError, "MeshDesc.positions", mesh, 'positions', None)
        self.assert_refused(TypeError, "MeshDesc.attributes", mesh, 'attributes', [mesh])
        self.assert_refused(TypeError, "InstanceDesc.attributes", core.InstanceDesc(),
                            'attributes', [1])
        with self.assertRaisesRegex(TypeError, "LightDesc.graph must be NodeGraph"):
            light.graph = mesh

    def test_wrong_sizes_and_ranges(self):
        instance = core.InstanceDesc()
        self.assert_refused(ValueError, "InstanceDesc.object_to_world needs 12 numbers, not 4",
                            instance, 'object_to_world', mathutils.Matrix())
        self.assert_refused(ValueError, "InstanceDesc.color", instance, 'color', (1, 1, 1))
        self.assert_refused(ValueError, "InstanceDesc.attributes", instance, 'attributes',
                            {"hue": (1, 2)})
        self.assert_refused(ValueError, "InstanceDesc.worlds", instance, 'worlds', -1)
        self.assert_refused(ValueError, "InstanceDesc.mesh", instance, 'mesh', 1 << 31)
        self.assert_refused(ValueError, "InstanceDesc.dream", instance, 'dream', 5)
        self.assert_refused(ValueError, "AttributeDesc.channels", core.AttributeDesc(), 'channels',
                            5)

    def test_wrong_names(self):
        for kind, name in ((core.InstanceDesc, 'entry'), (core.InstanceDesc, 'reentry'),
                           (core.MaterialDesc, 'displacement_method'), (core.LightDesc, 'type'),
                           (core.LightDesc, 'shape'), (core.WorldDesc, 'sampling'),
                           (core.ImageDesc, 'alpha_mode'), (core.CameraDesc, 'type'),
                           (core.CameraDesc, 'sensor_fit'), (core.RenderSettings, 'pixel_filter'),
                           (core.AttributeDesc, 'domain')):
            self.assert_refused(ValueError, rf"{kind.__name__}\.{name} must be one of .*'JABBER'",
                                kind(), name, 'JABBER')
        with self.assertRaises(AttributeError):
            core.LightDesc().colour = (1, 1, 1)

    def test_names_that_are_not_utf8(self):
        tile = core.ImageTileDesc()
        tile.path = os.fsdecode(b"/tmp/\xff.png")
        self.assertEqual(os.fsencode(tile.path), b"/tmp/\xff.png")

    def test_parts_are_references(self):
        material, scene = core.MaterialDesc(), core.SceneDescription()
        material.graph.add_node('ShaderNodeBsdfDiffuse', "Diffuse")
        self.assertEqual(material.graph.node_count, 1)
        scene.settings.width = 77
        self.assertEqual(scene.settings.width, 77)


class SceneTest(unittest.TestCase):

    def test_indices_count_up(self):
        scene = core.SceneDescription()
        for add, kind in ((scene.add_instance, core.InstanceDesc),
                          (scene.add_light, core.LightDesc),
                          (scene.add_material, core.MaterialDesc),
                          (scene.add_world, core.WorldDesc), (scene.add_image, core.ImageDesc)):
            self.assertEqual([add(kind()), add(kind())], [0, 1])
        with self.assertRaises(TypeError):
            scene.add_light(core.WorldDesc())

    def test_buffers_of_a_mesh_must_fit(self):
        def misfit(name, values):
            mesh = triangle()
            setattr(mesh, name, values)
            with self.assertRaisesRegex(ValueError, f"MeshDesc.{name}"):
                core.SceneDescription().add_mesh(mesh)

        misfit('positions', core.FloatBuffer(8))
        misfit('polygon_sizes', core.IntBuffer(2))
        misfit('triangle_corners', core.UIntBuffer(4))
        misfit('material_indices', core.IntBuffer(2))
        misfit('smooth_flags', core.ByteBuffer(2))
        misfit('vertex_normals', core.FloatBuffer(6))
        misfit('corner_normals', core.FloatBuffer(12))
        with self.assertRaisesRegex(ValueError, "MeshDesc.positions is missing"):
            core.SceneDescription().add_mesh(core.MeshDesc())

    def test_attributes_of_a_mesh_must_fit(self):
        for domain, channels, elements in (('POINT', 3, 3), ('CORNER', 2, 3), ('FACE', 4, 1)):
            attribute = core.AttributeDesc()
            attribute.name = "hue"
            attribute.domain, attribute.channels = domain, channels
            for extra in (0, 1):
                attribute.data = core.FloatBuffer(channels * elements + extra)
                mesh = triangle()
                mesh.attributes = [attribute]
                if not extra:
                    self.assertEqual(core.SceneDescription().add_mesh(mesh), 0)
                    continue
                with self.assertRaisesRegex(ValueError, "AttributeDesc.data .'hue'"):
                    core.SceneDescription().add_mesh(mesh)

    def test_pixels_of_an_image_must_fit(self):
        tile = core.ImageTileDesc()
        tile.pixels = core.FloatBuffer(4 * 6)
        tile.width, tile.height = 3, 3
        image = core.ImageDesc()
        image.tiles = [tile]
        with self.assertRaisesRegex(ValueError, "ImageTileDesc.pixels needs 36 values, not 24"):
            core.SceneDescription().add_image(image)
        tile.height = 2
        image.tiles = [tile]
        self.assertEqual(core.SceneDescription().add_image(image), 0)


class NodeGraphTest(unittest.TestCase):

    def setUp(self):
        self.graph = core.NodeGraph()
        self.node = self.graph.add_node('ShaderNodeMath', "Add")

    def test_inputs(self):
        for value in ((1.0,), (1, 2, 3), mathutils.Color((1, 1, 1)), [0, 0, 0, 1]):
            self.graph.set_input(self.node, 'Value', value)
        for value in ((), (1, 2), (1, 2, 3, 4, 5)):
            with self.assertRaisesRegex(ValueError, "ShaderNodeMath.Value needs 1, 3 or 4"):
                self.graph.set_input(self.node, 'Value', value)
        with self.assertRaisesRegex(TypeError, "ShaderNodeMath.Value"):
            self.graph.set_input(self.node, 'Value', 1.0)

    def test_settings(self):
        for value in (True, 7, 0.5, 'ADD', (1.0, 2.0), core.FloatBuffer(256)):
            self.graph.set_setting(self.node, 'operation', value)
        with self.assertRaisesRegex(TypeError, "ShaderNodeMath.operation"):
            self.graph.set_setting(self.node, 'operation', None)
        with self.assertRaisesRegex(ValueError, "ShaderNodeMath.operation"):
            self.graph.set_setting(self.node, 'operation', 1 << 40)

    def test_nodes_must_exist(self):
        other = self.graph.add_node('ShaderNodeMath', "Multiply")
        self.graph.link(self.node, 'Value', other, 'Value_001')
        for call in (lambda: self.graph.link(self.node, 'Value', 2, 'Value'),
                     lambda: self.graph.link(-1, 'Value', other, 'Value'),
                     lambda: self.graph.set_input(9, 'Value', (1,)),
                     lambda: self.graph.set_setting(-1, 'use_clamp', True)):
            with self.assertRaisesRegex(ValueError, "must be a node of the graph, which has 2"):
                call()
