# SPDX-License-Identifier: GPL-3.0-or-later
"""Object properties: the magic mirror, and who sees the object."""

from bpy.types import Panel

from .. import mirror_tags
from .base import (
    PropertiesPanel,
    draw_wrapped,
    property_column,
    register_classes,
    unregister_classes,
)

_RAY_KINDS = (
    ('visible_camera', "Camera"),
    ('visible_diffuse', "Diffuse"),
    ('visible_glossy', "Glossy"),
    ('visible_transmission', "Transmission"),
    ('visible_volume_scatter', "Volume Scatter"),
    ('visible_shadow', "Shadow"),
)

_CUSTOM_PROPERTY_MEANING = {
    mirror_tags.LOOKING_GLASS_PROPERTY: "makes this object a looking glass",
    mirror_tags.BEHIND_MIRROR_PROPERTY: "sends this object behind the mirror",
}

_SURFACE_TYPES = {'MESH', 'CURVE', 'SURFACE', 'META', 'FONT', 'CURVES', 'POINTCLOUD'}


class ObjectPanel(PropertiesPanel):
    bl_context = 'object'
    object_types = _SURFACE_TYPES | {'LIGHT', 'EMPTY', 'VOLUME'}

    @classmethod
    def poll(cls, context):
        return (context.object is not None and context.object.type in cls.object_types
                and context.engine in cls.COMPAT_ENGINES)


class TENNIEL_OBJECT_PT_magic_mirror(ObjectPanel, Panel):
    bl_label = "Magic Mirror"

    def draw(self, context):
        obj = context.object
        settings = obj.tenniel
        tags = mirror_tags.effective_tags(obj)
        column = property_column(self.layout)
        column.row().prop(settings, 'side', expand=True)
        if tags.side == 'BEHIND':
            column.row().prop(settings, 'dreams', expand=True)
        if tags.side != 'THIS_SIDE' and obj.type not in {'LIGHT', 'EMPTY'}:
            column.prop(settings, 'behind_material')
        for name in sorted(tags.from_custom_property):
            box = self.layout.box()
            draw_wrapped(box, f"Custom property '{name}' {_CUSTOM_PROPERTY_MEANING[name]}",
                         context.region.width if context.region else 300, 'INFO')


class TENNIEL_OBJECT_PT_looking_glass(ObjectPanel, Panel):
    bl_label = "Looking Glass"
    bl_parent_id = 'TENNIEL_OBJECT_PT_magic_mirror'
    object_types = _SURFACE_TYPES

    def draw_header(self, context):
        self.layout.prop(context.object.tenniel, 'looking_glass', text="")

    def draw(self, context):
        settings = context.object.tenniel
        column = property_column(self.layout)
        column.active = mirror_tags.effective_tags(context.object).looking_glass
        column.prop(settings, 'dream')
        hint = column.row()
        hint.alignment = 'RIGHT'
        hint.label(text=_dream_name(context.scene, settings.dream))
        column.prop(settings, 'entry')
        column.prop(settings, 'reenter')
        column.prop(settings, 'first_seen_only')


def _dream_name(scene, number):
    """What a dream number stands for in this scene, in a few words."""
    dreams = scene.tenniel.dreams
    if number > len(dreams):
        if number == 1:
            return "Surroundings: the scene's World"
        return f"The scene has no dream {number}: dream 1 is shown"
    dream = dreams[number - 1]
    return f"{dream.name}: {dream.world.name if dream.world else 'the scene World'}"


class TENNIEL_OBJECT_PT_visibility(ObjectPanel, Panel):
    bl_label = "Visibility"
    bl_options = {'DEFAULT_CLOSED'}

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.engine in cls.COMPAT_ENGINES

    def draw(self, context):
        obj = context.object
        column = property_column(self.layout)
        # Blender's default for these is an icon button, which does not read as on or off here.
        as_checkbox = {'toggle': False, 'invert_checkbox': True}
        column.prop(obj, 'hide_select', text="Selectable", **as_checkbox)
        shown = column.column(heading="Show In", align=True)
        shown.prop(obj, 'hide_viewport', text="Viewports", **as_checkbox)
        shown.prop(obj, 'hide_render', text="Renders", **as_checkbox)
        if obj.type in _SURFACE_TYPES | {'VOLUME', 'EMPTY'}:
            column.column(heading="Mask").prop(obj, 'is_holdout')


class TENNIEL_OBJECT_PT_motion_blur(ObjectPanel, Panel):
    bl_label = "Motion Blur"
    bl_options = {'DEFAULT_CLOSED'}
    object_types = _SURFACE_TYPES | {'EMPTY'}

    def draw_header(self, context):
        self.layout.prop(context.object.tenniel, 'use_motion_blur', text="")

    def draw(self, context):
        column = property_column(self.layout)
        column.active = (context.scene.render.use_motion_blur
                         and context.object.tenniel.use_motion_blur)
        column.prop(context.object.tenniel, 'motion_steps')


class TENNIEL_OBJECT_PT_ray_visibility(ObjectPanel, Panel):
    bl_label = "Ray Visibility"
    bl_parent_id = 'TENNIEL_OBJECT_PT_visibility'

    def draw(self, context):
        column = property_column(self.layout).column(align=True)
        for name, label in _RAY_KINDS:
            # A lamp casts no shadow of its own.
            if name != 'visible_shadow' or context.object.type != 'LIGHT':
                column.prop(context.object, name, text=label)


_CLASSES = (
    TENNIEL_OBJECT_PT_magic_mirror,
    TENNIEL_OBJECT_PT_looking_glass,
    TENNIEL_OBJECT_PT_visibility,
    TENNIEL_OBJECT_PT_ray_visibility,
    TENNIEL_OBJECT_PT_motion_blur,
)


def register():
    register_classes(_CLASSES)


def unregister():
    unregister_classes(_CLASSES)
