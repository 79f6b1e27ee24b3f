# SPDX-License-Identifier: GPL-3.0-or-later
"""Instances of every origin, visibility, the magic mirror tags, worlds and lamps."""
import bpy
from mathutils import Matrix
from support import scene_factory
from support.export_case import ExportTestCase
from support.render import REFERENCE_ENGINE, render
from tenniel.export import Cancelled, View

ALL_WORLDS = 0b11111
DREAMS = 0b11110
ALL_KINDS = 0b111111


class OriginTest(ExportTestCase):

    def test_linked_duplicates_share_their_mesh(self):
        data = scene_factory.plane(self.scene).data
        for i in range(3):
            scene_factory.link(self.scene, data, location=(i, 0, 0))
        description = self.export()
        self.assertEqual(len(description.meshes), 1)
        self.assertEqual([item.mesh for item in description.instances], [0] * 4)

    def test_matrix_rows(self):
        obj = scene_factory.plane(self.scene, location=(1, 2, 3), scale=(2, -1, 1))
        expected = Matrix.Translation((1, 2, 3)) @ Matrix.Diagonal((2, -1, 1, 1))
        instance, = self.export().instances
        self.assertEqual(obj.name, instance.name)
        self.assert_close(instance.object_to_world, [x for row in expected[:3] for x in row])

    def test_collection_instances(self):
        collection = bpy.data.collections.new("Set")
        obj = bpy.data.objects.new("Part", scene_factory.plane(self.scene).data)
        collection.objects.link(obj)
        for i in range(2):
            empty = scene_factory.link(self.scene, None, f"Empty {i}", location=(0, 0, 5 + i))
            empty.instance_type = 'COLLECTION'
            empty.instance_collection = collection
        description = self.export()
        parts = [item for item in description.instances if item.name == "Part"]
        self.assertEqual(sorted(item.object_to_world[11] for item in parts), [5.0, 6.0])
        self.assertEqual(len(description.meshes), 1)
        self.assertEqual(len({item.random for item in parts}), 2)

    def test_vertices_and_hidden_instancer(self):
        child = scene_factory.plane(self.scene, 0.1, name="Child")
        parent = scene_factory.plane(self.scene, 2.0, name="Parent")
        child.parent = parent
        parent.instance_type = 'VERTS'
        # The child itself is rendered too.
        names = [item.name for item in self.export().instances]
        self.assertEqual((names.count("Child"), names.count("Parent")), (4 + 1, 1))
        parent.show_instancer_for_viewport = False
        names = [item.name for item in self.export().instances]
        self.assertEqual((names.count("Child"), names.count("Parent")), (4 + 1, 0))

    def test_particles(self):
        child = scene_factory.plane(self.scene, 0.1, name="Leaf")
        emitter = scene_factory.plane(self.scene, 2.0, name="Tree")
        modifier = emitter.modifiers.new("Particles", 'PARTICLE_SYSTEM')
        settings = modifier.particle_system.settings
        settings.type = 'HAIR'
        settings.count = 7
        settings.render_type = 'OBJECT'
        settings.instance_object = child
        names = [item.name for item in self.export().instances]
        self.assertEqual(names.count("Leaf"), 7 + 1)

    def test_geometry_nodes(self):
        tree = bpy.data.node_groups.new("Scatter", 'GeometryNodeTree')
        tree.inputs.new('NodeSocketGeometry', "Geometry")
        tree.outputs.new('NodeSocketGeometry', "Geometry")
        source = tree.nodes.new('NodeGroupInput')
        scatter = tree.nodes.new('GeometryNodeInstanceOnPoints')
        cube = tree.nodes.new('GeometryNodeMeshCube')
        output = tree.nodes.new('NodeGroupOutput')
        tree.links.new(source.outputs[0], scatter.inputs["Points"])
        tree.links.new(cube.outputs["Mesh"], scatter.inputs["Instance"])
        tree.links.new(scatter.outputs["Instances"], output.inputs[0])
        obj = scene_factory.plane(self.scene)
        obj.modifiers.new("Nodes", 'NODES').node_group = tree
        description = self.export()
        self.assertEqual(len(description.instances), 4)
        self.assertEqual(len(description.meshes), 1)
        self.assertEqual(len(description.meshes[0].polygon_starts), 6)

    def test_random_number_is_that_of_the_reference(self):
        material = scene_factory.node_material(
            "m", lambda n: n.add("ShaderNodeEmission", None,
                                 {"Color": n.add("ShaderNodeObjectInfo").outputs["Random"]}))
        for i, name in enumerate(("Plane", "Gl\u00e4schen", "\u955c", "x" * 60)):
            scene_factory.plane(self.scene, 0.9, material, name, location=(i, 0, 0))
        scene_factory.top_camera(self.scene, 4.0, (1.5, 0))
        expected = {item.object_to_world[3]: item.random for item in self.export().instances}
        picture = render(REFERENCE_ENGINE, samples=1, resolution=(16, 4))
        for x, random in expected.items():
            self.assertAlmostEqual(picture.pixel(int(4 * x) + 2, 2)[0], random, places=5)

    def test_failure_costs_one_object(self):
        good = scene_factory.plane(self.scene, name="Good")
        scene_factory.sphere(self.scene, name="Bad")
        wanted = len(good.data.vertices) * 3
        allocate = self.core.FloatBuffer

        def fail(size):
            if size != wanted:
                raise MemoryError("no room")
            return allocate(size)
        self.core.FloatBuffer = fail
        names = [item.name for item in self.export().instances]
        self.assertEqual(names, ["Good"])
        self.assert_reported("Bad", "left out", "no room")

    def test_smoke_without_voxels_is_reported_and_no_box(self):
        scene_factory.box(self.scene, name="Cup")
        domain = scene_factory.box(self.scene, name="Smoke").modifiers.new("Fluid", 'FLUID')
        domain.fluid_type = 'DOMAIN'
        domain.domain_settings.domain_type = 'GAS'
        self.assertEqual([item.name for item in self.export().instances], ["Cup"])
        self.assert_reported("nothing at this frame")
        domain.domain_settings.domain_type = 'LIQUID'
        self.assertEqual(len(self.export().instances), 2)

    def test_cancel(self):
        scene_factory.plane(self.scene)
        with self.assertRaises(Cancelled):
            self.export(test_break=lambda: True)


