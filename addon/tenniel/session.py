# SPDX-License-Identifier: GPL-3.0-or-later
"""One final render: export, start, pictures out, cancel in."""

import math
import signal
import struct
import threading
import time

import bpy

from . import native, reports
from .export import Cancelled, View, export_scene, motion
from .export.camera import FromObject
from .passes import PassWriter, add_passes

# The core answers a cancel within 0.1 s, and so should we: Blender can only be asked.
_POLL_SECONDS = 0.02

# The first pictures come fast; later ones change less and may cost less.
_FIRST_REFRESH = 0.25
_REFRESH_GROWTH = 1.3
_SLOWEST_REFRESH = 5.0

# Writing a picture takes this share of the time at most.
_REFRESH_SHARE = 0.1

# Blender prints each status line where it has no window.
_STATUS_SECONDS = 0.2
_STATUS_SECONDS_BACKGROUND = 2.0

_MEGABYTE = 1024.0 * 1024.0
_MAX_PRINTED_REPORTS = 20


class RenderError(Exception):
    """The render cannot go on; the message is a sentence for the artist."""


def render_final(engine, depsgraph):
    """Renders the view layer of `depsgraph` into the engine's result, all views of it.

    Raises ExportError or RenderError with a sentence for the artist; in background mode a
    cancelled render is one too, since there it has to end in a bad exit status.
    """
    scene_name = depsgraph.scene.name
    try:
        with TerminationSignals() as signals:
            for view in _view_names(engine, depsgraph):
                render = FinalRender(engine, depsgraph, view, signals)
                if not render.run():
                    break
    finally:
        _print_reports(scene_name)
    if signals.name:
        raise RenderError(f"The render was stopped by {signals.name}")
    if bpy.app.background and engine.test_break():
        raise RenderError("The render was interrupted")


def _view_names(engine, depsgraph):
    """Names of the stereo or multi-view pictures; one empty name for an ordinary picture."""
    result = engine.begin_result(0, 0, 1, 1, layer=depsgraph.view_layer.name)
    names = [view.name for view in result.views] or ['']
    engine.end_result(result, cancel=True)
    return names


class TerminationSignals:
    """Turns SIGTERM into a request to stop while a render runs in background mode.

    `name` is that of the signal that came, else empty. SIGINT is left to Blender, whose own
    handler makes test_break() true.
    """

    def __init__(self):
        self.name = ''
        self._previous = None

    def __enter__(self):
        # Python allows handlers in the main thread only, where a background render is.
        if bpy.app.background and threading.current_thread() is threading.main_thread():
            self._previous = signal.signal(signal.SIGTERM, self._remember)
        return self

    def __exit__(self, *_exception):
        if self._previous is not None:
            signal.signal(signal.SIGTERM, self._previous)
            self._previous = None

    def _remember(self, number, _frame):
        self.name = signal.Signals(number).name


