# SPDX-License-Identifier: GPL-3.0-or-later
"""Each closure under a uniform world and under a sun at several angles, against Cycles."""
import math

from support import scene_factory
from support.case import RenderTestCase

VIEW_ANGLES = (0.0, 45.0, 75.0)
LAMP_ANGLES = (0.0, 30.0, 60.0, 80.0)


class ClosureCase(RenderTestCase):

    def ground(self, material):
        """A plane whose diagonal is far from the spot seen: Cycles 3.4 takes a path that leaves a
        triangle on its edge back to the neighbour, which adds up in glass."""
        scene_factory.plane(self.scene, 100.0, material, location=(20, 7, 0))

    def view(self, angle):
        """A camera that sees a spot of the surface at `angle` degrees from its normal."""
        theta = math.radians(angle)
        scene_factory.camera(self.scene, (4 * math.sin(theta), 0, 4 * math.cos(theta)), (0, 0, 0),
                             type="ORTHO", ortho_scale=0.01)

    def under_world(self, name, make_material, relative=0.003, samples=768, angles=VIEW_ANGLES,
                    seeds=3, **arguments):
        """Flat surface, radiance of the world 0.7: the albedo."""
        for angle in angles:
            with self.subTest(f"{name}, world, seen at {angle:g}"):
                self.setUp()
                self.ground(make_material())
                scene_factory.set_world(self.scene, (0.7, 0.7, 0.7))
                self.view(angle)
                self.assert_agrees(f"{name} world {angle:g}", samples=samples, resolution=(16, 16),
                                   relative=relative, max_noise=0.01, seeds=seeds, **arguments)

    def under_lamp(self, name, make_material, relative=0.003, samples=256, view=30.0,
                   angles=LAMP_ANGLES, behind=False, size=15.0, seeds=3, max_noise=0.01,
                   **arguments):
        """Sun of `size` degrees from several sides: the shape of the lobe."""
        for angle in angles:
            with self.subTest(f"{name}, sun from {angle:g}"):
                self.setUp()
                self.ground(make_material())
                scene_factory.lamp(self.scene, "SUN", energy=3.0, angle=math.radians(size),
                                   rotation=(0, 180 + angle if behind else -angle, 25))
                self.view(view)
                self.assert_agrees(f"{name} sun {angle:g}", samples=samples, resolution=(16, 16),
                                   relative=relative, max_noise=max_noise, absolute=1e-4,
                                   seeds=seeds, **arguments)

    def on_sphere(self, name, make_material, relative=0.003, samples=128, block=16, **arguments):
        """A closed sphere in a two-coloured light: inside and outside of the surface."""
        with self.subTest(f"{name}, sphere"):
            self.setUp()
            scene_factory.sphere(self.scene, 1.0, make_material(), 48, 24)
            scene_factory.set_world(self.scene, (0.3, 0.4, 0.5))
            scene_factory.plane(self.scene, 8.0, scene_factory.diffuse((0.7, 0.5, 0.3)),
                                location=(0, 0, -1.5))
            scene_factory.camera(self.scene, (0, -5, 1.5), (0, 0, 0), lens=70.0)
            self.assert_agrees(f"{name} sphere", samples=samples, resolution=(32, 32), block=block,
                               relative=relative, max_noise=0.01, **arguments)


def closure(node, settings=None, **inputs):
    return lambda: scene_factory.simple_material(node, None, settings, **inputs)


class DiffuseTest(ClosureCase):

    def test_diffuse(self):
        for roughness in (0.0, 0.3, 1.0):
            make = closure("ShaderNodeBsdfDiffuse", Color=(0.8, 0.5, 0.1), Roughness=roughness)
            self.under_world(f"diffuse {roughness}", make)
            self.under_lamp(f"diffuse {roughness}", make)

    def test_velvet(self):
        for sigma in (0.2, 1.0):
            make = closure("ShaderNodeBsdfVelvet", Color=(0.8, 0.5, 0.1), Sigma=sigma)
            self.under_world(f"velvet {sigma}", make, angles=(45.0, 75.0))
            self.under_lamp(f"velvet {sigma}", make, view=75.0)

    def test_translucent(self):
        make = closure("ShaderNodeBsdfTranslucent", Color=(0.8, 0.5, 0.1))
        self.under_world("translucent", make)
        self.under_lamp("translucent", make, behind=True)