class VisibilityTest(ExportTestCase):

    def test_ray_kinds(self):
        flags = ("camera", "diffuse", "glossy", "transmission", "volume_scatter", "shadow")
        obj = scene_factory.plane(self.scene)
        self.assertEqual(self.export().instances[0].ray_kinds, ALL_KINDS)
        for bit, flag in enumerate(flags):
            setattr(obj, f"visible_{flag}", False)
            self.assertEqual(self.export().instances[0].ray_kinds, ALL_KINDS & ~(1 << bit), flag)
            setattr(obj, f"visible_{flag}", True)

    def test_seen_by_nothing_is_left_out(self):
        obj = scene_factory.plane(self.scene)
        for name in dir(obj):
            if name.startswith("visible_") and isinstance(getattr(obj, name), bool):
                setattr(obj, name, False)
        self.assertEqual(self.export().instances, [])

    def test_collections_of_the_view_layer(self):
        collection = bpy.data.collections.new("Layer")
        self.scene.collection.children.link(collection)
        collection.objects.link(bpy.data.objects.new(
            "Plane", scene_factory.mesh("m", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])))
        layer = self.scene.view_layers[0].layer_collection.children["Layer"]
        layer.indirect_only = True
        self.assertEqual(self.export().instances[0].ray_kinds, ALL_KINDS & ~1)
        layer.indirect_only = False
        layer.holdout = True
        self.assertTrue(self.export().instances[0].is_holdout)
        layer.exclude = True
        self.assertEqual(self.export().instances, [])

    def test_holdout_of_the_object(self):
        scene_factory.plane(self.scene).is_holdout = True
        self.assertTrue(self.export().instances[0].is_holdout)

    def test_material_override(self):
        scene_factory.plane(self.scene, 1.0, scene_factory.diffuse())
        self.scene.view_layers[0].material_override = scene_factory.emission()
        description = self.export()
        self.assertEqual([item.name for item in description.materials], ["Emission"])

    def test_object_info(self):
        obj = scene_factory.plane(self.scene)
        obj.color = (0.1, 0.2, 0.3, 0.4)
        obj.pass_index = 7
        instance, = self.export().instances
        self.assert_close(instance.color, (0.1, 0.2, 0.3, 0.4))
        self.assertEqual(instance.pass_index, 7)


