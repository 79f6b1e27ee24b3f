# SPDX-License-Identifier: GPL-3.0-or-later
"""Cycles and Tenniel side by side on the same files.

bench.py [bench] [--scenes a,b]   time, memory, noise and efficiency on scenes of the catalogue
bench.py compare FILE...          do the two pictures of each file agree?
bench.py files DIR                compare for each .blend below DIR, with a table

Environment: BLENDER (the program), TENNIEL_SCRIPTS_DIR (folder with addons/tenniel).
"""
import argparse
import math
import pathlib
import statistics
import subprocess
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent))

from benchmarks import blender_process  # noqa: E402  (needs the path set above)
from benchmarks.blender_process import ENGINES, REPOSITORY  # noqa: E402
from support import compare  # noqa: E402
from support.picture import Picture  # noqa: E402
from support.report import Report  # noqa: E402

BLOCK = 16
# Agreement asked of two engines on a file whose nodes are all covered.
ALLOWED_DIFFERENCE = 0.01
FIREFLY_SHARE = 0.001


def scene_names():
    sys.path.insert(0, str(REPOSITORY / "scenes"))
    import catalog
    return list(catalog.SCENES)


def build_scene(name):
    """The .blend of a catalogue scene, built again when a builder is newer."""
    path = REPOSITORY / "build" / "scenes" / f"{name}.blend"
    newest = max(p.stat().st_mtime for p in (REPOSITORY / "scenes").glob("*.py"))
    if not path.exists() or path.stat().st_mtime < newest:
        path.parent.mkdir(parents=True, exist_ok=True)
        print(f"building {name}", file=sys.stderr, flush=True)
        subprocess.run([blender_process.blender(), "-b", "--factory-startup",
                        "--python-exit-code", "3", "--python",
                        str(REPOSITORY / "scenes" / "build.py"), "--", name, str(path)],
                       check=True, stdout=subprocess.DEVNULL,
                       env=blender_process.blender_environment())
    return path


class Measurement:
    """All renders of one scene by one engine, seeds 0, 1, ..."""

    def __init__(self):
        self.results = []

    def summary(self):
        """Medians over the runs, noise from neighbouring seeds; None if a render failed."""
        if any(r.error for r in self.results):
            return None
        pictures = [Picture.from_exr(r.picture_path) for r in self.results]
        pairs = list(zip(pictures, pictures[1:]))

        def variance(drop):
            return statistics.mean(compare.relative_variance(a, b, drop) for a, b in pairs)
        render_seconds = statistics.median(r.render_seconds for r in self.results)
        noise = variance(0.0)
        return {
            "setup": statistics.median(r.setup_seconds for r in self.results),
            "render": render_seconds,
            "fastest": min(r.render_seconds for r in self.results),
            "total": statistics.median(r.total_seconds for r in self.results),
            "memory": max(r.peak_memory for r in self.results),
            "variance": noise,
            "trimmed": variance(FIREFLY_SHARE),
            "efficiency": 1.0 / (noise * render_seconds) if noise > 0.0 else math.inf,
        }


HEADINGS = ("scene", "engine", "setup s", "render s", "fastest", "total s", "MiB", "variance",
            "trimmed", "efficiency")


def format_summary(scene, engine, summary):
    return (f"{scene:14s} {engine:8s} {summary['setup']:8.2f} {summary['render']:8.2f} "
            f"{summary['fastest']:8.2f} {summary['total']:8.2f} {summary['memory']:8.0f} "
            f"{summary['variance']:9.3g} {summary['trimmed']:9.3g} {summary['efficiency']:10.3g}")


def format_ratio(scene, ours, theirs):
    def ratio(name):
        return ours[name] / theirs[name] if theirs[name] else math.nan
    return (f"{scene:14s} {'ratio':8s} {ratio('setup'):8.2f} {ratio('render'):8.2f} "
            f"{ratio('fastest'):8.2f} {ratio('total'):8.2f} {ratio('memory'):8.2f} "
            f"{ratio('variance'):9.3g} {ratio('trimmed'):9.3g} {ratio('efficiency'):10.3g}")


def command_bench(options):
    """Renders in turn A B A B, so that a change of the machine's load hits both."""
    names = options.scenes.split(",") if options.scenes else scene_names()
    unknown = set(names) - set(scene_names())
    if unknown:
        raise SystemExit(f"no such scene: {', '.join(sorted(unknown))}; there are "
                         f"{', '.join(scene_names())}")
    folder = pathlib.Path(options.out)
    folder.mkdir(parents=True, exist_ok=True)
    head = "{:14s} {:8s} {:>8s} {:>8s} {:>8s} {:>8s} {:>8s} {:>9s} {:>9s} {:>10s}"
    print(f"{options.samples} samples, {options.resolution[0]} x {options.resolution[1]}, "
          f"{options.runs} runs; ratio = TENNIEL / CYCLES")
    print(head.format(*HEADINGS), flush=True)
    failed = False
    for name in names:
        blend = build_scene(name)
        measured = {engine: Measurement() for engine in ENGINES}
        for run in range(options.runs):
            for engine in ENGINES:
                out = folder / f"{name}.{engine.lower()}.{run}.exr"
                measured[engine].results.append(blender_process.render(
                    blend, engine, options.samples, run, options.resolution, out,
                    options.timeout))
        summaries = {engine: m.summary() for engine, m in measured.items()}
        for engine, summary in summaries.items():
            if summary is None:
                failed = True
                errors = {r.error for r in measured[engine].results if r.error}
                print(f"{name:14s} {engine:8s} failed: {'; '.join(errors)}", flush=True)
            else:
                print(format_summary(name, engine, summary), flush=True)
        if all(summaries.values()):
            print(format_ratio(name, summaries["TENNIEL"], summaries["CYCLES"]), flush=True)
    return 1 if failed else 0


