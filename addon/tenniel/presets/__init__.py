# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets of measured metals and media: Add > Tenniel in the shader editor."""

from . import menu


def register():
    menu.register()


def unregister():
    menu.unregister()
