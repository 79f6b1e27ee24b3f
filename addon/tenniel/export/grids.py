# SPDX-License-Identifier: GPL-3.0-or-later
"""What fills space voxel by voxel -> GridDesc: simulated smoke and fire, and Point Density."""

from array import array

from mathutils import Matrix

from .context import filled, matrix_rows
from .volume import has_volumes

# Attribute -> (property of a gas domain, floats per voxel, whether Noise refines it).
_SMOKE_GRIDS = {
    'density': ('density_grid', 1, True),
    'flame': ('flame_grid', 1, True),
    'color': ('color_grid', 4, True),
    'temperature': ('temperature_grid', 1, True),
    'heat': ('heat_grid', 1, False),
    'velocity': ('velocity_grid', 3, False),
}


def gas_domain(obj):
    """FluidDomainSettings of the gas simulation whose domain the object is, or None."""
    for modifier in obj.modifiers:
        if modifier.type == 'FLUID' and modifier.fluid_type == 'DOMAIN' and modifier.show_render \
                and modifier.domain_settings.domain_type == 'GAS':
            return modifier.domain_settings
    return None


def has_grids(context):
    """Whether anything in the scene may be filled with voxels of a simulation or of a file."""
    if context.has_grids is None:
        context.has_grids = has_volumes() or any(map(gas_domain, context.depsgraph.objects))
    return context.has_grids


def has_smoke(context, domain):
    """Whether the simulation holds anything at this frame."""
    return any(_has_values(context, grid) for grid in (domain.density_grid, domain.flame_grid))


def _has_values(context, grid):
    values = context.core.FloatBuffer(len(grid))
    if len(grid):
        grid.foreach_get(values)
    return bool(bytes(memoryview(values)).strip(b'\0'))


def export_smoke(context, domain, names):
    """Indices of the grids of an evaluated gas domain that `names` of attributes ask for."""
    return [index for name in sorted(names & _SMOKE_GRIDS.keys())
            for index in _export_smoke_grid(context, domain, name)]


def _export_smoke_grid(context, domain, name):
    source, channels, is_refined = _SMOKE_GRIDS[name]
    scale = domain.noise_scale if is_refined and domain.use_noise else 1
    resolution = tuple(n * scale for n in domain.domain_resolution)
    count = resolution[0] * resolution[1] * resolution[2] * channels
    values = getattr(domain, source)
    # What was not simulated (fire, colours) has no voxels.
    if not count or len(values) != count:
        return
    buffer = context.core.FloatBuffer(count)
    values.foreach_get(buffer)
    yield _add(context, name, resolution, channels, buffer)


def export_point_density(context, node):
    """(index, world space to the grid as 12 floats) of a Point Density node; None where it has no
    points."""
    if node.object is None:
        return None
    node.cache_point_density(depsgraph=context.depsgraph)
    # The bounds go with the cache, which the next call frees.
    low, high = node.calc_point_density_minmax(depsgraph=context.depsgraph)
    voxels = node.calc_point_density(depsgraph=context.depsgraph)
    size = round((len(voxels) / 4) ** (1 / 3))
    if not size or len(voxels) != 4 * size ** 3:
        return None
    buffer = filled(context.core.FloatBuffer(len(voxels)), array('f', voxels))
    stretch = Matrix.Diagonal([1.0 / (b - a) if b != a else 1.0 for a, b in zip(low, high)])
    to_grid = stretch.to_4x4() @ Matrix.Translation(-low)
    world = node.object.evaluated_get(context.depsgraph).matrix_world
    return (_add(context, node.name, (size, size, size), 4, buffer),
            matrix_rows(to_grid @ world.inverted_safe()))


def _add(context, name, resolution, channels, values):
    desc = context.core.GridDesc()
    desc.name = name
    desc.width, desc.height, desc.depth = resolution
    desc.channels = channels
    desc.values = values
    return context.description.add_grid(desc)
