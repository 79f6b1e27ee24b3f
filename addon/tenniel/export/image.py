# SPDX-License-Identifier: GPL-3.0-or-later
"""Images -> ImageDesc: as files where a file holds what Blender shows, else as pixels."""

import os

import bpy

_UDIM_TOKENS = ('<UDIM>', '<UVTILE>')


def export_image(context, image, image_user=None):
    """Index of `image` as shown at this frame, adding it at its first use.

    A missing image is reported and added without tiles, which renders as magenta.
    """
    frame = 0
    if image.source in {'SEQUENCE', 'MOVIE'}:
        frame = context.scene.frame_current
    key = (image.name_full, frame)
    if key not in context.images:
        context.images[key] = context.description.add_image(_describe(context, image, image_user))
    return context.images[key]


def _describe(context, image, image_user):
    desc = context.core.ImageDesc()
    desc.name = image.name
    desc.colorspace = image.colorspace_settings.name
    desc.is_data = bool(getattr(image.colorspace_settings, 'is_data', False))
    desc.alpha_mode = image.alpha_mode
    try:
        if _needs_pixels(image):
            desc.tiles = _pixel_tiles(context, desc, image)
        elif image.source == 'TILED':
            desc.tiles = _udim_tiles(context, image)
        else:
            desc.tiles = _file_tile(context, image, image_user)
    except (OSError, RuntimeError, ValueError, MemoryError) as error:
        context.report('WARNING', f"Image '{image.name}' cannot be read ({error}) and is shown "
                       "magenta", file=image.filepath)
        desc.tiles = []
    return desc


def _needs_pixels(image):
    """Whether what Blender shows is not what a file holds."""
    if image.source in {'GENERATED', 'VIEWER', 'MOVIE'} or image.is_dirty:
        return True
    # Only the first tile of a packed UDIM set could be read as pixels; its files may be there.
    return len(image.packed_files) > 0 and image.source != 'TILED'


def _file_tile(context, image, image_user):
    if image.source == 'SEQUENCE' and image_user is not None:
        path = image.filepath_from_user(image_user=image_user)
    else:
        path = image.filepath_raw or image.filepath
    path = _absolute(image, path)
    if not path or not os.path.isfile(path):
        _report_missing(context, image, path)
        return []
    return [_tile(context, 0, path)]


def _udim_tiles(context, image):
    pattern = _absolute(image, image.filepath_raw or image.filepath)
    tiles, missing = [], []
    for number in [tile.number for tile in image.tiles]:
        path = _tile_path(pattern, number)
        if os.path.isfile(path):
            tiles.append(_tile(context, number, path))
        else:
            missing.append(path)
    if missing:
        _report_missing(context, image, missing[0])
    return tiles


def _tile_path(pattern, number):
    column, row = (number - 1001) % 10, (number - 1001) // 10
    for token, text in zip(_UDIM_TOKENS, (str(number), f'u{column + 1}_v{row + 1}')):
        pattern = pattern.replace(token, text)
    return pattern


def _tile(context, number, path):
    tile = context.core.ImageTileDesc()
    tile.number = number
    tile.path = path
    return tile


def _absolute(image, path):
    # Paths relative to a library's file start there, not at the file that is open.
    return os.path.normpath(bpy.path.abspath(path, library=image.library)) if path else ''


def _report_missing(context, image, path):
    context.report('WARNING', f"Image '{image.name}' is missing and is shown magenta",
                   file=path or image.filepath)


def _pixel_tiles(context, desc, image):
    """The image as Blender holds it, widened to four channels."""
    width, height = image.size
    channels = image.channels
    if not width or not height or len(image.pixels) != width * height * channels:
        _report_missing(context, image, image.filepath)
        return []
    if image.source == 'MOVIE':
        context.report('INFO', f"Movie '{image.name}' is shown with one frame only",
                       file=image.filepath)
    pixels = context.core.FloatBuffer(width * height * channels)
    image.pixels.foreach_get(pixels)
    tile = context.core.ImageTileDesc()
    tile.pixels = pixels if channels == 4 else _with_four_channels(context, pixels, channels)
    tile.width, tile.height = width, height
    desc.is_float = image.is_float
    if image.is_float:
        # Blender has made its float pixels scene-linear with associated alpha already.
        desc.colorspace = 'Linear'
        if desc.alpha_mode == 'STRAIGHT':
            desc.alpha_mode = 'PREMUL'
    return [tile]


def _with_four_channels(context, pixels, channels):
    """RGBA of pixels with 1 (grey), 2 (grey, alpha) or 3 (RGB) channels."""
    count = len(pixels) // channels
    result = context.core.FloatBuffer(4 * count)
    source, target = memoryview(pixels), memoryview(result)
    for channel in range(3):
        target[channel::4] = source[(channel if channels == 3 else 0)::channels]
    if channels == 2:
        target[3::4] = source[1::2]
    else:
        ones = context.core.FloatBuffer(1)
        memoryview(ones)[0] = 1.0
        target[3::4] = memoryview(bytes(memoryview(ones)) * count).cast('f')
    return result
