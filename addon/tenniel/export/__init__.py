# SPDX-License-Identifier: GPL-3.0-or-later
"""Describes an evaluated Blender scene to the core."""

from . import camera, instances, settings, world
from .context import Cancelled, ExportContext, ExportError, View

__all__ = ('Cancelled', 'ExportError', 'View', 'export_scene')


def export_scene(core, depsgraph, view, camera_source, test_break=lambda: False, motion=None):
    """SceneDescription of what `depsgraph` holds.

    core: the native module. view: View. camera_source: camera.FromObject or camera.FromRegion.
    test_break: polled between objects. Nothing of Blender's data is referred to afterwards.

    motion: motion.Motion of the shutter in whose middle the scene stands, or None.

    Raises ExportError for a scene that cannot be rendered and Cancelled after test_break().
    Anything less is reported, and what cannot be exported is left out.
    """
    context = ExportContext(core, depsgraph, view, test_break)
    context.motion = motion
    context.description.settings = settings.export_settings(context)
    context.description.camera = camera_source.export(context)
    if motion is not None:
        context.description.camera.motion = motion.of_camera()
    settings.export_aovs(context)
    world.export_worlds(context)
    instances.export_instances(context)
    return context.description
