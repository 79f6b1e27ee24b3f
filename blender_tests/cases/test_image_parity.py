# SPDX-License-Identifier: GPL-3.0-or-later
"""Image and Environment Texture, compared with the reference engine to 1e-4 (see tile_grid)."""
import itertools

import bpy

from support.node_variants import TEXTURE_MAPPINGS, Variant
from support.parity import TILTED, ParityCase, pattern_image
from support.tile_grid import TOLERANCE, TileGrid, emission_of, enum_items


class ImageParityTest(ParityCase):

    COORDINATES = [(0.13, 0.27, 0.41), (0.5, 0.5, 0.5), (0.999, 0.001, 0.3), (1.3, -0.2, 0.6),
                   (-2.71, 3.14, 0.9), (0.4375, 0.5625, 0.0), (0.02, 0.97, 1.2), (0.8, 0.3, 0.77)]

    def images(self):
        return {
            "byte": pattern_image("byte"),
            "packed": pattern_image("packed", packed=True),
            "float": pattern_image("float", 5, 7, float_buffer=True),
            "opaque": pattern_image("opaque", alpha=False),
            "1x1": pattern_image("single", 1, 1),
        }

    def vectors(self):
        return [{"Vector": v} for v in self.COORDINATES]

    def test_interpolation_and_extension(self):
        grid = TileGrid(self.scene)
        images = self.images()
        node = "ShaderNodeTexImage"
        for image, interpolation, extension in itertools.product(
                images.values(), enum_items(node, "interpolation"), enum_items(node, "extension")):
            settings = {"image": image, "interpolation": interpolation, "extension": extension}
            for output in ("Color", "Alpha"):
                Variant(node, settings, self.vectors(), output).add_to(grid)
        self.check_grid(grid)

    def test_projection(self):
        grid = TileGrid(self.scene)
        image = self.images()["packed"]
        node = "ShaderNodeTexImage"
        for projection, blend, normal in itertools.product(
                enum_items(node, "projection"), (0.0, 0.4, 1.0), TILTED):
            settings = {"image": image, "projection": projection, "projection_blend": blend}
            Variant(node, settings, self.vectors(), "Color", note=f"normal {normal}").add_to(
                grid, normal=normal)
        self.check_grid(grid)

    def test_color_space_and_alpha_mode(self):
        # Both engines keep converted images as halves (2 ** -11 = 5e-4 of the value), and a last
        # bit of the matrix of a wide gamut decides where a half rounds to.
        wide = {"Linear ACES", "Linear ACEScg", "XYZ"}
        self.check_spaces(lambda space: space not in wide)
        self.setUp()
        self.check_spaces(lambda space: space in wide, 1e-3)

    def check_spaces(self, wanted, tolerance=TOLERANCE):
        grid = TileGrid(self.scene)
        spaces = [item.identifier for item in
                  bpy.types.ColorManagedInputColorspaceSettings.bl_rna.properties["name"].enum_items
                  if "Filmic" not in item.identifier and wanted(item.identifier)]
        self.assertTrue(spaces)
        modes = ("STRAIGHT", "PREMUL", "CHANNEL_PACKED", "NONE")
        for space, mode, as_float in itertools.product(spaces, modes, (False, True)):
            image = pattern_image(f"{space} {mode} {as_float}", 4, 4, float_buffer=as_float,
                                  packed=not as_float)
            image.colorspace_settings.name = space
            image.alpha_mode = mode
            for output in ("Color", "Alpha"):
                Variant("ShaderNodeTexImage", {"image": image}, self.vectors()[:3],
                        output).add_to(grid)
        self.check_grid(grid, tolerance)

    def test_alpha_linked_unpremultiplies(self):
        """With the Alpha output in use the colour is divided by it."""
        image = self.images()["packed"]

        def build(nodes, fac):
            texture = nodes.add("ShaderNodeTexImage", {"image": image}, {"Vector": fac(nodes)})
            return nodes.add("ShaderNodeMix", {"data_type": "RGBA"}, {
                "Factor_Float": texture.outputs["Alpha"], "A_Color": texture.outputs["Color"],
                "B_Color": (0.0, 0.0, 0.0)})
        grid = TileGrid(self.scene)
        material = emission_of("unpremultiply", lambda n: build(n, lambda m: m.add(
            "ShaderNodeAttribute", {"attribute_name": "v"}).outputs["Vector"]))
        for vector in self.COORDINATES:
            grid.add(f"alpha linked {vector}", material, attributes={"v": vector})
        self.check_grid(grid)

    def test_default_vector_is_uv(self):
        grid = TileGrid(self.scene)
        for uv in ((0.13, 0.27), (0.6, 0.9), (1.3, -0.4)):
            Variant("ShaderNodeTexImage", {"image": self.images()["packed"]}, [{}],
                    "Color", note=f"uv {uv}").add_to(grid, uv=uv)
        self.check_grid(grid)

    def test_texture_mapping(self):
        grid = TileGrid(self.scene)
        image = self.images()["packed"]
        for name, settings in TEXTURE_MAPPINGS.items():
            Variant("ShaderNodeTexImage", {"image": image, **settings}, self.vectors(), "Color",
                    note=name).add_to(grid)
        self.check_grid(grid)

    def test_missing_image_and_no_image(self):
        grid = TileGrid(self.scene)
        missing = bpy.data.images.new("missing", 4, 4)
        missing.source = "FILE"
        missing.filepath = "/nonexistent/picture.png"
        for image in (missing, None):
            for output in ("Color", "Alpha"):
                Variant("ShaderNodeTexImage", {"image": image}, self.vectors()[:2], output,
                        note=str(image)).add_to(grid)
        self.check_grid(grid)

    def test_environment_texture(self):
        grid = TileGrid(self.scene)
        node = "ShaderNodeTexEnvironment"
        directions = [(0.3, 0.7, -0.2), (-1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -0.6, 0.8),
                      (-0.5, -0.5, -0.7071068), (0.2, 0.9, 0.39)]
        images = self.images()
        for image, projection, interpolation in itertools.product(
                (images["packed"], images["float"]), enum_items(node, "projection"),
                enum_items(node, "interpolation")):
            settings = {"image": image, "projection": projection, "interpolation": interpolation}
            Variant(node, settings, [{"Vector": d} for d in directions]).add_to(grid)
        for name, settings in TEXTURE_MAPPINGS.items():
            Variant(node, {"image": images["packed"], **settings},
                    [{"Vector": d} for d in directions[:3]], note=name).add_to(grid)
        self.check_grid(grid)
