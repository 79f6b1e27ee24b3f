# SPDX-License-Identifier: GPL-3.0-or-later
"""Camera properties: panorama settings, which Blender's own lens panel shows for Cycles only."""

from bpy.types import Panel

from .base import PropertiesPanel, property_column, register_classes, unregister_classes


def _panorama(camera):
    """What holds a camera's panorama settings: Cycles' group, the camera itself in Blender 5."""
    for owner in (getattr(camera, 'cycles', None), camera):
        if hasattr(owner, 'panorama_type'):
            return owner
    return None


class TENNIEL_CAMERA_PT_panorama(PropertiesPanel, Panel):
    bl_label = "Panorama"
    bl_context = 'data'

    @classmethod
    def poll(cls, context):
        camera = context.camera
        return (camera is not None and camera.type == 'PANO'
                and _panorama(camera) is not None and context.engine in cls.COMPAT_ENGINES)

    def draw(self, context):
        settings = _panorama(context.camera)
        column = property_column(self.layout)
        column.prop(settings, 'panorama_type', text="Type")
        if settings.panorama_type != 'EQUIRECTANGULAR':
            column.label(text="Only Equirectangular is supported", icon='INFO')
        latitude = column.column(align=True)
        latitude.prop(settings, 'latitude_min', text="Latitude Min")
        latitude.prop(settings, 'latitude_max', text="Max")
        longitude = column.column(align=True)
        longitude.prop(settings, 'longitude_min', text="Longitude Min")
        longitude.prop(settings, 'longitude_max', text="Max")


_CLASSES = (TENNIEL_CAMERA_PT_panorama,)


def register():
    register_classes(_CLASSES)


def unregister():
    unregister_classes(_CLASSES)