class MirrorTest(ExportTestCase):

    def test_untagged(self):
        scene_factory.plane(self.scene)
        instance, = self.export().instances
        self.assertEqual((instance.worlds, instance.dream), (ALL_WORLDS, 0))
        self.assertEqual(instance.behind_materials, [])

    def test_sides(self):
        obj = scene_factory.plane(self.scene)
        for side, dreams, expected in (('BEHIND', set(), DREAMS), ('BEHIND', {'2', '4'}, 0b10100),
                                       ('THIS_SIDE', set(), 1), ('BOTH', set(), ALL_WORLDS)):
            obj.tenniel.side, obj.tenniel.dreams = side, dreams
            self.assertEqual(self.export().instances[0].worlds, expected)

    def test_looking_glass(self):
        clear = scene_factory.simple_material("ShaderNodeBsdfTransparent")
        tags = scene_factory.plane(self.scene, 2.0, clear).tenniel
        for number in range(2):
            self.scene.tenniel.dreams.add().name = f"Dream {number}"
        tags.looking_glass, tags.dream, tags.entry = True, 2, 'TRANSMISSION'
        tags.reenter, tags.first_seen_only = 'TOGGLE', True
        instance, = self.export().instances
        self.assertEqual((instance.dream, instance.entry, instance.reentry,
                          instance.first_seen_only), (2, 'TRANSMISSION', 'TOGGLE', True))
        self.assertEqual(self.report_texts(), [])

    def test_dream_without_entry_falls_back(self):
        obj = scene_factory.plane(self.scene, name="Glass")
        obj.tenniel.looking_glass, obj.tenniel.dream = True, 3
        self.assertEqual(self.export().instances[0].dream, 1)
        self.assert_reported("Glass", "no dream 3")

    def test_custom_properties(self):
        scene_factory.plane(self.scene, name="Glass")["looking_glass"] = 1
        scene_factory.plane(self.scene, name="Ghost")["behind_mirror"] = True
        found = {item.name: item for item in self.export().instances}
        self.assertEqual(found["Glass"].dream, 1)
        self.assertEqual(found["Ghost"].worlds, DREAMS)

    def test_behind_without_looking_glass_is_reported(self):
        scene_factory.plane(self.scene, name="Ghost").tenniel.side = 'BEHIND'
        self.export()
        self.assert_reported("Ghost", "no looking glass")

    def test_many_behind_without_looking_glass_are_summed_up(self):
        for number in range(20):
            scene_factory.plane(self.scene, name=f"Ghost {number:02}").tenniel.side = 'BEHIND'
        self.export()
        self.assert_reported("Ghost 00", "no looking glass")
        self.assert_reported("12 more objects")
        self.assertEqual(len(self.report_texts()), 9)

    def test_behind_materials(self):
        front, back = scene_factory.diffuse(), scene_factory.emission()
        obj = scene_factory.plane(self.scene, 1.0, front)
        front.tenniel.behind_material = back
        description = self.export()
        instance, = description.instances
        names = [description.materials[i].name for i in
                 instance.materials + instance.behind_materials]
        self.assertEqual(names, ["Diffuse", "Emission"])
        obj.tenniel.behind_material = scene_factory.mirror()
        description = self.export()
        behind = description.instances[0].behind_materials
        self.assertEqual(description.materials[behind[0]].name, "Mirror")

    def test_instancer_overrides_its_instances(self):
        collection = bpy.data.collections.new("Set")
        part = bpy.data.objects.new("Part", scene_factory.plane(self.scene, name="P").data)
        part.tenniel.side = 'THIS_SIDE'
        collection.objects.link(part)
        for name, side in (("Both", 'BOTH'), ("Behind", 'BEHIND')):
            empty = scene_factory.link(self.scene, None, name, location=(len(name), 0, 0))
            empty.instance_type, empty.instance_collection = 'COLLECTION', collection
            empty.tenniel.side = side
        worlds = {item.object_to_world[3]: item.worlds for item in self.export().instances
                  if item.name == "Part"}
        self.assertEqual(worlds, {4.0: 1, 6.0: DREAMS})

    def test_viewport_of_this_side_has_ordinary_mirrors(self):
        scene_factory.plane(self.scene).tenniel.looking_glass = True
        self.scene.tenniel.mirror_view = 'THIS_SIDE'
        viewport = View(64, 32, is_viewport=True)
        self.assertEqual(self.export(viewport).instances[0].dream, 0)
        self.assertEqual(self.export().instances[0].dream, 1)
        self.scene.tenniel.mirror_view = 'DREAM_3'
        self.assertEqual(self.export(viewport).settings.start_world, 3)

    def test_worlds_of_the_dreams(self):
        for name, world in (("First", None), ("Second", bpy.data.worlds.new("Night"))):
            dream = self.scene.tenniel.dreams.add()
            dream.name, dream.world = name, world
        day = self.scene.world.name
        self.assertEqual([item.name for item in self.export().worlds], [day, day, "Night"])