class GlossyTest(ClosureCase):

    def test_glossy(self):
        for distribution, roughness in (("SHARP", 0.0), ("GGX", 0.0), ("GGX", 0.3), ("GGX", 0.8),
                                        ("GGX", 1.0), ("BECKMANN", 0.3), ("BECKMANN", 0.9)):
            name = f"glossy {distribution} {roughness}"
            make = closure("ShaderNodeBsdfGlossy", {"distribution": distribution},
                           Color=(0.9, 0.6, 0.3), Roughness=roughness)
            # Cycles draws Beckmann slopes from a table, which brightens what it finds by sampling
            # the closure alone, up to 0.7 %. Its closure's values are exactly ours: see the lamp.
            self.under_world(name, make, relative=0.008 if distribution == "BECKMANN" else 0.003)
            if roughness >= 0.3:
                self.under_lamp(name, make)


    def test_anisotropic(self):
        """Both distributions, stretched either way and turned. Beckmann under a sharp sun, which is
        never found by sampling the closure: Cycles' table of slopes is coarse where they are steep."""
        for distribution in ("GGX", "BECKMANN"):
            for anisotropy, rotation in ((0.6, 0.1), (-0.4, 0.3)):
                make = closure("ShaderNodeBsdfAnisotropic", {"distribution": distribution},
                               Color=(0.9, 0.6, 0.3), Roughness=0.5, Anisotropy=anisotropy,
                               Rotation=rotation)
                self.under_lamp(f"anisotropic {distribution} {anisotropy}", make,
                                size=15.0 if distribution == "GGX" else 0.0, samples=64)


class TransmissionTest(ClosureCase):

    def test_glass(self):
        for distribution, roughness, ior in (("SHARP", 0.0, 1.5), ("GGX", 0.0, 1.3),
                                             ("GGX", 0.4, 1.5), ("BECKMANN", 0.3, 1.5),
                                             ("GGX", 0.3, 0.7)):
            name = f"glass {distribution} {roughness} ior {ior}"
            make = closure("ShaderNodeBsdfGlass", {"distribution": distribution},
                           Color=(0.9, 0.7, 0.5), Roughness=roughness, IOR=ior)
            self.under_world(name, make)
            self.on_sphere(name, make)
            if roughness:
                self.under_lamp(name, make, samples=512, size=40.0, angles=(0.0, 60.0),
                                max_noise=0.02)

    def test_refraction(self):
        """Where a facet can refract the light: within acos(1 / ior) of straight through.

        Beyond, Cycles 3.4 adds the light of lamps off facets seen from behind; and where the bend is
        towards the surface (ior < 1) its samples may leave above it, where its closure is black.
        """
        for distribution, roughness, ior in (("SHARP", 0.0, 1.5), ("GGX", 0.4, 1.5),
                                             ("BECKMANN", 0.3, 1.3), ("GGX", 0.3, 0.8)):
            name = f"refraction {distribution} {roughness} ior {ior}"
            make = closure("ShaderNodeBsdfRefraction", {"distribution": distribution},
                           Color=(0.9, 0.7, 0.5), Roughness=roughness, IOR=ior)
            self.under_world(name, make, angles=VIEW_ANGLES if ior > 1.0 else (0.0, 45.0))
            self.on_sphere(name, make)
            if roughness:
                self.under_lamp(name, make, samples=512, size=25.0, angles=(15.0, 25.0),
                                behind=True, max_noise=0.02)

    def test_glass_sphere_in_uniform_light_is_invisible(self):
        scene_factory.sphere(self.scene, 1.0, scene_factory.simple_material(
            "ShaderNodeBsdfGlass", settings={"distribution": "SHARP"}, Color=(1, 1, 1), IOR=1.5))
        scene_factory.set_world(self.scene, (1, 1, 1))
        scene_factory.top_camera(self.scene, 2.2)
        self.assert_agrees(samples=64, block=8, relative=0.002)

    def test_transparent(self):
        make = closure("ShaderNodeBsdfTransparent", Color=(0.9, 0.5, 0.2))
        self.under_world("transparent", make, angles=(0.0, 60.0), samples=16)
        self.on_sphere("transparent", make)

    def test_transparent_shadow(self):
        scene_factory.plane(self.scene, 4.0, scene_factory.diffuse())
        for i in range(3):
            scene_factory.plane(self.scene, 1.5, closure(
                "ShaderNodeBsdfTransparent", Color=(0.9, 0.5, 0.2))(),
                                location=(0.3 * i, 0, 0.5 + 0.2 * i))
        scene_factory.lamp(self.scene, "AREA", 60.0, (0, 0, 2.5), size=0.5)
        scene_factory.top_camera(self.scene, 4.0)
        self.assert_agrees(samples=256, block=8)


