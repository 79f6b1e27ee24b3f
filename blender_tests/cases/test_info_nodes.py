# SPDX-License-Identifier: GPL-3.0-or-later
"""Wireframe, Pointiness, particle, hair and point info; lamps with IES and Light Falloff."""
import os
import tempfile

import bpy

from support import scene_factory
from support.case import RenderTestCase
from support.parity import ParityCase
from support.tile_grid import FieldGrid, emission_of
from cases.test_geometry_parity import PLACEMENTS, sphere_patch

# Type C over a quarter, C without the last angle, B over a half, and what Blender cannot use.
IES_TEXTS = {
    "quarter": "1\n3 3 1 2 0 0 0\n1 1 9\n0 45 90\n0 30 90\n800 300 50 800 500 20 800 900 10\n",
    "round": "2\n4 1 1 2 0 0 0\n1 0.9 9\n0, 20, 60, 180\n0\n900 700 100 30\n",
    "gap": "1\n3 4 1 2 0 0 0\n1 1 9\n0 60 120\n0 90 180 270\n300 8 7 300 5 400 300 2 1 300 5 4\n",
    "type b": "1\n3 3 2 2 0 0 0\n1 1 9\n0 45 90\n-90 0 90\n8 3 5 600 500 20 8 900 10\n",
    "upward": "1\n3 1 1 2 0 0 0\n1 1 9\n90 120 180\n0\n100 500 900\n",
    "broken": "1\n3 1\n",
}


def ies_text(name):
    numbers = IES_TEXTS[name]
    return "IESNA:LM-63-2002\n[TEST] made by hand\nTILT=NONE\n1 1000 " + numbers


class InfoParityTest(ParityCase):

    def field_of(self, node_type, outputs, settings=None, inputs=None,
                 shapes=(None, sphere_patch)):
        grid = FieldGrid(self.scene)
        for output in outputs:
            for shape in shapes:
                for name, placement in PLACEMENTS.items():
                    material = emission_of(f"{node_type} {output}", lambda n, o=output: n.add(
                        node_type, settings, inputs).outputs[o])
                    grid.add(f"{node_type[10:]} {output} {bool(shape)} {name}", material,
                             shape() if shape else None, **placement)
        return grid

    def test_hair_and_points_on_a_mesh(self):
        outputs = ("Is Strand", "Intercept", "Length", "Thickness", "Tangent Normal", "Random")
        self.check_field(self.field_of("ShaderNodeHairInfo", outputs, shapes=(None,)))
        self.setUp()
        self.check_field(self.field_of("ShaderNodePointInfo", ("Position", "Radius", "Random"),
                                       shapes=(None,)))

    def test_particle_info_without_particle(self):
        outputs = ("Index", "Random", "Age", "Lifetime", "Location", "Size", "Velocity",
                   "Angular Velocity")
        self.check_field(self.field_of("ShaderNodeParticleInfo", outputs, shapes=(None,)))

    def test_pointiness(self):
        grid = FieldGrid(self.scene)
        for name, placement in PLACEMENTS.items():
            for shape in (None, sphere_patch, self.ridge):
                material = emission_of("pointiness", lambda n: n.add(
                    "ShaderNodeNewGeometry").outputs["Pointiness"])
                grid.add(f"pointiness {name} {shape}", material, shape() if shape else None,
                         **placement)
        self.check_field(grid)

    @staticmethod
    def ridge():
        """A bent sheet of split faces: each has vertices of its own."""
        vertices, faces = [], []
        for i in range(3):
            x0, x1 = -0.5 + 0.4 * i, -0.1 + 0.4 * i
            faces.append(tuple(range(4 * i, 4 * i + 4)))
            vertices += [(x, y, -abs(x) * 0.6) for x, y in (
                (x0, -0.5), (x1, -0.5), (x1, 0.6), (x0, 0.6))]
        return scene_factory.mesh("Ridge", vertices, faces)

    def wires(self, size, pixels):
        """A folded sheet of quads, triangles and a pentagon under its wires."""
        material = emission_of("wires", lambda n: n.add(
            "ShaderNodeWireframe", {"use_pixel_size": pixels}, {"Size": size}))
        vertices = [(0, 0, 0), (1, 0, 0), (2, 0, 0.4), (0, 1, 0.3), (1, 1.2, 0), (2, 1, 0),
                    (0, 2, 0), (1, 2, 0.3), (2, 2, 0), (2.6, 1, 0)]
        faces = [(0, 1, 4, 3), (1, 2, 5), (1, 5, 4), (3, 4, 7, 6), (4, 5, 9, 8, 7)]
        scene_factory.link(self.scene, scene_factory.mesh("Wires", vertices, faces, material),
                           rotation=(10, -20, 30), scale=(0.5, 0.5, 0.5))

    def test_wireframe(self):
        """The mean over pixels of a few wires each."""
        for size, pixels in ((0.04, False), (0.15, False), (2.0, True), (6.0, True)):
            for kind in ("ORTHO", "PERSP"):
                with self.subTest(f"size {size} pixels {pixels} {kind}"):
                    self.setUp()
                    self.wires(size, pixels)
                    if kind == "ORTHO":
                        scene_factory.top_camera(self.scene, 1.6, (0.4, 0.6))
                    else:
                        scene_factory.camera(self.scene, (0.4, -2.0, 3.0), (0.4, 0.6, 0), lens=70)
                    self.assert_agrees(samples=256, resolution=(48, 48), block=8, relative=0.002,
                                       absolute=1e-3, seeds=3, max_noise=0.01)


