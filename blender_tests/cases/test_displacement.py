# SPDX-License-Identifier: GPL-3.0-or-later
"""Displacement as bump, as geometry and as both, against Cycles."""
from support import scene_factory
from support.case import RenderTestCase
from support.parity import pattern_image

METHODS = ("BUMP", "DISPLACEMENT", "BOTH")


def subdivided(count=40, smooth=True):
    """Square of side 2 with UVs."""
    row = count + 1
    vertices = [(2 * i / count - 1, 2 * j / count - 1, 0) for j in range(row) for i in range(row)]
    faces = [(a, a + 1, a + row + 1, a + row)
             for j in range(count) for a in range(j * row, j * row + count)]
    uv = [((vertices[c][0] + 1) / 2, (vertices[c][1] + 1) / 2) for face in faces for c in face]
    return scene_factory.mesh("Grid", vertices, faces, uv=uv, smooth=smooth)


def noise(nodes, coordinate="Generated"):
    vector = nodes.add("ShaderNodeTexCoord").outputs[coordinate]
    return nodes.add("ShaderNodeTexNoise", None, {"Vector": vector, "Scale": 2.5}).outputs["Fac"]


def wave(nodes):
    vector = nodes.add("ShaderNodeTexCoord").outputs["Object"]
    return nodes.add("ShaderNodeTexWave", None, {"Vector": vector, "Scale": 0.25}).outputs["Fac"]


def image(nodes):
    return nodes.add("ShaderNodeTexImage", {"image": pattern_image("relief", packed=True)}
                     ).outputs["Color"]


class DisplacementTest(RenderTestCase):

    def material(self, method, build, color=lambda n: (0.8, 0.6, 0.4)):
        material = scene_factory.node_material(f"displaced {method}", lambda n: n.add(
            "ShaderNodeBsdfDiffuse", None, {"Color": color(n)}))
        nodes = scene_factory.Nodes(material.node_tree)
        output = next(n for n in nodes.tree.nodes if n.type == "OUTPUT_MATERIAL")
        nodes.set(output.inputs["Displacement"], build(nodes))
        material.cycles.displacement_method = method
        return material

    def show(self, name, method, build, shape="grid", color=lambda n: (0.8, 0.6, 0.4),
             change=lambda data: None, **placement):
        with self.subTest(name, method=method):
            self.setUp()
            material = self.material(method, build, color)
            if shape == "sphere":
                scene_factory.sphere(self.scene, 1.0, material, segments=64, rings=32, **placement)
            else:
                data = subdivided(smooth=shape == "grid")
                data.materials.append(material)
                change(data)
                scene_factory.link(self.scene, data, **placement)
            scene_factory.lamp(self.scene, "SUN", 3.0, rotation=(40, 20, 0))
            scene_factory.set_world(self.scene, (0.2, 0.25, 0.3))
            scene_factory.camera(self.scene, (0, -2.5, 3.5), (0, 0, 0), lens=50.0)
            self.assert_agrees(f"{name} {method}", samples=32, resolution=(96, 64), block=16,
                               seeds=3, relative=0.01, absolute=3e-3, max_noise=0.01,
                               max_bounces=2)

    @staticmethod
    def along_normal(height, scale=0.3, midlevel=0.5, space="OBJECT"):
        return lambda n: n.add("ShaderNodeDisplacement", {"space": space}, {
            "Height": height(n), "Scale": scale, "Midlevel": midlevel})

    def test_methods(self):
        for method in METHODS:
            for height in (noise, wave, image):
                self.show(height.__name__, method, self.along_normal(height))
            self.show("steep", method, self.along_normal(wave, 0.8))
            self.show("ball", method, self.along_normal(noise, 0.5, 0.2), shape="sphere")
            self.show("ball by place", method, self.along_normal(lambda n: noise(n, "Object"), 0.3),
                      shape="sphere")

    def test_flat_faces(self):
        self.show("flat", "DISPLACEMENT", self.along_normal(noise), shape="flat grid")

    def test_coordinates_of_what_has_moved(self):
        """Generated coordinates stay with the surface; Object and Position are of the new place."""
        for output in ("Generated", "Object", "Normal", "UV"):
            self.show(output, "DISPLACEMENT", self.along_normal(noise, 0.8), color=lambda n: n.add(
                "ShaderNodeTexCoord").outputs[output])

    def test_slots(self):
        """Only the faces whose material displaces move, and those beside them at the seam."""
        def split(data):
            data.materials.append(scene_factory.diffuse((0.2, 0.5, 0.8)))
            for polygon in data.polygons:
                polygon.material_index = int(polygon.center.x > 0)
        self.show("slots", "DISPLACEMENT", self.along_normal(noise, 0.6, 0.0), change=split)

    def test_auto_smooth(self):
        """Normals by corner follow too."""
        def sharpen(data):
            data.use_auto_smooth = True
            data.auto_smooth_angle = 0.5
        self.show("auto smooth", "DISPLACEMENT", self.along_normal(noise), change=sharpen)

    def test_spaces(self):
        for method in METHODS:
            for space in ("OBJECT", "WORLD"):
                for scale in ((1.2, 0.8, 1.5), (-1.0, 1.0, 1.2)):
                    self.show(f"{space} {scale}", method, self.along_normal(wave, space=space),
                              rotation=(10, 20, 30), scale=scale)

    def test_steep_by_attribute(self):
        """Generated coordinates move with the surface."""
        for scale in ((1, 1, 1), (1.2, 0.8, 1.5)):
            self.show(f"noise {scale}", "BOTH", self.along_normal(noise, 1.2), scale=scale)

    def test_vector(self):
        for space in ("TANGENT", "OBJECT", "WORLD"):
            self.show(f"vector {space}", "DISPLACEMENT", lambda n, s=space: n.add(
                "ShaderNodeVectorDisplacement", {"space": s}, {
                    "Vector": n.add("ShaderNodeCombineXYZ", None, {0: 0.4, 1: noise(n), 2: 0.1}),
                    "Midlevel": 0.2, "Scale": 0.6}), rotation=(10, 0, 30))