class MixtureTest(ClosureCase):

    @staticmethod
    def two(nodes):
        return (nodes.add("ShaderNodeBsdfDiffuse", None, {"Color": (0.7, 0.2, 0.1)}),
                nodes.add("ShaderNodeBsdfGlossy", {"distribution": "GGX"},
                          {"Color": (0.2, 0.5, 0.9), "Roughness": 0.4}))

    def test_mix_and_add(self):
        def mix(factor):
            def build(nodes):
                first, second = self.two(nodes)
                return nodes.add("ShaderNodeMixShader", None, {0: factor, 1: first, 2: second})
            return lambda: scene_factory.node_material("mix", build)

        def add(nodes):
            first, second = self.two(nodes)
            return nodes.add("ShaderNodeAddShader", None, {0: first, 1: second})

        def half_empty(nodes):
            return nodes.add("ShaderNodeMixShader", None, {0: 0.4, 1: self.two(nodes)[0]})

        for factor in (0.0, 0.3, 1.0):
            self.under_world(f"mix {factor}", mix(factor))
            self.under_lamp(f"mix {factor}", mix(factor), angles=(30.0,))
        self.under_world("add", lambda: scene_factory.node_material("add", add))
        self.under_world("mix with nothing", lambda: scene_factory.node_material("m", half_empty))

    def test_mix_by_fresnel_and_layer_weight(self):
        for node, output in (("ShaderNodeFresnel", "Fac"), ("ShaderNodeLayerWeight", "Facing")):
            def build(nodes):
                first, second = self.two(nodes)
                factor = nodes.add(node).outputs[output]
                return nodes.add("ShaderNodeMixShader", None, {0: factor, 1: first, 2: second})
            self.under_world(f"mix {node}", lambda: scene_factory.node_material("m", build))

    def test_mix_with_transparent_and_emission(self):
        def build(nodes):
            transparent = nodes.add("ShaderNodeBsdfTransparent", None, {"Color": (0.9, 0.8, 0.7)})
            glow = nodes.add("ShaderNodeEmission", None, {"Color": (0.2, 0.6, 0.4)})
            lit = nodes.add("ShaderNodeAddShader", None, {0: self.two(nodes)[0], 1: glow})
            return nodes.add("ShaderNodeMixShader", None, {0: 0.6, 1: transparent, 2: lit})
        make = lambda: scene_factory.node_material("m", build)  # noqa: E731
        self.under_world("cut out", make)
        self.on_sphere("cut out", make)

    def test_nothing_linked(self):
        def nothing(nodes):
            return nodes.add("NodeReroute")
        self.under_world("nothing", lambda: scene_factory.node_material("m", nothing), samples=4,
                         angles=(0.0,))

    def test_volume_without_surface_is_seen_through(self):
        def make():
            material = scene_factory.node_material(
                "m", lambda nodes: nodes.add("ShaderNodeVolumeAbsorption", None, {"Density": 0.0}))
            surface, = material.node_tree.links
            volume = surface.to_node.inputs["Volume"]
            material.node_tree.links.new(surface.from_socket, volume)
            material.node_tree.links.remove(surface)
            return material
        self.under_world("volume", make, samples=4, angles=(0.0,))

    def test_emission(self):
        make = closure("ShaderNodeEmission", Color=(0.9, 0.5, 0.2), Strength=3.0)
        self.under_world("emission", make, samples=4)

    def test_nested_mix(self):
        def build(nodes):
            first, second = self.two(nodes)
            glass = nodes.add("ShaderNodeBsdfGlass", {"distribution": "GGX"}, {"Roughness": 0.2})
            inner = nodes.add("ShaderNodeMixShader", None, {0: 0.3, 1: first, 2: second})
            return nodes.add("ShaderNodeMixShader", None, {0: 0.6, 1: glass, 2: inner})
        self.under_world("nested", lambda: scene_factory.node_material("m", build))


