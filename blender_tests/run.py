# SPDX-License-Identifier: GPL-3.0-or-later
"""Run the tests that need Blender.

One Blender runs test after test and is started again after a crash or a time-out; the test during
which it happened counts as failed. Exit status 0 when all passed; the last line is
"N passed, N failed".

Environment: TENNIEL_SCRIPTS_DIR (folder with addons/tenniel, default build/scripts), BLENDER (the
program), TENNIEL_TEST_ENGINE and TENNIEL_REFERENCE_ENGINE (default TENNIEL against CYCLES).
"""
import argparse
import collections
import json
import os
import pathlib
import select
import subprocess
import sys
import tempfile
import threading
import time

from support import parity_page

FOLDER = pathlib.Path(__file__).resolve().parent
REPOSITORY = FOLDER.parent
LOG_LINES = 40


def blender_command(engine):
    """Program and arguments up to the script."""
    command = [os.environ.get("BLENDER", "blender"), "-b", "--factory-startup",
               "--python-exit-code", "3"]
    if engine == "TENNIEL":
        command += ["--addons", "tenniel"]
    return command


def child_environment():
    """Our environment plus where Blender finds the add-on."""
    scripts = os.environ.get("TENNIEL_SCRIPTS_DIR", str(REPOSITORY / "build" / "scripts"))
    return {**os.environ, "BLENDER_USER_SCRIPTS": scripts}


class Batch:
    """One Blender process: yields its messages, remembers the end of its log."""

    def __init__(self, job, engine):
        self.file = tempfile.NamedTemporaryFile("w", suffix=".json", delete=False)
        json.dump(job, self.file)
        self.file.close()
        read_end, write_end = os.pipe()
        self.pipe = read_end
        environment = {**child_environment(), "TENNIEL_TEST_FD": str(write_end),
                       "TENNIEL_TEST_JOB": self.file.name}
        self.process = subprocess.Popen(
            [*blender_command(engine), "--python", str(FOLDER / "inside.py")],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            env=environment, pass_fds=[write_end])
        os.close(write_end)
        self.log = collections.deque(maxlen=LOG_LINES)
        self.reader = threading.Thread(target=self._read_log, daemon=True)
        self.reader.start()

    def _read_log(self):
        for line in self.process.stdout:
            text = line.decode("utf-8", "replace").rstrip()
            if text and not text.startswith("Fra:"):
                self.log.append(text)

    def messages(self, timeout):
        """Yield messages; None once no message came for `timeout` seconds (process is killed)."""
        rest = b""
        while True:
            ready, _, _ = select.select([self.pipe], [], [], timeout)
            if not ready:
                self.process.kill()
                yield None
                return
            data = os.read(self.pipe, 1 << 16)
            if not data:
                return
            *lines, rest = (rest + data).split(b"\n")
            for line in lines:
                yield json.loads(line)

    def finish(self):
        """Wait for the end and return the exit status (negative: signal)."""
        try:
            status = self.process.wait(timeout=30)
        except subprocess.TimeoutExpired:
            self.process.kill()
            status = self.process.wait()
        self.reader.join(timeout=5)
        os.close(self.pipe)
        os.unlink(self.file.name)
        return status


class Runner:
    """Goes through all tests, with as many Blender processes as it takes."""

    def __init__(self, options):
        self.options = options
        self.engine = os.environ.get("TENNIEL_TEST_ENGINE", "TENNIEL")
        self.results = {}
        self.failures = []
        self.plan = None

    def run(self):
        remaining = None
        batch_number = 0
        while remaining is None or remaining:
            report = self.options.report
            if report and batch_number:
                report = os.path.join(report, f"part{batch_number + 1}")
            parity = self.options.parity
            if parity:
                parity = os.path.join(parity, f"part{batch_number + 1}.json")
            job = {"patterns": self.options.k or [""], "only": remaining,
                   "list": self.options.list, "report": report, "parity": parity}
            if not self._run_batch(job):
                break
            remaining = [name for name in self.plan if name not in self.results]
            batch_number += 1
        return self._sum_up()

    def _run_batch(self, job):
        """Run one Blender to its end. False: do not go on."""
        batch = Batch(job, self.engine)
        current, started, complete, timed_out, count = None, time.monotonic(), False, False, 0
        for message in batch.messages(self.options.timeout):
            if message is None:
                timed_out = True
                break
            kind = message["kind"]
            if kind == "plan" and self.plan is None:
                self.plan = message["ids"]
            elif kind == "start":
                current, started = message["id"], time.monotonic()
            elif kind == "end":
                seconds = time.monotonic() - started
                self._record(message["id"], message["status"], message["text"], seconds)
                current, count = None, count + 1
            elif kind == "fatal":
                self.failures.append(("blender", message["text"]))
            elif kind == "done":
                complete = True
        status = batch.finish()
        if self.options.list or complete:
            return False
        log = "\n".join(batch.log)
        if current is not None:
            reason = (f"no end after {self.options.timeout} s" if timed_out
                      else f"Blender ended with status {status}")
            self._record(current, "fail", f"{reason}\n{log}", time.monotonic() - started)
            return True
        if not self.failures:
            self.failures.append(("blender", f"Blender ended with status {status}\n{log}"))
        return count > 0 and not self.failures

    def _record(self, name, status, text, seconds):
        self.results[name] = status
        print(f"{status.upper():4s} {name} ({seconds:.1f} s)", flush=True)
        if status == "fail":
            self.failures.append((name, text))
            print("     " + text.strip().replace("\n", "\n     "), flush=True)
        elif status == "skip":
            print(f"     {text}", flush=True)

    def _sum_up(self):
        if self.options.list:
            print("\n".join(self.plan or []))
            return 0 if self.plan else 1
        passed = sum(status == "pass" for status in self.results.values())
        skipped = sum(status == "skip" for status in self.results.values())
        lost = [name for name in self.plan or [] if name not in self.results]
        for name, text in self.failures:
            if name == "blender":
                print(f"FAIL {text}")
        if self.failures:
            print("failed: " + ", ".join(name for name, _ in self.failures))
        if skipped:
            print(f"{skipped} skipped")
        failed = sum(status == "fail" for status in self.results.values()) + len(lost)
        print(f"{passed} passed, {failed} failed")
        return 0 if passed and not failed and not self.failures else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("-k", action="append", metavar="PATTERN",
                        help="only tests whose id contains this (case does not matter); may be "
                             "given several times")
    parser.add_argument("--list", action="store_true", help="print the ids and stop")
    parser.add_argument("--report", metavar="DIR",
                        help="write a page with tested / reference / difference pictures")
    parser.add_argument("--parity", metavar="DIR",
                        help="write DIR/PARITY.md, what each shader node was tried with; "
                             "without -k of all tests of nodes")
    parser.add_argument("--timeout", type=float, default=300.0,
                        help="seconds a single test may take (default 300)")
    options = parser.parse_args()
    if options.report:
        options.report = os.path.abspath(options.report)
    if options.parity:
        options.parity = os.path.abspath(options.parity)
        os.makedirs(options.parity, exist_ok=True)
        for old in pathlib.Path(options.parity).glob("part*.json"):
            old.unlink()
        options.k = options.k or list(parity_page.CASES)
    status = Runner(options).run()
    if options.parity and not options.list:
        parity_page.write(options.parity, os.path.join(options.parity, "PARITY.md"))
    return status


if __name__ == "__main__":
    sys.exit(main())
