# SPDX-License-Identifier: GPL-3.0-or-later
"""The render engine as Blender knows it; all work is in session.py and viewport.py."""

import traceback

import bpy

from . import native, passes, reports, session, viewport
from .export import ExportError


class TennielRenderEngine(bpy.types.RenderEngine):
    bl_idname = 'TENNIEL'
    bl_label = "Tenniel"
    bl_use_preview = False
    bl_use_eevee_viewport = True
    bl_use_postprocess = True
    bl_use_shading_nodes_custom = False

    def __init__(self, *args, **kwargs):
        super().__init__(*args, **kwargs)
        self._viewport = None
        self._reported = None    # scene and frame whose problems are in the Render Report

    def __del__(self):
        # Blender has taken its own part of the engine away by now, so that ordinary attribute
        # access fails, and it may drop an engine whose __init__ never ran.
        view = object.__getattribute__(self, '__dict__').get('_viewport')
        if view is not None:
            view.close()
        for parent in type(self).__mro__[1:]:
            if '__del__' in vars(parent):
                parent.__del__(self)
                break

    # Final render --------------------------------------------------------------------------------

    def update_render_passes(self, scene=None, renderlayer=None):
        try:
            passes.register_passes(self, native.core(), scene, renderlayer)
        except Exception as error:
            self._fail(error)

    def render(self, depsgraph):
        try:
            self._begin_reports(depsgraph.scene)
            session.render_final(self, depsgraph)
        # Blender takes a render that raised for a good one and saves a black picture.
        except BaseException as error:
            self._fail(error)

    def _begin_reports(self, scene):
        # Blender calls render() for each view layer: their problems belong together.
        current = (scene.name, scene.frame_current)
        if self._reported != current:
            self._reported = current
            reports.begin(scene.name)

    # 3D view -------------------------------------------------------------------------------------

    def view_update(self, context, depsgraph):
        try:
            if self._viewport is None:
                self._viewport = viewport.ViewportRender(self)
            self._viewport.update(context, depsgraph)
        except Exception as error:
            self._fail(error)

    def view_draw(self, context, depsgraph):
        try:
            if self._viewport is not None:
                self._viewport.draw(context, depsgraph)
        except Exception as error:
            self._fail(error)

    def _fail(self, error):
        """Ends the render with a sentence; only report() gives background mode a bad status."""
        if isinstance(error, (ExportError, session.RenderError, native.NativeModuleError)):
            text = str(error)
        else:
            traceback.print_exception(error)
            text = f"Tenniel failed: {type(error).__name__}: {error}"
        self.report({'ERROR'}, text)
        self.error_set(text)


def register():
    bpy.utils.register_class(TennielRenderEngine)


def unregister():
    bpy.utils.unregister_class(TennielRenderEngine)