class PrincipledTest(ClosureCase):

    BASE = {"Base_Color": (0.8, 0.4, 0.2)}
    VARIANTS = {
        "default": {},
        "rough 1": {"Roughness": 1.0},
        "smooth": {"Roughness": 0.1},
        "no specular": {"Specular": 0.0},
        "strong specular": {"Specular": 1.0, "Specular_Tint": 0.7},
        "metal": {"Metallic": 1.0, "Roughness": 0.3},
        "rough metal": {"Metallic": 1.0, "Roughness": 0.8},
        "half metal": {"Metallic": 0.5},
        "anisotropic": {"Metallic": 1.0, "Roughness": 0.5, "Anisotropic": 0.8,
                        "Anisotropic_Rotation": 0.15},
        "sheen": {"Sheen": 1.0, "Roughness": 0.8},
        "tinted sheen": {"Sheen": 0.7, "Sheen_Tint": 1.0, "Roughness": 0.8},
        "clearcoat": {"Clearcoat": 1.0, "Clearcoat_Roughness": 0.3},
        "weak clearcoat": {"Clearcoat": 0.4, "Clearcoat_Roughness": 0.05, "Roughness": 0.7},
        "sharp clearcoat": {"Clearcoat": 1.0, "Clearcoat_Roughness": 0.0},
        "rough clearcoat": {"Clearcoat": 1.0, "Clearcoat_Roughness": 1.0},
        "transmission": {"Transmission": 1.0, "Roughness": 0.3, "IOR": 1.45},
        "rough transmission": {"Transmission": 1.0, "Roughness": 0.2,
                               "Transmission_Roughness": 0.4},
        "half transmission": {"Transmission": 0.5, "Roughness": 0.3},
        "sharp transmission": {"Transmission": 1.0, "Roughness": 0.0, "IOR": 1.3},
        "alpha": {"Alpha": 0.4},
        "emission": {"Emission": (0.2, 0.5, 0.1), "Emission_Strength": 2.0},
        # Sheen would be one lobe more than Cycles has room for beside the rest.
        "everything": {"Metallic": 0.3, "Specular": 0.8, "Specular_Tint": 0.4, "Roughness": 0.4,
                       "Clearcoat": 0.6, "Clearcoat_Roughness": 0.2, "Transmission": 0.3,
                       "Alpha": 0.9, "Emission": (0.1, 0.1, 0.2)},
        "everything but coat": {"Metallic": 0.3, "Specular": 0.8, "Specular_Tint": 0.4,
                                "Roughness": 0.4, "Sheen": 0.5, "Transmission": 0.3,
                                "Emission": (0.1, 0.1, 0.2)},
    }

    # Cycles 3.4 counts a transparent part as a density of 1 beside rough refraction.
    WORLD_ANGLES = {"everything": ()}

    def make(self, settings, distribution="GGX"):
        return closure("ShaderNodeBsdfPrincipled", {"distribution": distribution},
                       **{**self.BASE, **settings})


