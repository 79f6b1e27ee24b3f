# SPDX-License-Identifier: GPL-3.0-or-later
"""The rendered 3D view: exports on change, renders in the background, draws what there is."""

import time

from . import native, reports
from .export import ExportError, View, export_scene
from .export.camera import FromRegion
from .session import report_problems, status_text

# Beyond it a half float is infinite, which draws as black.
_LARGEST_HALF = 65504.0

# A view that is being turned is exported again at most this often.
_RESTART_SECONDS = 0.05


class ViewportRender:
    """One rendered 3D view. Keeps nothing of Blender's data between calls."""

    def __init__(self, engine):
        self._engine = engine
        self._session = None
        self._size = None
        self._camera_state = None
        self._texture = None
        self._generation = 0
        self._stale = True
        self._is_reported = False
        self._started = 0.0

    def update(self, context, depsgraph):
        """The scene has changed: what is rendering is of no use any more."""
        self._stale = True
        self._ensure_session(context, depsgraph)

    def draw(self, context, depsgraph):
        """Draws the latest picture, and starts again if the view has changed."""
        state = _camera_state(context)
        size = (context.region.width, context.region.height)
        if state != self._camera_state or size != self._size:
            self._stale = True
        if self._stale:
            if time.monotonic() - self._started < _RESTART_SECONDS:
                self._engine.tag_redraw()
            else:
                self._ensure_session(context, depsgraph)
        if self._session is None:
            return
        progress = self._session.progress
        if progress.generation != self._generation and size == self._size:
            self._generation = progress.generation
            self._texture = self._read_texture()
        if self._texture is not None:
            self._draw_texture(depsgraph.scene, size)
        self._engine.update_stats("", self._session.error or status_text(progress))
        if not self._session.wait(0.0):
            self._engine.tag_redraw()
        elif not self._is_reported:
            self._is_reported = True
            report_problems(self._session)

    def close(self):
        """Stops rendering and frees the scene."""
        if self._session is not None:
            self._session.close()
            self._session = None
        self._texture = None

    def _ensure_session(self, context, depsgraph):
        if not self._stale:
            return
        self.close()
        self._started = time.monotonic()
        self._camera_state = _camera_state(context)
        self._size = (context.region.width, context.region.height)
        self._generation = 0
        self._stale = self._is_reported = False
        reports.begin(depsgraph.scene.name)
        core = native.core()
        try:
            description = export_scene(core, depsgraph, View(*self._size, is_viewport=True),
                                       FromRegion(context.space_data, context.region_data))
        except ExportError as error:
            self._engine.update_stats("", str(error))
            return
        self._session = core.RenderSession(description)
        self._session.start()
        self._engine.tag_redraw()

    def _read_texture(self):
        # Blender without a window has no `gpu`: it is imported where there is one for sure.
        import gpu

        width, height = self._size
        pixels = native.core().FloatBuffer(4 * width * height)
        self._session.read_pass('Combined', pixels)
        # A memoryview, because `gpu` asks for the shape in a way that only this one answers.
        buffer = gpu.types.Buffer('FLOAT', 4 * width * height, memoryview(pixels))
        return gpu.types.GPUTexture((width, height), format='RGBA16F', data=buffer)

    def _draw_texture(self, scene, size):
        import gpu
        from gpu_extras.presets import draw_texture_2d

        gpu.state.blend_set('ALPHA_PREMULT')
        self._engine.bind_display_space_shader(scene)
        draw_texture_2d(self._texture, (0, 0), *size)
        self._engine.unbind_display_space_shader()
        gpu.state.blend_set('NONE')


def _camera_state(context):
    """What the picture depends on beside the scene, as plain numbers."""
    view, space = context.region_data, context.space_data
    rows = (*view.view_matrix, *view.window_matrix)
    return tuple(value for row in rows for value in row), space.clip_start, space.clip_end
