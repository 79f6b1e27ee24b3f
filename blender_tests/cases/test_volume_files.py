# SPDX-License-Identifier: GPL-3.0-or-later
"""Volume objects, from OpenVDB files and from modifiers, against Cycles; and files that are bad."""
import pathlib
import shutil
import tempfile

import bpy
from support import scene_factory, volume_files
from support.export_case import ExportTestCase
from support.render import TESTED_ENGINE, render
from support.volume_case import VolumeCase, volume


def attribute_volume(name, node="ShaderNodeVolumeAbsorption", factor=1.0):
    """A material whose density is the grid of that name, times a factor."""
    def build(nodes):
        grid = nodes.add("ShaderNodeAttribute", {"attribute_name": name})
        scaled = nodes.add("ShaderNodeMath", {"operation": "MULTIPLY"},
                           {0: grid.outputs["Fac"], 1: factor})
        return nodes.add(node, None, {"Color": (0.3, 0.6, 0.8), "Density": scaled})
    return scene_factory.volume_material(name, build)


def glowing_smoke(nodes):
    """Smoke that also emits where it is dense."""
    info = nodes.add("ShaderNodeVolumeInfo")
    return nodes.add("ShaderNodeVolumePrincipled", None, {
        "Density": 2.0, "Emission Strength": info.outputs["Density"]})


class FileCase(VolumeCase):

    def setUp(self):
        super().setUp()
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def noise_file(self):
        path = self.folder / "noise.vdb"
        made = volume_files.made_volume(self.scene)
        volume_files.save(made, path)
        bpy.data.objects.remove(made)
        return path

    def add_noise(self, material, space="OBJECT", **placement):
        placement.setdefault("rotation", (0, 0, 25))
        return volume_files.volume_from_file(self.scene, self.noise_file(), material, space,
                                             **placement)


class FileTest(FileCase):

    def test_materials(self):
        makers = {"default": lambda: None,
                  "principled": volume("ShaderNodeVolumePrincipled", Density=3.0, Anisotropy=0.4,
                                       Color=(0.8, 0.5, 0.3)),
                  "attribute": lambda: attribute_volume("density", factor=3.0)}
        for name, make in makers.items():
            with self.subTest(name):
                self.setUp()
                self.room()
                self.add_noise(make())
                self.agrees(name, volume_bounces=2)

    def test_density_in_object_and_world_space(self):
        for space in ("OBJECT", "WORLD"):
            with self.subTest(space):
                self.setUp()
                self.room()
                self.add_noise(scene_factory.volume_material("glow", glowing_smoke), space,
                               scale=(1.6, 0.8, 0.5))
                self.agrees(space)

    def test_several_grids(self):
        """Smoke, fire and motion, numbers and vectors, as Blender stores its own simulations."""
        def build(nodes):
            red = nodes.add("ShaderNodeAttribute", {"attribute_name": "color_r"})
            speed = nodes.add("ShaderNodeAttribute", {"attribute_name": "velocity"})
            info = nodes.add("ShaderNodeVolumeInfo")
            smoke = nodes.add("ShaderNodeVolumePrincipled", None, {
                "Density": 2.0, "Blackbody Intensity": 1.0, "Temperature": 500.0,
                "Color": red.outputs["Color"]})
            fire = nodes.add("ShaderNodeEmission", None, {
                "Color": (1.0, 0.5, 0.2), "Strength": info.outputs["Flame"]})
            squared = nodes.add("ShaderNodeVectorMath", {"operation": "MULTIPLY"},
                                {0: speed.outputs["Vector"], 1: speed.outputs["Vector"]})
            # Not at the border, where Cycles lets vectors end without fading.
            inside = nodes.add("ShaderNodeMath", {"operation": "SUBTRACT", "use_clamp": True},
                               {0: info.outputs["Density"], 1: 0.15})
            motion = nodes.add("ShaderNodeEmission", None, {"Color": squared, "Strength": inside})
            both = nodes.add("ShaderNodeAddShader", None, {0: smoke, 1: fire})
            return nodes.add("ShaderNodeAddShader", None, {0: both, 1: motion})
        cache = self.smoke(lambda nodes: nodes.add("ShaderNodeVolumePrincipled"))
        for obj in list(self.scene.objects):
            bpy.data.objects.remove(obj)
        self.room()
        volume_files.volume_from_file(
            self.scene, cache / "fluid_data_0005.vdb", scene_factory.volume_material("all", build),
            location=(-1.2, -0.9, -1.0), scale=(1.2, 1.0, 1.0))
        self.agrees("several grids", volume_bounces=1)

    def test_sequence(self):
        cache = self.smoke(lambda nodes: nodes.add("ShaderNodeVolumePrincipled"))
        for obj in list(self.scene.objects):
            bpy.data.objects.remove(obj)
        self.room()
        smoke = volume_files.volume_from_file(
            self.scene, cache / "fluid_data_0001.vdb", attribute_volume("density", factor=3.0),
            location=(-1.2, -0.9, -1.0), scale=(1.2, 1.0, 1.0))
        smoke.data.is_sequence = True
        smoke.data.frame_duration = 5
        self.scene.frame_set(4)
        self.agrees("frame 4")

    def test_cubic_interpolation(self):
        self.room()
        material = attribute_volume("density", factor=5.0)
        material.cycles.volume_interpolation = 'CUBIC'
        self.add_noise(material)
        self.agrees("cubic")

    def test_instances(self):
        self.room()
        first = self.add_noise(attribute_volume("density", factor=4.0), scale=(0.5, 0.5, 0.5),
                               location=(-0.8, 0, 0))
        scene_factory.link(self.scene, first.data, "Second", location=(0.8, 0, 0.4),
                           rotation=(20, 50, 0), scale=(0.4, 0.4, 0.6))
        self.agrees("instances")


