# SPDX-License-Identifier: GPL-3.0-or-later
"""Hair and points -> MeshDesc: particle hair, hair Curves, point clouds.

Particle hair can only be asked for point by point, at about a microsecond each: what makes up most
of the time that the export of a furry scene takes. Curves and point clouds are copied whole.
"""

from array import array
from itertools import chain
from typing import Any, NamedTuple

from mathutils import Vector

from . import compat
from .context import ACTIVE_UV, GENERATED, filled, matrix_rows
from .mesh import NO_MESH, read_attribute

# Blender's radius of a point that has none.
_DEFAULT_RADIUS = 0.005
_DEFAULT_POINT_RADIUS = 0.01

_SHAPES = {'RIBBONS': 'RIBBONS', 'THICK': 'TUBES'}
_MOST_PIECES = 16

# `break` is asked for between this many hairs.
_HAIRS_PER_BREAK_TEST = 1000


class HairSystem(NamedTuple):
    """A particle system of an object that is drawn as hair.

    owner: the evaluated object. modifier, system: of that object. first: number of its first
    particle to be drawn, the parents' come before the children's. count: of hairs. keys: of each.
    """
    owner: Any
    modifier: Any
    system: Any
    first: int
    count: int
    keys: int

    @property
    def slot(self):
        """Material slot, from 0; there may be fewer."""
        return self.system.settings.material - 1


def hair_systems(context, owner):
    """HairSystems of an evaluated object that are to be seen."""
    found = []
    for modifier in owner.modifiers:
        if modifier.type != 'PARTICLE_SYSTEM':
            continue
        is_viewport = context.view.is_viewport
        if not (modifier.show_viewport if is_viewport else modifier.show_render):
            continue
        system = modifier.particle_system
        settings = system.settings
        if settings.type != 'HAIR' or settings.render_type != 'PATH':
            continue
        parents, children = len(system.particles), len(system.child_particles)
        if is_viewport:
            children = children * settings.display_percentage // 100
        has_children = settings.child_type != 'NONE' and children > 0
        count = children + (0 if has_children else parents)
        if count == 0:
            continue
        keys = 2 ** (settings.display_step if is_viewport else settings.render_step) + 1
        if settings.kink == 'SPIRAL':
            keys += settings.kink_extra_steps
        found.append(HairSystem(owner, modifier, system, parents if has_children else 0, count,
                                keys))
    return found


def export_hair_system(context, hair, first_hair, names):
    """Index of the mesh that holds a HairSystem.

    first_hair: how many hairs the object's systems before this one have. names: attributes that
    its material asks for.
    """
    core = context.core
    owner = hair.owner
    points = _points_of(context, hair)
    desc = _new(context, hair.system.name)
    desc.to_object = matrix_rows(owner.matrix_world.inverted_safe())
    desc.positions = filled(core.FloatBuffer(len(points)), points)
    settings = hair.system.settings
    scale = 0.5 * settings.radius_scale
    desc.root_radius, desc.tip_radius = scale * settings.root_radius, scale * settings.tip_radius
    desc.radius_shape, desc.closes_tip = settings.shape, settings.use_close_tip
    sizes = array('i', [hair.keys]) * hair.count
    desc.strand_sizes = filled(core.IntBuffer(len(sizes)), sizes)
    desc.first_strand = first_hair
    desc.texture_space_location = tuple(owner.data.texspace_location)
    desc.texture_space_size = tuple(owner.data.texspace_size)
    desc.attributes = [a for a in (_emitter_attribute(context, hair, name, points)
                                   for name in sorted(names)) if a is not None]
    return context.description.add_mesh(desc)


def export_curves(context, curves, names):
    """Index of the mesh that holds evaluated hair Curves; NO_MESH where there are none."""
    if len(curves.curves) == 0 or len(curves.points) == 0:
        return NO_MESH
    core = context.core
    desc = _new(context, curves.name)
    desc.positions = core.FloatBuffer(3 * len(curves.points))
    curves.position_data.foreach_get('vector', desc.positions)
    desc.radii = _radius_attribute(core, curves, _DEFAULT_RADIUS)
    sizes = array('i', bytes(4 * len(curves.curves)))
    curves.curves.foreach_get('points_length', sizes)
    desc.strand_sizes = filled(core.IntBuffer(len(sizes)), sizes)
    desc.attributes = _curve_attributes(core, curves, names)
    return context.description.add_mesh(desc)


def export_points(context, cloud, names):
    """Index of the mesh that holds an evaluated point cloud; NO_MESH where it is empty."""
    if len(cloud.points) == 0:
        return NO_MESH
    core = context.core
    desc = _new(context, cloud.name)
    desc.shape = 'SPHERES'
    desc.positions = core.FloatBuffer(3 * len(cloud.points))
    cloud.attributes['position'].data.foreach_get('vector', desc.positions)
    desc.radii = _radius_attribute(core, cloud, _DEFAULT_POINT_RADIUS)
    desc.attributes = [a for a in (read_attribute(core, cloud.attributes.get(name), name)
                                   for name in sorted(names) if name) if a is not None]
    return context.description.add_mesh(desc)


