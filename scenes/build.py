# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds one scene of the catalogue and saves it.

blender -b --factory-startup --python scenes/build.py -- NAME OUT.blend [--check]

With --check the saved file is opened again and must have a camera, meshes and every picture.
When the add-on `tenniel` can be found it is enabled first, so that the scene also carries the
settings that only it knows; without it the scene still builds.
"""

import argparse
import importlib
import os
import pathlib
import sys

import addon_utils
import bpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from catalog import SCENES  # noqa: E402  (beside this file, which Blender does not put on the path)


def enable_addon():
    if any(module.__name__ == "tenniel" for module in addon_utils.modules()):
        if addon_utils.enable("tenniel") is None:
            raise SystemExit("the add-on is there but cannot be enabled; see above")


def clear():
    """Empties the start-up file but keeps its scene."""
    for collection in (bpy.data.objects, bpy.data.meshes, bpy.data.lights, bpy.data.cameras,
                       bpy.data.materials, bpy.data.worlds):
        for block in list(collection):
            collection.remove(block)


def save(path):
    path.parent.mkdir(parents=True, exist_ok=True)
    root = pathlib.Path(__file__).resolve().parent.parent
    for image in bpy.data.images:
        if image.source == 'FILE' and root in pathlib.Path(image.filepath).parents:
            image.filepath = bpy.path.relpath(image.filepath, start=str(path.parent))
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=True, relative_remap=False)


def check(path):
    bpy.ops.wm.open_mainfile(filepath=str(path))
    scene = bpy.context.scene
    missing = [image.name for image in bpy.data.images
               if image.source == 'FILE' and not os.path.exists(bpy.path.abspath(image.filepath))]
    if missing:
        raise SystemExit(f"{path}: pictures are missing: {', '.join(missing)}")
    if scene.camera is None:
        raise SystemExit(f"{path}: no camera")
    statistics = triangle_count(bpy.context.evaluated_depsgraph_get())
    if not statistics:
        raise SystemExit(f"{path}: no mesh")
    print(f"{path}: {len(scene.objects)} objects, {statistics} triangles")


def triangle_count(depsgraph):
    """Triangles of all instances that a render would see."""
    total = 0
    for instance in depsgraph.object_instances:
        if instance.object.type in {'MESH', 'CURVE', 'FONT', 'META', 'SURFACE'}:
            mesh = instance.object.to_mesh()
            if mesh is not None:
                mesh.calc_loop_triangles()
                total += len(mesh.loop_triangles)
                instance.object.to_mesh_clear()
    return total


def main():
    parser = argparse.ArgumentParser(prog="build.py")
    parser.add_argument("name", choices=SCENES)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])

    enable_addon()
    clear()
    importlib.import_module(arguments.name).build(bpy.context.scene)
    output = arguments.output.resolve()
    save(output)
    if arguments.check:
        check(output)


if __name__ == "__main__":
    main()
