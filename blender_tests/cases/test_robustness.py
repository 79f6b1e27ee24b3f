# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input: Blender survives, the user reads what was wrong, the rest of the picture is right."""
import math
import os
import struct
import tempfile
import zlib

import bpy

from support import scene_factory
from support.case import RenderTestCase
from support.render import TESTED_ENGINE, RenderFailure, prepare, render
from support.tile_grid import emission_of

MAGENTA = (1.0, 0.0, 1.0)
GOOD = (0.25, 0.5, 0.75)


class BadInputCase(RenderTestCase):
    """A good emissive plane fills the left of the picture; the right half is for trouble."""

    def setUp(self):
        super().setUp()
        scene_factory.plane(self.scene, 2.0, scene_factory.emission(GOOD), "Good",
                            location=(-1.0, 0, 0))
        scene_factory.top_camera(self.scene, 4.0)

    def render_bad(self, expect_report=(), samples=4, **settings):
        """Render; the good half must be right, all values finite, each word reported."""
        picture = render(TESTED_ENGINE, samples, 0, (16, 8), **settings)
        self.assert_pixel(picture, 3, 4, GOOD)
        self.assertTrue(all(math.isfinite(v) for v in picture.rgba), "not all values are finite")
        self.assert_reported(expect_report)
        return picture

    def assert_reported(self, words):
        """Each of `words` occurs in the report of the last render (Tenniel only)."""
        if TESTED_ENGINE != "TENNIEL":
            return
        from tenniel import reports
        text = "\n".join(f"{row.where()}: {row.text}" for row in reports.rows())
        for word in words:
            self.assertIn(word.lower(), text.lower())

    def bad_mesh(self, vertices, faces, material=None, edges=()):
        data = bpy.data.meshes.new("Bad")
        data.from_pydata(vertices, edges, faces)
        data.materials.append(material or scene_factory.diffuse())
        return scene_factory.link(self.scene, data, "Bad", location=(1, 0, 0))


