# SPDX-License-Identifier: GPL-3.0-or-later
"""View layer properties: the passes Tenniel writes."""

from bpy.types import Panel

from .base import PropertiesPanel, property_column, register_classes, unregister_classes

_PASSES = ('use_pass_combined', 'use_pass_z', 'use_pass_normal')
_MIRROR_PASSES = ('use_pass_mirror_world', 'use_pass_dream')


class TENNIEL_VIEWLAYER_PT_passes(PropertiesPanel, Panel):
    bl_label = "Passes"
    bl_context = 'view_layer'

    def draw(self, context):
        column = property_column(self.layout).column(heading="Include", align=True)
        for name in _PASSES:
            column.prop(context.view_layer, name)
        column.prop(context.view_layer, 'pass_alpha_threshold')
        column = property_column(self.layout).column(heading="Magic Mirror", align=True)
        for name in _MIRROR_PASSES:
            column.prop(context.view_layer.tenniel, name)


_CLASSES = (TENNIEL_VIEWLAYER_PT_passes,)


def register():
    register_classes(_CLASSES)


def unregister():
    unregister_classes(_CLASSES)
