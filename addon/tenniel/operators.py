# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators: settings, the render report, dreams, and the magic mirror tags of the selection."""

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, StringProperty
from bpy.types import Menu, Operator

from . import mirror_tags, reports
from .mirror_tags import MAX_DREAMS

# Only these have a surface that can be a mirror; those below can be on one side of it.
_SURFACE_TYPES = {'MESH', 'CURVE', 'SURFACE', 'META', 'FONT', 'CURVES', 'POINTCLOUD'}
_SIDED_TYPES = _SURFACE_TYPES | {'LIGHT', 'EMPTY', 'VOLUME'}


# Settings and report -----------------------------------------------------------------------------

class TENNIEL_OT_copy_cycles_settings(Operator):
    """Take over samples, bounces, clamping, film and seed from this scene's Cycles settings"""
    bl_idname = 'tenniel.copy_cycles_settings'
    bl_label = "Copy Cycles Settings"
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context):
        if getattr(context.scene, 'cycles', None) is None:
            cls.poll_message_set("The Cycles add-on is not enabled")
            return False
        return True

    def execute(self, context):
        source, target = context.scene.cycles, context.scene.tenniel
        shared = [name for name in target.bl_rna.properties.keys()
                  if name not in {'rna_type', 'name'} and hasattr(source, name)]
        for name in shared:
            setattr(target, name, getattr(source, name))
        self.report({'INFO'}, f"Copied {len(shared)} settings from Cycles")
        return {'FINISHED'}


class TENNIEL_OT_select_report_object(Operator):
    """Select this object and make it the active one"""
    bl_idname = 'tenniel.select_report_object'
    bl_label = "Select Object"
    bl_options = {'REGISTER', 'UNDO', 'INTERNAL'}

    object_name: StringProperty(name="Object", options={'SKIP_SAVE'})

    def execute(self, context):
        obj = context.view_layer.objects.get(self.object_name)
        if obj is None:
            self.report({'WARNING'}, f"'{self.object_name}' is not in this view layer")
            return {'CANCELLED'}
        if not obj.visible_get():
            self.report({'WARNING'}, f"'{self.object_name}' is hidden in the viewport")
            return {'CANCELLED'}
        for other in context.selected_objects:
            other.select_set(False)
        obj.select_set(True)
        context.view_layer.objects.active = obj
        return {'FINISHED'}


class TENNIEL_OT_clear_reports(Operator):
    """Empty the list of problems; the next render fills it again"""
    bl_idname = 'tenniel.clear_reports'
    bl_label = "Clear Render Report"
    bl_options = {'INTERNAL'}

    def execute(self, context):
        reports.clear(context.scene.name)
        return {'FINISHED'}


# Dreams ------------------------------------------------------------------------------------------

class TENNIEL_OT_dream_add(Operator):
    """Add a dream: another world that looking glasses can show"""
    bl_idname = 'tenniel.dream_add'
    bl_label = "Add Dream"
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context):
        if len(context.scene.tenniel.dreams) >= MAX_DREAMS:
            cls.poll_message_set(f"A scene has at most {MAX_DREAMS} dreams")
            return False
        return True

    def execute(self, context):
        settings = context.scene.tenniel
        taken = {dream.name for dream in settings.dreams}
        number = len(settings.dreams) + 1
        while f"Dream {number}" in taken:
            number += 1
        settings.dreams.add().name = f"Dream {number}"
        settings.active_dream_index = len(settings.dreams) - 1
        return {'FINISHED'}


class TENNIEL_OT_dream_remove(Operator):
    bl_idname = 'tenniel.dream_remove'
    bl_label = "Remove Dream"
    bl_description = ("Remove the active dream. Objects of later dreams keep theirs, "
                      "those of this one fall back to dream 1")
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context):
        return len(context.scene.tenniel.dreams) > 0

    def execute(self, context):
        settings = context.scene.tenniel
        index = min(settings.active_dream_index, len(settings.dreams) - 1)
        settings.dreams.remove(index)
        settings.active_dream_index = max(0, min(index, len(settings.dreams) - 1))
        for obj in context.scene.objects:
            _renumber_dreams(obj.tenniel, removed=index + 1)
        return {'FINISHED'}


def _renumber_dreams(tags, removed):
    """Keeps an object's tags at the dreams they meant after dream number `removed` has gone."""
    def moved(number):
        return number - 1 if number > removed else number

    if tags.dream == removed:
        tags.dream = 1
    elif tags.dream > removed:
        tags.dream = moved(tags.dream)
    if tags.dreams:
        kept = {str(moved(int(name))) for name in tags.dreams if int(name) != removed}
        # An empty set would mean all dreams: more than the object ever was in.
        tags.dreams = kept or {'1'}


# Magic mirror tags -------------------------------------------------------------------------------

class _SelectionOperator:
    """Applies `change(obj)` to every selected object of a type in `object_types`."""
    bl_options = {'REGISTER', 'UNDO'}
    object_types = _SIDED_TYPES

    @classmethod
    def poll(cls, context):
        if not context.selected_objects:
            cls.poll_message_set("No object is selected")
            return False
        return True

    def execute(self, context):
        changed, refused = [], []
        for obj in context.selected_objects:
            editable = obj.library is None and obj.type in self.object_types
            (changed if editable else refused).append(obj)
        for obj in changed:
            self.change(obj)
        if refused:
            self.report({'WARNING'}, _refusal(refused))
        elif changed:
            self.report({'INFO'}, self.done(len(changed)))
        return {'FINISHED'} if changed else {'CANCELLED'}


