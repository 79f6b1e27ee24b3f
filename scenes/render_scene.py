# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders one frame of the open file with overrides; what `./tenniel render` runs.

blender -b -Y FILE.blend --python-exit-code 1 --python scenes/render_scene.py --
    --engine ENGINE --output FILE.png|FILE.exr [--samples N] [--resolution WxH] [--frame N]

The picture is written under another name, opened, and only then given its own name: a render that
fails or is cancelled never leaves a file there. Any failure ends Blender with status 1.
"""

import argparse
import os
import pathlib
import sys

import bpy

FORMATS = {".png": 'PNG', ".exr": 'OPEN_EXR'}


class Failure(Exception):
    """Something the caller can mend; the text says what."""


def whole_number(text):
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError("must be at least 1")
    return value


def size(text):
    try:
        width, height = (whole_number(part) for part in text.lower().split("x"))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not of the form 1280x720") from None
    return width, height


def picture_path(text):
    path = pathlib.Path(text)
    if path.suffix.lower() not in FORMATS:
        raise argparse.ArgumentTypeError(f"{text!r} must end in .png or .exr")
    return path


def parse_arguments(argv):
    parser = argparse.ArgumentParser(prog="tenniel render")
    parser.add_argument("--engine", default="TENNIEL")
    parser.add_argument("--output", type=picture_path, required=True)
    parser.add_argument("--samples", type=whole_number)
    parser.add_argument("--resolution", type=size)
    parser.add_argument("--frame", type=int)
    return parser.parse_args(argv)


def apply_overrides(scene, arguments):
    try:
        scene.render.engine = arguments.engine
    except TypeError:
        raise Failure(f"Blender has no engine {arguments.engine}; is its add-on there?") from None
    if arguments.samples:
        for name in ("cycles", "tenniel"):
            if hasattr(scene, name):
                getattr(scene, name).samples = arguments.samples
        scene.eevee.taa_render_samples = arguments.samples
    if arguments.resolution:
        scene.render.resolution_x, scene.render.resolution_y = arguments.resolution
        scene.render.resolution_percentage = 100
    if arguments.frame is not None:
        scene.frame_set(arguments.frame)


def set_output(scene, path):
    """Blender writes exactly `path`: no frame number, no extension of its own."""
    render = scene.render
    render.filepath = str(path)
    render.use_file_extension = False
    render.use_overwrite = True
    render.use_placeholder = False
    render.use_multiview = False
    settings = render.image_settings
    settings.file_format = FORMATS[path.suffix.lower()]
    settings.color_mode = 'RGBA' if render.film_transparent else 'RGB'
    if settings.file_format == 'PNG':
        settings.color_depth = '8'


def expected_size(render):
    scale = render.resolution_percentage / 100.0
    width, height = int(render.resolution_x * scale), int(render.resolution_y * scale)
    if render.use_border and render.use_crop_to_border:
        width = int(width * render.border_max_x) - int(width * render.border_min_x)
        height = int(height * render.border_max_y) - int(height * render.border_min_y)
    return max(width, 1), max(height, 1)


def check_picture(path, wanted):
    """Opens the file as a reader would. A cropped border may differ by a pixel of rounding."""
    if not path.is_file():
        raise Failure("no picture was written")
    image = bpy.data.images.load(str(path))
    found = tuple(image.size)
    if not image.has_data and not len(image.pixels) or min(found) < 1:
        raise Failure(f"the picture {path} cannot be read")
    if any(abs(a - b) > 1 for a, b in zip(found, wanted)):
        raise Failure(f"the picture has {found[0]}x{found[1]} pixels instead of "
                      f"{wanted[0]}x{wanted[1]}")


def render(scene, output):
    output.parent.mkdir(parents=True, exist_ok=True)
    partial = output.with_name(f"{output.name}.part{output.suffix}")
    set_output(scene, partial)
    try:
        result = bpy.ops.render.render(write_still=True, scene=scene.name)
        if 'FINISHED' not in result:
            raise Failure("the render was cancelled")
        check_picture(partial, expected_size(scene.render))
        os.replace(partial, output)
    finally:
        partial.unlink(missing_ok=True)


def main():
    arguments = parse_arguments(sys.argv[sys.argv.index("--") + 1:])
    scene = bpy.context.scene
    try:
        apply_overrides(scene, arguments)
        render(scene, arguments.output.resolve())
    except (Failure, RuntimeError, OSError) as error:
        # RuntimeError is how an operator passes on report({'ERROR'}, ...).
        print(f"Error: {error}", file=sys.stderr, flush=True)
        sys.exit(1)


if __name__ == "__main__":
    main()
