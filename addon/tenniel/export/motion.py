# SPDX-License-Identifier: GPL-3.0-or-later
"""Where objects and the camera are while the shutter is open.

The scene is evaluated at a few times of the shutter before it is described at its middle. Turning
objects get more steps between, since the core moves them from step to step on straight lines.
"""

import math
from typing import NamedTuple

from mathutils import Matrix

from .context import matrix_rows

# An object that turns by less than this between two steps loses under 0.1 % of its size.
_MAX_TURN = math.radians(4.0)
_MAX_STEPS = 129
_MOST_MOTION_STEPS = 7    # as in Cycles: 2^7 + 1 times


class Shutter(NamedTuple):
    """start, end: frames between which the shutter is open."""
    start: float
    end: float

    @property
    def middle(self):
        return 0.5 * (self.start + self.end)

    def times(self, steps):
        """2^steps + 1 frames, equally far apart."""
        count = 2 ** steps
        return [self.start + (self.end - self.start) * i / count for i in range(count + 1)]


def shutter_of(scene):
    """Shutter of a scene as it is at its frame; None without motion blur."""
    render = scene.render
    if not render.use_motion_blur or render.motion_blur_shutter <= 0.0:
        return None
    frame, length = scene.frame_current_final, render.motion_blur_shutter
    start = {'START': 0.0, 'CENTER': -0.5, 'END': -1.0}[scene.tenniel.motion_blur_position]
    return Shutter(frame + start * length, frame + (start + 1.0) * length)


class Motion:
    """Places of everything over one shutter, by `record` at each of `times` in their order."""

    def __init__(self, scene, shutter):
        self.steps = max((steps_of(obj) for obj in scene.objects), default=1)
        self.times = shutter.times(self.steps)
        self._places = {}     # key of an instance -> [matrix]
        self._camera = []

    def record(self, depsgraph, camera_matrix):
        """Notes where everything is now. camera_matrix: of the camera in use, or None."""
        for instance in depsgraph.object_instances:
            if instance.object.type != 'LIGHT':
                self._places.setdefault(_key(instance), []).append(instance.matrix_world.copy())
        if camera_matrix is not None:
            self._camera.append(camera_matrix)

    def of_instance(self, instance):
        """Rows of the steps of an instance that moves, else an empty list."""
        owner = instance.parent if instance.is_instance and instance.parent else instance.object
        if not owner.tenniel.use_motion_blur or not instance.object.tenniel.use_motion_blur:
            return []
        places = self._places.get(_key(instance), [])
        if len(places) != len(self.times):
            # It was not there all the time.
            return []
        return _steps(places[::2 ** (self.steps - min(steps_of(owner), self.steps))])

    def of_camera(self):
        return _steps(self._camera) if len(self._camera) == len(self.times) else []


def steps_of(obj):
    return min(obj.tenniel.motion_steps, _MOST_MOTION_STEPS)


def _key(instance):
    if not instance.is_instance:
        return (instance.object.name_full,)
    parent = instance.parent.name_full if instance.parent else ''
    return (instance.object.name_full, parent, *instance.persistent_id)


def _steps(places):
    if all(place == places[0] for place in places):
        return []
    turn = max(_turn(a, b) for a, b in zip(places, places[1:]))
    parts = max(1, min(math.ceil(turn / _MAX_TURN), (_MAX_STEPS - 1) // (len(places) - 1)))
    fine = [_between(a, b, k / parts) for a, b in zip(places, places[1:]) for k in range(parts)]
    return [matrix_rows(place) for place in (*fine, places[-1])]


def _turn(a, b):
    """Angle in [0, pi] between the rotations of two places."""
    angle = a.to_quaternion().rotation_difference(b.to_quaternion()).angle
    return min(angle, 2.0 * math.pi - angle)


def _between(a, b, factor):
    if factor == 0.0:
        return a
    (place_a, turn_a, size_a), (place_b, turn_b, size_b) = a.decompose(), b.decompose()
    return Matrix.LocRotScale(place_a.lerp(place_b, factor), turn_a.slerp(turn_b, factor),
                              size_a.lerp(size_b, factor))
