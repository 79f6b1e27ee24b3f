# SPDX-License-Identifier: GPL-3.0-or-later
"""Lamps -> LightDesc."""

from . import compat
from .context import matrix_rows
from .material import export_tree


def export_light(context, lamp, name, matrix, visibility, random):
    """Adds a lamp.

    lamp: evaluated Light. matrix: object to world. visibility: (worlds, ray_kinds) bits.
    random: [0, 1], for the Object Info node of its tree.
    """
    # A portal only guides the sampling of the World and gives no light.
    if lamp.type == 'AREA' and compat.lookup(lamp, 'is_portal', False):
        return
    desc = context.core.LightDesc()
    desc.name = name
    desc.type = lamp.type
    desc.object_to_world = matrix_rows(matrix)
    desc.color = lamp.color[:]
    desc.energy = lamp.energy
    desc.worlds, desc.ray_kinds = visibility
    desc.random = random
    if lamp.type == 'AREA':
        _set_area(desc, lamp)
    elif lamp.type == 'SUN':
        desc.angle = lamp.angle
    else:
        desc.radius = lamp.shadow_soft_size
    if lamp.type == 'SPOT':
        desc.spot_size = lamp.spot_size
        desc.spot_blend = lamp.spot_blend
    if compat.uses_nodes(lamp):
        desc.graph = export_tree(context, lamp.node_tree, 'ShaderNodeOutputLight', name).graph
    desc.casts_shadow = bool(compat.lookup(lamp, 'cast_shadow', True))
    desc.use_mis = bool(compat.lookup(lamp, 'use_mis', True))
    desc.max_bounces = compat.lookup(lamp, 'max_bounces', 1024)
    context.description.add_light(desc)


def _set_area(desc, lamp):
    desc.shape = lamp.shape
    desc.size_x = lamp.size
    desc.size_y = lamp.size_y if lamp.shape in {'RECTANGLE', 'ELLIPSE'} else lamp.size
    desc.spread = lamp.spread
