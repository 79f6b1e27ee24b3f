# SPDX-License-Identifier: GPL-3.0-or-later
"""Normal maps whose green points down (DirectX), turned around in the tree as artists do it."""
import itertools

from support import scene_factory
from support.parity import ParityCase
from support.render import TESTED_ENGINE, render
from support.tile_grid import FieldGrid, emission_of


def tilt(x, y):
    """Normals that lean, by green far more to one side than to the other."""
    return (0.35 + 0.03 * x, 0.2 + 0.04 * y, 0.85, 1.0)


def upright(x, y):
    """What `tilt` shows with green the other way up."""
    red, green, blue, alpha = tilt(x, y)
    return (red, 1.0 - green, blue, alpha)


def map_image(name, pixel):
    return scene_factory.generated_image(name, 8, 8, pixel, float_buffer=True,
                                         colorspace="Non-Color")


def as_it_is(nodes, color):
    return color


def by_channels(nodes, color):
    parts = nodes.add("ShaderNodeSeparateColor", None, {"Color": color})
    down = nodes.add("ShaderNodeInvert", None, {"Color": parts.outputs["Green"]})
    green = nodes.add("ShaderNodeSeparateColor", None, {"Color": down}).outputs["Green"]
    return nodes.add("ShaderNodeCombineColor", None, {
        "Red": parts.outputs["Red"], "Green": green, "Blue": parts.outputs["Blue"]})


def by_math(nodes, color):
    parts = nodes.add("ShaderNodeSeparateXYZ", None, {"Vector": color})
    green = nodes.add("ShaderNodeMath", {"operation": "SUBTRACT"}, {0: 1.0, 1: parts.outputs["Y"]})
    return nodes.add("ShaderNodeCombineXYZ", None, {
        "X": parts.outputs["X"], "Y": green, "Z": parts.outputs["Z"]})


def by_curves(nodes, color):
    node = nodes.add("ShaderNodeRGBCurve", None, {"Color": color})
    points = node.mapping.curves[1].points
    points[0].location, points[1].location = (0.0, 1.0), (1.0, 0.0)
    for point in points:
        point.handle_type = "VECTOR"
    node.mapping.update()
    return node


WAYS = (by_channels, by_math, by_curves)
# UVs of a square's corners: as drawn, and mirrored in each direction.
LAYOUTS = {"plain": [0, 0, 1, 0, 1, 1, 0, 1], "mirrored": [1, 0, 0, 0, 0, 1, 1, 1],
           "upside down": [0, 1, 1, 1, 1, 0, 0, 0]}


class GreenDownTest(ParityCase):

    @staticmethod
    def normal(nodes, image, turn):
        color = nodes.add("ShaderNodeTexImage", {"image": image}).outputs["Color"]
        return nodes.add("ShaderNodeNormalMap", None, {"Color": turn(nodes, color)})

    def test_as_the_reference(self):
        image = map_image("down", tilt)
        grid = FieldGrid(self.scene)
        for way, (name, uv), scale in itertools.product(WAYS, LAYOUTS.items(), (1.0, -1.0)):
            material = emission_of("normal", lambda n, w=way: self.normal(n, image, w))
            obj = grid.add(f"{way.__name__} {name} {scale}", material, scale=(scale, 1.0, 1.0))
            obj.data.uv_layers[0].data.foreach_set("uv", uv)
        # Between the pixels of the image the normal bends within a tile.
        self.check_field(grid, 5e-4)

    def squares(self, image, turn):
        """Each layout in the light of a low sun."""
        self.setUp()
        material = scene_factory.node_material("map", lambda n: n.add(
            "ShaderNodeBsdfDiffuse", None, {"Normal": self.normal(n, image(), turn)}))
        for i, uv in enumerate(LAYOUTS.values()):
            square = scene_factory.plane(self.scene, 2.0, material, location=(2.0 * i - 2.0, 0, 0))
            square.data.uv_layers[0].data.foreach_set("uv", uv)
        scene_factory.lamp(self.scene, "SUN", 3.0, rotation=(50, 0, 20), angle=0.0)
        scene_factory.top_camera(self.scene, 6.0)
        return render(TESTED_ENGINE, 16, 3, (48, 16))

    def test_equals_the_inverted_map(self):
        def down():
            return map_image("down", tilt)

        def up():
            return map_image("up", upright)
        expected = self.squares(up, as_it_is)
        self.assertGreater(min(expected.mean()[:3]), 0.1, "the sun misses the squares")
        unturned = self.squares(down, as_it_is)
        self.assertGreater(max(abs(a - b) for a, b in zip(unturned.rgba, expected.rgba)), 0.1,
                           "green does not matter")
        for way in WAYS:
            with self.subTest(way.__name__):
                turned = self.squares(down, way)
                for a, b in zip(turned.rgba, expected.rgba):
                    self.assertAlmostEqual(a, b, delta=2e-3)
