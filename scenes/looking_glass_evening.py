# SPDX-License-Identifier: GPL-3.0-or-later
"""The looking glass by candlelight."""

import looking_glass


def build(scene):
    looking_glass.build(scene, evening=True)
