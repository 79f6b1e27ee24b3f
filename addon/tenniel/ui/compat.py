# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes Blender's own panels and the Add-node menu serve Tenniel as they serve Cycles."""

import functools

import bpy

from .base import ENGINE

# Stock panels that ours replace, or that show what only other engines have.
_REPLACED = frozenset({
    'DATA_PT_area',
    'DATA_PT_falloff_curve',
    'DATA_PT_light',
    'DATA_PT_preview',
    'DATA_PT_spot',
    'NODE_DATA_PT_light',
    'NODE_DATA_PT_spot',
    'OBJECT_PT_visibility',
    'RENDER_PT_simplify',
    'RENDER_PT_simplify_greasepencil',
    'RENDER_PT_simplify_render',
    'RENDER_PT_simplify_viewport',
    'VIEWLAYER_PT_layer_passes',
})

# Stock panels that are right for Tenniel but are not marked as for every engine.
_BY_NAME = (
    'DATA_PT_camera_dof',
    'DATA_PT_camera_dof_aperture',
    'EEVEE_MATERIAL_PT_context_material',
    'VIEWLAYER_PT_layer_passes_aov',
)

_NODE_POLL = 'cycles_shader_nodes_poll'

_extended = []        # sets that got our id from us; panels and their node editor copies share one
_patched = []         # (module, our function, the function it stands for)


def stock_panels():
    """Panel classes of Blender that Tenniel takes over as they are."""
    panels = [panel for panel in bpy.types.Panel.__subclasses__()
              if 'BLENDER_RENDER' in getattr(panel, 'COMPAT_ENGINES', ())
              and panel.__name__ not in _REPLACED]
    named = (getattr(bpy.types, name, None) for name in _BY_NAME)
    return panels + [panel for panel in named if hasattr(panel, 'COMPAT_ENGINES')]


def _offer_cycles_nodes():
    """Lets the Add-node menu treat Tenniel as Cycles.

    The polls of the menu's entries look this function up by its name in its module, so
    replacing it there reaches all of them. Its module is another one in later versions of
    Blender, and gone where the menu lets every engine through.
    """
    for module in _node_menu_modules():
        original = getattr(module, _NODE_POLL, None)
        if original is None:
            continue

        def poll(context, original=original):
            return context.engine == ENGINE or original(context)

        functools.update_wrapper(poll, original)
        setattr(module, _NODE_POLL, poll)
        _patched.append((module, poll, original))


def _node_menu_modules():
    modules = []
    try:
        import nodeitems_builtins
        modules.append(nodeitems_builtins)
    except ImportError:
        pass
    try:
        from bl_ui import node_add_menu_shader
        modules.append(node_add_menu_shader)
    except ImportError:
        pass
    return modules


def register():
    for panel in stock_panels():
        if ENGINE not in panel.COMPAT_ENGINES:
            panel.COMPAT_ENGINES.add(ENGINE)
            _extended.append(panel.COMPAT_ENGINES)
    _offer_cycles_nodes()


def unregister():
    while _extended:
        _extended.pop().discard(ENGINE)
    while _patched:
        module, ours, original = _patched.pop()
        # Another add-on may have put its own function over ours since; that one stays.
        if getattr(module, _NODE_POLL, None) is ours:
            setattr(module, _NODE_POLL, original)
