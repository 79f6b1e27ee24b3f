# SPDX-License-Identifier: GPL-3.0-or-later
"""Tenniel beside Mitsuba 3 on the cases of cases.py; what `./tenniel test oracle` runs.

python compare.py --output FOLDER --blender COMMAND... [--samples FACTOR] [NAME...]

Writes FOLDER/NAME.png (Mitsuba, Tenniel, their difference) and prints for each case how far the
means are apart. Runs in the environment that holds Mitsuba.
"""

import argparse
import math
import os
import pathlib
import subprocess
import sys

import numpy

import cases
import in_mitsuba
from in_mitsuba import mitsuba

SEEDS = (1, 2)
DIFFERENCE_SHOWN = 10.0    # times


def arguments():
    parser = argparse.ArgumentParser(prog="tenniel test oracle --")
    parser.add_argument("--output", type=pathlib.Path, required=True)
    parser.add_argument("--samples", type=float, default=1.0, metavar="FACTOR",
                        help="times the samples of each case")
    parser.add_argument("names", nargs="*", metavar="NAME", help="cases; default all")
    found = parser.parse_args()
    known = [case.name for case in cases.CASES]
    unknown = set(found.names) - set(known)
    if unknown:
        parser.error(f"there is no case {', '.join(sorted(unknown))}; there are {', '.join(known)}")
    found.names = found.names or known
    return found


def render_tenniel(folder, factor, names):
    """All cases in one Blender; the pictures are files."""
    command = [os.environ.get("BLENDER", "/usr/bin/blender"), "-b", "-Y", "--factory-startup",
               "--addons", "tenniel", "--python-exit-code", "1", "--python",
               str(pathlib.Path(__file__).with_name("in_blender.py")), "--", str(folder),
               str(factor), *names]
    environment = {**os.environ, "BLENDER_USER_SCRIPTS": os.environ["TENNIEL_SCRIPTS_DIR"]}
    with open(folder / "blender.log", "w", encoding="utf-8") as log:
        status = subprocess.run(command, env=environment, stdout=log, stderr=subprocess.STDOUT,
                                check=False).returncode
    if status != 0:
        raise SystemExit(f"Tenniel did not render; see {folder / 'blender.log'}")


def read(path):
    bitmap = mitsuba.Bitmap(str(path)).convert(mitsuba.Bitmap.PixelFormat.RGB,
                                               mitsuba.Struct.Type.Float32, False)
    return numpy.array(bitmap)


def ball_mask():
    """Pixels whose middle shows the ball, which lies in the middle of the picture."""
    distance = math.dist(cases.CAMERA, cases.TARGET)
    slope = math.tan(math.asin(cases.RADIUS / distance)) / math.tan(0.5 * cases.FIELD_OF_VIEW)
    radius = 0.5 * cases.WIDTH * slope
    y, x = numpy.mgrid[0:cases.HEIGHT, 0:cases.WIDTH] + 0.5
    return (x - 0.5 * cases.WIDTH) ** 2 + (y - 0.5 * cases.HEIGHT) ** 2 < radius ** 2


class Comparison:
    """Pictures of one case, one for each seed, and how far their means are apart."""

    def __init__(self, tested, reference):
        self.tested, self.reference = sum(tested) / len(tested), sum(reference) / len(reference)
        ball = ball_mask()
        self.differences, self.noise = {}, 0.0
        for name, mask in (("ball", ball), ("rest", ~ball)):
            means = self.reference[mask].mean(axis=0)
            self.differences[name] = (self.tested[mask].mean(axis=0) - means) / means
            for pictures in (tested, reference):
                halves = [picture[mask].mean(axis=0) for picture in pictures]
                self.noise = max(self.noise, float(
                    (numpy.abs(halves[0] - halves[1]) / (2.0 * means)).max()))

    def worst(self):
        return max(float(numpy.abs(value).max()) for value in self.differences.values())

    def row(self, case):
        def percent(values):
            return " ".join(f"{100.0 * value:+6.2f}" for value in values)

        if case.limit is None:
            verdict = "differs by convention, see README.md"
        else:
            verdict = "ok" if self.worst() <= case.limit else f"MORE THAN {case.limit:.1%}"
        return (f"{case.name:22} {percent(self.differences['ball'])}   "
                f"{percent(self.differences['rest'])}   {100.0 * self.noise:5.2f}   {verdict}")

    def write(self, path):
        apart = DIFFERENCE_SHOWN * numpy.abs(self.tested - self.reference)
        strip = numpy.concatenate([self.reference, self.tested, apart], axis=1)
        mitsuba.Bitmap(strip.astype(numpy.float32)).convert(
            mitsuba.Bitmap.PixelFormat.RGB, mitsuba.Struct.Type.UInt8, True).write(str(path))


def main():
    options = arguments()
    folder = options.output.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    in_mitsuba.write_environment(folder / "environment.exr")
    in_mitsuba.write_ball(folder / "ball.ply")
    print(f"{len(options.names)} cases with Tenniel", flush=True)
    render_tenniel(folder, options.samples, options.names)
    print(f"Mitsuba {mitsuba.__version__}; differences of the means in %, red green blue\n"
          f"{'':22} {'on the ball':20}   {'beside it':20}   noise", flush=True)
    failed = 0
    chosen = [case for case in cases.CASES if case.name in options.names]
    for case in chosen:
        samples = max(1, int(case.samples * options.samples))
        found = Comparison([read(folder / f"{case.name}_tenniel_{seed}.exr") for seed in SEEDS],
                           [in_mitsuba.render(case, folder, seed, samples) for seed in SEEDS])
        found.write(folder / f"{case.name}.png")
        print(found.row(case), flush=True)
        failed += case.limit is not None and found.worst() > case.limit
    print(f"pictures (Mitsuba, Tenniel, {DIFFERENCE_SHOWN:g} x difference) are in {folder}")
    print(f"{len(chosen) - failed} passed, {failed} failed")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