def _refusal(objects):
    names = ', '.join(f"'{obj.name}'" for obj in objects[:3])
    more = f" and {len(objects) - 3} more" if len(objects) > 3 else ""
    return f"Left as they are, being linked or without a surface: {names}{more}"


def _objects(count):
    return "1 object" if count == 1 else f"{count} objects"


class TENNIEL_OT_make_looking_glass(_SelectionOperator, Operator):
    """Turn the selected objects into looking glasses: what they mirror is another world"""
    bl_idname = 'tenniel.make_looking_glass'
    bl_label = "Make Looking Glass"
    object_types = _SURFACE_TYPES

    dream: IntProperty(
        name="Dream", min=1, max=MAX_DREAMS, default=1,
        description="Number of the dream they show")

    def change(self, obj):
        obj.tenniel.looking_glass = True
        obj.tenniel.dream = self.dream

    def done(self, count):
        return f"{_objects(count)} made a looking glass of dream {self.dream}"


class TENNIEL_OT_send_behind_mirror(_SelectionOperator, Operator):
    """Let the selected objects exist only behind the mirror"""
    bl_idname = 'tenniel.send_behind_mirror'
    bl_label = "Send Behind the Mirror"

    def change(self, obj):
        obj.tenniel.side = 'BEHIND'

    def done(self, count):
        if any(mirror_tags.effective_tags(obj).looking_glass for obj in bpy.context.scene.objects):
            return f"{_objects(count)} sent behind the mirror"
        return (f"{_objects(count)} sent behind the mirror; "
                f"the scene has no looking glass to see them in yet")


class TENNIEL_OT_keep_on_this_side(_SelectionOperator, Operator):
    """Let the selected objects have no reflection in a looking glass"""
    bl_idname = 'tenniel.keep_on_this_side'
    bl_label = "Keep on This Side"

    def change(self, obj):
        obj.tenniel.side = 'THIS_SIDE'

    def done(self, count):
        return f"{_objects(count)} kept on this side"


class TENNIEL_OT_clear_mirror_tags(_SelectionOperator, Operator):
    """Make the selected objects ordinary again, custom properties of the mirror included"""
    bl_idname = 'tenniel.clear_mirror_tags'
    bl_label = "Clear Mirror Tags"

    def change(self, obj):
        for name in obj.tenniel.bl_rna.properties.keys():
            if name not in {'rna_type', 'name', 'use_motion_blur', 'motion_steps'}:
                obj.tenniel.property_unset(name)
        for name in (mirror_tags.LOOKING_GLASS_PROPERTY, mirror_tags.BEHIND_MIRROR_PROPERTY):
            if name in obj:
                del obj[name]

    def done(self, count):
        return f"Mirror tags of {_objects(count)} cleared"


class TENNIEL_OT_select_by_mirror_side(Operator):
    """Select the visible objects that are of one kind to the magic mirror"""
    bl_idname = 'tenniel.select_by_mirror_side'
    bl_label = "Select by Mirror Side"
    bl_options = {'REGISTER', 'UNDO'}

    kind: EnumProperty(name="Select", default='BEHIND', items=(
        ('LOOKING_GLASS', "Looking Glasses", "Objects that show a dream"),
        ('BEHIND', "Behind", "Objects that exist only behind the mirror"),
        ('THIS_SIDE', "This Side", "Objects without a reflection"),
        ('BOTH', "Both Sides", "Ordinary objects, looking glasses included"),
    ))
    extend: BoolProperty(
        name="Extend", default=False, description="Keep what is selected already")

    def execute(self, context):
        found = 0
        for obj in context.view_layer.objects:
            tags = mirror_tags.effective_tags(obj)
            matches = tags.looking_glass if self.kind == 'LOOKING_GLASS' else tags.side == self.kind
            matches = matches and obj.visible_get()
            found += matches
            if matches or not self.extend:
                obj.select_set(matches)
        self.report({'INFO'}, f"{_objects(found)} found")
        return {'FINISHED'}


class TENNIEL_MT_magic_mirror(Menu):
    bl_label = "Magic Mirror"

    def draw(self, _context):
        layout = self.layout
        layout.operator('tenniel.make_looking_glass', icon='MOD_MIRROR')
        layout.operator('tenniel.send_behind_mirror')
        layout.operator('tenniel.keep_on_this_side')
        layout.operator('tenniel.clear_mirror_tags')
        layout.separator()
        layout.operator_menu_enum('tenniel.select_by_mirror_side', 'kind')


def _draw_object_menu(self, context):
    if context.engine == 'TENNIEL':
        self.layout.separator()
        self.layout.menu('TENNIEL_MT_magic_mirror')


_CLASSES = (
    TENNIEL_OT_copy_cycles_settings,
    TENNIEL_OT_select_report_object,
    TENNIEL_OT_clear_reports,
    TENNIEL_OT_dream_add,
    TENNIEL_OT_dream_remove,
    TENNIEL_OT_make_looking_glass,
    TENNIEL_OT_send_behind_mirror,
    TENNIEL_OT_keep_on_this_side,
    TENNIEL_OT_clear_mirror_tags,
    TENNIEL_OT_select_by_mirror_side,
    TENNIEL_MT_magic_mirror,
)


def register():
    for cls in _CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.VIEW3D_MT_object.append(_draw_object_menu)


def unregister():
    bpy.types.VIEW3D_MT_object.remove(_draw_object_menu)
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
