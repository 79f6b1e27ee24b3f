# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes that read surface, object, ray or world, as fields over a pixel (see tile_grid)."""
import itertools
import math

import bpy

from support import scene_factory
from support.case import RenderTestCase
from support.parity import ParityCase, pattern_image
from support.render import REFERENCE_ENGINE, TESTED_ENGINE, render
from support.tile_grid import FieldGrid, emission_of, enum_items


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

    def test_tangent(self):
        for settings in ({"axis": "X"}, {"axis": "Y"}, {"axis": "Z"}, {"direction_type": "UV_MAP"}):
            with self.subTest(settings):
                self.setUp()
                # A flat face has no direction about an axis that lies in it.
                shapes = (sphere_patch,) if settings.get("axis") in ("X", "Y") else (
                    None, sphere_patch)
                self.check_field(self.field_of("ShaderNodeTangent", ("Tangent",), settings,
                                               shapes), tolerance=2e-4)

    def test_camera_data(self):
        self.check_field(self.field_of("ShaderNodeCameraData", (
            "View Vector", "View Z Depth", "View Distance")))

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

    def test_random_of_several_islands(self):
        """Hidden parts before the one that shows move its number."""
        grid = FieldGrid(self.scene)
        for hidden in range(4):
            vertices, faces = [], []
            for part in range(hidden + 1):
                size, height = (0.7, 0.0) if part == hidden else (0.1, -0.1 * (part + 1))
                faces.append(tuple(range(4 * part, 4 * part + 4)))
                vertices += [(x * size, y * size, height)
                             for x, y in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
            material = emission_of("island", lambda n: n.add(
                "ShaderNodeNewGeometry").outputs["Random Per Island"])
            grid.add(f"{hidden} hidden", material,
                     scene_factory.mesh("Islands", vertices, faces))
        self.check_field(grid)

    def test_incoming_in_perspective(self):
        material = emission_of("incoming", lambda n: n.add(
            "ShaderNodeNewGeometry").outputs["Incoming"])
        scene_factory.plane(self.scene, 200.0, material, rotation=(20, 10, 0))
        scene_factory.camera(self.scene, (1, 1, 6), (1.2, 1.4, 0), lens=30.0)
        tested, reference = (render(engine, 256, seed, (24, 24))
                             for engine, seed in ((TESTED_ENGINE, 0), (REFERENCE_ENGINE, 1000)))
        self.assert_pictures_agree([tested], [reference], block=4, relative=0.001, absolute=0.001)

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
        values = [0.13 + 0.21 * ((7 * i) % 4) + 0.05 * (i % 3)
                  for i in range(len(layer.data) * width)]
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
                "image": pattern_image("sky", 16, 8, packed=True)}),
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
                    self.assert_agrees(f"{output} {name}", resolution=(8, 8), samples=256, seeds=2,
                                       relative=0.005, max_noise=0.05)
