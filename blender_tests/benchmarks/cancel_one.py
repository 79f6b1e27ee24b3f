# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender for cancel.py: how long a render of the open file goes on after a cancel.

blender -b --factory-startup --addons tenniel FILE --python cancel_one.py -- --points 5

A first render shows which stages there are and how long they take; then one for each of `points`
moments of each stage is cancelled there, and another closed as the viewport does on every edit. The
last line printed begins with "RESULT " and holds a JSON list of [stage, seconds of the stage,
[seconds of each cancel], [seconds of each close]].

blender -b --factory-startup --python cancel_one.py -- --save-grid FILE
"""
import argparse
import json
import sys
import time

import bpy

EXPORT, RENDERING = "Export", "Rendering"
# Of the stage that lasts as long as one likes.
RENDER_SECONDS = 3.0
GRID_SIDE = 1000


class Artist:
    """Wants a render to stop `delay` seconds after its `stage` has begun.

    Blender is asked at the polls of export and render; the wish is as old as its moment.
    """

    def __init__(self, stage, delay):
        self.stage, self.delay = stage, delay
        self.begun = {EXPORT: time.perf_counter()}   # stage -> when it was first seen

    def wants_to_stop(self, session):
        now = time.perf_counter()
        stage = session.progress.stage if session else EXPORT
        self.begun.setdefault(stage, now)
        return self.stage in self.begun and now >= self.begun[self.stage] + self.delay

    def waited(self):
        return time.perf_counter() - self.begun[self.stage] - self.delay

    def stages(self):
        """[(stage, its seconds)]; one that passed between two polls is not seen."""
        names, times = list(self.begun), list(self.begun.values())
        ends = [*times[1:], times[-1] + self.delay]
        return [(name, end - begin) for name, begin, end in zip(names, times, ends)]


def cancel(stage, delay):
    """(Artist, seconds from the wish until the engine has returned) of an ordinary render."""
    from tenniel.session import FinalRender

    artist, waited = None, 0.0
    plain_run, plain_stopped = FinalRender.run, FinalRender._stopped

    def run(render):
        nonlocal artist, waited
        artist = Artist(stage, delay)
        try:
            return plain_run(render)
        finally:
            waited = artist.waited()

    FinalRender.run = run
    FinalRender._stopped = lambda render: artist.wants_to_stop(render._session)
    try:
        bpy.ops.render.render()
    finally:
        FinalRender.run, FinalRender._stopped = plain_run, plain_stopped
    return artist, waited


def close(stage, delay):
    """Seconds that closing the session of a render takes, scene and all."""
    from tenniel.session import FinalRender

    seconds = 0.0
    plain_poll = FinalRender._poll

    def poll(render):
        nonlocal seconds
        artist = Artist(stage, delay)
        while not artist.wants_to_stop(render._session) and not render._session.wait(0.001):
            pass
        start = time.perf_counter()
        render._session.close()
        seconds = time.perf_counter() - start
        return True

    FinalRender._poll = poll
    try:
        bpy.ops.render.render()
    finally:
        FinalRender._poll = plain_poll
    return seconds


def measure(points):
    scene = bpy.context.scene
    scene.render.engine = 'TENNIEL'
    scene.tenniel.samples = 1000000
    scene.render.resolution_x, scene.render.resolution_y = 1920, 1080
    scene.render.resolution_percentage = 100
    first, _ = cancel(RENDERING, RENDER_SECONDS)
    result = []
    for stage, seconds in first.stages():
        delays = [seconds * (i + 0.5) / points for i in range(points)]
        cancels = [cancel(stage, delay)[1] for delay in delays]
        closes = [close(stage, delay) for delay in delays] if stage != EXPORT else []
        result.append((stage, seconds, cancels, closes))
    print("RESULT " + json.dumps(result), flush=True)


def save_grid(path):
    """Two million triangles in one smooth mesh with UVs, a sun and a camera."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=GRID_SIDE, y_subdivisions=GRID_SIDE, size=10.0)
    bpy.ops.object.shade_smooth()
    bpy.ops.object.light_add(type='SUN', rotation=(0.5, 0.3, 0.0))
    bpy.ops.object.camera_add(location=(0.0, -9.0, 6.0), rotation=(1.0, 0.0, 0.0))
    bpy.context.scene.camera = bpy.context.object
    bpy.ops.wm.save_as_mainfile(filepath=path)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--points", type=int, default=5)
    parser.add_argument("--save-grid", metavar="FILE")
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])
    if options.save_grid:
        save_grid(options.save_grid)
    else:
        measure(options.points)


main()
