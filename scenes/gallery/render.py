# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders the gallery and writes its page; what `./tenniel gallery` runs.

blender -b --factory-startup --addons tenniel --python-exit-code 1 --python scenes/gallery/render.py
    -- --output FOLDER [--width PIXELS] [--samples FACTOR] [--no-cycles] [NAME...]
"""

import argparse
import array
import collections
import html
import pathlib
import sys
import tempfile
import time

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

import gallery  # noqa: E402  (beside this file's folder, which Blender does not put on the path)
import parts  # noqa: E402
from gallery import media, metals, mirrors, subsurface, textures  # noqa: E402,F401  (fill EXHIBITS)

# Blender's own defaults: pictures to look at, not to measure.
_PICTURE_SETTINGS = {"sample_clamp_indirect": 10.0, "blur_glossy": 1.0, "volume_bounces": 64,
                     "max_bounces": 64, "transmission_bounces": 16}

_PAGE = """<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>Tenniel: gallery</title>
<style>body{{font-family:sans-serif;margin:2em;background:#1c1c1e;color:#ddd}}
section{{display:inline-block;vertical-align:top;margin:0 1.5em 2em 0;max-width:{page_width}px}}
h2{{font-size:1.1em;margin:0 0 .3em}}figure{{display:inline-block;margin:0 .4em 0 0}}
figcaption,p{{font-size:.85em;color:#aaa}}</style>
<h1>Tenniel: gallery</h1>
<p>Left Tenniel, right Cycles with the same settings where it has the feature. Seconds are of the
whole render, export included. The difference is that of the mean radiance, Tenniel less Cycles;
in blocks, that of squares of 8 x 8 pixels without their signs, with all noise, both divided by
Cycles' mean.</p>
{sections}</html>
"""


def arguments():
    parser = argparse.ArgumentParser(prog="tenniel gallery")
    parser.add_argument("--output", type=pathlib.Path, required=True)
    parser.add_argument("--width", type=int, default=320)
    parser.add_argument("--samples", type=float, default=1.0, metavar="FACTOR")
    parser.add_argument("--no-cycles", action="store_true")
    parser.add_argument("names", nargs="*", metavar="NAME")
    found = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])
    known = {item.name for item in gallery.EXHIBITS}
    unknown = set(found.names) - known
    if unknown:
        parser.error(f"there is no exhibit {', '.join(sorted(unknown))}; "
                     f"there are {', '.join(sorted(known))}")
    return found


def build(item, width, samples):
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = bpy.context.scene
    item.build()
    parts.render_settings(scene, width, width * 5 // 8, samples=samples,
                          **_PICTURE_SETTINGS)
    scene.view_settings.view_transform = 'Filmic'
    settings = scene.render.image_settings
    settings.file_format, settings.quality = 'JPEG', 90
    scene.render.use_file_extension = False
    return scene


def picture(scene, engine, path):
    """Renders to `path`; returns the seconds and the radiance."""
    scene.render.engine = engine
    scene.render.filepath = str(path)
    start = time.perf_counter()
    bpy.ops.render.render(write_still=True)
    return time.perf_counter() - start, radiance(scene)


def radiance(scene):
    """What was rendered last, before view transform and JPEG: four numbers a pixel, by rows."""
    settings = scene.render.image_settings
    with tempfile.TemporaryDirectory() as folder:
        path = f"{folder}/radiance.exr"
        settings.file_format = 'OPEN_EXR'
        bpy.data.images["Render Result"].save_render(path, scene=scene)
        settings.file_format = 'JPEG'
        image = bpy.data.images.load(path)
        pixels = array.array('f', bytes(4 * len(image.pixels)))
        image.pixels.foreach_get(pixels)
        bpy.data.images.remove(image)
    return pixels


def difference(ours, theirs, width, block=8):
    """Of the means, and of blocks without their signs; both by the mean of `theirs`."""
    blocks = collections.defaultdict(float)
    for index, (own, other) in enumerate(zip(ours, theirs)):
        pixel, channel = divmod(index, 4)
        if channel < 3:
            blocks[pixel // width // block, pixel % width // block, channel] += own - other
    total = sum(sum(theirs[channel::4]) for channel in range(3))
    return sum(blocks.values()) / total, sum(map(abs, blocks.values())) / total


def section(item, samples, seconds, beside):
    """The part of the page on one exhibit; `seconds`: engine -> seconds; `beside`: a sentence."""
    figures = []
    for engine, value in seconds.items():
        suffix = "" if engine == 'TENNIEL' else "_cycles"
        figures.append(f'<figure><img src="{item.name}{suffix}.jpg" alt="{engine.title()}">'
                       f'<figcaption>{engine.title()}, {samples} samples, {value:.1f} s'
                       f'</figcaption></figure>')
    return (f'<section><h2>{html.escape(item.title)}</h2>{"".join(figures)}'
            f'<p>{html.escape(item.text)} {beside}</p></section>\n')


def main():
    options = arguments()
    output = options.output.resolve()
    output.mkdir(parents=True, exist_ok=True)
    chosen = [item for item in gallery.EXHIBITS
              if not options.names or item.name in options.names]
    sections = []
    for item in chosen:
        samples = max(1, round(item.samples * options.samples))
        scene = build(item, options.width, samples)
        seconds, beside = {}, ""
        seconds['TENNIEL'], ours = picture(scene, 'TENNIEL', output / f"{item.name}.jpg")
        if item.in_cycles and not options.no_cycles:
            seconds['CYCLES'], theirs = picture(scene, 'CYCLES',
                                                output / f"{item.name}_cycles.jpg")
            mean, blocks = difference(ours, theirs, options.width)
            beside = f"Difference {100.0 * mean:+.2f} %, in blocks {100.0 * blocks:.2f} %."
        sections.append(section(item, samples, seconds, beside))
        times = ", ".join(f"{engine.title()} {value:.1f} s" for engine, value in seconds.items())
        print(f"{item.name}: {times}. {beside}".rstrip(), flush=True)
    page = output / "index.html"
    page.write_text(_PAGE.format(page_width=2 * options.width + 40, sections="".join(sections)),
                    encoding="utf-8")
    print(f"{len(chosen)} exhibits in {page}")


if __name__ == "__main__":
    main()
