# SPDX-License-Identifier: GPL-3.0-or-later
"""Add > Tenniel in the shader editor, and the operators behind it."""

import bpy
from bpy.props import EnumProperty, StringProperty
from bpy.types import Menu, Operator

from . import groups
from .tables import LIQUIDS, METALS, SOLIDS

_DISTRIBUTIONS = (
    ('GGX', "GGX", "Facets with a long tail: a bright core and a wide glow"),
    ('BECKMANN', "Beckmann", "Facets that scatter normally: a rounder highlight"),
    ('SHARP', "Sharp", "A perfect mirror"),
)


def add_metal(tree, name, distribution='GGX'):
    """Adds metal `name` of the table to a shader tree; returns the group node."""
    eta, k = METALS[name]
    return _add_group(tree, groups.metal_group(distribution), name, (eta, k))


def add_medium(tree, name):
    """Adds the medium `name` of the tables to a shader tree; returns the group node."""
    return _add_group(tree, groups.medium_group(), name, {**LIQUIDS, **SOLIDS}[name])


def _add_group(tree, group, name, values):
    node = tree.nodes.new('ShaderNodeGroup')
    node.node_tree = group
    node.label = name
    for socket, value in zip(node.inputs, values):
        socket.default_value = value
    return node


class _AddOperator:
    bl_options = {'REGISTER', 'UNDO'}

    preset: StringProperty(name="Name", options={'SKIP_SAVE'})

    @classmethod
    def poll(cls, context):
        space = context.space_data
        if getattr(space, 'type', '') != 'NODE_EDITOR' or space.tree_type != 'ShaderNodeTree':
            cls.poll_message_set("This belongs into the shader editor")
            return False
        if space.edit_tree is None:
            cls.poll_message_set("There is no node tree to add to")
            return False
        return True

    def invoke(self, context, event):
        space = context.space_data
        space.cursor_location_from_region(event.mouse_region_x, event.mouse_region_y)
        result = self.execute(context)
        if 'FINISHED' in result:
            # The new node hangs on the mouse, as those of Blender's own menu do.
            bpy.ops.node.translate_attach_remove_placed('INVOKE_DEFAULT')
        return result

    def execute(self, context):
        tree = context.space_data.edit_tree
        try:
            node = self.add(tree)
        except KeyError:
            self.report({'ERROR'}, f"There is no preset '{self.preset}'")
            return {'CANCELLED'}
        for other in tree.nodes:
            other.select = other == node
        tree.nodes.active = node
        node.location = context.space_data.cursor_location
        return {'FINISHED'}


class TENNIEL_OT_add_metal(_AddOperator, Operator):
    """Add a metal by its measured refractive index"""
    bl_idname = 'tenniel.add_metal'
    bl_label = "Add Metal"

    distribution: EnumProperty(name="Distribution", items=_DISTRIBUTIONS, default='GGX')

    def add(self, tree):
        return add_metal(tree, self.preset, self.distribution)


class TENNIEL_OT_add_medium(_AddOperator, Operator):
    """Add a measured medium; link it to the Volume of the material output"""
    bl_idname = 'tenniel.add_medium'
    bl_label = "Add Medium"

    def add(self, tree):
        return add_medium(tree, self.preset)


class _PresetMenu:
    operator = ''
    table = {}

    def draw(self, _context):
        for name in self.table:
            self.layout.operator(self.operator, text=name).preset = name


class TENNIEL_MT_metals(_PresetMenu, Menu):
    bl_label = "Metal"
    operator, table = 'tenniel.add_metal', METALS


class TENNIEL_MT_liquids(_PresetMenu, Menu):
    bl_label = "Liquid"
    operator, table = 'tenniel.add_medium', LIQUIDS


class TENNIEL_MT_solids(_PresetMenu, Menu):
    bl_label = "Translucent Material"
    operator, table = 'tenniel.add_medium', SOLIDS


class TENNIEL_MT_presets(Menu):
    bl_label = "Tenniel"

    def draw(self, _context):
        self.layout.menu('TENNIEL_MT_metals')
        self.layout.menu('TENNIEL_MT_liquids')
        self.layout.menu('TENNIEL_MT_solids')


def _draw_add_menu(self, context):
    if context.engine == 'TENNIEL' and context.space_data.tree_type == 'ShaderNodeTree':
        self.layout.separator()
        self.layout.menu('TENNIEL_MT_presets')


_CLASSES = (
    TENNIEL_OT_add_metal,
    TENNIEL_OT_add_medium,
    TENNIEL_MT_metals,
    TENNIEL_MT_liquids,
    TENNIEL_MT_solids,
    TENNIEL_MT_presets,
)


def register():
    for cls in _CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.NODE_MT_add.append(_draw_add_menu)


def unregister():
    bpy.types.NODE_MT_add.remove(_draw_add_menu)
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
