# SPDX-License-Identifier: GPL-3.0-or-later
"""Each node alone as emission, compared with the reference engine to 1e-4 (see tile_grid)."""
import itertools
import math

import bpy

from support import scene_factory
from support.case import RenderTestCase
from support.node_variants import (COLORS, NODE_TABLE, TEXTURE_MAPPINGS, VECTORS, Variant,
                                   fresnel_variants)
from support.render import REFERENCE_ENGINE, TESTED_ENGINE, render
from support.tile_grid import FieldGrid, TileGrid, emission_of, enum_items

SHOWN_FAILURES = 12
TILTED = ((0.0, 0.0, 1.0), (0.6, 0.0, 0.8), (-0.36, 0.48, 0.8), (0.1, -0.7, 0.7071068))


class ParityCase(RenderTestCase):

    def assert_same(self, failures, count):
        if failures:
            shown = "\n".join(failures[:SHOWN_FAILURES])
            self.fail(f"{len(failures)} of {count} differ:\n{shown}")

    def check_grid(self, grid):
        self.assertTrue(grid.tiles)
        self.assert_same(grid.compare(), len(grid.tiles))

    def check_field(self, grid, tolerance=1e-4):
        self.assertTrue(grid.objects)
        self.assert_same(grid.compare(tolerance), len(grid.objects))


class NodeParityTest(ParityCase):
    """Nodes that need nothing but their inputs; the methods come from NODE_TABLE."""


def _table_test(make_variants):
    def test(self):
        grid = TileGrid(self.scene)
        for variant in make_variants():
            variant.add_to(grid)
        self.check_grid(grid)
    return test


for _name, _make in NODE_TABLE.items():
    setattr(NodeParityTest, f"test_{_name}", _table_test(_make))


class ReadoutTest(ParityCase):

    def test_reference_shows_attribute_values_unchanged(self):
        """The method itself: what goes in through an attribute is what the picture holds."""
        grid = TileGrid(self.scene)
        material = emission_of("Attribute", lambda n: n.add(
            "ShaderNodeAttribute", {"attribute_name": "v"}).outputs["Vector"])
        values = [(0.25, 0.5, 3.0), (-2.0, 0.0, 1e-3), (100.0, -7.5, 0.125)]
        for value in values:
            grid.add(str(value), material, attributes={"v": value})
        shown = grid.values(REFERENCE_ENGINE, grid.build())
        for actual, expected in zip(shown, values):
            self.assertEqual([round(a, 5) for a in actual], [round(e, 5) for e in expected])


