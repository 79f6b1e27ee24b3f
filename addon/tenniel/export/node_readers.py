# SPDX-License-Identifier: GPL-3.0-or-later
"""The few shader nodes whose data is in neither sockets nor plain settings.

Each reader returns settings by the core's names; the exporter keeps those the core knows. Readers
also note in `Needs` what a node wants from meshes and instances.
"""

from dataclasses import dataclass, field
from typing import Set

import bpy
from mathutils import Matrix

from .context import ACTIVE_COLOR, ACTIVE_UV, GENERATED, ISLAND, POINTINESS, matrix_rows
from .grids import export_point_density, has_grids
from .image import export_image

# Entries of ramp and curve tables, as in Cycles.
_TABLE_SIZE = 256

# Attribute nodes that do not read the mesh, by their type: prefix that keeps the names apart.
INSTANCE_ATTRIBUTE_PREFIXES = {
    'OBJECT': '\x01object:',
    'INSTANCER': '\x01instancer:',
    'VIEW_LAYER': '\x01layer:',
    'PARTICLE': '\x01particle:',
}

# The core's own conductor, which stands for the group of a metal (presets/groups.py), and its
# inputs in the order of the group's.
CONDUCTOR = 'TennielConductor'
CONDUCTOR_INPUTS = ('Eta', 'K', 'Roughness', 'Normal')

# The core answers these by itself, whatever the type of the Attribute node.
_MIRROR_ATTRIBUTES = {'behind_mirror', 'dream'}

# Textures that take the generated coordinate where their Vector input has no link.
_WITHOUT_COORDINATE = {'ShaderNodeTexImage', 'ShaderNodeTexEnvironment', 'ShaderNodeTexWhiteNoise',
                       'ShaderNodeTexIES', 'ShaderNodeTexPointDensity'}


@dataclass
class Needs:
    """What a tree reads of the mesh (attribute names) and of the instance ((type, name)), and the
    types of its nodes."""
    attributes: Set[str] = field(default_factory=set)
    instance_attributes: Set[tuple] = field(default_factory=set)
    node_types: Set[str] = field(default_factory=set)


def read(context, node, known, needs, report):
    """Settings of `node` that have to be read in a way of their own, as a new dict.

    known: NodeType. needs: Needs, added to. report: called with a sentence about the node.
    """
    settings = {}
    if 'texture_mapping' in known.settings and hasattr(node, 'texture_mapping'):
        mapping = texture_mapping(node.texture_mapping)
        if mapping is not None:
            settings['texture_mapping'] = mapping
    if node.bl_idname.startswith('ShaderNodeTex') and node.bl_idname not in _WITHOUT_COORDINATE:
        needs.attributes.add(GENERATED)
    reader = _conductor if node.type == 'GROUP' else _READERS.get(node.bl_idname)
    if reader is not None:
        settings.update(reader(context, node, needs, report))
    return settings


def _conductor(context, node, _needs, _report):
    return {'distribution': context.metal_distribution(node.node_tree)}


# Images ------------------------------------------------------------------------------------------

def _image(context, node, needs, _report):
    if node.bl_idname == 'ShaderNodeTexImage':
        needs.attributes.update((ACTIVE_UV, GENERATED))
    if node.image is None:
        return {}
    return {'image': export_image(context, node.image, node.image_user)}


def texture_mapping(mapping):
    """12 floats of a texture node's own mapping, or None where it changes nothing."""
    rows = matrix_rows(_mapping_matrix(mapping))
    identity = matrix_rows(Matrix.Identity(4))
    if all(abs(a - b) < 1e-7 for a, b in zip(rows, identity)):
        return None
    return rows


def _mapping_matrix(mapping):
    axes = Matrix(((0.0,) * 4,) * 4)
    axes[3][3] = 1.0
    for row, name in enumerate((mapping.mapping_x, mapping.mapping_y, mapping.mapping_z)):
        if name != 'NONE':
            axes[row]['XYZ'.index(name)] = 1.0
    scale = mapping.scale.copy()
    if mapping.vector_type in {'TEXTURE', 'NORMAL'}:
        # These divide by the scale.
        for i in range(3):
            if abs(scale[i]) < 1e-5:
                scale[i] = -1e-5 if scale[i] < 0.0 else 1e-5
    stretch = Matrix.Diagonal((*scale, 1.0))
    turn = mapping.rotation.to_matrix().to_4x4()
    shift = Matrix.Translation(mapping.translation)
    if mapping.vector_type == 'TEXTURE':
        matrix = (shift @ turn @ stretch).inverted()
    elif mapping.vector_type == 'POINT':
        matrix = shift @ turn @ stretch
    elif mapping.vector_type == 'VECTOR':
        matrix = turn @ stretch
    else:
        matrix = turn @ stretch.inverted()
    return matrix @ axes


def _ies(_context, node, _needs, report):
    """The text itself; an empty one is what Blender shows a bright spot for."""
    if node.mode == 'INTERNAL':
        return {'text': node.ies.as_string() if node.ies else ''}
    path = bpy.path.abspath(node.filepath, library=node.id_data.library)
    try:
        with open(path, encoding='latin-1') as file:
            return {'text': file.read()}
    except OSError as error:
        report(f"The IES file cannot be read: {error.strerror}", file=path)
        return {}


def aov_name(node):
    """Of the pass that an AOV Output writes; Blender 3.4 keeps it in place of the node's name."""
    return getattr(node, 'aov_name', node.name)


def _aov_output(_context, node, _needs, _report):
    return {'aov_name': aov_name(node)}


