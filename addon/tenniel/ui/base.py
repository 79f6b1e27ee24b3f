# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panels share."""

import textwrap

import bpy

ENGINE = 'TENNIEL'


class PropertiesPanel:
    """Mix-in of a panel in the Properties editor that is shown while Tenniel is the engine."""
    bl_space_type = 'PROPERTIES'
    bl_region_type = 'WINDOW'
    COMPAT_ENGINES = {ENGINE}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES


def property_column(layout):
    """A column in the two-column style of Blender's own panels."""
    layout.use_property_split = True
    layout.use_property_decorate = False
    return layout.column()


def draw_node_input(layout, owner, input_name):
    """Shows what feeds `input_name` of the output node in force; False if `owner` has no nodes."""
    tree = owner.node_tree if owner.use_nodes else None
    if tree is None:
        layout.prop(owner, 'use_nodes', icon='NODETREE', toggle=True)
        return False
    # Trees made for Cycles may hold an output node of their own for it: that one is rendered.
    output = tree.get_output_node('CYCLES')
    socket = output.inputs.get(input_name) if output else None
    if socket is None:
        layout.label(text="The node tree has no output node", icon='INFO')
    else:
        layout.template_node_view(tree, output, socket)
    return True


def draw_wrapped(layout, text, region_width, icon='NONE'):
    """Draws a sentence as labels, broken to the width of the region."""
    # Measured in Blender's default font: an average letter is 6 pixels wide at scale 1. The
    # scale is 0 as long as there is no window.
    letter_width = 6 * (bpy.context.preferences.system.ui_scale or 1)
    letters = max(20, int((region_width - 60) / letter_width))
    column = layout.column(align=True)
    column.scale_y = 0.8
    for number, line in enumerate(textwrap.wrap(text, letters)):
        column.label(text=line, icon=icon if number == 0 else _indent(icon))


def _indent(icon):
    return 'NONE' if icon == 'NONE' else 'BLANK1'


def register_classes(classes):
    for cls in classes:
        bpy.utils.register_class(cls)


def unregister_classes(classes):
    for cls in reversed(classes):
        bpy.utils.unregister_class(cls)
