# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes: topology, normals, materials of faces, attributes, texture space."""
import math

import bpy
from support import scene_factory
from support.export_case import ExportTestCase
from tenniel.export import Cancelled

QUAD_AND_TRIANGLE = ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0.5, 0)],
                     [(0, 1, 2, 3), (1, 4, 2)])


def attributes_of(mesh):
    return {item.name: item for item in mesh.attributes}


class TopologyTest(ExportTestCase):

    def test_arrays_are_those_of_the_mesh(self):
        data = scene_factory.mesh("mixed", *QUAD_AND_TRIANGLE)
        scene_factory.link(self.scene, data)
        mesh, = self.export().meshes
        self.assert_close(mesh.positions, [x for v in QUAD_AND_TRIANGLE[0] for x in v])
        self.assertEqual(list(mesh.corner_vertices), [0, 1, 2, 3, 1, 4, 2])
        self.assertEqual(list(mesh.polygon_starts), [0, 4])
        self.assertEqual(list(mesh.polygon_sizes), [4, 3])
        self.assertEqual(len(mesh.triangle_corners), 9)
        self.assertEqual(set(mesh.triangle_corners[:6]), {0, 1, 2, 3})
        self.assertEqual(set(mesh.triangle_corners[6:]), {4, 5, 6})

    def test_polygon_with_many_corners(self):
        ring = [(math.cos(a / 50 * math.pi), math.sin(a / 50 * math.pi), 0) for a in range(100)]
        scene_factory.link(self.scene, scene_factory.mesh("disc", ring, [range(100)]))
        mesh, = self.export().meshes
        self.assertEqual(len(mesh.triangle_corners), 3 * 98)
        self.assertEqual(list(mesh.polygon_sizes), [100])

    def test_modifiers_are_applied(self):
        obj = scene_factory.plane(self.scene)
        obj.modifiers.new("Array", 'ARRAY').count = 3
        mesh, = self.export().meshes
        self.assertEqual(len(mesh.polygon_starts), 3)

    def test_nothing_to_render_without_faces(self):
        scene_factory.link(self.scene, scene_factory.mesh("none", [], []))
        scene_factory.link(self.scene, scene_factory.mesh("points", [(0, 0, 0), (1, 0, 0)], []))
        description = self.export()
        self.assertEqual((description.meshes, description.instances), ([], []))

    def test_looking_glass_without_faces_is_reported(self):
        obj = scene_factory.link(self.scene, scene_factory.mesh("none", [], []), "Glass")
        obj["looking_glass"] = True
        self.export()
        self.assert_reported("Glass", "without faces")


class CancelTest(ExportTestCase):

    def test_each_array_can_be_the_last(self):
        """One mesh may hold all of a scene: the artist is asked between its arrays."""
        scene_factory.plane(self.scene)
        asked = []
        self.export(test_break=lambda: asked.append(None))
        self.assertGreater(len(asked), 6)
        for last in range(len(asked)):
            answers = iter([False] * last + [True])
            with self.assertRaises(Cancelled):
                self.export(test_break=lambda: next(answers))


class NormalsTest(ExportTestCase):

    def test_flat_mesh_needs_none(self):
        scene_factory.plane(self.scene)
        mesh, = self.export().meshes
        self.assertEqual(list(mesh.smooth_flags), [0])
        self.assertIsNone(mesh.vertex_normals)
        self.assertIsNone(mesh.corner_normals)

    def test_smooth_sphere_leaves_normals_to_the_core(self):
        scene_factory.sphere(self.scene, 2.0)
        mesh, = self.export().meshes
        self.assertTrue(all(mesh.smooth_flags))
        self.assertIsNone(mesh.vertex_normals)
        self.assertIsNone(mesh.corner_normals)

    def test_auto_smooth_has_normals_of_corners(self):
        obj = scene_factory.sphere(self.scene, segments=4, rings=2)
        obj.data.use_auto_smooth = True
        obj.data.auto_smooth_angle = 0.0
        mesh, = self.export().meshes
        corners = [tuple(mesh.corner_normals[i:i + 3])
                   for i in range(0, len(mesh.corner_normals), 3)]
        self.assertEqual(len(corners), len(mesh.corner_vertices))
        # With an angle of 0 every edge is sharp: all corners of a face agree.
        for start, size in zip(mesh.polygon_starts, mesh.polygon_sizes):
            for corner in corners[start:start + size]:
                self.assert_close(corner, corners[start], 4)

    def test_custom_normals_survive(self):
        obj = scene_factory.plane(self.scene)
        tilted = (0.6, 0.0, 0.8)
        obj.data.use_auto_smooth = True
        obj.data.polygons[0].use_smooth = True
        obj.data.normals_split_custom_set([tilted] * 4)
        mesh, = self.export().meshes
        for i in range(0, 12, 3):
            self.assert_close(mesh.corner_normals[i:i + 3], tilted, 2)


    def test_custom_normals_bend_flat_faces(self):
        obj = scene_factory.plane(self.scene)
        obj.data.use_auto_smooth = True
        obj.data.normals_split_custom_set([(0.6, 0.0, 0.8)] * 4)
        obj.data.polygons[0].use_smooth = False
        mesh, = self.export().meshes
        self.assertTrue(all(mesh.smooth_flags))
        for i in range(0, 12, 3):
            self.assert_close(mesh.corner_normals[i:i + 3], (0.6, 0.0, 0.8), 2)


