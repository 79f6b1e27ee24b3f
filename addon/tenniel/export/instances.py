# SPDX-License-Identifier: GPL-3.0-or-later
"""Walks all objects of the evaluated scene, instances included, and describes each.

Objects of other kinds than mesh that have a surface (text, curves, metaballs) come from the
depsgraph as instances of their evaluated mesh, so beside meshes there are only hair, points and
volumes.
"""

from typing import Any, NamedTuple

import bpy

from .. import mirror_tags
from . import material as materials
from .context import CAMERA_BIT, GENERATED, Cancelled, matrix_rows, ray_kinds, world_bits
from .grids import export_smoke, gas_domain, has_smoke
from .hair import export_curves, export_hair_system, export_points, hair_systems
from .light import export_light
from .mesh import NO_MESH, export_mesh
from .node_readers import CONDUCTOR, INSTANCE_ATTRIBUTE_PREFIXES
from .settings import hash_string, hash_uint2
from .volume import export_volume

_UINT_MAX = 0xffffffff

# Data-blocks of hair, points and volumes; versions before 3.4 may lack the first two.
_OTHER_GEOMETRY = tuple(getattr(bpy.types, name) for name in ('Curves', 'PointCloud', 'Volume')
                        if hasattr(bpy.types, name))

# Nodes with lobes that a path may enter a dream by.
_REFLECTING = frozenset({'ShaderNodeBsdfGlossy', 'ShaderNodeBsdfAnisotropic', 'ShaderNodeBsdfGlass',
                         'ShaderNodeBsdfPrincipled', CONDUCTOR})
_TRANSMITTING = frozenset({'ShaderNodeBsdfGlass', 'ShaderNodeBsdfRefraction',
                           'ShaderNodeBsdfTransparent', 'ShaderNodeBsdfPrincipled'})
_ENTERING = {'REFLECTION': _REFLECTING, 'TRANSMISSION': _TRANSMITTING,
             'BOTH': _REFLECTING | _TRANSMITTING}
_ENTRY_WORDS = {'REFLECTION': "reflects", 'TRANSMISSION': "lets light through",
                'BOTH': "reflects or lets light through"}

# `break` asked for this often costs less than a percent of the walk.
_OBJECTS_PER_BREAK_TEST = 64

# A dream may hold hundreds of objects: these many are named one by one.
_MAX_UNSEEN_ROWS = 8


class _Template(NamedTuple):
    """What all instances of a part of one object by one instancer share.

    A part is a mesh or the hair on it. attributes: (type, name) to read.
    """
    desc: Any
    attributes: tuple


def export_instances(context):
    """Adds meshes and lamps as the depsgraph shows them; reports what cannot be."""
    walker = _Walker(context)
    for number, instance in enumerate(context.depsgraph.object_instances):
        if number % _OBJECTS_PER_BREAK_TEST == 0:
            context.check_break()
        if instance.show_self or instance.show_particles:
            walker.visit(instance)
    _report_unseen(context)


def _report_unseen(context):
    """A row for each of the first objects that no glass shows, one for all the others."""
    if context.has_looking_glass:
        return
    names = sorted(context.behind_objects)
    for name in names[:_MAX_UNSEEN_ROWS]:
        context.report('WARNING', "Exists only behind the mirror, but the scene has no "
                       "looking glass: it will not be seen", object=name)
    if len(names) > _MAX_UNSEEN_ROWS:
        context.report('WARNING', f"{len(names) - _MAX_UNSEEN_ROWS} more objects exist only behind "
                       "the mirror, and no looking glass shows them")


