# SPDX-License-Identifier: GPL-3.0-or-later
"""The same bits in the same Blender, from meshes, maps and trees that several threads make."""
import bpy

from support import scene_factory
from support.mirror import MirrorCase
from support.parity import pattern_image
from support.render import TESTED_ENGINE, render


class SameBitsTest(MirrorCase):

    RESOLUTION = (40, 30)

    def subdivided(self, name, material, levels, **placement):
        obj = scene_factory.sphere(self.scene, 0.35, material, 16, 8, name=name, **placement)
        obj.modifiers.new("Subdivision", "SUBSURF").render_levels = levels
        return obj

    def with_custom_normals(self, material, **placement):
        obj = scene_factory.sphere(self.scene, 0.35, material, 48, 24, name="Custom", **placement)
        mesh = obj.data
        mesh.use_auto_smooth = True
        mesh.normals_split_custom_set([
            tuple(mesh.vertices[loop.vertex_index].co.xzy) for loop in mesh.loops])
        return obj

    def textured(self):
        image = pattern_image("pattern")
        return scene_factory.node_material("textured", lambda n: n.add(
            "ShaderNodeBsdfPrincipled", {"distribution": "GGX"}, {
                "Base Color": n.add("ShaderNodeTexImage", {"image": image}, {
                    "Vector": n.add("ShaderNodeTexCoord").outputs["Generated"]}),
                "Roughness": 0.3}))

    def full_room(self):
        """The mirror's room with smooth meshes of every kind, instances and a World to sample."""
        self.room()
        material = self.textured()
        self.subdivided("Smooth", material, 4, location=(-1.2, -0.6, 0.4))
        split = self.subdivided("Split", material, 3, location=(0.0, -0.8, 0.4))
        split.data.use_auto_smooth = True
        split.data.auto_smooth_angle = 0.4
        custom = self.with_custom_normals(material, location=(1.2, -0.6, 0.4))
        group = bpy.data.collections.new("Group")
        group.objects.link(custom)
        for i in range(6):
            instance = scene_factory.link(self.scene, None, f"Instance {i}",
                                          (-2.2 + 0.8 * i, 0.2, 0.9), (20 * i, 10, 0))
            instance.instance_type, instance.instance_collection = "COLLECTION", group
        tree = self.scene.world.node_tree
        noise = scene_factory.Nodes(tree).add("ShaderNodeTexNoise", None, {"Scale": 2.0})
        tree.links.new(noise.outputs["Color"], tree.nodes["Background"].inputs["Color"])

    def test_threads_and_repetition(self):
        self.full_room()
        self.scene.render.threads_mode = "FIXED"
        pictures = []
        for threads in (2, 1, 2):
            self.scene.render.threads = threads
            pictures.append(render(TESTED_ENGINE, 4, 5, self.RESOLUTION))
        self.assertGreater(min(pictures[0].mean()[:3]), 0.05, "nothing is lit")
        self.assert_bitwise_equal(pictures[1], pictures[0], "one thread")
        self.assert_bitwise_equal(pictures[2], pictures[0], "again")
