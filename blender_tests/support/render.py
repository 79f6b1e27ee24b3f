# SPDX-License-Identifier: GPL-3.0-or-later
"""Render the current scene with either engine under settings that leave nothing to the engine."""
import os
import tempfile

import bpy

from .picture import Picture


class TestedEngine(str):
    """Engine id that stays different from the reference when one engine is compared with itself."""
    __test__ = False


REFERENCE_ENGINE = os.environ.get("TENNIEL_REFERENCE_ENGINE", "CYCLES")
TESTED_ENGINE = TestedEngine(os.environ.get("TENNIEL_TEST_ENGINE", "TENNIEL"))

# A factor on the tested side, to see that a comparison fails when it should.
TESTED_EXPOSURE = float(os.environ.get("TENNIEL_TEST_EXPOSURE", "1"))

SETTINGS_GROUP = {"CYCLES": "cycles", "TENNIEL": "tenniel"}

# What biases the picture is off and what ends paths early is far away, in both engines.
COMPARISON_SETTINGS = {
    "use_adaptive_sampling": False,
    "use_denoising": False,
    "use_animated_seed": False,
    "time_limit": 0.0,
    "sample_clamp_direct": 0.0,
    "sample_clamp_indirect": 0.0,
    "blur_glossy": 0.0,
    "light_sampling_threshold": 0.0,
    "min_light_bounces": 0,
    "min_transparent_bounces": 0,
    "max_bounces": 32,
    "diffuse_bounces": 32,
    "glossy_bounces": 32,
    "transmission_bounces": 32,
    "volume_bounces": 0,
    "transparent_max_bounces": 32,
    "caustics_reflective": True,
    "caustics_refractive": True,
    "film_exposure": 1.0,
    "pixel_filter_type": "BOX",
    "filter_width": 1.0,
    "use_auto_tile": False,
    "use_light_tree": False,
}


class RenderFailure(Exception):
    """The engine reported an error instead of a picture."""


def engine_settings(scene, engine):
    """The property group of `engine` ("CYCLES" -> scene.cycles)."""
    group = getattr(scene, SETTINGS_GROUP[engine], None)
    if group is None:
        raise RenderFailure(f"engine {engine} is not registered: scene has no settings for it")
    return group


def prepare(scene, engine, samples=64, seed=0, resolution=(32, 32), **settings):
    """Set engine, comparison settings and then `settings` (attributes of the engine's group).

    An engine may lack names of COMPARISON_SETTINGS; those in `settings` must exist.
    """
    group = engine_settings(scene, engine)
    scene.render.engine = engine
    for name, value in COMPARISON_SETTINGS.items():
        if hasattr(group, name):
            setattr(group, name, value)
    group.samples = samples
    group.seed = seed
    for name, value in settings.items():
        setattr(group, name, value)
    if isinstance(engine, TestedEngine):
        group.film_exposure *= TESTED_EXPOSURE
    scene.render.resolution_x, scene.render.resolution_y = resolution
    scene.render.use_compositing = False
    scene.render.use_sequencer = False


def render(engine, samples=64, seed=0, resolution=(32, 32), multilayer=False, scene=None,
           **settings):
    """Render the context's scene and return its Picture (see `prepare` for the arguments)."""
    scene = scene or bpy.context.scene
    prepare(scene, engine, samples, seed, resolution, **settings)
    return render_as_is(scene, multilayer)


def render_as_is(scene=None, multilayer=False):
    """Render with whatever the scene says and read the picture back through an OpenEXR file."""
    scene = scene or bpy.context.scene
    image = scene.render.image_settings
    image.file_format = "OPEN_EXR_MULTILAYER" if multilayer else "OPEN_EXR"
    image.color_mode = "RGBA"
    image.color_depth = "32"
    image.exr_codec = "NONE"
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "render.exr")
        scene.render.filepath = path
        try:
            bpy.ops.render.render(write_still=True, scene=scene.name)
        except RuntimeError as error:
            raise RenderFailure(str(error).strip()) from error
        if not os.path.exists(path):
            raise RenderFailure(f"{scene.render.engine} wrote no picture")
        return Picture.from_exr(path)


def render_seeds(engine, seeds=4, first_seed=0, **arguments):
    """`seeds` renders that differ in the seed only."""
    return [render(engine, seed=first_seed + i, **arguments) for i in range(seeds)]


def render_pair(seeds=4, **arguments):
    """(tested pictures, reference pictures) for the comparisons of `compare`.

    The reference takes other seeds, so that an engine compared with itself gives a real test.
    """
    return (render_seeds(TESTED_ENGINE, seeds, **arguments),
            render_seeds(REFERENCE_ENGINE, seeds, first_seed=1000, **arguments))
