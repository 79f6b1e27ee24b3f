# SPDX-License-Identifier: GPL-3.0-or-later
"""How soon a render stops: `./tenniel bench cancel`. Prints figures, judges none.

For each stage of a render at 1920 x 1080: milliseconds from the wish to stop until the engine has
given control back to Blender, with its scene freed, and how long the viewport waits for the session
that an edit has made useless. Then seconds from SIGINT and SIGTERM to the end of a headless Blender,
and what files it left.
"""
import argparse
import json
import pathlib
import signal
import statistics
import subprocess
import sys
import tempfile
import time

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent))

from benchmarks import bench, blender_process  # noqa: E402  (needs the path set above)
from benchmarks.blender_process import REPOSITORY  # noqa: E402

# Seconds after the engine is called: export, BVH build and render of the grid.
SIGNAL_DELAYS = (0.0, 0.2, 0.5, 1.0, 2.0, 4.0)
BEGIN = "BEGIN"
RENDER = f"""
import bpy
scene = bpy.context.scene
scene.render.engine = 'TENNIEL'
scene.tenniel.samples = 1000000
scene.render.resolution_x, scene.render.resolution_y = 1920, 1080
import tenniel.session as session
plain = session.render_final
def render_final(*arguments):
    print("{BEGIN}", flush=True)
    plain(*arguments)
session.render_final = render_final
"""


def blender(*arguments):
    return [blender_process.blender(), "-b", "--factory-startup", "-noaudio", "-Y",
            "--addons", "tenniel", *map(str, arguments)]


def inside(*arguments, blend=None):
    """Lines that cancel_one.py prints in a Blender of its own."""
    done = subprocess.run(
        blender(*([blend] if blend else []), "--python-exit-code", "3", "--python",
                FOLDER / "cancel_one.py", "--", *arguments),
        env=blender_process.blender_environment(), stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", check=False)
    if done.returncode:
        raise SystemExit(f"Blender ended with {done.returncode}:\n{done.stdout[-2000:]}")
    return done.stdout.splitlines()


def grid_file():
    path = REPOSITORY / "build" / "scenes" / "bench_grid.blend"
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        inside("--save-grid", path)
    return path


def milliseconds(values):
    if not values:
        return f"{'':26s}"
    return "".join(f"{1000.0 * f(values):8.0f} " for f in (min, statistics.median, max))


def print_stages(name, blend, points):
    lines = inside("--points", str(points), blend=blend)
    payload = [line for line in lines if line.startswith("RESULT ")][-1]
    for stage, seconds, cancels, closes in json.loads(payload[len("RESULT "):]):
        print(f"{name:12s} {stage:18s} {seconds:7.2f} {milliseconds(cancels)} "
              f"{milliseconds(closes)}", flush=True)


def stop_by(number, delay, blend):
    """(seconds from the signal to the end of Blender, its status, names of the files it left)"""
    with tempfile.TemporaryDirectory() as folder:
        process = subprocess.Popen(
            blender(blend, "--python-expr", RENDER, "-o", f"{folder}/out_", "-f", "1"),
            env=blender_process.blender_environment(), stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
        for line in process.stdout:
            if line.startswith(BEGIN):
                break
        time.sleep(delay)
        process.send_signal(number)
        start = time.perf_counter()
        process.communicate()
        seconds = time.perf_counter() - start
        return seconds, process.returncode, sorted(p.name for p in pathlib.Path(folder).iterdir())


def print_signals(name, blend):
    for number in (signal.SIGINT, signal.SIGTERM):
        for delay in SIGNAL_DELAYS:
            seconds, status, files = stop_by(number, delay, blend)
            print(f"{name:12s} {number.name} after {delay:3.1f} s: ended {1000 * seconds:5.0f} ms "
                  f"later, status {status}, files: {', '.join(files) or 'none'}", flush=True)


def main():
    parser = argparse.ArgumentParser(prog="tenniel bench cancel", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scene", choices=("grid", "bench_room"), help="this one alone")
    parser.add_argument("--points", type=int, default=5, help="moments of each stage (default 5)")
    parser.add_argument("--no-signals", action="store_true", help="the stages alone")
    options = parser.parse_args()
    print(f"{'':39s} {'cancel, ms':27s} close, ms")
    print(f"{'scene':12s} {'stage':18s} {'seconds':>7s} " + 2 * f"{'min':>8s} {'median':>8s} "
          f"{'max':>8s}  ")
    files = {"grid": grid_file, "bench_room": lambda: bench.build_scene("bench_room")}
    for name, file in files.items():
        if options.scene in (None, name):
            print_stages(name, file(), options.points)
    if not options.no_signals:
        print_signals("grid", grid_file())


if __name__ == "__main__":
    main()