class MadeTest(FileCase):

    def test_geometry_nodes(self):
        self.room()
        made = volume_files.made_volume(self.scene, rotation=(0, 0, 25))
        made.data.materials.append(attribute_volume("density", factor=3.0))
        self.agrees("made")

    def test_solid_inside(self):
        """What lies deep inside is not stored voxel by voxel."""
        self.room()
        ball = scene_factory.sphere(self.scene, 1.1)
        ball.hide_render = True
        solid = volume_files.solid_volume(self.scene, ball, voxel=0.04)
        solid.data.materials.append(attribute_volume("density", factor=0.8))
        self.agrees("solid")


class DescriptionTest(ExportTestCase):

    def test_users_share_box_and_grids(self):
        made = volume_files.made_volume(self.scene, resolution=(8, 8, 8))
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        volume_files.save(made, folder / "small.vdb")
        bpy.data.objects.remove(made)
        first = volume_files.volume_from_file(self.scene, folder / "small.vdb")
        scene_factory.link(self.scene, first.data, "Second")
        description = self.export()
        self.assertEqual([item.grids for item in description.instances], [[0], [0]])
        self.assertEqual((len(description.meshes), len(description.grids)), (1, 1))
        self.assertEqual(description.grids[0].path, str(folder / "small.vdb"))

    def test_made_volumes_are_saved_for_the_core(self):
        volume_files.made_volume(self.scene, resolution=(8, 8, 8))
        path = pathlib.Path(self.export().grids[0].path)
        self.assertTrue(path.is_file())
        self.assertIn(pathlib.Path(bpy.app.tempdir), path.parents)


class BadFileTest(FileCase):

    def render_bad(self, path, *words, grid="density"):
        """A picture of the World without the volume, and a report that has all of `words`."""
        scene_factory.set_world(self.scene, (0.25, 0.25, 0.25))
        scene_factory.top_camera(self.scene, 2.0)
        volume_files.volume_from_file(self.scene, path, attribute_volume(grid))
        picture = render(TESTED_ENGINE, 4, 0, (8, 8))
        self.assert_pixel(picture, 4, 4, (0.25, 0.25, 0.25))
        if TESTED_ENGINE == "TENNIEL":
            from tenniel import reports
            text = "\n".join(f"{row.where()}: {row.text}" for row in reports.rows())
            for word in words:
                self.assertIn(word, text)

    def test_missing(self):
        self.render_bad(self.folder / "absent.vdb", "File", "cannot be read", "absent.vdb")

    def test_no_volume(self):
        path = self.folder / "text.vdb"
        path.write_text("This is no volume.")
        self.render_bad(path, "File", "cannot be read")

    def test_grid_that_no_material_reads(self):
        self.render_bad(self.noise_file(), "File", "No material reads", "'density'", grid="smoke")

    def test_view_layer_without_volumes(self):
        self.scene.view_layers[0].use_volumes = False
        self.render_bad(self.noise_file())
