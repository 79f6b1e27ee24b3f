# SPDX-License-Identifier: GPL-3.0-or-later
"""The looking glass as anybody else would see it."""

import looking_glass


def build(scene):
    looking_glass.build(scene, dreaming=False)