class _Walker:

    def __init__(self, context):
        self._context = context
        self._templates = {}
        self._hair_meshes = {}    # (object name_full, particle system) -> mesh
        self._tags = {}           # object name_full -> MirrorTags
        self._reported = set()

    def visit(self, instance):
        """Describes one entry of the depsgraph; an exception costs this entry only."""
        obj = instance.object
        try:
            if isinstance(obj.data, bpy.types.Mesh):
                self._visit_geometry(instance, obj)
            elif not instance.show_self:
                pass
            elif obj.type == 'LIGHT':
                self._visit_light(instance, obj)
            elif isinstance(obj.data, _OTHER_GEOMETRY):
                self._visit_geometry(instance, obj)
        except (Cancelled, KeyboardInterrupt):
            raise
        except Exception:
            self._context.report_exception(object=obj.name)

    # Lamps ---------------------------------------------------------------------------------------

    def _visit_light(self, instance, obj):
        visibility = self._visibility(instance, obj)
        if visibility[0]:
            export_light(self._context, obj.data, obj.name, instance.matrix_world, visibility,
                         _random(instance, obj))

    # Meshes, hair and points ---------------------------------------------------------------------

    def _visit_geometry(self, instance, obj):
        parent = instance.parent if instance.is_instance else None
        key = (obj.name_full, obj.data.as_pointer(), parent and parent.name_full,
               instance.show_self, instance.show_particles)
        templates = self._templates.get(key)
        if templates is None:
            # Kept also where it fails, so that each of a thousand instances does not fail again.
            self._templates[key] = ()
            templates = self._templates[key] = tuple(self._prepare(instance, obj))
        for template in templates:
            self._add(instance, obj, template)

    def _add(self, instance, obj, template):
        desc = template.desc
        desc.object_to_world = matrix_rows(instance.matrix_world)
        desc.random = _random(instance, obj)
        if self._context.motion is not None:
            desc.motion = self._context.motion.of_instance(instance)
        if instance.is_instance:
            # Cycles hands these coordinates to shaders halved and shifted.
            desc.generated = tuple(0.5 * x - 0.5 for x in instance.orco)
            desc.instancer_uv = tuple(instance.uv)
        if template.attributes:
            desc.attributes = self._instance_attributes(instance, obj, template.attributes)
        self._context.description.add_instance(desc)

    def _prepare(self, instance, obj):
        """_Template of each part of an object."""
        context = self._context
        worlds, kinds = self._visibility(instance, obj)
        if not worlds or not kinds:
            return
        tags = self._tags_of(instance, obj)
        front, behind = self._materials(obj, tags)
        if isinstance(obj.data, bpy.types.Mesh):
            if instance.show_self and context.view_layer.use_solid:
                mesh = self._mesh(obj, tags, front, behind)
                if mesh != NO_MESH:
                    yield self._template(instance, obj, mesh, front, behind)
            if instance.show_particles and context.view_layer.use_strand:
                yield from self._hair(instance, obj, front, behind)
            self._report_limits(obj)
            return
        names = _attribute_names(front, behind)
        if isinstance(obj.data, bpy.types.Volume):
            yield from self._volume(instance, obj, front[:1], behind[:1], names)
            return
        if isinstance(obj.data, bpy.types.PointCloud):
            mesh = export_points(context, obj.data, names)
        else:
            has_hair = context.view_layer.use_strand
            mesh = export_curves(context, obj.data, names) if has_hair else NO_MESH
        if mesh != NO_MESH:
            yield self._template(instance, obj, mesh, front[:1], behind[:1])

    def _mesh(self, obj, tags, front, behind):
        """Index of the mesh of an object, or NO_MESH."""
        domain = gas_domain(obj)
        if domain is not None and not has_smoke(self._context, domain):
            # Its box filled with the same density all over would hide what lies in it.
            self._report_once(obj.name, "The simulation of this smoke or fire has nothing at this "
                              "frame: bake it, or play it from its first frame")
            return NO_MESH
        names = _attribute_names(front, behind)
        original = self._original_mesh(obj)
        if original is None:
            names -= {GENERATED}
        mesh = export_mesh(self._context, obj.data, original, names, len(front) > 1)
        if mesh == NO_MESH and tags.looking_glass:
            self._report_once(obj.name, "A looking glass without faces shows nothing")
        return mesh

    def _hair(self, instance, obj, front, behind):
        """_Template of each particle system that grows hair."""
        owner = instance.instance_object if instance.is_instance else obj
        if owner is None or owner.data != obj.data:
            return
        count = 0
        for hair in hair_systems(self._context, owner):
            slot = min(max(hair.slot, 0), len(front) - 1)
            used = front[slot:slot + 1], behind[slot:slot + 1]
            mesh = self._hair_meshes.get((owner.name_full, hair.system.name))
            if mesh is None:
                mesh = export_hair_system(self._context, hair, count, _attribute_names(*used))
                self._hair_meshes[owner.name_full, hair.system.name] = mesh
            count += hair.count
            yield self._template(instance, obj, mesh, *used)

    def _volume(self, instance, obj, front, behind, names):
        """_Template of a volume object, if anything of it is to be seen."""
        if not self._context.view_layer.use_volumes:
            return
        volume = export_volume(self._context, obj, names,
                               lambda text: self._report_once(obj.name, text))
        if volume.mesh == NO_MESH:
            return
        template = self._template(instance, obj, volume.mesh, front, behind)
        template.desc.grids = volume.grids
        template.desc.has_scaled_density = obj.data.render.space == 'OBJECT'
        yield template

    def _template(self, instance, obj, mesh, front, behind):
        context = self._context
        worlds, kinds = self._visibility(instance, obj)
        desc = context.core.InstanceDesc()
        desc.name = obj.name
        desc.mesh = mesh
        desc.worlds, desc.ray_kinds = worlds, kinds
        desc.materials = [item.index for item in front]
        if behind != front:
            desc.behind_materials = [item.index for item in behind]
        domain = gas_domain(obj)
        if domain is not None:
            desc.grids = export_smoke(context, domain, _attribute_names(front, behind))
        desc.color = tuple(obj.color)
        desc.pass_index = obj.pass_index
        desc.is_holdout = self._layer_flag(instance, obj, 'holdout_get')
        desc.terminator_cutoff = _terminator_cutoff(obj)
        self._set_looking_glass(desc, obj, self._tags_of(instance, obj), front)
        attributes = frozenset().union(*(m.instance_attributes for m in (*front, *behind)))
        return _Template(desc, tuple(sorted(attributes)))

    def _original_mesh(self, obj):
        """The mesh before modifiers, or None where it is what is rendered."""
        mesh = getattr(obj.original, 'data', None)
        if isinstance(mesh, bpy.types.Mesh) and len(obj.modifiers) + _has_shape_keys(mesh):
            return mesh
        return None

    def _set_looking_glass(self, desc, obj, tags, materials_used):
        context = self._context
        if tags.side == 'BEHIND':
            context.behind_objects.append(obj.name)
        if not tags.looking_glass or context.mirror_view == 'THIS_SIDE':
            return
        context.has_looking_glass = True
        lobes = frozenset().union(*(item.node_types for item in materials_used))
        if not lobes & _ENTERING[tags.entry]:
            self._report_once(obj.name, "No material of this looking glass "
                              f"{_ENTRY_WORDS[tags.entry]}: it shows no dream")
        desc.dream = context.dream_index(tags.dream, obj.name)
        desc.entry = tags.entry
        desc.reentry = tags.reenter
        desc.first_seen_only = tags.first_seen_only

    def _materials(self, obj, tags):
        """ExportedMaterial of each slot: on this side, and in the dreams."""
        context = self._context
        override = context.view_layer.material_override
        slots = [override or slot.material for slot in obj.material_slots] or [override]
        is_volume = isinstance(obj.data, bpy.types.Volume)
        export = materials.export_volume_material if is_volume else materials.export_material
        front = [export(context, item) for item in slots]
        if tags.behind_material is not None:
            behind = [tags.behind_material] * len(slots)
        else:
            behind = [materials.behind_material(item) for item in slots]
        return front, [export(context, item) for item in behind]

    # What holds for an object and its instancer --------------------------------------------------

    def _tags_of(self, instance, obj):
        tags = self._own_tags(obj)
        if instance.is_instance and instance.parent is not None:
            tags = mirror_tags.with_instancer(tags, self._own_tags(instance.parent))
        return tags

    def _own_tags(self, obj):
        tags = self._tags.get(obj.name_full)
        if tags is None:
            tags = self._tags[obj.name_full] = mirror_tags.effective_tags(obj)
        return tags

    def _visibility(self, instance, obj):
        """(worlds, ray_kinds) bits; an instancer hides what it makes."""
        kinds = ray_kinds(obj)
        if instance.is_instance and instance.parent is not None:
            kinds &= ray_kinds(instance.parent)
        if self._layer_flag(instance, obj, 'indirect_only_get'):
            kinds &= ~CAMERA_BIT
        return world_bits(self._tags_of(instance, obj)), kinds

    def _layer_flag(self, instance, obj, getter):
        """A flag that collections of the view layer may set."""
        owner = instance.parent if instance.is_instance and instance.parent else obj
        return bool(getattr(owner, getter)(view_layer=self._context.view_layer))

    # Attributes from outside the mesh ------------------------------------------------------------

    def _instance_attributes(self, instance, obj, wanted):
        context = self._context
        values = {}
        particle = _particle_values(context, instance) if any(
            kind == 'PARTICLE' for kind, _ in wanted) else {}
        for kind, name in wanted:
            if kind == 'PARTICLE':
                if name in particle:
                    values[INSTANCE_ATTRIBUTE_PREFIXES[kind] + name] = particle[name]
                continue
            if kind == 'VIEW_LAYER':
                owners = [context.view_layer, context.scene, context.scene.world]
            else:
                owners = [obj, obj.data]
                if kind == 'INSTANCER' and instance.is_instance:
                    particles = instance.particle_system
                    owners = [particles and particles.settings, instance.parent, *owners]
            value = _find_value(owners, name)
            if value is not None:
                values[INSTANCE_ATTRIBUTE_PREFIXES[kind] + name] = value
        return values

    # Reports -------------------------------------------------------------------------------------

    def _report_limits(self, obj):
        if obj.is_shadow_catcher:
            self._report_once(obj.name, "Shadow catchers are not supported, it is rendered as an "
                              "ordinary object")

    def _report_once(self, name, text):
        if (name, text) not in self._reported:
            self._reported.add((name, text))
            self._context.report('WARNING', text, object=name)


