# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds and imports the native render core that fits this processor and this Blender.

The core is built once per instruction set (`_core_v2`, `_core_v3`, `_core_v4`: the x86-64
levels) and lies beside this file, or in the folder named by TENNIEL_CORE_DIR. Everything that
can go wrong here happens on somebody else's machine, so each failure is one sentence that says
what is missing and what to do about it.
"""

import importlib.machinery
import importlib.util
import os
import platform
import re
import sys

# Flags as /proc/cpuinfo spells them; `abm` is lzcnt. Each level includes those below it.
_V2_FLAGS = frozenset({'ssse3', 'sse4_2', 'popcnt'})
_V3_FLAGS = _V2_FLAGS | {'avx2', 'bmi1', 'bmi2', 'fma', 'f16c', 'movbe', 'abm'}
_V4_FLAGS = _V3_FLAGS | {'avx512f', 'avx512bw', 'avx512cd', 'avx512dq', 'avx512vl'}
ISA_LEVELS = (('v4', _V4_FLAGS), ('v3', _V3_FLAGS), ('v2', _V2_FLAGS))

# What the core links; a package name only where Debian's differs from a guess by soname.
_EMBREE_SONAME = 'libembree3.so.3'
_PACKAGES = {
    'libembree3.so.3': 'libembree3-3',
    'libOpenImageIO.so.2.4': 'libopenimageio2.4',
    'libtbb.so.12': 'libtbb12',
}

_core = None


class NativeModuleError(ImportError):
    """The render core cannot run here; the message is one sentence for the artist."""


def core():
    """The native module, imported at the first call.

    Raises NativeModuleError when no build of the core fits.
    """
    global _core
    if _core is None:
        _core = _load(_search_dir(), cpu_flags())
    return _core


def loaded():
    """The native module if it has been imported, else None; never imports it."""
    return _core


def cpu_flags(path='/proc/cpuinfo'):
    """Feature flags of the first processor as a frozenset; empty if the system lists none."""
    try:
        with open(path, encoding='ascii', errors='replace') as file:
            for line in file:
                if line.startswith('flags'):
                    return frozenset(line.partition(':')[2].split())
    except OSError:
        pass
    return frozenset()


def fitting_levels(flags):
    """ISA levels this processor can run, best first.

    Without any flag only v2 is offered: Blender 3.4 itself needs a processor of that level.
    """
    if not flags:
        return ['v2']
    return [level for level, needed in ISA_LEVELS if needed <= flags]


def _search_dir():
    return os.environ.get('TENNIEL_CORE_DIR') or os.path.dirname(os.path.abspath(__file__))


def _load(folder, flags):
    _refuse_foreign_embree()
    levels = fitting_levels(flags)
    forced = os.environ.get('TENNIEL_ISA')
    if forced:
        if forced not in levels:
            raise NativeModuleError(
                f"TENNIEL_ISA asks for '{forced}', but this processor runs "
                f"{', '.join(levels) or 'no level'} only.")
        levels = [forced]
    if not levels:
        raise NativeModuleError(
            "Tenniel needs a processor with SSE 4.2 and POPCNT (x86-64-v2), which this one lacks.")

    for level in levels:
        stem = f'_core_{level}'
        path = _module_path(folder, stem)
        if path is not None:
            return _import_checked(stem, path)
    raise NativeModuleError(_missing_message(folder, levels))


def _module_path(folder, stem):
    """Path of the build of `stem` that this Python can import, or None."""
    for suffix in importlib.machinery.EXTENSION_SUFFIXES:
        path = os.path.join(folder, stem + suffix)
        if os.path.isfile(path):
            return path
    return None


def _import_checked(stem, path):
    # The full name keeps Python's PyInit lookup right: it takes the part after the last dot.
    name = f'{__package__}.{stem}'
    try:
        spec = importlib.util.spec_from_file_location(name, path)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
    except ImportError as error:
        raise NativeModuleError(explain_import_error(str(error), path)) from None

    built_for = str(module.python_version)
    if built_for.split('.')[:2] != [str(part) for part in sys.version_info[:2]]:
        raise NativeModuleError(_wrong_python_message(built_for))
    sys.modules[name] = module
    return module


def explain_import_error(text, path):
    """One sentence for what the dynamic loader or Python said about the module at `path`."""
    library = re.search(r'(lib[\w.+-]+\.so[\w.]*): cannot open shared object', text)
    if library:
        soname = library.group(1)
        package = _PACKAGES.get(soname, soname)
        return (f"Tenniel's render core needs {soname}, which is not on this system; "
                f"on Debian 12 install it with 'sudo apt install {package}' (the core was built "
                f"for Debian's Blender 3.4 with Python 3.11, this is {_this_blender()}).")
    if 'GLIBC' in text or 'version `' in text:
        return (f"Tenniel's render core was built for a newer system than this one ({text}); "
                f"build it here with './tenniel build' and './tenniel install'.")
    if 'undefined symbol' in text or 'PyInit' in text:
        return (f"Tenniel's render core does not fit {_this_blender()} or the libraries "
                f"installed here ({text}); build it again with './tenniel build' and "
                f"'./tenniel install'.")
    return (f"Tenniel's render core {os.path.basename(path)} cannot be loaded by "
            f"{_this_blender()} ({text}); build it again with './tenniel build' and "
            f"'./tenniel install'.")


def _missing_message(folder, levels):
    """Why no module was found: another Python, a better processor wanted, or nothing built."""
    builds = []
    try:
        builds = sorted(name for name in os.listdir(folder)
                        if re.match(r'_core_v\d.*\.(so|pyd)$', name))
    except OSError:
        pass
    for name in builds:
        tag = re.search(r'cpython-(\d)(\d+)', name)
        if tag and (int(tag.group(1)), int(tag.group(2))) != sys.version_info[:2]:
            return _wrong_python_message(f'{tag.group(1)}.{tag.group(2)}')
    if builds:
        return (f"Tenniel's render core is here only as {', '.join(builds)}, but this processor "
                f"runs {', '.join(levels)}; build it on this machine with './tenniel build' and "
                f"'./tenniel install'.")
    return (f"Tenniel's render core is missing from {folder}; build it with './tenniel build' "
            f"and './tenniel install' (for {_this_blender()}, {platform.machine()} Linux).")


def _wrong_python_message(built_for):
    return (f"Tenniel's render core was built for Python {built_for}, but this is "
            f"{_this_blender()}; build it for this Blender with './tenniel build' and "
            f"'./tenniel install', or use the Blender it was built for.")


def _refuse_foreign_embree(maps='/proc/self/maps'):
    """Stops before two Embree libraries meet in one process.

    Both export the same names, so one of them would be called with the other's data: a crash
    at the first render instead of a sentence now.
    """
    try:
        with open(maps, encoding='utf-8', errors='replace') as file:
            names = {os.path.basename(line.split(maxsplit=5)[-1].strip())
                     for line in file if 'libembree' in line}
    except OSError:
        return
    for name in sorted(names):
        if not name.startswith('libembree3.so'):
            raise NativeModuleError(
                f"{_this_blender()} brings its own Embree ({name}), while Tenniel's render core "
                f"was built for {_EMBREE_SONAME}; use Debian's Blender 3.4 "
                f"('sudo apt install blender').")


def _this_blender():
    python = f'Python {sys.version_info[0]}.{sys.version_info[1]}'
    try:
        import bpy
    except ImportError:
        return python
    return f'Blender {bpy.app.version_string} with {python}'


def register():
    core()


def unregister():
    """Nothing to undo: a native module cannot be unloaded from a Python process."""
