# SPDX-License-Identifier: GPL-3.0-or-later
"""Every name that differs between versions of Blender, in one place.

The core speaks the names of Blender 3.4. What a later version moved or renamed is found here by
looking, not by version numbers, so that a build between two versions works as well.
"""

# What is asked for -> where versions keep it, the first that exists wins: (property group of the
# data-block or '', RNA name). `use_shadow` of a lamp is EEVEE's own as long as Cycles has its.
_PLACES = {
    'displacement_method': (('cycles', 'displacement_method'), ('', 'displacement_method')),
    'use_transparent_shadow': (('cycles', 'use_transparent_shadow'),
                               ('', 'use_transparent_shadow')),
    'sample_as_light': (('cycles', 'sample_as_light'), ('cycles', 'emission_sampling')),
    'volume_interpolation': (('cycles', 'volume_interpolation'),),
    'volume_step_rate': (('cycles', 'volume_step_rate'),),
    'volume_step_size': (('cycles', 'volume_step_size'),),
    'cast_shadow': (('cycles', 'cast_shadow'), ('', 'use_shadow')),
    'use_mis': (('cycles', 'use_multiple_importance_sampling'),),
    'is_portal': (('cycles', 'is_portal'),),
    'max_bounces': (('cycles', 'max_bounces'),),
    'sampling_method': (('cycles', 'sampling_method'),),
    'sample_map_resolution': (('cycles', 'sample_map_resolution'),),
    'panorama_type': (('cycles', 'panorama_type'), ('', 'panorama_type')),
    'longitude_min': (('cycles', 'longitude_min'), ('', 'longitude_min')),
    'longitude_max': (('cycles', 'longitude_max'), ('', 'longitude_max')),
    'latitude_min': (('cycles', 'latitude_min'), ('', 'latitude_min')),
    'latitude_max': (('cycles', 'latitude_max'), ('', 'latitude_max')),
    'curves_shape': (('cycles_curves', 'shape'),),
    'curves_subdivisions': (('cycles_curves', 'subdivisions'),),
    'texture_limit': (('cycles', 'texture_limit'),),
    'texture_limit_render': (('cycles', 'texture_limit_render'),),
}



def lookup(block, name, default):
    """Value of `name` (a key of _PLACES) for a data-block, or `default` where nothing has it.

    The Cycles add-on may be off, and then its groups do not exist.
    """
    for group, attribute in _PLACES[name]:
        owner = getattr(block, group, None) if group else block
        value = getattr(owner, attribute, None)
        if value is not None:
            return value
    return default


def sample_as_light(material):
    """Whether emission of this material is to be sampled like a lamp."""
    value = lookup(material, 'sample_as_light', True)
    return value != 'NONE' and bool(value)


def uses_nodes(block):
    """Whether the shader tree of a material, World or lamp is in force.

    Blender 5 keeps `use_nodes` always on.
    """
    return block.node_tree is not None and getattr(block, 'use_nodes', True)


def read_uv(layer, buffer):
    """Fills a FloatBuffer of 2 floats a corner from a UV layer."""
    if hasattr(layer, 'uv'):
        layer.uv.foreach_get('vector', buffer)
    else:
        layer.data.foreach_get('uv', buffer)


def read_corner_normals(mesh, buffer):
    """Fills a FloatBuffer of 3 floats a corner."""
    if hasattr(mesh, 'corner_normals'):
        mesh.corner_normals.foreach_get('vector', buffer)
        return
    mesh.calc_normals_split()
    mesh.loops.foreach_get('normal', buffer)
    mesh.free_normals_split()


def needs_corner_normals(mesh):
    """Whether normals at a vertex may differ between its faces beyond the smooth flags."""
    if hasattr(mesh, 'use_auto_smooth'):
        # Without it Blender 3.4 ignores custom normals as well.
        return mesh.use_auto_smooth
    return mesh.normals_domain == 'CORNER'


def render_color_name(mesh):
    """Name of the colour attribute that is active for rendering, or None."""
    index = mesh.color_attributes.render_color_index
    if 0 <= index < len(mesh.color_attributes):
        return mesh.color_attributes[index].name
    return None
