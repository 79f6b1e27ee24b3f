#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails when a module of core/ includes what its layer may not know, or a third party leaks."""

import pathlib
import re
import sys

CORE = pathlib.Path(__file__).resolve().parent.parent

LAYERS = {
    "math": set(),
    "sampling": {"math"},
    "image": {"math"},
    "geometry": {"math", "sampling"},
    "camera": {"math", "sampling"},
    "bsdf": {"math", "sampling"},
    "media": {"math", "sampling"},
    "film": {"math", "image", "sampling"},
    "shading": {"math", "sampling", "image", "geometry", "bsdf", "media"},
    "lights": {"math", "sampling", "image", "geometry", "bsdf", "shading"},
    "scene": {"math", "sampling", "image", "geometry", "camera", "bsdf", "shading", "lights"},
    "integrator": {"math", "sampling", "image", "geometry", "camera", "bsdf", "media", "shading",
                   "lights", "scene"},
    "render": {"math", "sampling", "geometry", "camera", "film", "scene", "integrator", "shading"},
    "bindings": {"math", "sampling", "image", "geometry", "camera", "shading", "film", "scene",
                 "render"},
    "testing": set(),
}
TESTS_MAY = {"testing"}

# Third party: pattern of the include -> the only places that may name it.
BORDERS = {
    r"embree3/": ("geometry/accel",),
    r"OpenImageIO/": ("image/image_io", "image/volume_io"),
    r"pybind11/": ("bindings/",),
    r"(tbb|oneapi)/": ("render/", "scene/"),
}

INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')


def violations(path):
    relative = path.relative_to(CORE).as_posix()
    module = relative.split("/")[0]
    if module not in LAYERS:
        yield f"{relative}: folder '{module}' is in no layer"
        return
    allowed = LAYERS[module] | {module}
    if module == "testing":
        allowed |= set(LAYERS)
    if relative.endswith(("_test.cpp", "_bench.cpp")):
        allowed |= TESTS_MAY
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        own, system = match.groups()
        if own is not None:
            target = own.split("/")[0]
            if target not in LAYERS:
                yield f"{relative}:{number}: \"{own}\" is not named from core/"
            elif target not in allowed:
                yield f"{relative}:{number}: {module} may not include {target}"
        for pattern, places in BORDERS.items():
            if re.match(pattern, own or system) and not relative.startswith(places):
                yield f"{relative}:{number}: only {', '.join(places)} may include {own or system}"


def main():
    files = sorted(p for p in CORE.rglob("*") if p.suffix in (".h", ".cpp"))
    found = [text for path in files for text in violations(path)]
    for text in found:
        print(text)
    print(f"layers: {len(files)} files, {len(found)} violations")
    return 1 if found or not files else 0


if __name__ == "__main__":
    sys.exit(main())
