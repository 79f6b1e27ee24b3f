# SPDX-License-Identifier: GPL-3.0-or-later
"""One timed render in a Blender of its own, with the peak memory of that process."""
import json
import os
import pathlib
import signal
import subprocess
import tempfile
import threading
from dataclasses import dataclass, field

FOLDER = pathlib.Path(__file__).resolve().parent
REPOSITORY = FOLDER.parent.parent
ENGINES = ("CYCLES", "TENNIEL")


@dataclass
class RenderResult:
    """Times in seconds, memory in MiB. `error` is empty when a picture was written."""
    picture_path: str
    error: str = ""
    setup_seconds: float = 0.0
    total_seconds: float = 0.0
    peak_memory: float = 0.0
    width: int = 0
    height: int = 0
    reports: list = field(default_factory=list)

    @property
    def render_seconds(self):
        """Time for the samples alone: the render less one of a single sample."""
        return max(self.total_seconds - self.setup_seconds, 1e-3)


def blender_environment():
    scripts = os.environ.get("TENNIEL_SCRIPTS_DIR", str(REPOSITORY / "build" / "scripts"))
    return {**os.environ, "BLENDER_USER_SCRIPTS": scripts}


def blender():
    return os.environ.get("BLENDER", "blender")


def render(blend, engine, samples, seed, size, out, timeout=600.0):
    """Render `blend` at size (width, height or 0) to the EXR file `out`; never raises.

    Scripts inside the file do not run (-Y).
    """
    command = [blender(), "-b", "--factory-startup", "-noaudio", "-Y"]
    if engine == "TENNIEL":
        command += ["--addons", "tenniel"]
    command += [str(blend), "--python-exit-code", "3", "--python", str(FOLDER / "render_one.py"),
                "--", "--engine", engine, "--samples", str(samples), "--seed", str(seed),
                "--width", str(size[0]), "--height", str(size[1]), "--out", str(out)]
    out = pathlib.Path(out)
    out.unlink(missing_ok=True)
    with tempfile.TemporaryFile() as log:
        status, memory, timed_out = _run(command, log, timeout)
        log.seek(0)
        lines = log.read().decode("utf-8", "replace").splitlines()
    result = RenderResult(str(out), peak_memory=memory)
    payload = [line for line in lines if line.startswith("RESULT ")]
    if payload:
        for name, value in json.loads(payload[-1][len("RESULT "):]).items():
            setattr(result, name, value)
    if timed_out:
        result.error = f"no end after {timeout:g} s"
    elif status != 0 or not payload or not out.exists():
        result.error = f"status {status}: {_last_words(lines)}"
    return result


def _run(command, log, timeout):
    """(exit status or -signal, peak resident memory in MiB, timed out)."""
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log,
                               stderr=subprocess.STDOUT, env=blender_environment())
    timed_out = threading.Event()

    def stop():
        timed_out.set()
        os.kill(process.pid, signal.SIGKILL)
    timer = threading.Timer(timeout, stop)
    timer.start()
    # wait4 gives the resource usage of this child alone.
    _, status, usage = os.wait4(process.pid, 0)
    timer.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, usage.ru_maxrss / 1024.0, timed_out.is_set()


def _last_words(lines):
    """The line that says most about a failure."""
    useful = [line for line in lines if line.strip() and not line.startswith("Fra:")]
    errors = [line for line in useful
              if "error" in line.lower() and "script failed" not in line]
    return (errors or useful or ["no output"])[-1].strip()[:200]
