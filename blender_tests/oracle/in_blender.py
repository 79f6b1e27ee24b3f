# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders cases with Tenniel; run by compare.py.

blender -b --factory-startup --addons tenniel --python-exit-code 1 --python in_blender.py
    -- FOLDER SAMPLE_FACTOR NAME...
"""

import pathlib
import sys

import bpy

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(FOLDER), str(FOLDER.parent)]

import cases  # noqa: E402  (needs the path set above)
from support import render as rendering  # noqa: E402
from support import scene_factory  # noqa: E402
from tenniel.presets import groups  # noqa: E402

SEEDS = (1, 2)


def material(case):
    """The ball's material in nodes a user would take."""
    found = bpy.data.materials.new(case.name)
    found.use_nodes = True
    tree = found.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    shader = surface(tree, case.surface)
    if shader is not None:
        tree.links.new(shader, output.inputs["Surface"])
    if case.medium is not None:
        tree.links.new(medium(tree, case.medium), output.inputs["Volume"])
    return found


def surface(tree, wanted):
    if wanted.kind == "none":
        return None
    if wanted.kind == "metal":
        node = tree.nodes.new("ShaderNodeGroup")
        smooth = wanted.roughness == 0.0
        node.node_tree = groups.metal_group("SHARP" if smooth else wanted.distribution)
        values = {"Refractive Index": wanted.eta, "Extinction": wanted.k,
                  "Roughness": wanted.roughness}
    elif wanted.kind == "glass":
        node = tree.nodes.new("ShaderNodeBsdfGlass")
        node.distribution = "SHARP" if wanted.roughness == 0.0 else wanted.distribution
        values = {"Color": (*wanted.color, 1.0), "Roughness": wanted.roughness, "IOR": wanted.ior}
    else:
        node = tree.nodes.new("ShaderNodeBsdfDiffuse")
        values = {"Color": (*wanted.color, 1.0)}
    for name, value in values.items():
        node.inputs[name].default_value = value
    return node.outputs[0]


def medium(tree, wanted):
    """The add-on's group for measured media, whose values are per millimetre."""
    node = tree.nodes.new("ShaderNodeGroup")
    node.node_tree = groups.medium_group()
    for name, value in (("Scattering (1/mm)", wanted.scattering),
                        ("Absorption (1/mm)", wanted.absorption),
                        ("Anisotropy", wanted.anisotropy), ("Scale", 0.001)):
        node.inputs[name].default_value = value
    return node.outputs[0]


def environment(scene, path):
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    tree.nodes.clear()
    texture = tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image = bpy.data.images.load(str(path))
    background = tree.nodes.new("ShaderNodeBackground")
    output = tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(texture.outputs["Color"], background.inputs["Color"])
    tree.links.new(background.outputs["Background"], output.inputs["Surface"])


def build(case, folder):
    scene = scene_factory.empty_scene()
    environment(scene, folder / "environment.exr")
    floor = cases.Case("floor", cases.Surface("matte", color=cases.FLOOR_COLOR))
    scene_factory.plane(scene, 2.0 * cases.FLOOR_HALF_WIDTH, material(floor),
                        location=(0.0, 0.0, cases.FLOOR_HEIGHT))
    vertices, triangles = cases.ball()
    mesh = scene_factory.mesh("Ball", vertices, triangles, material(case), smooth=True)
    scene_factory.link(scene, mesh, location=cases.TARGET)
    scene_factory.camera(scene, cases.CAMERA, cases.TARGET, angle=cases.FIELD_OF_VIEW)
    return scene


def main():
    folder, factor, *names = sys.argv[sys.argv.index("--") + 1:]
    folder = pathlib.Path(folder)
    for case in cases.CASES:
        if case.name not in names:
            continue
        scene = build(case, folder)
        for seed in SEEDS:
            limits = {name: cases.MAX_BOUNCES for name in (
                "max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces",
                "volume_bounces", "transparent_max_bounces")}
            samples = max(1, int(case.samples * float(factor)))
            rendering.prepare(scene, rendering.TESTED_ENGINE, samples, seed,
                              (cases.WIDTH, cases.HEIGHT), **limits)
            image = scene.render.image_settings
            image.file_format, image.color_mode, image.color_depth = 'OPEN_EXR', 'RGB', '32'
            scene.render.filepath = str(folder / f"{case.name}_tenniel_{seed}.exr")
            bpy.ops.render.render(write_still=True)


main()