class MaterialIndexTest(ExportTestCase):

    def two_faces(self):
        data = scene_factory.mesh("two", *QUAD_AND_TRIANGLE)
        data.materials.append(scene_factory.diffuse())
        data.polygons[1].material_index = 1
        return scene_factory.link(self.scene, data)

    def test_index_of_each_face(self):
        obj = self.two_faces()
        obj.data.materials.append(scene_factory.emission())
        description = self.export()
        self.assertEqual(list(description.meshes[0].material_indices), [0, 1])
        self.assertEqual(description.instances[0].materials, [0, 1])

    def test_no_array_for_one_slot(self):
        self.two_faces()
        self.assertIsNone(self.export().meshes[0].material_indices)

    def test_empty_slots_get_the_default(self):
        obj = self.two_faces()
        obj.data.materials.append(None)
        self.assertEqual(self.export().instances[0].materials, [0, -1])

    def test_object_without_slots_gets_the_default(self):
        scene_factory.plane(self.scene)
        self.assertEqual(self.export().instances[0].materials, [-1])

    def test_slot_of_the_object_wins(self):
        data = scene_factory.mesh("shared", *QUAD_AND_TRIANGLE, scene_factory.diffuse())
        scene_factory.link(self.scene, data, "a")
        own = scene_factory.link(self.scene, data, "b")
        own.material_slots[0].link = 'OBJECT'
        own.material_slots[0].material = scene_factory.emission()
        description = self.export()
        names = {item.name: description.materials[item.materials[0]].name
                 for item in description.instances}
        self.assertEqual(names, {"a": "Diffuse", "b": "Emission"})
        self.assertEqual(len(description.meshes), 1)


class AttributeTest(ExportTestCase):

    def textured(self, *sources):
        """A plane whose material reads (node type, settings) sources."""
        def build(nodes):
            shader = None
            for node_type, settings in sources:
                source = nodes.add(node_type, settings)
                emission = nodes.add("ShaderNodeEmission", None, {"Color": source.outputs[0]})
                shader = emission if shader is None else nodes.add(
                    "ShaderNodeMixShader", None,
                    {"Shader": shader.outputs[0], "Shader_001": emission.outputs[0]})
            return shader
        return scene_factory.plane(self.scene, 2.0, scene_factory.node_material("m", build))

    def attribute(self, mesh, name, kind, domain, element, values):
        attribute = mesh.attributes.new(name, kind, domain)
        for item, value in zip(attribute.data, values):
            setattr(item, element, value)

    def test_only_what_is_asked_for(self):
        scene_factory.plane(self.scene, 2.0, scene_factory.diffuse())
        self.assertEqual(self.export().meshes[0].attributes, [])

    def test_active_and_named_uv(self):
        obj = self.textured(("ShaderNodeUVMap", {"uv_map": ""}),
                            ("ShaderNodeUVMap", {"uv_map": "second"}))
        second = obj.data.uv_layers.new(name="second")
        second.data.foreach_set("uv", [0.25] * 8)
        found = attributes_of(self.export().meshes[0])
        self.assertEqual(set(found), {"", "second"})
        self.assertEqual((found[""].domain, found[""].channels), ("CORNER", 2))
        self.assertEqual(list(found[""].data), [0, 0, 1, 0, 1, 1, 0, 1])
        self.assertEqual(list(found["second"].data), [0.25] * 8)

    def test_types_and_domains(self):
        cases = {
            "number": ('FLOAT', 'POINT', 'value', [0.5, 1.5, 2.5, -1.0], 1),
            "whole": ('INT', 'POINT', 'value', [1, -2, 30, 4], 1),
            "flag": ('BOOLEAN', 'FACE', 'value', [True], 1),
            "pair": ('FLOAT2', 'CORNER', 'vector', [(1, 2), (3, 4), (5, 6), (7, 8)], 2),
            "arrow": ('FLOAT_VECTOR', 'FACE', 'vector', [(1, 2, 3)], 3),
            "paint": ('FLOAT_COLOR', 'CORNER', 'color', [(0.1, 0.2, 0.3, 0.4)] * 4, 4),
        }
        obj = self.textured(*(("ShaderNodeAttribute", {"attribute_name": name})
                              for name in cases))
        for name, (kind, domain, element, values, _channels) in cases.items():
            self.attribute(obj.data, name, kind, domain, element, values)
        found = attributes_of(self.export().meshes[0])
        self.assertEqual(set(found), set(cases))
        for name, (_kind, domain, _element, values, channels) in cases.items():
            with self.subTest(name):
                flat = [float(x) for v in values for x in (v if channels > 1 else (v,))]
                self.assertEqual((found[name].domain, found[name].channels), (domain, channels))
                self.assert_close(found[name].data, flat)

    def test_byte_colors_become_linear(self):
        obj = self.textured(("ShaderNodeVertexColor", {"layer_name": ""}))
        colors = obj.data.color_attributes.new("Col", 'BYTE_COLOR', 'CORNER')
        for item in colors.data:
            item.color_srgb = (0.5, 1.0, 0.0, 1.0)
        obj.data.color_attributes.render_color_index = 0
        color = attributes_of(self.export().meshes[0])["\x01color"]
        self.assertEqual((color.domain, color.channels), ("CORNER", 4))
        self.assert_close(color.data[:4], (0.2140, 1.0, 0.0, 1.0), 2)

    def test_missing_attribute_is_left_out(self):
        self.textured(("ShaderNodeAttribute", {"attribute_name": "nowhere"}))
        self.assertEqual(self.export().meshes[0].attributes, [])