class InstanceAttributeTest(ExportTestCase):

    def instance_with(self, kind, name, prepare):
        material = scene_factory.node_material(
            "m", lambda n: n.add("ShaderNodeEmission", None, {"Color": n.add(
                "ShaderNodeAttribute", {"attribute_type": kind, "attribute_name": name})}))
        prepare(scene_factory.plane(self.scene, 1.0, material))
        description = self.export()
        node, = description.materials[0].graph.find("ShaderNodeAttribute")
        key = node["settings"]["attribute_name"]
        return description.instances[0].attributes.get(key)

    def test_custom_property(self):
        def prepare(obj):
            obj["tint"] = [0.1, 0.2, 0.3]
        self.assert_close(self.instance_with('OBJECT', "tint", prepare), (0.1, 0.2, 0.3, 1.0))

    def test_rna_path(self):
        def prepare(obj):
            obj.location = (1.0, 2.0, 3.0)
        self.assert_close(self.instance_with('OBJECT', "location", prepare), (1, 2, 3, 1))

    def test_view_layer_falls_back_to_the_scene(self):
        self.scene["mood"] = 0.75
        value = self.instance_with('VIEW_LAYER', "mood", lambda obj: None)
        self.assert_close(value, (0.75, 0.75, 0.75, 1.0))

    def test_missing(self):
        self.assertIsNone(self.instance_with('OBJECT', "nothing", lambda obj: None))

    def test_mirror_attributes_keep_their_names(self):
        def build(nodes):
            source = nodes.add("ShaderNodeAttribute", {"attribute_type": 'OBJECT',
                                                       "attribute_name": "behind_mirror"})
            return nodes.add("ShaderNodeEmission", None, {"Color": source})
        graph = self.material_graph(scene_factory.node_material("m", build))
        node, = graph.find("ShaderNodeAttribute")
        self.assertEqual(node["settings"]["attribute_name"], "behind_mirror")


class LightTest(ExportTestCase):

    def test_values(self):
        scene_factory.lamp(self.scene, "AREA", 40.0, (0, 0, 3), size=2.0, shape='RECTANGLE',
                           size_y=0.5, color=(1.0, 0.5, 0.25))
        light, = self.export().lights
        self.assertEqual((light.type, light.energy, light.shape), ("AREA", 40.0, "RECTANGLE"))
        self.assertEqual((light.size_x, light.size_y), (2.0, 0.5))
        self.assert_close(light.color, (1.0, 0.5, 0.25))
        self.assertEqual(light.object_to_world[11], 3.0)

    def test_square_uses_one_size(self):
        scene_factory.lamp(self.scene, "AREA", 1.0, size=2.0, size_y=0.5)
        light, = self.export().lights
        self.assertEqual((light.size_x, light.size_y), (2.0, 2.0))

    def test_default_lamp_is_not_seen_by_the_camera(self):
        scene_factory.lamp(self.scene, "POINT", 1.0).visible_camera = False
        self.assertEqual(self.export().lights[0].ray_kinds, ALL_KINDS & ~1)

    def test_nodes(self):
        lamp = scene_factory.lamp(self.scene, "SPOT", 1.0).data
        lamp.use_nodes = True
        graph = self.export().lights[0].graph
        emission, = graph.find("ShaderNodeEmission")
        self.assertEqual(graph.nodes[graph.output]["type"], "ShaderNodeOutputLight")
        self.assertEqual(graph.source(graph.nodes[graph.output], "Surface"),
                         (emission, "Emission"))

    def test_portals_give_no_light(self):
        scene_factory.lamp(self.scene, "AREA", 10.0).data.cycles.is_portal = True
        self.assertEqual(self.export().lights, [])

    def test_side(self):
        scene_factory.lamp(self.scene, "POINT", 1.0).tenniel.side = 'BEHIND'
        self.assertEqual(self.export().lights[0].worlds, DREAMS)


class WorldTest(ExportTestCase):

    def test_color_without_nodes(self):
        self.scene.world = bpy.data.worlds.new("Plain")
        self.scene.world.color = (0.1, 0.2, 0.3)
        world, = self.export().worlds
        self.assert_close(world.color, (0.1, 0.2, 0.3))
        self.assertEqual(world.graph.node_count, 0)

    def test_no_world_is_black(self):
        self.scene.world = None
        world, = self.export().worlds
        self.assertEqual((world.color, world.graph.node_count), ((0.0, 0.0, 0.0), 0))

    def test_tree_without_output_is_black(self):
        self.scene.world = bpy.data.worlds.new("Cut")
        self.scene.world.use_nodes = True
        self.scene.world.node_tree.nodes.clear()
        world, = self.export().worlds
        self.assertEqual([node["type"] for node in world.graph.nodes], ["ShaderNodeOutputWorld"])

    def test_ray_kinds(self):
        self.scene.world.cycles_visibility.glossy = False
        self.assertEqual(self.export().worlds[0].ray_kinds, ALL_KINDS & ~4)
