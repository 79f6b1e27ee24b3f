# SPDX-License-Identifier: GPL-3.0-or-later
"""MirrorCase: the room with a looking glass that the magic mirror tests share."""
import unittest
from array import array

import bpy

from . import scene_factory
from .case import RenderTestCase
from .picture import Picture
from .render import TESTED_ENGINE, render

MIRROR_Y = 2.0


def flat(picture, mask):
    """`picture` with everything outside `mask` (list of bool a pixel) black."""
    rgba = array("f", picture.rgba)
    for index, inside in enumerate(mask):
        if not inside:
            rgba[4 * index:4 * index + 4] = array("f", [0.0] * 4)
    return Picture(picture.width, picture.height, rgba)


def flipped(picture):
    """`picture` mirrored left to right."""
    rgba = array("f")
    for y in range(picture.height):
        for x in range(picture.width - 1, -1, -1):
            rgba.extend(picture.pixel(x, y))
    return Picture(picture.width, picture.height, rgba)


def coated(nodes):
    """A diffuse and a rough glossy lobe in equal parts."""
    diffuse = nodes.add("ShaderNodeBsdfDiffuse", None, {"Color": (0.7, 0.3, 0.2)})
    glossy = nodes.add("ShaderNodeBsdfGlossy", {"distribution": "GGX"},
                       {"Color": (0.9, 0.9, 0.9), "Roughness": 0.4})
    return nodes.add("ShaderNodeMixShader", None, {0: 0.5, 1: diffuse, 2: glossy})


@unittest.skipUnless(TESTED_ENGINE == "TENNIEL", "only Tenniel has a magic mirror")
class MirrorCase(RenderTestCase):

    RESOLUTION = (48, 36)

    def looking_glass(self, material=None, **tags):
        """The mirror: a wall at y = MIRROR_Y that faces -Y."""
        material = material or scene_factory.mirror((0.9, 0.9, 0.9))
        obj = scene_factory.plane(self.scene, 3.0, material, "Looking Glass",
                                  location=(0, MIRROR_Y, 1.2), rotation=(90, 0, 0))
        obj.tenniel.looking_glass = True
        for name, value in tags.items():
            setattr(obj.tenniel, name, value)
        return obj

    def room(self, mirror_material=None):
        """Floor, three spheres (of both sides, of this side, behind), lamp, mirror, camera."""
        scene_factory.plane(self.scene, 10.0, scene_factory.diffuse((0.8, 0.8, 0.8)), "Floor")
        for x, side, color in ((-0.9, "BOTH", (0.8, 0.1, 0.1)), (0.0, "THIS_SIDE", (0.1, 0.2, 0.8)),
                               (0.9, "BEHIND", (0.1, 0.7, 0.2))):
            obj = scene_factory.sphere(self.scene, 0.4, scene_factory.diffuse(color), 24, 12,
                                       name=side, location=(x, 0.6, 0.4))
            obj.tenniel.side = side
        scene_factory.lamp(self.scene, "AREA", 150.0, (0.5, -0.5, 4.0), size=1.5)
        scene_factory.set_world(self.scene, (0.1, 0.15, 0.2))
        scene_factory.camera(self.scene, (0.3, -4.0, 2.2), (0.0, 1.2, 0.7), lens=32.0)
        return self.looking_glass(mirror_material)

    def make_ordinary(self, keep):
        """Remove what does not exist in world `keep` ("this" or "dream") and all tags."""
        unwanted = "BEHIND" if keep == "this" else "THIS_SIDE"
        for obj in list(self.scene.objects):
            if obj.tenniel.side == unwanted:
                bpy.data.objects.remove(obj)
                continue
            obj.tenniel.side = "BOTH"
            obj.tenniel.looking_glass = False

    def coverage(self, name="Looking Glass", samples=64):
        """For each pixel how much of it shows object `name`, as seen by the camera (0..1).

        Everything else turns black and this object white; tags and lights play no part.
        """
        black, white = scene_factory.emission((0, 0, 0)), scene_factory.emission((1, 1, 1))
        slots = {}
        tags = {o: (o.tenniel.looking_glass, o.tenniel.side) for o in self.scene.objects}
        for obj, (_, side) in tags.items():
            obj.tenniel.looking_glass = False
            if obj.type == "MESH":
                slots[obj] = obj.data.materials[0]
                obj.data.materials[0] = white if obj.name == name else black
        world, self.scene.world = self.scene.world, None
        picture = render(TESTED_ENGINE, samples, 5, self.RESOLUTION, max_bounces=0)
        self.scene.world = world
        for obj, material in slots.items():
            obj.data.materials[0] = material
        for obj, (glass, side) in tags.items():
            obj.tenniel.looking_glass, obj.tenniel.side = glass, side
        return list(picture.rgba[0::4])

    def assert_region(self, first, second, mask, name, relative=0.01):
        """Means of 6x6 blocks of two lists of pictures agree inside `mask`."""
        self.assertGreater(sum(mask), 40, "the region is too small to prove anything")
        self.assert_pictures_agree([flat(p, mask) for p in first], [flat(p, mask) for p in second],
                                   name, 6, relative, 1e-4, max_noise=0.03)