def _new(context, name):
    desc = context.core.MeshDesc()
    desc.name = name
    desc.shape = _SHAPES.get(compat.lookup(context.scene, 'curves_shape', 'RIBBONS'), 'RIBBONS')
    pieces = (1 << compat.lookup(context.scene, 'curves_subdivisions', 2)) + 1
    desc.ribbon_pieces = min(pieces, _MOST_PIECES)
    return desc


# Particle hair -----------------------------------------------------------------------------------

def _points_of(context, hair):
    """World-space coordinates of all keys in one array."""
    owner, at = hair.owner, hair.system.co_hair
    steps = range(hair.keys)
    points = array('f')
    for number in range(hair.first, hair.first + hair.count):
        if number % _HAIRS_PER_BREAK_TEST == 0:
            context.check_break()
        found = [at(owner, particle_no=number, step=step) for step in steps]
        if not any(found[-1]):
            _end_where_cut(found)
        points.extend(chain.from_iterable(found))
    return points


def _end_where_cut(points):
    """Gives keys beyond the end of a hair the place of its last: Blender answers zeros for them."""
    last = next((i for i in reversed(range(len(points))) if any(points[i])), None)
    if last is not None:
        points[last + 1:] = [points[last]] * (len(points) - last - 1)


def _emitter_attribute(context, hair, name, points):
    """What the mesh has where a hair grows, as AttributeDesc with a value for each hair; or None.
    """
    mesh = hair.owner.data
    if name == GENERATED:
        return _roots(context, hair, points)
    maps = mesh.uv_layers.keys()
    number = _active_map(mesh) if name == ACTIVE_UV else maps.index(name) if name in maps else -1
    try:
        if number >= 0:
            return _per_hair(context.core, name, 2, hair, hair.system.uv_on_emitter, uv_no=number)
        colors = [a.name for a in mesh.color_attributes
                  if a.domain == 'CORNER' and a.data_type == 'BYTE_COLOR']
        if name not in colors:
            return None
        desc = _per_hair(context.core, name, 3, hair, hair.system.mcol_on_emitter,
                         vcol_no=colors.index(name))
    except RuntimeError:
        # The mesh that the modifier has seen lacks it.
        return None
    values = memoryview(desc.data)
    for i, value in enumerate(values):
        values[i] = _srgb_to_linear(value)
    return desc


def _active_map(mesh):
    return next((i for i, layer in enumerate(mesh.uv_layers) if layer.active_render), -1)


def _per_hair(core, name, channels, hair, ask, **number):
    particles = hair.system.particles
    values = array('f')
    for index in range(hair.first, hair.first + hair.count):
        parent = particles[min(index, len(particles) - 1)]
        values.extend(ask(hair.modifier, particle=parent, particle_no=index, **number))
    return _attribute(core, name, 'FACE', channels, values)


def _roots(context, hair, points):
    to_object = hair.owner.matrix_world.inverted_safe()
    step = 3 * hair.keys
    values = array('f', chain.from_iterable(
        to_object @ Vector(points[i:i + 3]) for i in range(0, len(points), step)))
    return _attribute(context.core, GENERATED, 'FACE', 3, values)


def _srgb_to_linear(value):
    if value < 0.04045:
        return max(value, 0.0) / 12.92
    return ((value + 0.055) / 1.055) ** 2.4


# Curves and points -------------------------------------------------------------------------------

def _radius_attribute(core, data, default):
    attribute = data.attributes.get('radius')
    if attribute is None or attribute.data_type != 'FLOAT' or attribute.domain != 'POINT':
        count = len(data.points)
        return filled(core.FloatBuffer(count), array('f', [default]) * count)
    buffer = core.FloatBuffer(len(data.points))
    attribute.data.foreach_get('value', buffer)
    return buffer


def _curve_attributes(core, curves, names):
    found = []
    for name in sorted(names):
        # The first pair of numbers on the hairs is what UV maps are to meshes.
        attribute = next((a for a in curves.attributes
                          if a.domain == 'CURVE' and a.data_type == 'FLOAT2'), None) \
            if name == ACTIVE_UV else curves.attributes.get(name)
        desc = read_attribute(core, attribute, name)
        if desc is not None:
            found.append(desc)
    return found


def _attribute(core, name, domain, channels, values):
    desc = core.AttributeDesc()
    desc.name, desc.domain, desc.channels = name, domain, channels
    desc.data = filled(core.FloatBuffer(len(values)), values)
    return desc
