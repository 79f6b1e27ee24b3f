# SPDX-License-Identifier: GPL-3.0-or-later
"""Volume objects -> a box around their voxels, and the grids of the OpenVDB file that fill it.

Python sees a volume's grids but not its voxels: the core reads them from the file. What modifiers
made, or what is packed into the .blend, has none of its own and is saved for it.
"""

import os
from array import array
from itertools import chain
from pathlib import Path
from typing import NamedTuple, Sequence

import bpy
from mathutils import Vector

from .context import filled
from .mesh import NO_MESH
from .settings import hash_string

# By how many voxels the box goes beyond the outermost: their values fade to nothing over one, and
# Blender's bounds end in the middle of a voxel.
_VOXELS_BEYOND = 2.0

# Corners of each side of a box, seen from outside; corner i is low or high in x, y, z by its bits.
_SIDES = ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6))

_MAKERS = {'GeometryNodeVolumeCube', 'GeometryNodeMeshToVolume', 'GeometryNodePointsToVolume'}


class ExportedVolume(NamedTuple):
    """mesh: index of the box or NO_MESH. grids: indices of what fills it."""
    mesh: int
    grids: Sequence[int] = ()


_NOTHING = ExportedVolume(NO_MESH)


def has_volumes():
    """Whether anything in this file may be a volume object or make one."""
    return len(bpy.data.volumes) > 0 or any(
        node.bl_idname in _MAKERS for tree in bpy.data.node_groups
        if tree.bl_idname == 'GeometryNodeTree' for node in tree.nodes)


def export_volume(context, obj, names, report):
    """ExportedVolume of an evaluated object, adding it at the first use of its data.

    names: the attributes that its materials ask for. report: called with a sentence for the artist.
    """
    key = (obj.data.as_pointer(), names)
    if key not in context.volumes:
        context.volumes[key] = _NOTHING
        context.volumes[key] = _describe(context, obj, names, report)
    return context.volumes[key]


def _describe(context, obj, names, report):
    grids = obj.data.grids
    if not grids.load():
        report(f"The OpenVDB file cannot be read: {grids.error_message or obj.data.filepath}")
        return _NOTHING
    wanted = sorted(names & {grid.name for grid in grids})
    if not wanted:
        found = ", ".join(f"'{grid.name}'" for grid in grids) or "none"
        report(f"No material reads a grid of this volume (it has {found}): nothing is seen of it")
        return _NOTHING
    path = _file_of(context, obj)
    if path is None:
        report(f"What modifiers made of the volume cannot be saved: {grids.error_message}")
        return _NOTHING
    return ExportedVolume(_box(context, obj), [_grid(context, path, name) for name in wanted])


def _file_of(context, obj):
    """Path of a file that holds the evaluated grids, or None where none can be written."""
    volume = obj.data
    if volume.filepath and not volume.packed_file and not len(obj.modifiers):
        return bpy.path.abspath(volume.grids.frame_filepath, library=volume.library)
    name = hash_string('\0'.join((obj.name_full, volume.name_full)))
    kind = 'view' if context.view.is_viewport else 'render'
    path = Path(bpy.app.tempdir) / f"tenniel_{kind}_{name:08x}.vdb"
    # A session that is still reading the last one keeps it: only its name goes.
    fresh = path.with_suffix('.new.vdb')
    if not volume.grids.save(filepath=str(fresh)):
        return None
    os.replace(fresh, path)
    return str(path)


def _box(context, obj):
    core = context.core
    corners = [Vector(corner) for corner in obj.bound_box]
    low = Vector(min(c[axis] for c in corners) for axis in range(3))
    high = Vector(max(c[axis] for c in corners) for axis in range(3))
    beyond = _VOXELS_BEYOND * _voxel_extent(obj.data.grids)
    low, high = low - beyond, high + beyond
    desc = core.MeshDesc()
    desc.name = obj.data.name
    desc.positions = filled(core.FloatBuffer(24), array('f', [
        (high if corner >> axis & 1 else low)[axis] for corner in range(8) for axis in range(3)]))
    desc.corner_vertices = filled(core.UIntBuffer(24), array('I', chain.from_iterable(_SIDES)))
    desc.polygon_starts = filled(core.IntBuffer(6), array('i', range(0, 24, 4)))
    desc.polygon_sizes = filled(core.IntBuffer(6), array('i', [4] * 6))
    desc.triangle_corners = filled(core.UIntBuffer(36), array('I', [
        4 * side + corner for side in range(6) for corner in (0, 1, 2, 0, 2, 3)]))
    # A volume's Generated coordinates are those of the object, as in Cycles.
    desc.texture_space_location = desc.texture_space_size = (0.5, 0.5, 0.5)
    return context.description.add_mesh(desc)


def _voxel_extent(grids):
    """The box around the largest voxel of the grids, as a Vector in object space."""
    extents = [[sum(abs(x) for x in row[:3]) for row in grid.matrix_object[:3]] for grid in grids]
    return Vector(max(values) for values in zip(*extents))


def _grid(context, path, name):
    desc = context.core.GridDesc()
    desc.name = name
    desc.path = path
    return context.description.add_grid(desc)