class TreeParityTest(ParityCase):
    """What belongs to trees rather than to nodes."""

    def setUp(self):
        super().setUp()
        self.grid = TileGrid(self.scene)

    def add(self, label, build, **attributes):
        self.grid.add(label, emission_of(label, build), attributes=attributes)

    @staticmethod
    def attribute(nodes, name="v", output="Vector"):
        return nodes.add("ShaderNodeAttribute", {"attribute_name": name}).outputs[output]

    def test_conversions(self):
        """Value, vector and colour linked to each other's sockets."""
        def to_value(nodes, source):
            return nodes.add("ShaderNodeMath", {"operation": "ADD"}, {0: source, 1: 0.0})

        def to_vector(nodes, source):
            return nodes.add("ShaderNodeVectorMath", {"operation": "ADD"}, {0: source})

        def to_color(nodes, source):
            return nodes.add("ShaderNodeGamma", None, {"Color": source, "Gamma": 1.0})

        for output, convert in itertools.product(("Fac", "Vector", "Color"),
                                                 (to_value, to_vector, to_color)):
            for value in VECTORS + COLORS:
                self.add(f"{output} {convert.__name__} {value}",
                         lambda n, o=output, c=convert: c(n, self.attribute(n, "v", o)), v=value)
        for convert in (to_value, to_vector, to_color):
            self.add(f"constant {convert.__name__}", lambda n, c=convert: c(
                n, n.add("ShaderNodeCombineXYZ", None, {0: 0.2, 1: 0.7, 2: -0.4})))
        self.check_grid(self.grid)

    def group(self, name, factor, inner=None):
        """Group (Vector, Scale = `factor`) -> Vector * Scale, through `inner` first if given."""
        tree = bpy.data.node_groups.new(name, "ShaderNodeTree")
        tree.inputs.new("NodeSocketVector", "Vector")
        tree.inputs.new("NodeSocketFloat", "Scale").default_value = factor
        tree.outputs.new("NodeSocketVector", "Result")
        nodes = scene_factory.Nodes(tree)
        entry = nodes.add("NodeGroupInput")
        vector = entry.outputs["Vector"]
        if inner is not None:
            vector = nodes.add("ShaderNodeGroup", {"node_tree": inner},
                               {"Vector": vector}).outputs["Result"]
        scaled = nodes.add("ShaderNodeVectorMath", {"operation": "SCALE"},
                           {"Vector": vector, "Scale": entry.outputs["Scale"]})
        nodes.add("NodeGroupOutput", None, {"Result": scaled})
        return tree

    def test_groups(self):
        inner = self.group("Inner", 3.0)
        outer = self.group("Outer", 0.5, inner)
        outermost = self.group("Outermost", 1.5, outer)
        value = (0.3, -0.7, 1.1)
        for tree in (inner, outer, outermost):
            self.add(f"{tree.name} linked", lambda n, t=tree: n.add(
                "ShaderNodeGroup", {"node_tree": t}, {"Vector": self.attribute(n)}), v=value)
            self.add(f"{tree.name} constant", lambda n, t=tree: n.add(
                "ShaderNodeGroup", {"node_tree": t}, {"Vector": value, "Scale": 0.2}))
        twice = self.group("Twice", 2.0)

        def chain(nodes):
            first = nodes.add("ShaderNodeGroup", {"node_tree": twice},
                              {"Vector": self.attribute(nodes)})
            return nodes.add("ShaderNodeGroup", {"node_tree": twice}, {"Vector": first})
        self.add("same group twice", chain, v=value)
        self.add("no tree", lambda n: n.add("ShaderNodeVectorMath", {"operation": "ADD"}, {
            0: self.attribute(n), 1: (0.5, 0.5, 0.5)}), v=value)
        self.check_grid(self.grid)

    def test_reroutes(self):
        def reroutes(nodes, count):
            source = self.attribute(nodes)
            for _ in range(count):
                reroute = nodes.tree.nodes.new("NodeReroute")
                nodes.tree.links.new(source, reroute.inputs[0])
                source = reroute.outputs[0]
            return nodes.add("ShaderNodeGamma", None, {"Color": source, "Gamma": 2.0})
        for count in range(4):
            self.add(f"{count} reroutes", lambda n, c=count: reroutes(n, c), v=(0.3, 0.7, 1.1))

        def dangling(nodes):
            reroute = nodes.tree.nodes.new("NodeReroute")
            gamma = nodes.add("ShaderNodeGamma", None, {"Color": (0.2, 0.4, 0.6)})
            nodes.tree.links.new(reroute.outputs[0], gamma.inputs["Color"])
            return gamma
        self.add("reroute without source", dangling)
        self.check_grid(self.grid)

    def test_muted(self):
        def muted(nodes, kind, settings, inputs):
            node = nodes.add(kind, settings, inputs)
            node.mute = True
            return node
        value = (0.3, 0.7, 1.1)
        self.add("gamma", lambda n: muted(n, "ShaderNodeGamma", None, {
            "Color": self.attribute(n), "Gamma": 3.0}), v=value)
        self.add("gamma unlinked", lambda n: muted(n, "ShaderNodeGamma", None, {
            "Color": (0.2, 0.4, 0.6), "Gamma": 3.0}))
        self.add("mix", lambda n: muted(n, "ShaderNodeMix", {"data_type": "RGBA"}, {
            "Factor_Float": 0.8, "A_Color": self.attribute(n), "B_Color": (1, 0, 0)}), v=value)
        self.add("mix second linked", lambda n: muted(n, "ShaderNodeMix", {"data_type": "RGBA"}, {
            "Factor_Float": 0.8, "B_Color": self.attribute(n)}), v=value)
        self.add("vector math", lambda n: muted(n, "ShaderNodeVectorMath", {
            "operation": "CROSS_PRODUCT"}, {0: self.attribute(n), 1: (1, 2, 3)}), v=value)
        self.add("group", lambda n: muted(n, "ShaderNodeGroup", {
            "node_tree": self.group("G", 3.0)}, {"Vector": self.attribute(n)}), v=value)
        self.add("texture", lambda n: muted(n, "ShaderNodeTexChecker", None, {
            "Vector": self.attribute(n)}).outputs["Color"], v=value)

        def muted_link(nodes):
            gamma = nodes.add("ShaderNodeGamma", None, {"Color": self.attribute(nodes),
                                                        "Gamma": 2.0})
            gamma.inputs["Color"].links[0].is_muted = True
            return gamma
        self.add("link", muted_link, v=value)
        self.check_grid(self.grid)

    def test_several_outputs(self):
        """The active Material Output counts; one for another engine does not."""
        def build(nodes):
            other = nodes.add("ShaderNodeOutputMaterial", {"target": "EEVEE"})
            red = nodes.add("ShaderNodeEmission", None, {"Color": (1, 0, 0)})
            nodes.set(other.inputs["Surface"], red)
            return nodes.add("ShaderNodeRGB")
        self.add("eevee output", build)
        self.check_grid(self.grid)


