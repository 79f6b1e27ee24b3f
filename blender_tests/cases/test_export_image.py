# SPDX-License-Identifier: GPL-3.0-or-later
"""Images: as files, as pixels, in tiles, missing."""
import os
import tempfile

import bpy
from support import scene_factory
from support.export_case import ExportTestCase


def gradient(x, y):
    return (x / 4.0, y / 2.0, 0.5, 1.0)


class ImageCase(ExportTestCase):

    def setUp(self):
        super().setUp()
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def export_image(self, image, output="Color", **settings):
        """(ImageDesc, node dict) of an Image Texture with `image`."""
        def build(nodes):
            texture = nodes.add("ShaderNodeTexImage", {"image": image, **settings})
            return nodes.add("ShaderNodeEmission", None, {"Color": texture.outputs[output]})
        scene_factory.plane(self.scene, 1.0, scene_factory.node_material("m", build))
        description = self.export()
        node, = description.materials[0].graph.find("ShaderNodeTexImage")
        index = node["settings"].get("image")
        return (None if index is None else description.images[index]), node

    def saved(self, name="picture.png", **settings):
        """An image that lies in a file and is not changed since."""
        image = scene_factory.generated_image("source", 4, 2, gradient)
        image.filepath_raw = os.path.join(self.folder.name, name)
        image.file_format = 'PNG'
        image.save()
        bpy.data.images.remove(image)
        image = bpy.data.images.load(os.path.join(self.folder.name, name))
        for key, value in settings.items():
            setattr(image, key, value)
        return image


class FileTest(ImageCase):

    def test_path_and_colour_space(self):
        image = self.saved(alpha_mode='CHANNEL_PACKED')
        desc, node = self.export_image(image, interpolation='Closest', extension='CLIP')
        tile, = desc.tiles
        self.assertEqual(tile.path, os.path.join(self.folder.name, "picture.png"))
        self.assertIsNone(tile.pixels)
        self.assertEqual((desc.colorspace, desc.is_data, desc.alpha_mode),
                         ("sRGB", False, 'CHANNEL_PACKED'))
        self.assertEqual((node["settings"]["interpolation"], node["settings"]["extension"]),
                         ('Closest', 'CLIP'))

    def test_data(self):
        image = self.saved()
        image.colorspace_settings.name = "Non-Color"
        desc, _ = self.export_image(image)
        self.assertTrue(desc.is_data)

    def test_missing_file_is_reported(self):
        image = self.saved()
        path = os.path.join(self.folder.name, "gone.png")
        image.filepath = path
        desc, _ = self.export_image(image)
        self.assertEqual(desc.tiles, [])
        self.assert_reported("gone.png", "missing", "magenta")

    def test_no_image(self):
        desc, node = self.export_image(None)
        self.assertIsNone(desc)
        self.assertNotIn("image", node["settings"])

    def test_one_description_for_all_users(self):
        image = self.saved()
        for name in ("a", "b"):
            material = scene_factory.node_material(name, lambda nodes: nodes.add(
                "ShaderNodeEmission", None,
                {"Color": nodes.add("ShaderNodeTexImage", {"image": image})}))
            scene_factory.plane(self.scene, 1.0, material)
        self.assertEqual(len(self.export().images), 1)

    def test_udim_tiles(self):
        for number in (1001, 1012):
            self.saved(f"cloth.{number}.png")
        image = bpy.data.images.load(os.path.join(self.folder.name, "cloth.1001.png"))
        image.source = 'TILED'
        image.filepath = os.path.join(self.folder.name, "cloth.<UDIM>.png")
        image.tiles.new(1012)
        image.tiles.new(1003)
        desc, _ = self.export_image(image)
        self.assertEqual([(tile.number, os.path.basename(tile.path)) for tile in desc.tiles],
                         [(1001, "cloth.1001.png"), (1012, "cloth.1012.png")])
        self.assert_reported("cloth.1003.png", "missing")

    def test_sequence_follows_the_frame(self):
        for number in (1, 2, 3):
            self.saved(f"walk.{number:04}.png")
        image = bpy.data.images.load(os.path.join(self.folder.name, "walk.0001.png"))
        image.source = 'SEQUENCE'

        def build(nodes):
            texture = nodes.add("ShaderNodeTexImage", {
                "image": image, "image_user.frame_duration": 3, "image_user.frame_start": 1,
                "image_user.use_auto_refresh": True})
            return nodes.add("ShaderNodeEmission", None, {"Color": texture})
        scene_factory.plane(self.scene, 1.0, scene_factory.node_material("m", build))
        for frame in (1, 3):
            self.scene.frame_set(frame)
            tile, = self.export().images[0].tiles
            self.assertEqual(os.path.basename(tile.path), f"walk.{frame:04}.png")


class PixelTest(ImageCase):

    def assert_gradient(self, tile, places=2):
        self.assertEqual((tile.width, tile.height, len(tile.pixels)), (4, 2, 32))
        for y in range(2):
            for x in range(4):
                start = 4 * (4 * y + x)
                self.assert_close(tile.pixels[start:start + 4], gradient(x, y), places)

    def test_generated(self):
        desc, _ = self.export_image(scene_factory.generated_image("g", 4, 2, gradient))
        self.assert_gradient(desc.tiles[0])
        self.assertEqual((desc.colorspace, desc.is_float), ("sRGB", False))

    def test_float_pixels_are_linear_and_associated(self):
        image = scene_factory.generated_image("g", 4, 2, gradient, float_buffer=True)
        desc, _ = self.export_image(image)
        self.assert_gradient(desc.tiles[0], 5)
        self.assertEqual((desc.is_float, desc.colorspace, desc.alpha_mode),
                         (True, "Linear", 'PREMUL'))

    def test_packed_whose_file_is_gone(self):
        image = self.saved()
        image.pack()
        os.remove(os.path.join(self.folder.name, "picture.png"))
        desc, _ = self.export_image(image)
        self.assert_gradient(desc.tiles[0])
        self.assertEqual(self.report_texts(), [])

    def test_changed_but_not_saved(self):
        image = self.saved()
        image.pixels[0] = 0.75
        image.update()
        desc, _ = self.export_image(image)
        self.assertAlmostEqual(desc.tiles[0].pixels[0], 0.75, 2)

    def test_alpha_switch(self):
        _, node = self.export_image(scene_factory.generated_image("g", 4, 2, gradient))
        self.assertNotIn("alpha_is_linked", node["settings"])
        bpy.data.objects.remove(self.scene.objects[0])
        _, node = self.export_image(scene_factory.generated_image("g", 4, 2, gradient), "Alpha")
        self.assertTrue(node["settings"]["alpha_is_linked"])