class SceneTest(BadInputCase):

    def test_no_camera(self):
        self.scene.camera = None
        with self.assertRaisesRegex(RenderFailure, "(?i)camera"):
            render(TESTED_ENGINE, 1)

    def test_camera_that_is_no_camera(self):
        self.scene.camera = self.scene.objects["Good"]
        try:
            render(TESTED_ENGINE, 1)
        except RenderFailure as failure:
            self.assertIn("camera", str(failure).lower())

    def test_no_mesh(self):
        bpy.data.objects.remove(self.scene.objects["Good"])
        scene_factory.set_world(self.scene, GOOD)
        self.assert_pixel(render(TESTED_ENGINE, 1), 3, 3, GOOD)

    def test_nothing_at_all(self):
        bpy.data.objects.remove(self.scene.objects["Good"])
        self.scene.world = None
        self.assertEqual(render(TESTED_ENGINE, 1).mean()[:3], (0.0, 0.0, 0.0))

    def test_one_pixel(self):
        self.scene.render.resolution_percentage = 10
        picture = render(TESTED_ENGINE, 1, 0, (10, 10))
        self.assertEqual((picture.width, picture.height), (1, 1))

    def test_tiny_border(self):
        self.scene.render.use_border = self.scene.render.use_crop_to_border = True
        self.scene.render.border_min_x, self.scene.render.border_max_x = 0.2, 0.2001
        self.scene.render.border_min_y, self.scene.render.border_max_y = 0.5, 0.5001
        try:
            render(TESTED_ENGINE, 1, 0, (16, 8))
        except RenderFailure as failure:
            self.assertTrue(str(failure))

    def test_many_instances(self):
        dots = [(1 + 0.008 * (i % 100), -0.4 + 0.008 * (i // 100), 0) for i in range(10000)]
        parent = scene_factory.link(self.scene, scene_factory.mesh("Dots", dots, []))
        parent.instance_type = "VERTS"
        child = scene_factory.plane(self.scene, 0.01, scene_factory.emission((1, 1, 1)))
        child.parent = parent
        picture = self.render_bad(samples=16)
        self.assertGreater(picture.mean(8, 0, 16, 8)[0], 0.05)


class MeshTest(BadInputCase):

    def test_empty_and_flat_meshes(self):
        self.bad_mesh([], [])
        self.bad_mesh([(0, 0, 0)], [])
        self.bad_mesh([(0, 0, 0), (1, 0, 0)], [], edges=[(0, 1)])
        self.bad_mesh([(0, 0, 0)] * 4, [(0, 1, 2, 3)])
        self.bad_mesh([(0, 0, 0), (0.5, 0, 0), (1, 0, 0)], [(0, 1, 2)])
        self.render_bad()

    def test_degenerate_light(self):
        """Zero-area faces of an emissive mesh get no light samples and do no harm."""
        glow = scene_factory.emission((1, 1, 1), 5.0)
        scene_factory.plane(self.scene, 1.0, scene_factory.diffuse(), location=(1, 0, 0))
        self.bad_mesh([(0, 0, 1)] * 3 + [(0, 0, 1), (0.2, 0, 1), (0.1, 0.2, 1)],
                      [(0, 1, 2), (3, 4, 5)], glow)
        self.bad_mesh([(0, 0, 1)] * 3, [(0, 1, 2)], glow)
        picture = self.render_bad(samples=64)
        self.assertGreater(picture.pixel(12, 2)[0], 0.0)

    def test_values_that_are_no_numbers(self):
        nan, inf = math.nan, math.inf
        for value in (nan, inf, 1e30, 3e38, 1e-30):
            with self.subTest(value):
                self.setUp()
                self.bad_mesh([(0, 0, 0), (value, 0, 0), (0, value, 0), (0, 0.5, 0)],
                              [(0, 1, 2), (0, 2, 3)])
                report = ("Bad",) if value in (inf,) or value != value else ()
                self.render_bad(report)

    def test_emissive_values_that_are_no_numbers(self):
        self.bad_mesh([(0, 0, 1), (math.nan, 0, 1), (0, 1, 1), (0.1, 0, 1), (0.3, 0, 1),
                       (0.2, 0.2, 1)], [(0, 1, 2), (3, 4, 5)], scene_factory.emission((1, 1, 1)))
        self.render_bad()

    def test_far_away(self):
        self.scene.objects["Good"].location.x = 1e7
        scene_factory.top_camera(self.scene, 4.0, (1e7 + 1.0, 0.0))
        self.assert_pixel(render(TESTED_ENGINE, 1, 0, (16, 8)), 3, 4, GOOD)

    def test_scale(self):
        for scale in ((0, 0, 0), (1, 0, 1), (1, 1, 0), (-1, 1, 1), (-1, -1, -1), (1e-20,) * 3,
                      (math.nan, 1, 1)):
            with self.subTest(scale):
                self.setUp()
                scene_factory.sphere(self.scene, 0.5, scene_factory.emission((1, 1, 1)),
                                     location=(1, 0, 0), scale=scale)
                picture = self.render_bad()
                if abs(scale[0] * scale[1]) == 1.0 and scale[2]:
                    self.assertGreater(picture.pixel(12, 4)[0], 0.5)

    def test_scaled_lamp(self):
        for scale in ((0, 0, 0), (0, 1, 1), (math.nan, 1, 1)):
            with self.subTest(scale):
                self.setUp()
                for kind in ("POINT", "SPOT", "AREA", "SUN"):
                    scene_factory.lamp(self.scene, kind, location=(1, 0, 2), scale=scale)
                scene_factory.plane(self.scene, 1.0, scene_factory.diffuse(), location=(1, 0, 0))
                self.render_bad()

    def test_wide_polygon(self):
        count = 3000
        points = [((0.3 + 0.5 * (i % 2)) * math.cos(2 * math.pi * i / count),
                   (0.3 + 0.5 * (i % 2)) * math.sin(2 * math.pi * i / count), 0)
                  for i in range(count)]
        self.bad_mesh(points, [range(count)], scene_factory.emission((1, 1, 1)))
        self.assertGreater(self.render_bad().pixel(12, 4)[0], 0.5)

    def test_material_slots(self):
        obj = self.bad_mesh([(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)],
                            [(0, 1, 2, 3)])
        obj.data.materials.append(None)
        for index in (1, 7, 32767):
            obj.data.polygons[0].material_index = index
            self.render_bad()
        obj.data.materials.clear()
        self.render_bad()

    def test_indices_out_of_range(self):
        """Face corners beyond the vertices, as broken importers make them."""
        obj = self.bad_mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], [(0, 1, 3, 2)])
        obj.data.validate()
        obj.data.polygons[0].material_index = 3
        obj.data.loops[0].vertex_index = 3
        self.render_bad()

    def test_camera_inside_geometry(self):
        scene_factory.sphere(self.scene, 1.0, scene_factory.emission(GOOD), location=(0, 0, 10))
        self.assert_pixel(render(TESTED_ENGINE, 1), 16, 16, GOOD)


class ValueTest(BadInputCase):

    def test_bad_light_values(self):
        scene_factory.plane(self.scene, 2.0, scene_factory.diffuse(), location=(1, 0, 0))
        for value in (math.nan, math.inf, -50.0, 1e30):
            for kind in ("POINT", "AREA", "SUN"):
                with self.subTest(f"{kind} {value}"):
                    obj = scene_factory.lamp(self.scene, kind, value, (1, 0, 2))
                    self.render_bad()
                    bpy.data.objects.remove(obj)

    def test_lamps_of_no_size(self):
        scene_factory.plane(self.scene, 2.0, scene_factory.diffuse(), location=(1, 0, 0))
        scene_factory.lamp(self.scene, "AREA", 10.0, (1, 0, 2), size=0.0)
        scene_factory.lamp(self.scene, "AREA", 10.0, (1, 0, 2), shape="ELLIPSE", size=0.0,
                           size_y=1.0)
        scene_factory.lamp(self.scene, "SPOT", 10.0, (1, 0, 2), spot_size=math.radians(1.0))
        scene_factory.lamp(self.scene, "AREA", 10.0, (1, 0, 2), spread=0.0)
        self.render_bad()

    def test_bad_material_values(self):
        for value in (math.nan, math.inf, -1.0, 1e30):
            for node, name in (("ShaderNodeEmission", "Strength"),
                               ("ShaderNodeBsdfDiffuse", "Roughness"),
                               ("ShaderNodeBsdfPrincipled", "Roughness"),
                               ("ShaderNodeBsdfPrincipled", "IOR"),
                               ("ShaderNodeBsdfGlass", "IOR"),
                               ("ShaderNodeBsdfGlossy", "Roughness")):
                with self.subTest(f"{node} {name} {value}"):
                    self.setUp()
                    material = scene_factory.node_material("Poisoned", lambda n: n.add(
                        node, None, {name: n.add("ShaderNodeMath", {"operation": "ADD"}, {
                            0: value, 1: 0.0})}))
                    scene_factory.plane(self.scene, 1.0, material, location=(1, 0, 0))
                    scene_factory.lamp(self.scene, "POINT", 10.0, (1, 0, 2))
                    self.render_bad()

    def test_bad_world(self):
        for value in (math.nan, math.inf, -1.0, 1e30):
            with self.subTest(value):
                self.setUp()
                scene_factory.plane(self.scene, 1.0, scene_factory.diffuse(), location=(1, 0, 0))
                scene_factory.set_world(self.scene, (1, 1, 1), value)
                self.render_bad(["strength"] if value == math.inf else ())

    def test_nan_in_attribute(self):
        """A NaN that only shading meets: the samples are dropped, counted and reported."""
        material = emission_of("Poisoned", lambda n: n.add(
            "ShaderNodeAttribute", {"attribute_name": "poison"}).outputs["Vector"])
        obj = scene_factory.plane(self.scene, 1.0, material, location=(1, 0, 0))
        layer = obj.data.attributes.new("poison", "FLOAT_VECTOR", "FACE")
        layer.data[0].vector = (math.nan, 1.0, math.inf)
        self.render_bad()


class NodeTest(BadInputCase):

    def test_nodes_beyond_the_list(self):
        """A node that is not covered gives a neutral value and says so."""
        material = emission_of("Odd", lambda n: n.add("ShaderNodeTexPointDensity"))
        scene_factory.plane(self.scene, 1.0, material, location=(1, 0, 0))
        self.render_bad(("Odd", "Point Density", "no points"))

    def test_every_node_type(self):
        """Each node that can be added renders, covered or not."""
        names = [n for n in dir(bpy.types) if n.startswith("ShaderNode")]
        for name in names:
            material = bpy.data.materials.new(name)
            material.use_nodes = True
            nodes = material.node_tree.nodes
            try:
                node = nodes.new(name)
            except RuntimeError:
                continue
            output = next(n for n in nodes if n.type == "OUTPUT_MATERIAL")
            usable = [s for s in node.outputs if s.enabled]
            if usable:
                material.node_tree.links.new(usable[0], output.inputs["Surface"])
            scene_factory.plane(self.scene, 0.02, material, name,
                                location=(0.1 + 0.02 * len(self.scene.objects) % 1.8, 0, 0.1))
        self.assertGreater(len(self.scene.objects), 80)
        self.render_bad()

    def test_cyclic_groups(self):
        first, second = (bpy.data.node_groups.new(n, "ShaderNodeTree") for n in "AB")
        for tree, inner in ((first, second), (second, first), (first, first)):
            tree.outputs.new("NodeSocketColor", "Color")
            node = tree.nodes.new("ShaderNodeGroup")
            try:
                node.node_tree = inner
            except RuntimeError:
                continue
            end = tree.nodes.new("NodeGroupOutput")
            if node.outputs:
                tree.links.new(node.outputs[0], end.inputs[0])
        material = emission_of("Cyclic", lambda n: n.add("ShaderNodeGroup", {"node_tree": first}))
        scene_factory.plane(self.scene, 1.0, material, location=(1, 0, 0))
        self.render_bad()

    def test_cyclic_links(self):
        def build(nodes):
            first = nodes.add("ShaderNodeMath")
            second = nodes.add("ShaderNodeMath", None, {0: first})
            nodes.set(first.inputs[0], second)
            return second
        scene_factory.plane(self.scene, 1.0, emission_of("Loop", build), location=(1, 0, 0))
        self.render_bad()

    def test_material_without_output_or_nodes(self):
        empty = bpy.data.materials.new("Empty")
        empty.use_nodes = True
        empty.node_tree.nodes.clear()
        unlinked = bpy.data.materials.new("Unlinked")
        unlinked.use_nodes = True
        unlinked.node_tree.links.clear()
        for x, material in ((0.5, empty), (1.5, unlinked), (1.0, bpy.data.materials.new("Old"))):
            scene_factory.plane(self.scene, 0.5, material, location=(x, 0, 0))
        scene_factory.set_world(self.scene, (1, 1, 1))
        picture = self.render_bad()
        for x in (10, 14):
            self.assertEqual(picture.pixel(x, 4)[:3], (0.0, 0.0, 0.0))

    def test_material_cuts_the_links(self):
        """A group node whose tree is gone."""
        def build(nodes):
            tree = bpy.data.node_groups.new("Gone", "ShaderNodeTree")
            tree.outputs.new("NodeSocketColor", "Color")
            node = nodes.add("ShaderNodeGroup", {"node_tree": tree})
            bpy.data.node_groups.remove(tree)
            return node if node.outputs else nodes.add("ShaderNodeRGB")
        scene_factory.plane(self.scene, 1.0, emission_of("Gone", build), location=(1, 0, 0))
        self.render_bad()


def png_chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def lying_png(width, height):
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", header)
            + png_chunk(b"IDAT", zlib.compress(b"\0" * 16)) + png_chunk(b"IEND", b""))


