# SPDX-License-Identifier: GPL-3.0-or-later
"""Scene properties: the dreams behind the looking glasses, and who is tagged."""

from bpy.types import Panel, UIList

from .. import mirror_tags
from .base import PropertiesPanel, property_column, register_classes, unregister_classes

_MAX_OBJECTS_SHOWN = 100


class TENNIEL_UL_dreams(UIList):
    def draw_item(self, _context, layout, _data, item, _icon, _active_data, _active_propname,
                  index):
        number, rest = _split(layout, 0.08)
        number.label(text=str(index + 1))
        name, world = _split(rest, 0.5)
        name.prop(item, 'name', text="", emboss=False)
        world.active = False
        world.label(text=item.world.name if item.world else "Scene World", icon='WORLD')


def _split(layout, factor):
    split = layout.split(factor=factor, align=True)
    return split.row(align=True), split.row(align=True)


class ScenePanel(PropertiesPanel):
    bl_context = 'scene'


class TENNIEL_SCENE_PT_dreams(ScenePanel, Panel):
    bl_label = "Dreams"

    def draw(self, context):
        settings = context.scene.tenniel
        row = self.layout.row()
        row.template_list('TENNIEL_UL_dreams', '', settings, 'dreams',
                          settings, 'active_dream_index', rows=3, maxrows=4)
        buttons = row.column(align=True)
        buttons.operator('tenniel.dream_add', text="", icon='ADD')
        buttons.operator('tenniel.dream_remove', text="", icon='REMOVE')

        column = property_column(self.layout)
        if settings.active_dream_index < len(settings.dreams):
            dream = settings.dreams[settings.active_dream_index]
            column.prop(dream, 'world')
        elif not settings.dreams:
            column.label(text="Dream 1 has the scene's World", icon='INFO')
        column.prop(settings, 'mirror_view')


class TENNIEL_SCENE_PT_tagged_objects(ScenePanel, Panel):
    bl_label = "Objects of the Magic Mirror"
    bl_parent_id = 'TENNIEL_SCENE_PT_dreams'

    def draw(self, context):
        tagged = mirror_tags.tagged_objects(context.scene.objects)
        if not tagged:
            self.layout.label(text="None: tag objects in their Object properties", icon='INFO')
            return
        if not any(tags.looking_glass for _obj, tags in tagged):
            self.layout.label(text="No looking glass: nothing behind will be seen", icon='ERROR')
        column = self.layout.column(align=True)
        for obj, tags in tagged[:_MAX_OBJECTS_SHOWN]:
            name, description = _split(column, 0.5)
            name.alignment = 'LEFT'
            button = name.operator('tenniel.select_report_object', text=obj.name,
                                  icon=_tag_icon(tags), emboss=False)
            button.object_name = obj.name
            description.alignment = 'RIGHT'
            description.label(text=_tag_text(tags))
        if len(tagged) > _MAX_OBJECTS_SHOWN:
            column.label(text=f"and {len(tagged) - _MAX_OBJECTS_SHOWN} more")


def _tag_icon(tags):
    if tags.looking_glass:
        return 'MOD_MIRROR'
    return {'BEHIND': 'HIDE_ON', 'THIS_SIDE': 'GHOST_DISABLED'}.get(tags.side, 'MATERIAL')


def _tag_text(tags):
    parts = []
    if tags.looking_glass:
        parts.append(f"Looking Glass {tags.dream}")
    if tags.side == 'BEHIND':
        dreams = sorted(tags.dreams)
        every = len(dreams) == mirror_tags.MAX_DREAMS
        parts.append("Behind" if every else "Behind " + ", ".join(map(str, dreams)))
    elif tags.side == 'THIS_SIDE':
        parts.append("This Side")
    if tags.behind_material is not None:
        parts.append(tags.behind_material.name)
    return ", ".join(parts)


_CLASSES = (
    TENNIEL_UL_dreams,
    TENNIEL_SCENE_PT_dreams,
    TENNIEL_SCENE_PT_tagged_objects,
)


def register():
    register_classes(_CLASSES)


def unregister():
    unregister_classes(_CLASSES)
