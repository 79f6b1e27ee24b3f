# SPDX-License-Identifier: GPL-3.0-or-later
"""Light properties: kind, colour, power, size, beam, nodes."""

from bpy.types import Panel

from .base import (
    PropertiesPanel,
    draw_node_input,
    property_column,
    register_classes,
    unregister_classes,
)


class LightPanel(PropertiesPanel):
    bl_context = 'data'

    @classmethod
    def poll(cls, context):
        return context.light is not None and context.engine in cls.COMPAT_ENGINES


class TENNIEL_LIGHT_PT_light(LightPanel, Panel):
    bl_label = "Light"

    def draw(self, context):
        light = context.light
        self.layout.row().prop(light, 'type', expand=True)
        column = property_column(self.layout)
        column.prop(light, 'color')
        column.prop(light, 'energy', text="Strength" if light.type == 'SUN' else "Power")
        column.separator()
        _draw_size(column, light)
        # Where Cycles keeps the switch, files have it set there and not on the light itself.
        cycles = getattr(light, 'cycles', None)
        if hasattr(cycles, 'cast_shadow'):
            column.prop(cycles, 'cast_shadow')
        else:
            column.prop(light, 'use_shadow', text="Cast Shadow")


def _draw_size(column, light):
    if light.type == 'SUN':
        column.prop(light, 'angle')
    elif light.type == 'AREA':
        column.prop(light, 'shape')
        size = column.column(align=True)
        if light.shape in {'RECTANGLE', 'ELLIPSE'}:
            size.prop(light, 'size', text="Size X")
            size.prop(light, 'size_y', text="Y")
        else:
            size.prop(light, 'size')
    else:
        column.prop(light, 'shadow_soft_size', text="Radius")


class TENNIEL_LIGHT_PT_beam_shape(LightPanel, Panel):
    bl_label = "Beam Shape"
    bl_parent_id = 'TENNIEL_LIGHT_PT_light'

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.light.type in {'SPOT', 'AREA'}

    def draw(self, context):
        light = context.light
        column = property_column(self.layout)
        if light.type == 'SPOT':
            column.prop(light, 'spot_size', text="Spot Size")
            column.prop(light, 'spot_blend', text="Blend", slider=True)
            column.prop(light, 'show_cone')
        else:
            column.prop(light, 'spread')


class TENNIEL_LIGHT_PT_nodes(LightPanel, Panel):
    bl_label = "Nodes"
    bl_options = {'DEFAULT_CLOSED'}

    def draw(self, context):
        self.layout.use_property_split = True
        draw_node_input(self.layout, context.light, 'Surface')


_CLASSES = (
    TENNIEL_LIGHT_PT_light,
    TENNIEL_LIGHT_PT_beam_shape,
    TENNIEL_LIGHT_PT_nodes,
)


def register():
    register_classes(_CLASSES)


def unregister():
    unregister_classes(_CLASSES)
