# SPDX-License-Identifier: GPL-3.0-or-later
"""Cameras and 3D views -> CameraDesc."""

from mathutils import Matrix, Vector

from . import compat
from .context import ExportError, matrix_rows

_MM = 1e-3


class FromObject:
    """The camera of a final render.

    engine: the RenderEngine, which knows the stereo view and a camera override.
    """

    def __init__(self, engine):
        self._engine = engine

    def matrix(self, scene):
        """Where the camera is, or None without one."""
        obj = self._engine.camera_override or scene.camera
        return self._engine.camera_model_matrix(obj).copy() if obj else None

    def export(self, context):
        """CameraDesc; raises ExportError without a camera."""
        obj = self._engine.camera_override or context.scene.camera
        if obj is None:
            raise ExportError(f"Scene '{context.scene.name}' has no camera: add one and make it "
                              "the scene's camera")
        matrix = self._engine.camera_model_matrix(obj)
        if obj.type != 'CAMERA':
            return _other_object(context, matrix)
        desc = _camera(context, obj, matrix)
        desc.shift_x = self._engine.camera_shift_x(obj)
        render = context.scene.render
        desc.pixel_aspect_x = render.pixel_aspect_x
        desc.pixel_aspect_y = render.pixel_aspect_y
        return desc


class FromRegion:
    """What a 3D view shows: its own perspective, or the camera it looks through.

    space: SpaceView3D. region_data: RegionView3D.
    """

    def __init__(self, space, region_data):
        self._space = space
        self._region_data = region_data

    def export(self, context):
        """CameraDesc with the lens, shift and frame of the view's projection matrix."""
        view = self._region_data
        matrix = view.view_matrix.inverted()
        camera = self._space.camera
        looks_through = view.view_perspective == 'CAMERA' and camera is not None
        if looks_through and camera.type == 'CAMERA':
            desc = _camera(context, camera.evaluated_get(context.depsgraph), matrix)
            if desc.type == 'PANO':
                return desc
        else:
            desc = _other_object(context, matrix)
            desc.clip_start, desc.clip_end = self._space.clip_start, self._space.clip_end
        if not view.is_perspective and not looks_through:
            _see_behind(desc, matrix)
        set_projection(desc, view.window_matrix, view.is_perspective)
        return desc


def _see_behind(desc, matrix):
    """Blender's orthographic views see as far behind their origin as before it."""
    distance = desc.clip_end
    desc.camera_to_world = matrix_rows(matrix @ Matrix.Translation((0.0, 0.0, distance)))
    desc.clip_start, desc.clip_end = 0.0, 2.0 * distance


def set_projection(desc, projection, is_perspective):
    """Sets lens or scale, and shift, so that the core's camera equals a projection matrix."""
    desc.sensor_fit = 'HORIZONTAL'
    desc.sensor_width = 36.0
    desc.pixel_aspect_x = desc.pixel_aspect_y = 1.0
    if is_perspective:
        desc.type = 'PERSP'
        desc.lens = 0.5 * desc.sensor_width * projection[0][0]
        desc.shift_x = 0.5 * projection[0][2]
        desc.shift_y = 0.5 * projection[1][2] * projection[0][0] / projection[1][1]
    else:
        desc.type = 'ORTHO'
        desc.ortho_scale = 2.0 / projection[0][0]
        desc.shift_x = -0.5 * projection[0][3]
        desc.shift_y = -0.5 * projection[1][3] * projection[0][0] / projection[1][1]


def _other_object(context, matrix):
    """Blender lets any object be the camera; it then has the lens of a new one."""
    desc = context.core.CameraDesc()
    desc.camera_to_world = matrix_rows(matrix)
    return desc


def _camera(context, obj, matrix):
    """CameraDesc of a camera object, with `matrix` for its place; its scale does not count."""
    data = obj.data
    desc = context.core.CameraDesc()
    desc.type = data.type
    desc.camera_to_world = matrix_rows(matrix)
    for name in ('lens', 'sensor_width', 'sensor_height', 'sensor_fit', 'shift_x', 'shift_y',
                 'ortho_scale', 'clip_start', 'clip_end'):
        setattr(desc, name, getattr(data, name))
    if data.type == 'PANO':
        _set_panorama(context, desc, obj)
    if data.dof.use_dof:
        _set_depth_of_field(desc, data, matrix, context.depsgraph)
    return desc


def _set_panorama(context, desc, obj):
    kind = compat.lookup(obj.data, 'panorama_type', 'EQUIRECTANGULAR')
    if kind != 'EQUIRECTANGULAR':
        context.report('WARNING', f"Panorama type {kind} is not supported, equirectangular is "
                       "rendered instead", object=obj.name)
    for name in ('longitude_min', 'longitude_max', 'latitude_min', 'latitude_max'):
        setattr(desc, name, compat.lookup(obj.data, name, getattr(desc, name)))


def _set_depth_of_field(desc, data, matrix, depsgraph):
    dof = data.dof
    fstop = max(dof.aperture_fstop, 1e-5)
    # An orthographic camera has no focal length; Blender takes one metre.
    focal_length = 1.0 if data.type == 'ORTHO' else data.lens * _MM
    desc.aperture_radius = focal_length / (2.0 * fstop)
    desc.aperture_blades = dof.aperture_blades
    desc.aperture_rotation = dof.aperture_rotation
    desc.aperture_ratio = dof.aperture_ratio
    desc.focus_distance = _focus_distance(dof, matrix, depsgraph)


def _focus_distance(dof, matrix, depsgraph):
    """Metres along the view axis."""
    target = dof.focus_object
    if target is None:
        return max(dof.focus_distance, 1e-5)
    target = target.evaluated_get(depsgraph)
    place = target.matrix_world
    bone = target.pose.bones.get(dof.focus_subtarget) if target.pose else None
    if bone is not None:
        place = place @ bone.matrix
    axis = Vector((matrix[0][2], matrix[1][2], matrix[2][2])).normalized()
    return max(abs(axis.dot(place.translation - matrix.translation)), 1e-5)