class TextureSpaceTest(ExportTestCase):

    def deformed(self):
        material = scene_factory.node_material(
            "m", lambda n: n.add("ShaderNodeEmission", None,
                                 {"Color": n.add("ShaderNodeTexChecker")}))
        obj = scene_factory.plane(self.scene, 2.0, material)
        modifier = obj.modifiers.new("Cast", 'CAST')
        modifier.factor = 1.0
        return obj

    def test_of_the_original_mesh(self):
        self.deformed()
        mesh, = self.export().meshes
        self.assertEqual(mesh.texture_space_location, (0.0, 0.0, 0.0))
        # Blender gives a flat axis the size 1.
        self.assertEqual(mesh.texture_space_size, (1.0, 1.0, 1.0))

    def test_undeformed_positions_go_along(self):
        self.deformed()
        mesh, = self.export().meshes
        generated = attributes_of(mesh)["\x01generated"]
        self.assertEqual((generated.domain, generated.channels), ("POINT", 3))
        self.assertEqual(len(generated.data), len(mesh.positions))

    def test_none_without_modifiers(self):
        obj = self.deformed()
        obj.modifiers.clear()
        self.assertEqual(self.export().meshes[0].attributes, [])


class OtherSurfacesTest(ExportTestCase):

    def test_text_curve_surface_and_metaball_come_as_meshes(self):
        text = bpy.data.curves.new("text", 'FONT')
        text.body = "T"
        text.extrude = 0.1
        curve = bpy.data.curves.new("curve", 'CURVE')
        curve.dimensions = '3D'
        curve.bevel_depth = 0.1
        curve.splines.new('POLY').points.add(2)
        for i, point in enumerate(curve.splines[0].points):
            point.co = (i, 0, 0, 1)
        ball = bpy.data.metaballs.new("ball")
        ball.elements.new()
        for data in (text, curve, ball):
            scene_factory.link(self.scene, data)
        description = self.export()
        self.assertEqual({item.name for item in description.instances}, {"text", "curve", "ball"})
        self.assertEqual(len(description.instances), 3)
        for mesh in description.meshes:
            self.assertGreater(len(mesh.polygon_starts), 4)

    def test_hair_curves_without_curves_are_left_out(self):
        scene_factory.link(self.scene, bpy.data.hair_curves.new("Locks"))
        self.assertEqual(self.export().instances, [])

    def test_hair_curves(self):
        bpy.ops.object.curves_random_add()
        obj = bpy.context.object
        obj.name = "Locks"
        description = self.export()
        self.assertEqual([item.name for item in description.instances], ["Locks"])
        mesh = description.meshes[0]
        self.assertEqual((mesh.shape, len(mesh.strand_sizes)), ('RIBBONS', len(obj.data.curves)))
        self.assertEqual(len(mesh.positions), 3 * sum(mesh.strand_sizes))
        self.assertEqual(len(mesh.radii), sum(mesh.strand_sizes))
