# SPDX-License-Identifier: GPL-3.0-or-later
"""Tenniel: a path tracer for Blender whose mirrors may show another world."""

import importlib
import sys

# Set by an earlier run of this file: Blender reloads it when a new version is installed over it.
_is_reload = '_MODULES' in globals()

bl_info = {
    "name": "Tenniel",
    "author": "The Tenniel authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Render Properties > Render Engine",
    "description": "CPU path tracer with looking glasses that show another world",
    "category": "Render",
}

# In the order of registration. `native` comes first: if the core does not fit this Blender,
# nothing else is imported or registered, and the artist reads why.
_MODULES = (
    'native',
    'properties',
    'operators',
    'node_marks',
    'engine',
    'presets',
    'ui',
)

_registered = []


def _forget_old_modules():
    """Lets the files of a newly installed version be imported in place of the running ones.

    All but the core and `native`, which holds it: a process cannot load the core twice.
    """
    for name in [name for name in sys.modules if name.startswith(__name__ + '.')]:
        if not name.startswith((__name__ + '._core', __name__ + '.native')):
            del sys.modules[name]


def register():
    global _is_reload
    if _is_reload:
        _forget_old_modules()
        _is_reload = False
    try:
        for name in _MODULES:
            module = importlib.import_module('.' + name, __name__)
            module.register()
            _registered.append(module)
    except BaseException:
        unregister()
        raise


def unregister():
    while _registered:
        _registered.pop().unregister()
