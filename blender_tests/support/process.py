# SPDX-License-Identifier: GPL-3.0-or-later
"""Another Blender for tests in which the exit status, a signal or the files written matter."""
import os
import signal
import subprocess
import tempfile
import time

import bpy

from .render import TESTED_ENGINE

# A start of Blender on a busy machine, without the render.
START_SECONDS = 120


class Outcome:
    """Exit status (negative: killed by that signal), output as text, seconds from the signal."""

    def __init__(self, status, output, seconds=0.0):
        self.status = status
        self.output = output
        self.seconds = seconds

    def __str__(self):
        lines = [line for line in self.output.splitlines() if not line.startswith("Fra:")]
        return f"status {self.status}\n" + "\n".join(lines[-20:])


def command(arguments, blend=None):
    """Blender's command line; the add-on comes before the file so that its engine is known."""
    start = [bpy.app.binary_path, "-b", "--factory-startup", "-noaudio"]
    if TESTED_ENGINE == "TENNIEL":
        start += ["--addons", "tenniel"]
    return start + ([blend] if blend else []) + list(arguments)


def run(arguments, blend=None, environment=None, timeout=300):
    """Run Blender to its end."""
    done = subprocess.run(command(arguments, blend), stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=timeout,
                          env={**os.environ, **(environment or {})}, check=False)
    return Outcome(done.returncode, done.stdout.decode("utf-8", "replace"))


def run_script(text, **options):
    """Run Blender with a Python script given as text."""
    with tempfile.NamedTemporaryFile("w", suffix=".py") as script:
        script.write(text)
        script.flush()
        return run(["--python-exit-code", "3", "--python", script.name], **options)


def interrupt(arguments, blend, marker, delay, signal_number=signal.SIGTERM, patience=60.0):
    """Start Blender, wait for `marker` in its output and `delay` seconds, send a signal.

    Killed after another `patience` seconds. `Outcome.seconds` is the time from signal to end.
    """
    with tempfile.TemporaryFile() as log:
        process = subprocess.Popen(command(arguments, blend), stdin=subprocess.DEVNULL, stdout=log,
                                   stderr=subprocess.STDOUT)
        try:
            _wait_for(process, log, marker)
            time.sleep(delay)
            process.send_signal(signal_number)
            start = time.monotonic()
            process.wait(timeout=patience)
        finally:
            if process.poll() is None:
                process.kill()
                process.wait()
        seconds = time.monotonic() - start
        log.seek(0)
        return Outcome(process.returncode, log.read().decode("utf-8", "replace"), seconds)


def _wait_for(process, log, marker):
    end = time.monotonic() + START_SECONDS
    while time.monotonic() < end:
        # The child shares the file position, so read without moving it.
        if marker.encode() in os.pread(log.fileno(), 1 << 24, 0):
            return
        if process.poll() is not None:
            raise AssertionError(f"Blender ended with {process.returncode} before {marker!r}")
        time.sleep(0.02)
    raise AssertionError(f"no {marker!r} within {START_SECONDS} s")
