# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests of participating media share: a lit room, and simulated smoke."""
import pathlib
import shutil
import tempfile

from . import scene_factory
from .case import RenderTestCase


def volume(node, **inputs):
    """Maker of a material of one volume node and no surface."""
    named = {key.replace("_", " "): value for key, value in inputs.items()}
    return lambda: scene_factory.volume_material(node, lambda n: n.add(node, None, named))


class VolumeCase(RenderTestCase):

    def room(self, lamp="SUN", **settings):
        """A floor, a coloured wall and a lamp; the middle is left for what is tested."""
        scene_factory.plane(self.scene, 12.0, scene_factory.diffuse((0.7, 0.6, 0.5)),
                            location=(0, 0, -1.2))
        scene_factory.plane(self.scene, 12.0, scene_factory.diffuse((0.2, 0.4, 0.8)),
                            location=(0, 4, 0), rotation=(90, 0, 0))
        scene_factory.camera(self.scene, (1.5, -6, 2.5), (0, 0, 0), lens=45.0)
        defaults = {"SUN": dict(energy=3.0, angle=0.1, rotation=(35, 20, 0)),
                    "POINT": dict(energy=300.0, shadow_soft_size=0.1, location=(-1.8, -1.0, 2.0)),
                    "AREA": dict(energy=300.0, size=1.0, location=(-1.5, 0, 2.5),
                                 rotation=(0, -30, 0)),
                    "SPOT": dict(energy=600.0, shadow_soft_size=0.05, spot_size=0.9,
                                 location=(-2.0, 0, 2.0), rotation=(0, -45, 0))}[lamp]
        scene_factory.lamp(self.scene, lamp, **{**defaults, **settings})

    def agrees(self, name, samples=256, relative=0.005, block=12, seeds=3, max_noise=0.012,
               volume_bounces=0, **arguments):
        self.assert_agrees(name, samples=samples, resolution=(36, 36), block=block, seeds=seeds,
                           relative=relative, max_noise=max_noise, absolute=2e-4,
                           volume_bounces=volume_bounces, **arguments)

    def in_box(self, name, make, lamp="SUN", **arguments):
        with self.subTest(name):
            self.setUp()
            self.room(lamp)
            scene_factory.box(self.scene, 2.0, make(), rotation=(0, 0, 25))
            self.agrees(name, **arguments)

    def smoke(self, build):
        """A box of some frames of a simulation; its volume is what `build(Nodes)` returns. Returns
        the folder of its OpenVDB files."""
        cache = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, cache, ignore_errors=True)
        domain = scene_factory.box(self.scene, 2.0, scene_factory.volume_material("smoke", build),
                                   rotation=(0, 0, 25))
        modifier = domain.modifiers.new("Fluid", "FLUID")
        modifier.fluid_type = "DOMAIN"
        settings = modifier.domain_settings
        settings.domain_type = "GAS"
        settings.resolution_max = 16
        settings.cache_type = "REPLAY"
        settings.cache_directory = cache
        source = scene_factory.sphere(self.scene, 0.45, location=(0.2, 0, -0.5))
        source.hide_render = True
        flow = source.modifiers.new("Fluid", "FLUID")
        flow.fluid_type = "FLOW"
        flow.flow_settings.flow_type = "BOTH"
        flow.flow_settings.flow_behavior = "INFLOW"
        flow.flow_settings.smoke_color = (0.9, 0.4, 0.1)
        for frame in range(1, 6):
            self.scene.frame_set(frame)
        return pathlib.Path(cache) / "data"