class IncidenceParityTest(ParityCase):
    """Fresnel and Layer Weight on tilted faces."""

    def test_fresnel_and_layer_weight(self):
        grid = TileGrid(self.scene)
        for variant, normal in itertools.product(fresnel_variants(), TILTED):
            variant.add_to(grid, normal=normal)
        self.check_grid(grid)


def test_pixel(x, y):
    """Colours without symmetry, alpha between 0.2 and 1."""
    return ((0.1 + 0.37 * x) % 1.0, (0.9 - 0.23 * y) % 1.0, (0.2 + 0.11 * x * y) % 1.0,
            0.2 + 0.8 * ((x + 2 * y) % 5) / 4)


class ImageParityTest(ParityCase):

    COORDINATES = [(0.13, 0.27, 0.41), (0.5, 0.5, 0.5), (0.999, 0.001, 0.3), (1.3, -0.2, 0.6),
                   (-2.71, 3.14, 0.9), (0.4375, 0.5625, 0.0), (0.02, 0.97, 1.2), (0.8, 0.3, 0.77)]

    def images(self):
        return {
            "byte": scene_factory.generated_image("byte", 8, 6, test_pixel),
            "packed": scene_factory.generated_image("packed", 8, 6, test_pixel, packed=True),
            "float": scene_factory.generated_image("float", 5, 7, test_pixel, float_buffer=True),
            "opaque": scene_factory.generated_image("opaque", 8, 6, test_pixel, alpha=False),
            "1x1": scene_factory.generated_image("single", 1, 1, test_pixel),
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
        grid = TileGrid(self.scene)
        spaces = [item.identifier for item in
                  bpy.types.ColorManagedInputColorspaceSettings.bl_rna.properties["name"].enum_items
                  if "Filmic" not in item.identifier]
        self.assertIn("Non-Color", spaces)
        modes = ("STRAIGHT", "PREMUL", "CHANNEL_PACKED", "NONE")
        for space, mode, as_float in itertools.product(spaces, modes, (False, True)):
            image = scene_factory.generated_image(f"{space} {mode} {as_float}", 4, 4, test_pixel,
                                                  float_buffer=as_float, packed=not as_float)
            image.colorspace_settings.name = space
            image.alpha_mode = mode
            for output in ("Color", "Alpha"):
                Variant("ShaderNodeTexImage", {"image": image}, self.vectors()[:3],
                        output).add_to(grid)
        self.check_grid(grid)

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


def sphere_patch():
    """Smooth, gently curved rectangle, with UVs."""
    count, vertices, faces, uv = 6, [], [], []
    for j in range(count + 1):
        for i in range(count + 1):
            x, y = (a + (b - a) * k / count
                    for (a, b), k in ((FieldGrid.X_RANGE, i), (FieldGrid.Y_RANGE, j)))
            vertices.append((x, y, math.sqrt(1.0 - x * x - y * y) - 1.0))
    for j in range(count):
        for i in range(count):
            a = j * (count + 1) + i
            corners = (a, a + 1, a + count + 2, a + count + 1)
            faces.append(corners)
            uv += [(vertices[c][0] + 0.5, vertices[c][1] + 0.5) for c in corners]
    return scene_factory.mesh("Patch", vertices, faces, uv=uv, smooth=True)


PLACEMENTS = {
    "plain": {},
    "turned": {"rotation": (0, 0, 30), "scale": (1.3, 1.3, 1.3)},
    "tilted": {"rotation": (20, -35, 10), "scale": (1.4, 1.5, 1.2)},
    "mirrored": {"rotation": (0, 25, 0), "scale": (-1.3, 1.2, 1.0)},
    "from behind": {"rotation": (180, 0, 20), "scale": (1.25, 1.25, 1.25)},
}


class GeometryParityTest(ParityCase):
    """Nodes that read the surface, the object or the ray: on objects placed in several ways."""

    def field_of(self, node_type, outputs, settings=None, shapes=(None, sphere_patch),
                 change=None):
        grid = FieldGrid(self.scene)
        for output, shape, (name, placement) in itertools.product(
                outputs, shapes, PLACEMENTS.items()):
            material = emission_of(f"{node_type} {output}", lambda n, o=output: n.add(
                node_type, settings).outputs[o])
            shape_name = shape.__name__ if shape else "square"
            obj = grid.add(f"{node_type[10:]} {output} {shape_name} {name}", material,
                           shape() if shape else None, **placement)
            if change:
                change(obj)
        return grid

    def test_texture_coordinate(self):
        for output in ("Generated", "Normal", "UV", "Object", "Camera", "Window", "Reflection"):
            with self.subTest(output):
                self.setUp()
                self.check_field(self.field_of("ShaderNodeTexCoord", [output]))

    def test_object_of_texture_coordinate(self):
        other = scene_factory.link(self.scene, None, "Empty", (0.3, 2.0, -1.0), (10, 20, 30),
                                   (2.0, 0.5, 1.0))
        self.check_field(self.field_of("ShaderNodeTexCoord", ["Object"], {"object": other}))

    def test_geometry(self):
        for output in ("Position", "Normal", "Tangent", "True Normal", "Incoming", "Parametric",
                       "Backfacing", "Random Per Island"):
            with self.subTest(output):
                self.setUp()
                jumps_at_edges = output in ("Parametric", "True Normal")
                shapes = (None,) if jumps_at_edges else (None, sphere_patch)
                self.check_field(self.field_of("ShaderNodeNewGeometry", [output], shapes=shapes))

    def test_incoming_in_perspective(self):
        grid = self.field_of("ShaderNodeNewGeometry", ["Incoming"])
        grid.compare()
        scene_factory.camera(self.scene, (1, 1, 6), (1.2, 1.4, 0))
        tested, reference = (render(engine, samples=64, resolution=(24, 24))
                             for engine in (TESTED_ENGINE, REFERENCE_ENGINE))
        self.assert_pictures_agree([tested], [reference], block=4, relative=0.002, absolute=0.002)

    def test_object_info(self):
        def change(obj):
            obj.color = (0.2, 0.4, 0.7, 0.6)
            obj.pass_index = 7
            obj.data.materials[0].pass_index = 3
        outputs = ("Location", "Color", "Alpha", "Object Index", "Material Index", "Random")
        self.check_field(self.field_of("ShaderNodeObjectInfo", outputs, shapes=(None,),
                                       change=change))

    def test_light_path_of_camera_rays(self):
        outputs = [s.name for s in self.light_path_outputs()]
        self.assertGreaterEqual(len(outputs), 13)
        self.check_field(self.field_of("ShaderNodeLightPath", outputs, shapes=(None,)))

    @staticmethod
    def light_path_outputs():
        material = bpy.data.materials.new("probe")
        material.use_nodes = True
        return material.node_tree.nodes.new("ShaderNodeLightPath").outputs

    def test_uv_map(self):
        def second_layer(obj):
            layer = obj.data.uv_layers.new(name="Second")
            layer.data.foreach_set("uv", [0.25, 0.5, 1.75, 0.25, 1.5, 1.5, 0.0, 1.25])
        for name in ("", "UVMap", "Second", "missing"):
            with self.subTest(name):
                self.setUp()
                self.check_field(self.field_of("ShaderNodeUVMap", ["UV"], {"uv_map": name}, (None,),
                                               second_layer))

    ATTRIBUTE_FIELDS = {"FLOAT": "value", "INT": "value", "BOOLEAN": "value",
                        "FLOAT_VECTOR": "vector", "FLOAT2": "vector", "FLOAT_COLOR": "color",
                        "BYTE_COLOR": "color"}

    def add_attribute(self, obj, kind, domain):
        layer = obj.data.attributes.new("mine", kind, domain)
        width = {"vector": 2 if kind == "FLOAT2" else 3, "color": 4}.get(
            self.ATTRIBUTE_FIELDS[kind], 1)
        values = [0.13 + 0.21 * ((7 * i) % 4) + 0.05 * (i % 3) for i in range(len(layer.data) * width)]
        if kind == "INT":
            values = [int(10 * v) for v in values]
        elif kind == "BOOLEAN":
            values = [i % 2 == 0 for i in range(len(values))]
        layer.data.foreach_set(self.ATTRIBUTE_FIELDS[kind], values)

    def test_attribute_domains_and_types(self):
        grid = FieldGrid(self.scene)
        for kind, domain, output in itertools.product(
                self.ATTRIBUTE_FIELDS, ("POINT", "EDGE", "FACE", "CORNER"),
                ("Color", "Vector", "Fac", "Alpha")):
            material = emission_of("attribute", lambda n, o=output: n.add(
                "ShaderNodeAttribute", {"attribute_name": "mine"}).outputs[o])
            obj = grid.add(f"attribute {kind} {domain} {output}", material)
            self.add_attribute(obj, kind, domain)
        self.check_field(grid)

    def test_missing_and_builtin_attributes(self):
        grid = FieldGrid(self.scene)
        for name, output in itertools.product(("missing", "", "UVMap"),
                                              ("Color", "Vector", "Fac", "Alpha")):
            material = emission_of(name, lambda n, a=name, o=output: n.add(
                "ShaderNodeAttribute", {"attribute_name": a}).outputs[o])
            grid.add(f"attribute {name!r} {output}", material)
        self.check_field(grid)

    def test_object_attributes(self):
        grid = FieldGrid(self.scene)
        for kind, name, output in itertools.product(
                ("OBJECT", "INSTANCER", "VIEW_LAYER"),
                ("mine", "mine_vector", '["mine"]', "location", "color", "nothing"),
                ("Color", "Vector", "Fac", "Alpha")):
            material = emission_of(name, lambda n, k=kind, a=name, o=output: n.add(
                "ShaderNodeAttribute", {"attribute_type": k, "attribute_name": a}).outputs[o])
            obj = grid.add(f"{kind} {name} {output}", material)
            obj["mine"] = 0.625
            obj["mine_vector"] = (0.25, 0.5, 0.75)
        self.scene.view_layers[0]["mine"] = 0.375
        self.check_field(grid)

    def test_color_attribute(self):
        grid = FieldGrid(self.scene)
        for kind, domain, name, output in itertools.product(
                ("FLOAT_COLOR", "BYTE_COLOR"), ("POINT", "CORNER"), ("mine", "", "missing"),
                ("Color", "Alpha")):
            material = emission_of("color", lambda n, a=name, o=output: n.add(
                "ShaderNodeVertexColor", {"layer_name": a}).outputs[o])
            obj = grid.add(f"color attribute {kind} {domain} {name!r} {output}", material)
            self.add_attribute(obj, kind, domain)
            obj.data.color_attributes.active_color = obj.data.color_attributes["mine"]
            obj.data.color_attributes.render_color_index = 0
        self.check_field(grid)

    def test_normal_map(self):
        for space in enum_items("ShaderNodeNormalMap", "space"):
            with self.subTest(space):
                self.setUp()
                grid = FieldGrid(self.scene)
                for color, strength, shape, (name, placement) in itertools.product(
                        ((0.5, 0.5, 1.0), (0.7, 0.4, 0.9)), (1.0, 0.4, 2.0), (None, sphere_patch),
                        PLACEMENTS.items()):
                    material = emission_of("normal map", lambda n, c=color, s=strength: n.add(
                        "ShaderNodeNormalMap", {"space": space}, {"Color": c, "Strength": s}))
                    grid.add(f"normal map {space} {color} {strength} "
                             f"{shape.__name__ if shape else 'square'} {name}", material,
                             shape() if shape else None, **placement)
                self.check_field(grid, 5e-4)

    def test_normal_map_of_uv_layers(self):
        """Tangents of a mirrored and of a turned second UV layer."""
        grid = FieldGrid(self.scene)
        layers = {"mirrored": [1, 0, 0, 0, 0, 1, 1, 1], "turned": [0, 1, 0, 0, 1, 0, 1, 1]}
        for name, uv in layers.items():
            for used in ("", name):
                material = emission_of(name, lambda n, u=used: n.add(
                    "ShaderNodeNormalMap", {"uv_map": u}, {"Color": (0.8, 0.4, 0.8)}))
                obj = grid.add(f"normal map {name} uv_map={used!r}", material)
                obj.data.uv_layers.new(name=name).data.foreach_set("uv", uv)
        self.check_field(grid)

    def bump_material(self, settings, inputs, height):
        return emission_of("bump", lambda n: n.add(
            "ShaderNodeBump", settings, {**inputs, "Height": height(n)}))

    @staticmethod
    def slope(nodes):
        position = nodes.add("ShaderNodeNewGeometry").outputs["Position"]
        return nodes.add("ShaderNodeVectorMath", {"operation": "DOT_PRODUCT"},
                         {0: position, 1: (0.3, -0.2, 0.1)}).outputs["Value"]

    @staticmethod
    def wave(nodes):
        coordinate = nodes.add("ShaderNodeTexCoord").outputs["Object"]
        value = nodes.add("ShaderNodeVectorMath", {"operation": "DOT_PRODUCT"},
                          {0: coordinate, 1: (2.0, 1.0, 0.0)}).outputs["Value"]
        return nodes.add("ShaderNodeMath", {"operation": "SINE"}, {0: value})

    def test_bump(self):
        grid = FieldGrid(self.scene)
        for height, invert, (strength, distance), shape, (name, placement) in itertools.product(
                (self.slope, self.wave), (False, True), ((1.0, 1.0), (0.4, 0.1), (1.0, 0.5)),
                (None, sphere_patch), PLACEMENTS.items()):
            material = self.bump_material({"invert": invert}, {
                "Strength": strength, "Distance": distance}, height)
            grid.add(f"bump {height.__name__} invert={invert} {strength} {distance} "
                     f"{shape.__name__ if shape else 'square'} {name}", material,
                     shape() if shape else None, **placement)
        self.check_field(grid, 5e-3)

    def test_flat_height_leaves_the_normal(self):
        grid = FieldGrid(self.scene)
        for name, placement in PLACEMENTS.items():
            material = self.bump_material({}, {}, lambda n: n.add(
                "ShaderNodeAttribute", {"attribute_name": "missing"}).outputs["Fac"])
            grid.add(f"flat {name}", material, **placement)
        self.check_field(grid)

    def test_environment_of_world(self):
        """The world by itself: generated coordinates, window, image, light path."""
        builders = {
            "image": lambda n: n.add("ShaderNodeTexEnvironment", {
                "image": scene_factory.generated_image("sky", 16, 8, test_pixel, packed=True)}),
            "generated": lambda n: n.add("ShaderNodeTexCoord").outputs["Generated"],
            "object": lambda n: n.add("ShaderNodeTexCoord").outputs["Object"],
            "normal": lambda n: n.add("ShaderNodeTexCoord").outputs["Normal"],
            "incoming": lambda n: n.add("ShaderNodeNewGeometry").outputs["Incoming"],
            "position": lambda n: n.add("ShaderNodeNewGeometry").outputs["Position"],
            "window": lambda n: n.add("ShaderNodeTexCoord").outputs["Window"],
            "camera": lambda n: n.add("ShaderNodeLightPath").outputs["Is Camera Ray"],
        }
        for name, build in builders.items():
            with self.subTest(name):
                self.setUp()
                background = scene_factory.set_world(self.scene, (1, 1, 1))
                nodes = scene_factory.Nodes(self.scene.world.node_tree)
                nodes.set(background.inputs["Color"], build(nodes))
                scene_factory.camera(self.scene, (0, 0, 0), (1, 2, 0.7), lens=12.0)
                tested, reference = (render(engine, samples=256, resolution=(24, 16))
                                     for engine in (TESTED_ENGINE, REFERENCE_ENGINE))
                self.assert_pictures_agree([tested], [reference], name, block=4, relative=0.003,
                                           absolute=0.003)


class LightPathParityTest(RenderTestCase):
    """Light Path on rays that are not the camera's, by paths without noise."""

    OUTPUTS = ("Is Camera Ray", "Is Diffuse Ray", "Is Glossy Ray", "Is Singular Ray",
               "Is Reflection Ray", "Is Transmission Ray", "Ray Depth", "Diffuse Depth",
               "Glossy Depth", "Transparent Depth", "Transmission Depth", "Ray Length")

    FIRST_SURFACES = {
        "mirror": lambda: scene_factory.mirror(),
        "rough mirror": lambda: scene_factory.mirror(roughness=0.3),
        "transparent": lambda: scene_factory.simple_material("ShaderNodeBsdfTransparent",
                                                             Color=(1, 1, 1)),
        "refraction": lambda: scene_factory.simple_material(
            "ShaderNodeBsdfRefraction", settings={"distribution": "SHARP"}, Color=(1, 1, 1),
            IOR=1.0001),
        "glass": lambda: scene_factory.simple_material(
            "ShaderNodeBsdfGlass", settings={"distribution": "SHARP"}, Color=(1, 1, 1), IOR=1.2),
        "diffuse": lambda: scene_factory.diffuse((1, 1, 1)),
        "translucent": lambda: scene_factory.simple_material("ShaderNodeBsdfTranslucent",
                                                             Color=(1, 1, 1)),
    }

    def test_after_one_event(self):
        """A surface in the middle of a box that shows the Light Path output."""
        for output in self.OUTPUTS:
            for name, first in self.FIRST_SURFACES.items():
                with self.subTest(f"{output} after {name}"):
                    self.setUp()
                    shown = emission_of(output, lambda n, o=output: n.add(
                        "ShaderNodeLightPath").outputs[o])
                    shown.cycles.sample_as_light = False
                    scene_factory.sphere(self.scene, 4.0, shown, 64, 32, smooth=False)
                    scene_factory.plane(self.scene, 6.0, first())
                    scene_factory.top_camera(self.scene, 0.1, height=2.0)
                    self.assert_agrees(f"{output} {name}", resolution=(4, 4), samples=256, seeds=2,
                                       relative=0.005, max_noise=0.02)


