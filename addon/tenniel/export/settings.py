# SPDX-License-Identifier: GPL-3.0-or-later
"""Render settings of the scene -> RenderSettings."""

from . import compat

_UINT_MAX = 0xffffffff
_INT_MAX = 0x7fffffff

# Settings of the same name and meaning on both sides.
_SAME = ('time_limit', 'max_bounces', 'diffuse_bounces', 'glossy_bounces', 'transmission_bounces',
         'volume_bounces', 'transparent_max_bounces', 'min_light_bounces', 'blur_glossy',
         'caustics_reflective', 'caustics_refractive', 'film_exposure', 'filter_width')


def export_settings(context):
    """RenderSettings of the context's scene, view layer and view."""
    source = context.scene.tenniel
    render = context.scene.render
    view = context.view
    target = context.core.RenderSettings()
    for name in _SAME:
        setattr(target, name, getattr(source, name))
    target.width, target.height = view.width, view.height
    if view.border is not None:
        (target.border_x, target.border_y,
         target.border_width, target.border_height) = view.border
    target.clamp_direct = source.sample_clamp_direct
    target.clamp_indirect = source.sample_clamp_indirect
    target.pixel_filter = source.pixel_filter_type
    target.pass_alpha_threshold = context.view_layer.pass_alpha_threshold
    target.film_transparent = render.film_transparent
    target.samples = _samples(context)
    target.seed = render_seed(source.seed, source.use_animated_seed,
                              context.scene.frame_current, context.scene.frame_subframe)
    target.threads = render.threads if render.threads_mode == 'FIXED' else 0
    target.texture_limit = _texture_limit(context)
    if context.scene.world is not None:
        target.occlusion_distance = context.scene.world.light_settings.distance
    target.volume_step_rate = (source.volume_preview_step_rate if view.is_viewport
                               else source.volume_step_rate)
    if view.is_viewport:
        target.time_limit = 0.0
        # It starts anew at every move: each first picture would wait for the training.
        target.use_radiance_cache = False
        target.start_world = _start_world(context)
    return target


def _samples(context):
    source = context.scene.tenniel
    if context.view.is_viewport:
        return source.preview_samples or 1 << 24
    # A view layer may have a number of its own; 0 means it has not.
    return context.view_layer.samples or source.samples


def _start_world(context):
    number = context.mirror_view.removeprefix('DREAM_')
    return int(number) if number.isdecimal() else 0


def _texture_limit(context):
    if not context.scene.render.use_simplify:
        return 0
    name = 'texture_limit' if context.view.is_viewport else 'texture_limit_render'
    value = compat.lookup(context.scene, name, 'OFF')
    return int(value) if value.isdecimal() else 0


def render_seed(seed, is_animated, frame, subframe):
    """Seed of a frame; an animated one is as good as random from frame to frame."""
    if not is_animated:
        return seed
    seed = hash_uint2(seed & _UINT_MAX, frame & _UINT_MAX)
    if subframe:
        seed = hash_uint2(seed, int(subframe * _INT_MAX))
    return seed


def hash_uint2(x, y):
    """Jenkins' lookup3 of two 32-bit words."""
    a = b = c = (0xdeadbeef + (2 << 2) + 13) & _UINT_MAX
    b = (b + y) & _UINT_MAX
    a = (a + x) & _UINT_MAX

    def rotate(value, bits):
        return ((value << bits) | (value >> (32 - bits))) & _UINT_MAX

    c = ((c ^ b) - rotate(b, 14)) & _UINT_MAX
    a = ((a ^ c) - rotate(c, 11)) & _UINT_MAX
    b = ((b ^ a) - rotate(a, 25)) & _UINT_MAX
    c = ((c ^ b) - rotate(b, 16)) & _UINT_MAX
    a = ((a ^ c) - rotate(c, 4)) & _UINT_MAX
    b = ((b ^ a) - rotate(a, 14)) & _UINT_MAX
    return ((c ^ b) - rotate(b, 24)) & _UINT_MAX


def hash_string(text):
    """32-bit hash of a name, as Cycles makes the random number of an object from it."""
    value = 0
    for byte in text.encode('utf-8', 'surrogateescape'):
        value = (value * 37 + byte) & _UINT_MAX
    return value


def export_aovs(context):
    """The passes of the view layer that AOV Output nodes write; a 3D view shows none of them."""
    if context.view.is_viewport:
        return
    for aov in context.view_layer.aovs:
        if not aov.is_valid:
            continue
        desc = context.core.AovDesc()
        desc.name = aov.name
        desc.is_color = aov.type == 'COLOR'
        context.description.add_aov(desc)
        context.aovs.add(aov.name)
