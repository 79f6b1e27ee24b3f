# SPDX-License-Identifier: GPL-3.0-or-later
"""Material properties: surface, volume, look behind the mirror, settings."""

from bpy.types import Panel

from .base import (
    PropertiesPanel,
    draw_node_input,
    property_column,
    register_classes,
    unregister_classes,
)


class MaterialPanel(PropertiesPanel):
    bl_context = 'material'

    @classmethod
    def poll(cls, context):
        material = context.material
        return (material is not None and not material.is_grease_pencil
                and context.engine in cls.COMPAT_ENGINES)


class TENNIEL_MATERIAL_PT_surface(MaterialPanel, Panel):
    bl_label = "Surface"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        material = context.material
        if not draw_node_input(layout, material, 'Surface'):
            column = layout.column()
            column.prop(material, 'diffuse_color', text="Base Color")
            column.prop(material, 'metallic')
            column.prop(material, 'roughness')


class TENNIEL_MATERIAL_PT_volume(MaterialPanel, Panel):
    bl_label = "Volume"
    bl_options = {'DEFAULT_CLOSED'}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.material.use_nodes

    def draw(self, context):
        self.layout.use_property_split = True
        draw_node_input(self.layout, context.material, 'Volume')


class TENNIEL_MATERIAL_PT_magic_mirror(MaterialPanel, Panel):
    bl_label = "Magic Mirror"
    bl_options = {'DEFAULT_CLOSED'}

    def draw(self, context):
        column = property_column(self.layout)
        column.prop(context.material.tenniel, 'behind_material')


class TENNIEL_MATERIAL_PT_settings(MaterialPanel, Panel):
    bl_label = "Settings"
    bl_options = {'DEFAULT_CLOSED'}

    def draw(self, context):
        property_column(self.layout).prop(context.material, 'pass_index')


_CLASSES = (
    TENNIEL_MATERIAL_PT_surface,
    TENNIEL_MATERIAL_PT_volume,
    TENNIEL_MATERIAL_PT_magic_mirror,
    TENNIEL_MATERIAL_PT_settings,
)


def register():
    register_classes(_CLASSES)


def unregister():
    unregister_classes(_CLASSES)
