# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender for run.py: discover the cases, run those asked for, report each as a line.

Lines are JSON objects on the file descriptor named by TENNIEL_TEST_FD; what to do comes from the
JSON file named by TENNIEL_TEST_JOB: {"patterns", "only" (test ids or null), "list", "report",
"parity" (file to write or null)}.
"""
import json
import os
import pathlib
import sys
import unittest

import bpy

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER))

from support import case, parity_log  # noqa: E402  (needs the path set above)
from support.render import TESTED_ENGINE  # noqa: E402


class Channel:
    """Writes one JSON object a line to run.py."""

    def __init__(self):
        self.stream = os.fdopen(int(os.environ["TENNIEL_TEST_FD"]), "w", buffering=1)

    def send(self, kind, **values):
        self.stream.write(json.dumps({"kind": kind, **values}) + "\n")


class StreamingResult(unittest.TestResult):
    """Sends `start` before and `end` after each test, with the texts of all that went wrong."""

    def __init__(self, channel):
        super().__init__()
        self.channel = channel
        self.problems = []
        self.skipped_because = None

    def startTest(self, test):
        super().startTest(test)
        self.problems = []
        self.skipped_because = None
        self.channel.send("start", id=test_id(test))

    def stopTest(self, test):
        super().stopTest(test)
        status = "fail" if self.problems else "skip" if self.skipped_because else "pass"
        text = "\n".join(self.problems) or self.skipped_because or ""
        self.channel.send("end", id=test_id(test), status=status, text=text)

    def addFailure(self, test, err):
        self.problems.append(self._exc_info_to_string(err, test))

    def addError(self, test, err):
        self.problems.append(self._exc_info_to_string(err, test))

    def addUnexpectedSuccess(self, test):
        self.problems.append("passed although it is marked as an expected failure")

    def addSkip(self, test, reason):
        self.skipped_because = reason

    def addSubTest(self, test, subtest, err):
        if err is not None:
            self.problems.append(f"{subtest._subDescription()}\n"
                                 f"{self._exc_info_to_string(err, test)}")


def test_id(test):
    """Id without the leading package: "test_camera.CameraTest.test_shift"."""
    return test.id().removeprefix("cases.")


def flatten(suite):
    for item in suite:
        if isinstance(item, unittest.TestSuite):
            yield from flatten(item)
        else:
            yield item


def discover():
    loader = unittest.TestLoader()
    names = sorted(p.stem for p in (FOLDER / "cases").glob("test_*.py"))
    return list(flatten(loader.loadTestsFromNames([f"cases.{name}" for name in names])))


def engine_available(name):
    try:
        bpy.context.scene.render.engine = name
    except TypeError:
        return False
    return True


def main():
    channel = Channel()
    with open(os.environ["TENNIEL_TEST_JOB"], encoding="utf-8") as stream:
        job = json.load(stream)
    tests = [t for t in discover()
             if any(pattern.lower() in test_id(t).lower() for pattern in job["patterns"])]
    if job["only"] is not None:
        wanted = set(job["only"])
        tests = [t for t in tests if test_id(t) in wanted]
    channel.send("plan", ids=[test_id(t) for t in tests])
    if job["list"]:
        return
    if not engine_available(TESTED_ENGINE):
        channel.send("fatal", text=f"engine {TESTED_ENGINE} is not available in this Blender")
        return
    if job["report"]:
        case.open_report(job["report"])
    if job["parity"]:
        parity_log.open_log(job["parity"])
    result = StreamingResult(channel)
    for test in tests:
        test.run(result)
        parity_log.save()
    case.close_report()
    channel.send("done")


main()
