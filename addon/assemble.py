# SPDX-License-Identifier: Apache-2.0
"""Usage: assemble.py SOURCE_PACKAGE TARGET_PACKAGE [MODULE.so ...]

Makes TARGET_PACKAGE a folder of links to the Python sources and to the native modules. Links that
nothing stands behind any more are removed; running it again changes nothing.
"""

import os
import pathlib
import sys


def link(target, source):
    if target.is_symlink() and os.readlink(target) == str(source):
        return
    target.parent.mkdir(parents=True, exist_ok=True)
    target.unlink(missing_ok=True)
    target.symlink_to(source)


def wanted_links(source, modules):
    for path in source.rglob("*"):
        if path.is_file() and "__pycache__" not in path.parts and path.suffix != ".so":
            yield path.relative_to(source), path
    for module in modules:
        # "_core_v3.cpython-311-x86_64-linux-gnu.so" keeps its tag: Python checks it for us.
        yield pathlib.Path(module.name), module


def main():
    source, target = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    modules = [pathlib.Path(m) for m in sys.argv[3:]]
    if target.resolve() == source.resolve():
        sys.exit(f"{target} is the source itself: nothing is assembled there")
    links = dict(wanted_links(source, modules))
    for old in target.rglob("*"):
        if old.is_symlink() and old.relative_to(target) not in links:
            old.unlink()
    for name, path in links.items():
        link(target / name, path.resolve())


if __name__ == "__main__":
    main()