def _principled_test(name, settings):
    def test(self):
        make = self.make(settings)
        self.under_world(name, make, angles=self.WORLD_ANGLES.get(name, (0.0, 60.0)))
        if settings.get("Roughness", 0.5) >= 0.2:
            self.under_lamp(name, make, angles=(0.0, 50.0),
                            size=40.0 if "transmission" in name else 15.0)
        if "transmission" in name or name in ("alpha", "everything but coat"):
            self.on_sphere(name, make)
    return test


for _name, _settings in PrincipledTest.VARIANTS.items():
    setattr(PrincipledTest, "test_" + _name.replace(" ", "_"), _principled_test(_name, _settings))


class TexturedInputTest(ClosureCase):

    def test_principled(self):
        """Colour, roughness and specular each by a texture of its own."""
        def build(nodes):
            place = nodes.add("ShaderNodeTexCoord").outputs["Object"]
            checker = nodes.add("ShaderNodeTexChecker", None, {
                "Vector": place, "Color1": (0.8, 0.4, 0.1), "Color2": (0.1, 0.3, 0.6),
                "Scale": 4.0})
            noise = nodes.add("ShaderNodeTexNoise", None, {"Vector": place, "Scale": 3.0})
            rough = nodes.add("ShaderNodeMapRange", None, {"Value": noise.outputs["Fac"],
                                                           "To Min": 0.2, "To Max": 0.9})
            wave = nodes.add("ShaderNodeTexWave", None, {"Vector": place, "Scale": 2.0})
            return nodes.add("ShaderNodeBsdfPrincipled", {"distribution": "GGX"}, {
                "Base Color": checker.outputs["Color"], "Roughness": rough,
                "Specular": wave.outputs["Fac"]})
        self.on_sphere("textured", lambda: scene_factory.node_material("textured", build),
                       samples=256, block=8, relative=0.01)


class NormalInputTest(ClosureCase):
    """Shading normals that differ from the surface, incl. the light-leak rule."""

    def test_normal_map(self):
        def build(kind, settings):
            def make(nodes):
                normal = nodes.add("ShaderNodeNormalMap", None, {"Color": (0.85, 0.4, 0.75)})
                return nodes.add(kind, settings, {"Normal": normal})
            return lambda: scene_factory.node_material("n", make)
        for kind, settings in (("ShaderNodeBsdfDiffuse", {}), ("ShaderNodeBsdfVelvet", {}),
                               ("ShaderNodeBsdfGlossy", {"distribution": "GGX"}),
                               ("ShaderNodeBsdfPrincipled", {"distribution": "GGX"})):
            make = build(kind, settings)
            self.under_world(f"normal map on {kind}", make, angles=(0.0, 60.0))
            self.under_lamp(f"normal map on {kind}", make, angles=(0.0, 40.0), max_noise=0.02)

    def test_smooth_low_poly_sphere(self):
        """Interpolated normals on few faces."""
        scene_factory.sphere(self.scene, 1.0, scene_factory.diffuse(), 8, 5)
        scene_factory.lamp(self.scene, "SUN", rotation=(50, 20, 0), angle=0.1)
        scene_factory.set_world(self.scene, (0.1, 0.1, 0.1))
        scene_factory.camera(self.scene, (0, -5, 1), (0, 0, 0), lens=80.0)
        self.assert_agrees(samples=256, block=8, relative=0.01, max_noise=0.01)

    def test_glossy_low_poly_sphere(self):
        scene_factory.sphere(self.scene, 1.0, scene_factory.mirror(roughness=0.2), 12, 7)
        scene_factory.lamp(self.scene, "SUN", rotation=(50, 20, 0), angle=0.5)
        scene_factory.set_world(self.scene, (0.3, 0.5, 0.8))
        scene_factory.camera(self.scene, (0, -5, 1), (0, 0, 0), lens=80.0)
        self.assert_agrees(samples=512, block=16, relative=0.01, max_noise=0.02)