def lying_bmp(width, height):
    return (b"BM" + struct.pack("<IHHI", 100, 0, 0, 54)
            + struct.pack("<IiiHHIIiiII", 40, width, height, 1, 24, 0, 0, 2835, 2835, 0, 0)
            + b"\0" * 40)


def lying_tga(width, height):
    return struct.pack("<BBBHHBHHHHBB", 0, 0, 2, 0, 0, 0, 0, 0, width, height, 24, 0) + b"\0" * 40


def lying_hdr(width, height):
    return (b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n"
            + f"-Y {height} +X {width}\n".encode() + b"\2\2" + b"\0" * 40)


class ImageTest(BadInputCase):
    """Broken files are magenta with a report that names the file."""

    def shown(self, path, report=True, node="ShaderNodeTexImage"):
        image = bpy.data.images.new("Broken", 4, 4)
        image.source = "FILE"
        image.filepath = path
        material = emission_of("Broken", lambda n: n.add(node, {"image": image}, {
            "Vector": (0.5, 0.5, 0.0)}))
        scene_factory.plane(self.scene, 1.0, material, location=(1, 0, 0))
        picture = self.render_bad((os.path.basename(path),) if report else ())
        return picture.pixel(12, 4)[:3]

    def check_broken(self, name, data):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, name)
            with open(path, "wb") as stream:
                stream.write(data)
            self.assertEqual(self.shown(path), MAGENTA)

    def test_missing(self):
        self.assertEqual(self.shown("/nonexistent/missing picture.png"), MAGENTA)

    def test_missing_environment(self):
        self.assertEqual(self.shown("/nonexistent/sky.hdr", node="ShaderNodeTexEnvironment"),
                         MAGENTA)

    def test_folder_instead_of_file(self):
        self.assertEqual(self.shown("/tmp"), MAGENTA)

    def test_lying_headers(self):
        for name, data in (("lying.png", lying_png(60000, 60000)),
                           ("lying.bmp", lying_bmp(60000, 60000)),
                           ("lying.tga", lying_tga(60000, 60000)),
                           ("lying.hdr", lying_hdr(60000, 60000))):
            with self.subTest(name):
                self.setUp()
                self.check_broken(name, data)

    def test_no_pixels(self):
        for name, data in (("zero.png", lying_png(0, 0)), ("zero.tga", lying_tga(0, 0)),
                           ("empty.png", b""), ("empty.exr", b""), ("text.jpg", b"not a picture")):
            with self.subTest(name):
                self.setUp()
                self.check_broken(name, data)

    def test_truncated(self):
        """Half a file: magenta or its readable part, but no crash."""
        image = scene_factory.generated_image("Noise", 64, 64, lambda x, y: (
            (x * 37 + y * 91) % 64 / 64, (x * 11 + y * 53) % 64 / 64, 0.5, 1.0))
        with tempfile.TemporaryDirectory() as folder:
            for extension, kind in (("png", "PNG"), ("exr", "OPEN_EXR"), ("jpg", "JPEG"),
                                    ("tif", "TIFF"), ("tga", "TARGA"), ("hdr", "HDR")):
                with self.subTest(kind):
                    path = os.path.join(folder, f"whole.{extension}")
                    self.scene.render.image_settings.file_format = kind
                    image.save_render(path, scene=self.scene)
                    with open(path, "rb") as stream:
                        data = stream.read()
                    broken = os.path.join(folder, f"broken.{extension}")
                    with open(broken, "wb") as stream:
                        stream.write(data[:len(data) // 2])
                    self.shown(broken, report=False)

    def test_very_wide(self):
        """16384 pixels wide is large and right, not an error."""
        line = b"\0" + bytes([188, 188, 188]) * 16384

        data = (b"\x89PNG\r\n\x1a\n"
                + png_chunk(b"IHDR", struct.pack(">IIBBBBB", 16384, 16, 8, 2, 0, 0, 0))
                + png_chunk(b"IDAT", zlib.compress(line * 16)) + png_chunk(b"IEND", b""))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "wide.png")
            with open(path, "wb") as stream:
                stream.write(data)
            for value in self.shown(path, report=False):
                self.assertAlmostEqual(value, 0.5029, places=3)

    def test_strange_names(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "Bild \u00e4\u00f6 \u6f22 'q'.png")
            image = scene_factory.generated_image("One", 2, 2, lambda x, y: (1, 0.5, 0, 1))
            image.file_format = "PNG"
            image.filepath_raw = path
            image.save()
            self.assertAlmostEqual(self.shown(path, report=False)[2], 0.0, places=4)


class PrepareTest(BadInputCase):

    def test_least_settings(self):
        for settings in ({"samples": 1, "max_bounces": 0}, {"samples": 1, "filter_width": 0.01},
                         {"samples": 1, "pixel_filter_type": "BLACKMAN_HARRIS",
                          "filter_width": 10.0}):
            with self.subTest(settings):
                prepare(self.scene, TESTED_ENGINE, **settings)
                render(TESTED_ENGINE, resolution=(4, 4), **settings)