class ParticleTest(RenderTestCase):

    def test_particles_know_themselves(self):
        """Instances of a particle system emit what Particle Info says."""
        for output in ("Index", "Random", "Age", "Lifetime", "Location", "Size", "Velocity",
                       "Angular Velocity"):
            with self.subTest(output):
                self.setUp()
                material = emission_of("particle", lambda n: n.add("ShaderNodeVectorMath", {
                    "operation": "SCALE"}, {0: n.add("ShaderNodeParticleInfo").outputs[output],
                                            "Scale": 0.1}))
                grain = scene_factory.plane(self.scene, 2.0, material, location=(0, 0, -50))
                ground = scene_factory.plane(self.scene, 4.0, name="Ground")
                system = ground.modifiers.new("Particles", "PARTICLE_SYSTEM").particle_system
                settings = system.settings
                settings.count, settings.frame_start, settings.frame_end = 20, 0.0, 3.0
                settings.lifetime, settings.render_type = 30, "OBJECT"
                settings.instance_object, settings.particle_size = grain, 0.2
                settings.normal_factor = 0.5
                self.scene.frame_set(1)
                self.scene.frame_set(5)
                scene_factory.top_camera(self.scene, 5.0)
                self.assert_agrees(output, samples=256, resolution=(32, 32), block=8,
                                   absolute=1e-3, seeds=2, max_noise=0.02)


class InstancerTest(RenderTestCase):
    """Coordinates that an instancer gives: one value for each of its instances."""

    def spread(self, material):
        """Small planes on the faces of a tilted ground with UVs."""
        vertices = [(x - 2.0, y - 1.5, 0.3 * x) for y in range(4) for x in range(5)]
        faces = [(5 * y + x, 5 * y + x + 1, 5 * y + x + 6, 5 * y + x + 5)
                 for y in range(3) for x in range(4)]
        uv = [(vertices[v][0] / 5.0 + 0.5, vertices[v][1] ** 2 / 4.0) for f in faces for v in f]
        ground = scene_factory.link(self.scene, scene_factory.mesh(
            "Ground", vertices, faces, uv=uv), rotation=(0, 0, 20))
        grain = scene_factory.plane(self.scene, 0.7, material)
        grain.parent = ground
        ground.instance_type = "FACES"
        ground.show_instancer_for_render = False
        scene_factory.top_camera(self.scene, 5.0)

    def test_from_instancer(self):
        for node, outputs in (("ShaderNodeTexCoord", ("Generated", "UV")),
                              ("ShaderNodeUVMap", ("UV",))):
            for output in outputs:
                for chosen in (True, False):
                    with self.subTest(f"{node} {output} {chosen}"):
                        self.setUp()
                        self.spread(emission_of("coordinate", lambda n: n.add(
                            node, {"from_instancer": chosen}).outputs[output]))
                        self.assert_agrees(f"{node} {output} {chosen}", samples=32,
                                           resolution=(40, 40), block=8, absolute=2e-3, seeds=2,
                                           max_noise=0.03)


class LampNodeTest(RenderTestCase):

    def lit_ground(self, kind, build, **settings):
        scene_factory.plane(self.scene, 6.0, scene_factory.diffuse())
        lamp = scene_factory.lamp(self.scene, kind, 100.0, (0.4, 0.2, 1.2), (25, 10, 70),
                                  **settings)
        lamp.data.use_nodes = True
        if kind == "SPOT":
            lamp.data.spot_size = 2.8    # its edge outside of the picture
        nodes = scene_factory.Nodes(lamp.data.node_tree)
        emission = lamp.data.node_tree.nodes["Emission"]
        nodes.set(emission.inputs["Strength"], build(nodes))
        scene_factory.top_camera(self.scene, 4.0)

    def test_light_falloff(self):
        for output in ("Quadratic", "Linear", "Constant"):
            for smooth in (0.0, 1.5):
                for kind in ("POINT", "SPOT", "AREA"):
                    with self.subTest(f"{output} {smooth} {kind}"):
                        self.setUp()
                        self.lit_ground(kind, lambda n: n.add("ShaderNodeLightFalloff", None, {
                            "Strength": 2.0, "Smooth": smooth}).outputs[output])
                        self.assert_agrees(samples=64, resolution=(16, 16), block=4,
                                           max_noise=0.01, seeds=3)

    def test_ies(self):
        for kind in ("POINT", "SPOT", "AREA"):
            # An area lamp asks for its axis only, where all horizontal angles meet.
            for name in ("round", "broken") if kind == "AREA" else IES_TEXTS:
                with self.subTest(f"{name} {kind}"):
                    self.setUp()
                    text = bpy.data.texts.new(name)
                    text.write(ies_text(name))
                    self.lit_ground(kind, lambda n: n.add("ShaderNodeTexIES", {
                        "mode": "INTERNAL", "ies": text}, {"Strength": 0.1}))
                    self.assert_agrees(samples=64, resolution=(16, 16), block=4, max_noise=0.015,
                                       seeds=3)

    def test_ies_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "lamp.ies")
            with open(path, "w", encoding="ascii") as file:
                file.write(ies_text("round"))
            for filepath in (path, os.path.join(folder, "missing.ies")):
                with self.subTest(os.path.basename(filepath)):
                    self.setUp()
                    self.lit_ground("POINT", lambda n: n.add("ShaderNodeTexIES", {
                        "mode": "EXTERNAL", "filepath": filepath}, {"Strength": 0.01}))
                    self.assert_agrees(samples=64, resolution=(16, 16), block=4, max_noise=0.01,
                                       seeds=3)
