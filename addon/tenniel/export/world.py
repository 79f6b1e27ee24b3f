# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene's World and those of the dreams -> WorldDesc."""

from .. import mirror_tags
from . import compat
from .context import ALL_RAY_KINDS
from .material import export_tree

# Names in Cycles' group, in the order of the core's bits.
_RAY_KINDS = ('camera', 'diffuse', 'glossy', 'transmission', 'scatter')


def export_worlds(context):
    """Adds the scene's World and, up to the last dream that has its own, those of the dreams."""
    dreams = list(context.scene.tenniel.dreams)
    if len(dreams) > mirror_tags.MAX_DREAMS:
        context.report('WARNING', f"The scene has {len(dreams)} dreams; those after the "
                       f"{mirror_tags.MAX_DREAMS}th are left out")
        del dreams[mirror_tags.MAX_DREAMS:]
    while dreams and dreams[-1].world is None:
        dreams.pop()
    own = context.scene.world if context.view_layer.use_sky else None
    for world in [own] + [dream.world or own for dream in dreams]:
        context.description.add_world(_export_world(context, world))


def _export_world(context, world):
    """WorldDesc; black where the scene has no World."""
    desc = context.core.WorldDesc()
    desc.graph = context.core.NodeGraph()
    desc.color = (0.0, 0.0, 0.0)
    if world is None:
        return desc
    world = world.evaluated_get(context.depsgraph)
    desc.name = world.name
    try:
        if compat.uses_nodes(world):
            desc.graph = export_tree(context, world.node_tree, 'ShaderNodeOutputWorld',
                                     world.name).graph
        else:
            desc.color = world.color[:]
    except Exception:
        context.report_exception(f"World '{world.name}'")
    desc.ray_kinds = _ray_kinds(world)
    desc.sampling = compat.lookup(world, 'sampling_method', 'AUTOMATIC')
    desc.map_resolution = compat.lookup(world, 'sample_map_resolution', 1024)
    desc.volume_step_size = compat.lookup(world, 'volume_step_size', 1.0)
    desc.max_bounces = compat.lookup(world, 'max_bounces', 1024)
    return desc


def _ray_kinds(world):
    flags = getattr(world, 'cycles_visibility', None)
    bits = ALL_RAY_KINDS
    for bit, name in enumerate(_RAY_KINDS):
        if not getattr(flags, name, True):
            bits &= ~(1 << bit)
    return bits