def _attribute_names(front, behind):
    """Attributes of the geometry that ExportedMaterials ask for."""
    return frozenset().union(*(item.attributes for item in (*front, *behind)))


def _terminator_cutoff(obj):
    """Cosine below which shadow rays leave the smooth surface; Cycles' default without Cycles."""
    cycles = getattr(obj, 'cycles', None)
    return 0.1 if cycles is None else cycles.shadow_terminator_geometry_offset


def _has_shape_keys(mesh):
    return mesh.shape_keys is not None


def _random(instance, obj):
    """Number of the Object Info node, in [0, 1], as Cycles makes it."""
    if instance.is_instance:
        number = instance.random_id & _UINT_MAX
    else:
        number = hash_uint2(hash_string(obj.name), 0)
    return number / _UINT_MAX


def _particle_values(context, instance):
    """What the Particle Info node asks of the particle that made this instance, or {}."""
    system = instance.particle_system if instance.is_instance else None
    index = instance.persistent_id[0]
    if system is None or index >= len(system.particles):
        return {}
    particle = system.particles[index]
    age = context.scene.frame_current_final - particle.birth_time
    return {
        'numbers': (float(index), age, particle.lifetime, particle.size),
        'location': (*particle.location, 0.0),
        'velocity': (*particle.velocity, 0.0),
        'angular_velocity': (*particle.angular_velocity, 0.0),
    }


def _find_value(owners, name):
    """The first owner's property `name` as four floats: a custom property, or an RNA path."""
    for owner in owners:
        if owner is None or not name:
            continue
        value = _four_floats(_property(owner, name))
        if value is not None:
            return value
    return None


def _property(owner, name):
    try:
        if name in owner.keys():
            return owner[name]
        return owner.path_resolve(name)
    except (AttributeError, TypeError, ValueError):
        return None


def _four_floats(value):
    if isinstance(value, (bool, int, float)):
        return (float(value),) * 3 + (1.0,)
    try:
        items = tuple(float(item) for item in value)
    except (TypeError, ValueError):
        return None
    return {3: (*items, 1.0), 4: items}.get(len(items))
