# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender for bench.py: renders the open file once and prints its times.

blender -b --factory-startup -Y FILE --python render_one.py -- --engine CYCLES --samples 16 \
    --seed 1 --width 480 --out PICTURE.exr

The last line printed begins with "RESULT " and holds a JSON object: setup_seconds (export, BVH and
one sample), total_seconds (the whole render of N samples), width, height, reports (texts of the
engine, if it keeps any). The file itself is never saved.
"""
import argparse
import json
import pathlib
import sys
import time

import bpy
from mathutils import Vector

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

from support.render import prepare  # noqa: E402  (needs the path set above)

# What both engines take from the file's Cycles settings; everything else is forced alike.
FROM_THE_FILE = ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces",
                 "volume_bounces", "transparent_max_bounces", "caustics_reflective",
                 "caustics_refractive", "film_exposure")


def parse():
    parser = argparse.ArgumentParser()
    parser.add_argument("--engine", required=True)
    parser.add_argument("--samples", type=int, required=True)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--width", type=int, required=True)
    parser.add_argument("--height", type=int, default=0, help="0: as the file's aspect ratio")
    parser.add_argument("--out", required=True)
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:])


def set_output(scene, width, height, path):
    settings = scene.render
    height = height or max(4, round(width * settings.resolution_y / settings.resolution_x))
    settings.resolution_x, settings.resolution_y = width, height
    settings.resolution_percentage = 100
    settings.use_border = settings.use_motion_blur = settings.use_freestyle = False
    settings.use_multiview = settings.use_stamp = settings.use_persistent_data = False
    image = settings.image_settings
    image.file_format, image.color_mode, image.color_depth = "OPEN_EXR", "RGBA", "32"
    image.exr_codec = "NONE"
    settings.use_file_extension = False
    settings.use_overwrite, settings.use_placeholder = True, False
    settings.filepath = path


def ensure_camera(scene):
    """A file without a camera gets one (in memory) that sees all of its meshes."""
    if scene.camera is not None:
        return
    corners = [obj.matrix_world @ Vector(corner) for obj in scene.objects
               if obj.type in {"MESH", "CURVE", "FONT", "META", "SURFACE"} and not obj.hide_render
               for corner in obj.bound_box] or [Vector((-1, -1, -1)), Vector((1, 1, 1))]
    low, high = (Vector(map(f, zip(*corners))) for f in (min, max))
    centre, radius = (low + high) / 2.0, max((high - low).length / 2.0, 1e-3)
    data = bpy.data.cameras.new("Bench")
    data.clip_start, data.clip_end = radius / 100.0, radius * 100.0
    obj = bpy.data.objects.new("Bench", data)
    obj.location = centre + Vector((1.5, -2.2, 1.2)).normalized() * radius * 3.2
    obj.rotation_euler = (centre - obj.location).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(obj)
    scene.camera = obj


def timed_render(scene):
    start = time.perf_counter()
    bpy.ops.render.render(write_still=True, scene=scene.name)
    return time.perf_counter() - start


def engine_reports():
    """Texts that the engine kept about the render; only Tenniel keeps any."""
    module = sys.modules.get("tenniel.reports")
    if module is None:
        return []
    return [f"{row.severity}: {row.where()}: {row.text} ({row.count})" for row in module.rows()]


def main():
    options = parse()
    scene = bpy.context.scene
    ensure_camera(scene)
    kept = {name: getattr(scene.cycles, name) for name in FROM_THE_FILE}
    prepare(scene, options.engine, 1, options.seed, **kept)
    set_output(scene, options.width, options.height, options.out)
    setup = timed_render(scene)
    prepare(scene, options.engine, options.samples, options.seed, **kept)
    set_output(scene, options.width, options.height, options.out)
    total = timed_render(scene)
    print("RESULT " + json.dumps({
        "setup_seconds": setup, "total_seconds": total, "width": scene.render.resolution_x,
        "height": scene.render.resolution_y, "reports": engine_reports()}), flush=True)


main()