def compare_file(blend, options, report):
    """Render `blend` with both engines and two seeds each; returns (agrees, one line of text)."""
    folder = pathlib.Path(options.out)
    folder.mkdir(parents=True, exist_ok=True)
    pictures, notes, seconds = {}, [], {}
    for engine in ENGINES:
        pictures[engine] = []
        for seed in (0, 1):
            out = folder / f"{blend.stem}.{engine.lower()}.{seed}.exr"
            result = blender_process.render(blend, engine, options.samples, seed,
                                            options.resolution, out, options.timeout)
            if result.error:
                return False, f"{engine} failed: {result.error}"
            pictures[engine].append(Picture.from_exr(out))
            seconds[engine] = result.total_seconds
            notes = result.reports or notes
    averages = {engine: p[0].average_with(p[1:]) for engine, p in pictures.items()}
    difference = compare.relative_difference(averages["TENNIEL"], averages["CYCLES"], BLOCK)
    # Two seeds differ by sqrt(2) of one picture's noise, their average has 1/sqrt(2) of it.
    noise = 0.5 * math.hypot(*(compare.relative_difference(*p, BLOCK)
                               for p in pictures.values()))
    agrees = difference <= ALLOWED_DIFFERENCE + noise
    text = (f"difference {difference:7.2%} noise {noise:7.2%} "
            f"{'agrees' if agrees else 'DIFFERS'}  "
            f"{seconds['CYCLES']:.1f} s / {seconds['TENNIEL']:.1f} s")
    report.add(blend.name, averages["TENNIEL"], averages["CYCLES"],
               "\n".join([text, *notes]), agrees)
    for note in notes:
        text += f"\n    {note}"
    return agrees, text


def compare_all(files, options):
    report = Report(options.out, "Tenniel against Cycles")
    agreed = 0
    for blend in files:
        agrees, text = compare_file(blend, options, report)
        agreed += agrees
        print(f"{blend.name:50s} {text}", flush=True)
        page = report.finish(f"{options.samples} samples; difference shown 5 times")
    print(f"{agreed} of {len(files)} agree; pictures in {page}")
    return 0 if agreed == len(files) else 1


def command_compare(options):
    files = [pathlib.Path(name) for name in options.files]
    for path in files:
        if not path.is_file():
            raise SystemExit(f"no such file: {path}")
    return compare_all(files, options)


def command_files(options):
    files = sorted(pathlib.Path(options.directory).glob("**/*.blend"))
    if not files:
        raise SystemExit(f"no .blend below {options.directory}")
    return compare_all(files, options)


def resolution(text):
    """"480x270" or "480" (height by the file's aspect ratio)."""
    width, _, height = text.partition("x")
    try:
        return int(width), int(height or 0)
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"{text!r} is not WIDTHxHEIGHT or WIDTH") from error


def parse():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    bench = commands.add_parser("bench", help="time, memory, noise and efficiency")
    bench.add_argument("--scenes", default="", help="comma-separated names (default: all)")
    bench.add_argument("--runs", type=int, default=2, help="renders an engine, each its own seed")
    pair = commands.add_parser("compare", help="do the pictures of these files agree?")
    pair.add_argument("files", nargs="+", metavar="FILE")
    folder = commands.add_parser("files", help="compare each .blend below a folder")
    folder.add_argument("directory", metavar="DIR")
    for command, samples, size, out in ((bench, 64, "480x270", "bench"),
                                        (pair, 128, "480", "compare"),
                                        (folder, 128, "480", "compare")):
        command.add_argument("--samples", type=int, default=samples)
        command.add_argument("--resolution", type=resolution, default=resolution(size),
                             metavar="WxH", help=f"default {size}")
        command.add_argument("--out", default=str(REPOSITORY / "build" / "bench" / out),
                             metavar="DIR")
        command.add_argument("--timeout", type=float, default=600.0,
                             help="seconds for one render")
    arguments = sys.argv[1:]
    if not arguments or (arguments[0].startswith("-") and arguments[0] not in ("-h", "--help")):
        arguments = ["bench", *arguments]
    options = parser.parse_args(arguments)
    if options.command == "bench" and options.runs < 2:
        parser.error("--runs must be at least 2: noise is measured between seeds")
    return options


def main():
    options = parse()
    return {"bench": command_bench, "compare": command_compare,
            "files": command_files}[options.command](options)


if __name__ == "__main__":
    sys.exit(main())
