# SPDX-License-Identifier: GPL-3.0-or-later
"""Evaluated meshes -> MeshDesc, with only the attributes that a material asks for.

Each array is allocated by the core and filled by foreach_get. The element types are those of
Blender's own arrays: any other type makes the call about ten times slower.
"""

from array import array

from . import compat
from .context import ACTIVE_COLOR, ACTIVE_UV, GENERATED, ISLAND, POINTINESS

# Data type of an attribute -> (property of its elements, channels, whether it holds floats).
_ATTRIBUTE_TYPES = {
    'FLOAT': ('value', 1, True),
    'INT': ('value', 1, False),
    'INT8': ('value', 1, False),
    'BOOLEAN': ('value', 1, False),
    'FLOAT2': ('vector', 2, True),
    'FLOAT_VECTOR': ('vector', 3, True),
    'FLOAT_COLOR': ('color', 4, True),
    'BYTE_COLOR': ('color', 4, True),
}
# What the core calls each: hairs are to keys what polygons are to vertices.
_DOMAINS = {'POINT': 'POINT', 'EDGE': 'EDGE', 'CORNER': 'CORNER', 'FACE': 'FACE', 'CURVE': 'FACE'}

NO_MESH = -1


def export_mesh(context, mesh, original, attribute_names, has_slots):
    """Index of an evaluated mesh, adding it at its first use; NO_MESH if it has no faces.

    mesh: evaluated Mesh. original: the Mesh before modifiers, or None if it has none.
    attribute_names: those that the materials of this user ask for. has_slots: whether there is
    more than one material to choose from.
    """
    # The address is good for this export only: evaluated meshes live until the next evaluation.
    key = (mesh.as_pointer(), attribute_names, has_slots)
    index = context.meshes.get(key)
    if index is None:
        if len(mesh.polygons) == 0:
            index = NO_MESH
        else:
            index = context.description.add_mesh(
                _describe(context, mesh, original, attribute_names, has_slots))
        context.meshes[key] = index
    return index


def _describe(context, mesh, original, attribute_names, has_slots):
    core = context.core
    desc = core.MeshDesc()
    desc.name = mesh.name
    _set_topology(context, desc, mesh)
    if has_slots:
        desc.material_indices = _filled(context, core.IntBuffer(len(mesh.polygons)),
                                        mesh.polygons, 'material_index')
    _set_normals(context, desc, mesh)
    desc.attributes = _attributes(context, mesh, original, attribute_names)
    if {ISLAND, POINTINESS} & attribute_names or any(a.domain == 'EDGE' for a in desc.attributes):
        desc.edge_vertices = _filled(context, core.UIntBuffer(2 * len(mesh.edges)),
                                     mesh.edges, 'vertices')
    # Modifiers leave it as it was, but the mesh they make may have lost it.
    source = original or mesh
    desc.texture_space_location = tuple(source.texspace_location)
    desc.texture_space_size = tuple(source.texspace_size)
    return desc


def _filled(context, buffer, collection, name):
    """An array of a mesh of millions takes as long as a cancel may, so each asks first."""
    context.check_break()
    collection.foreach_get(name, buffer)
    return buffer


def _set_topology(context, desc, mesh):
    core = context.core
    mesh.calc_loop_triangles()
    desc.positions = _filled(context, core.FloatBuffer(3 * len(mesh.vertices)),
                             mesh.vertices, 'co')
    desc.corner_vertices = _filled(context, core.UIntBuffer(len(mesh.loops)),
                                   mesh.loops, 'vertex_index')
    desc.polygon_starts = _filled(context, core.IntBuffer(len(mesh.polygons)),
                                  mesh.polygons, 'loop_start')
    desc.polygon_sizes = _filled(context, core.IntBuffer(len(mesh.polygons)),
                                 mesh.polygons, 'loop_total')
    desc.triangle_corners = _filled(context, core.UIntBuffer(3 * len(mesh.loop_triangles)),
                                    mesh.loop_triangles, 'loops')


def _set_normals(context, desc, mesh):
    # Those of vertices are the core's to make: Blender's depend on its threads in their last bits.
    core = context.core
    smooth = _filled(context, core.ByteBuffer(len(mesh.polygons)),
                     mesh.polygons, 'use_smooth')
    desc.smooth_flags = smooth
    context.check_break()
    if compat.needs_corner_normals(mesh):
        desc.corner_normals = core.FloatBuffer(3 * len(mesh.loops))
        compat.read_corner_normals(mesh, desc.corner_normals)
        # These hold for flat faces too: they are flat there unless the artist bent them.
        memoryview(smooth).cast('B')[:] = b'\x01' * len(mesh.polygons)


# Attributes --------------------------------------------------------------------------------------

def _attributes(context, mesh, original, names):
    core, found = context.core, []
    for name in sorted(names - {ISLAND, POINTINESS}):
        context.check_break()
        if name == GENERATED:
            desc = _undeformed(core, mesh, original)
        else:
            desc = _named(core, mesh, name)
        if desc is not None:
            found.append(desc)
    return found


def _named(core, mesh, name):
    """AttributeDesc of a UV map or attribute, or None if the mesh has none of that name."""
    layer = _uv_layer(mesh, name)
    if layer is not None:
        desc = _new(core, name, 'CORNER', 2, len(mesh.loops))
        compat.read_uv(layer, desc.data)
        return desc
    source = compat.render_color_name(mesh) if name == ACTIVE_COLOR else name
    return read_attribute(core, mesh.attributes.get(source) if source else None, name)


def read_attribute(core, attribute, name):
    """AttributeDesc `name` of an attribute of any data-block, or None where it cannot be used."""
    if attribute is None or attribute.domain not in _DOMAINS:
        return None
    if attribute.data_type not in _ATTRIBUTE_TYPES:
        return None
    element, channels, is_float = _ATTRIBUTE_TYPES[attribute.data_type]
    desc = _new(core, name, _DOMAINS[attribute.domain], channels, len(attribute.data))
    if is_float:
        attribute.data.foreach_get(element, desc.data)
    else:
        values = array('i', bytes(4 * len(attribute.data)))
        attribute.data.foreach_get(element, values)
        memoryview(desc.data)[:] = memoryview(array('f', values))
    return desc


def _uv_layer(mesh, name):
    if name == ACTIVE_UV:
        return next((layer for layer in mesh.uv_layers if layer.active_render), None)
    return mesh.uv_layers.get(name)


def _undeformed(core, mesh, original):
    """Positions before deforming modifiers where they differ: what generated coordinates follow."""
    if original is None:
        return None
    desc = _new(core, GENERATED, 'POINT', 3, len(mesh.vertices))
    mesh.vertices.foreach_get('undeformed_co', desc.data)
    return desc


def _new(core, name, domain, channels, count):
    desc = core.AttributeDesc()
    desc.name = name
    desc.domain = domain
    desc.channels = channels
    desc.data = core.FloatBuffer(channels * count)
    return desc