def _sky(_context, node, _needs, _report):
    return {'sun_direction': tuple(node.sun_direction)}


# Tables ------------------------------------------------------------------------------------------

def _color_ramp(_context, node, _needs, _report):
    ramp = node.color_ramp
    table = [value for i in range(_TABLE_SIZE) for value in ramp.evaluate(i / (_TABLE_SIZE - 1))]
    return {'color_ramp': table, 'interpolation': ramp.interpolation}


def _color_curves(_context, node, _needs, _report):
    mapping, (low, high) = _prepared(node.mapping, 4)
    red, green, blue, combined = mapping.curves
    table = []
    for x in _table_positions(low, high):
        x = mapping.evaluate(combined, x)
        table += [mapping.evaluate(curve, x) for curve in (red, green, blue)]
    return _curve_settings(mapping, table, low, high)


def _vector_curves(_context, node, _needs, _report):
    mapping, (low, high) = _prepared(node.mapping, 3)
    table = [mapping.evaluate(curve, x) for x in _table_positions(low, high)
             for curve in mapping.curves[:3]]
    return _curve_settings(mapping, table, low, high)


def _float_curve(_context, node, _needs, _report):
    mapping, (low, high) = _prepared(node.mapping, 1)
    table = [mapping.evaluate(mapping.curves[0], x) for x in _table_positions(low, high)]
    return _curve_settings(mapping, table, low, high)


def _prepared(mapping, count):
    mapping.initialize()
    positions = [point.location[0] for curve in mapping.curves[:count] for point in curve.points]
    return mapping, (min(positions), max(positions))


def _table_positions(low, high):
    return (low + (high - low) * i / (_TABLE_SIZE - 1) for i in range(_TABLE_SIZE))


def _curve_settings(mapping, table, low, high):
    return {'mapping': table, 'min_x': low, 'max_x': high,
            'extrapolate': mapping.extend == 'EXTRAPOLATED'}


# Coordinates and attributes ----------------------------------------------------------------------

def _texture_coordinate(context, node, needs, _report):
    needs.attributes.update((ACTIVE_UV, GENERATED))
    if node.object is None:
        return {}
    world = node.object.evaluated_get(context.depsgraph).matrix_world
    return {'object_transform': matrix_rows(world.inverted_safe())}


def _geometry(_context, node, needs, _report):
    if node.outputs['Random Per Island'].is_linked:
        needs.attributes.add(ISLAND)
    if node.outputs['Pointiness'].is_linked:
        needs.attributes.add(POINTINESS)
    return {}


def _particle_info(_context, _node, needs, _report):
    needs.instance_attributes.update(
        ('PARTICLE', name) for name in ('numbers', 'location', 'velocity', 'angular_velocity'))
    return {}


def _uv_map(_context, node, needs, _report):
    needs.attributes.add(node.uv_map)
    return {'uv_map': node.uv_map}


def _tangent(_context, node, needs, _report):
    needs.attributes.update((node.uv_map, GENERATED))
    return {'uv_map': node.uv_map}


def _color_attribute(_context, node, needs, _report):
    name = node.layer_name or ACTIVE_COLOR
    needs.attributes.add(name)
    return {'layer_name': name}


def _attribute(_context, node, needs, _report):
    name = node.attribute_name
    prefix = INSTANCE_ATTRIBUTE_PREFIXES.get(node.attribute_type)
    if name in _MIRROR_ATTRIBUTES:
        return {'attribute_name': name}
    if prefix is not None:
        needs.instance_attributes.add((node.attribute_type, name))
        return {'attribute_name': prefix + name}
    if name:
        needs.attributes.add(name)
    return {'attribute_name': name}


def _principled_volume(context, node, needs, _report):
    """Names of grids only where there are any: without them most volumes are the same all over."""
    if not has_grids(context):
        return {}
    settings = {}
    for kind in ('Density', 'Color', 'Temperature'):
        if name := node.inputs[f'{kind} Attribute'].default_value:
            needs.attributes.add(name)
            settings[f'{kind.lower()}_attribute'] = name
    return settings


def _volume_info(_context, _node, needs, _report):
    needs.attributes.update(('color', 'density', 'flame', 'temperature'))
    return {}


def _point_density(context, node, _needs, report):
    exported = export_point_density(context, node)
    if exported is None:
        report("There are no points to show the density of")
        return {}
    return dict(zip(('grid', 'to_grid'), exported))


_READERS = {
    'ShaderNodeTexImage': _image,
    'ShaderNodeTexEnvironment': _image,
    'ShaderNodeTexSky': _sky,
    'ShaderNodeTexIES': _ies,
    'ShaderNodeOutputAOV': _aov_output,
    'ShaderNodeParticleInfo': _particle_info,
    'ShaderNodeValToRGB': _color_ramp,
    'ShaderNodeRGBCurve': _color_curves,
    'ShaderNodeVectorCurve': _vector_curves,
    'ShaderNodeFloatCurve': _float_curve,
    'ShaderNodeTexCoord': _texture_coordinate,
    'ShaderNodeNewGeometry': _geometry,
    'ShaderNodeUVMap': _uv_map,
    'ShaderNodeNormalMap': _uv_map,
    'ShaderNodeTangent': _tangent,
    'ShaderNodeVertexColor': _color_attribute,
    'ShaderNodeAttribute': _attribute,
    'ShaderNodeVolumePrincipled': _principled_volume,
    'ShaderNodeVolumeInfo': _volume_info,
    'ShaderNodeTexPointDensity': _point_density,
}
