# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene of one triangle given straight to the native module, without the exporter."""
import math

from tenniel import native

core = native.core()

IDENTITY = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0)
# A camera at z = 3 looks down at the triangle, which covers the middle of its picture.
CAMERA = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 3)
SIZE = 32
POSITIONS = (-2, -2, 0, 2, -2, 0, 0, 3, 0)


def buffer(kind, values):
    """A buffer of the core that holds `values`."""
    result = kind(len(values))
    for i, value in enumerate(values):
        result[i] = value
    return result


def triangle():
    mesh = core.MeshDesc()
    mesh.name = "Triangle"
    mesh.positions = buffer(core.FloatBuffer, POSITIONS)
    mesh.corner_vertices = buffer(core.UIntBuffer, (0, 1, 2))
    mesh.polygon_starts = buffer(core.IntBuffer, (0,))
    mesh.polygon_sizes = buffer(core.IntBuffer, (3,))
    mesh.triangle_corners = buffer(core.UIntBuffer, (0, 1, 2))
    return mesh


def small_scene(samples=8, light_energy=math.pi):
    """One grey triangle below a sun; threads are few, so that the tests are the same anywhere."""
    scene = core.SceneDescription()
    instance = core.InstanceDesc()
    instance.mesh = scene.add_mesh(triangle())
    scene.add_instance(instance)
    light = core.LightDesc()
    light.type = 'SUN'
    light.energy = light_energy
    scene.add_light(light)
    camera = core.CameraDesc()
    camera.camera_to_world = CAMERA
    scene.camera = camera
    settings = core.RenderSettings()
    settings.width = settings.height = SIZE
    settings.samples = samples
    settings.threads = 2
    scene.settings = settings
    return scene
