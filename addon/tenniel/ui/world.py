# SPDX-License-Identifier: GPL-3.0-or-later
"""World properties: surface, volume, ray visibility."""

from bpy.types import Panel

from .base import (
    PropertiesPanel,
    draw_node_input,
    property_column,
    register_classes,
    unregister_classes,
)

_RAY_KINDS = ('camera', 'diffuse', 'glossy', 'transmission', 'scatter')


class WorldPanel(PropertiesPanel):
    bl_context = 'world'

    @classmethod
    def poll(cls, context):
        return context.world is not None and context.engine in cls.COMPAT_ENGINES


class TENNIEL_WORLD_PT_surface(WorldPanel, Panel):
    bl_label = "Surface"

    def draw(self, context):
        self.layout.use_property_split = True
        if not draw_node_input(self.layout, context.world, 'Surface'):
            self.layout.prop(context.world, 'color')


class TENNIEL_WORLD_PT_volume(WorldPanel, Panel):
    bl_label = "Volume"
    bl_options = {'DEFAULT_CLOSED'}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.world.use_nodes

    def draw(self, context):
        self.layout.use_property_split = True
        draw_node_input(self.layout, context.world, 'Volume')


class TENNIEL_WORLD_PT_ray_visibility(WorldPanel, Panel):
    bl_label = "Ray Visibility"
    bl_options = {'DEFAULT_CLOSED'}

    @classmethod
    def poll(cls, context):
        # Blender has no such flags on worlds; they belong to Cycles and may be absent.
        return (super().poll(context)
                and getattr(context.world, 'cycles_visibility', None) is not None)

    def draw(self, context):
        column = property_column(self.layout).column(align=True)
        for name in _RAY_KINDS:
            column.prop(context.world.cycles_visibility, name)


_CLASSES = (
    TENNIEL_WORLD_PT_surface,
    TENNIEL_WORLD_PT_volume,
    TENNIEL_WORLD_PT_ray_visibility,
)


def register():
    register_classes(_CLASSES)


def unregister():
    unregister_classes(_CLASSES)
