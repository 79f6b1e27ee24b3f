# SPDX-License-Identifier: GPL-3.0-or-later
"""Panels of Tenniel, one file for each tab of the Properties editor."""

from . import camera, compat, light, material, object, render, scene, view_layer, world

_MODULES = (compat, render, scene, view_layer, world, object, material, light, camera)


def register():
    for module in _MODULES:
        module.register()


def unregister():
    for module in reversed(_MODULES):
        module.unregister()