class FinalRender:
    """Renders one view (the name of a stereo view, or '') of one view layer."""

    def __init__(self, engine, depsgraph, view_name, signals):
        self._engine = engine
        self._depsgraph = depsgraph
        self._layer_name = depsgraph.view_layer.name
        self._view_name = view_name
        self._signals = signals
        self._session = None
        self._writer = None
        self._status_time = 0.0
        self._status_text = ''

    def run(self):
        """True when the picture is complete, False when cancelled; errors as RenderError."""
        try:
            self._engine.active_view_set(self._view_name)
            self._start()
            cancelled = self._poll()
            self._finish(cancelled)
            return not cancelled
        except Cancelled:
            return False
        finally:
            # Not left to the garbage collector: an animation would pile up scenes.
            if self._session is not None:
                self._session.close()
                self._session = None

    def _start(self):
        engine, core = self._engine, native.core()
        self._status("Exporting the scene")
        add_passes(engine, core, self._depsgraph.view_layer)
        result = self._begin_result()
        width, height = result.resolution_x, result.resolution_y
        engine.end_result(result, cancel=True)
        view = View(engine.resolution_x, engine.resolution_y,
                    border_rectangle(self._depsgraph.scene_eval.render, engine.resolution_x,
                                     engine.resolution_y, width, height))
        description = self._export(core, view)
        self._writer = PassWriter(core, width, height, self._depsgraph.view_layer)
        self._session = core.RenderSession(description)
        del description
        # Blender's copy of the scene is not needed any more while there is nothing to draw.
        self._depsgraph = None
        self._session.start()

    def _export(self, core, view):
        """Describes the scene; with motion blur as it is in the middle of the shutter."""
        engine, depsgraph = self._engine, self._depsgraph
        scene = depsgraph.scene
        shutter = motion.shutter_of(scene)
        if shutter is None:
            return export_scene(core, depsgraph, view, FromObject(engine), self._stopped)
        frame, subframe = scene.frame_current, scene.frame_subframe
        try:
            moves = motion.Motion(depsgraph.scene_eval, shutter)
            for time_of_step in moves.times:
                self._go_to(time_of_step)
                moves.record(depsgraph, FromObject(engine).matrix(depsgraph.scene_eval))
                if self._stopped():
                    raise Cancelled()
            self._go_to(shutter.middle)
            return export_scene(core, depsgraph, view, FromObject(engine), self._stopped, moves)
        finally:
            engine.frame_set(frame, subframe)

    def _go_to(self, frame):
        whole = math.floor(frame)
        self._engine.frame_set(whole, frame - whole)

    def _stopped(self):
        return bool(self._signals.name) or self._engine.test_break()

    def _poll(self):
        """Waits for the end and keeps Blender informed; True when cancelled."""
        refresh, interval, shown = time.monotonic() + _FIRST_REFRESH, _FIRST_REFRESH, 0
        while not self._session.wait(_POLL_SECONDS):
            if self._stopped():
                self._session.cancel()
                while not self._session.wait(1.0):
                    pass
                return True
            progress = self._session.progress
            self._show_progress(progress)
            now = time.monotonic()
            # Without a window nobody sees the picture before it is complete.
            if now >= refresh and progress.generation != shown and not bpy.app.background:
                shown = progress.generation
                self._write_result()
                cost = time.monotonic() - now
                interval = min(interval * _REFRESH_GROWTH, _SLOWEST_REFRESH)
                refresh = now + max(interval, cost / _REFRESH_SHARE)
        return False

    def _finish(self, cancelled):
        session = self._session
        progress = session.progress
        self._status_time = 0.0
        self._show_progress(progress)
        report_problems(session)
        if session.error:
            raise RenderError(session.error)
        if progress.generation and not (cancelled and bpy.app.background):
            # A cancelled render keeps the picture it has, where there is a window to show it.
            self._write_result(cancelled)

    # Towards Blender -----------------------------------------------------------------------------

    def _begin_result(self):
        engine = self._engine
        return engine.begin_result(0, 0, engine.resolution_x, engine.resolution_y,
                                   layer=self._layer_name, view=self._view_name)

    def _write_result(self, cancelled=False):
        result = self._begin_result()
        try:
            self._writer.write(self._session, result.layers[0])
        except BaseException:
            self._engine.end_result(result, cancel=True)
            raise
        self._engine.end_result(result, cancel=cancelled, do_merge_results=True)

    def _show_progress(self, progress):
        self._engine.update_progress(progress.fraction)
        self._engine.update_memory_stats(memory_used=progress.memory_bytes / _MEGABYTE,
                                         memory_peak=progress.peak_memory_bytes / _MEGABYTE)
        self._status(status_text(progress))

    def _status(self, text):
        pause = _STATUS_SECONDS_BACKGROUND if bpy.app.background else _STATUS_SECONDS
        now = time.monotonic()
        if text != self._status_text and now - self._status_time >= pause:
            self._status_text, self._status_time = text, now
            self._engine.update_stats("", text)


def report_problems(session):
    """Moves what a finished RenderSession has to say to the Render Report."""
    for item in session.take_diagnostics():
        reports.add(item.severity, item.text, object=item.object, material=item.material,
                    node=item.node, file=item.file)
    dropped = session.progress.dropped_samples
    if dropped:
        reports.add('WARNING', f"{dropped} samples were not finite numbers and were left out")


def status_text(progress):
    """One line, such as "Sample 12/128 | Remaining 00:12 | Mem 123 MB"."""
    memory = f"Mem {progress.memory_bytes / _MEGABYTE:.0f} MB"
    if progress.stage != 'Rendering' and progress.samples_done < progress.samples_total:
        return f"{progress.stage} | {memory}"
    parts = [f"Sample {progress.samples_done}/{progress.samples_total}"]
    if progress.remaining >= 0.0 and progress.samples_done < progress.samples_total:
        parts.append(f"Remaining {_clock(progress.remaining)}")
    return ' | '.join((*parts, memory))


def _clock(seconds):
    minutes, seconds = divmod(int(seconds + 0.5), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{seconds:02}" if hours else f"{minutes:02}:{seconds:02}"


def border_rectangle(render, width, height, result_width, result_height):
    """(x, y, width, height) in pixels of the part to render, or None for the whole picture.

    Blender rounds the border in single precision; the size is what begin_result() gave.
    """
    if not render.use_border or (result_width, result_height) == (width, height):
        return None
    x = min(_pixels(render.border_min_x, width), width - result_width)
    y = min(_pixels(render.border_min_y, height), height - result_height)
    return x, y, result_width, result_height


def _pixels(fraction, size):
    return int(struct.unpack('f', struct.pack('f', fraction * size))[0])


def _print_reports(scene_name):
    """Where there is no panel to read them, the problems are told on the console."""
    if not bpy.app.background:
        return
    rows = reports.rows(scene_name)
    for row in rows[:_MAX_PRINTED_REPORTS]:
        where = row.where()
        count = f" ({row.count} times)" if row.count > 1 else ""
        print(f"Tenniel {row.severity.lower()}: {where + ': ' if where else ''}{row.text}{count}")
    if len(rows) > _MAX_PRINTED_REPORTS:
        print(f"Tenniel: {len(rows) - _MAX_PRINTED_REPORTS} more problems")
    coverage = reports.coverage(scene_name)
    if coverage and coverage.reported:
        print(f"Tenniel: {coverage.text()}")
