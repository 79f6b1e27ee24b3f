# SPDX-License-Identifier: GPL-3.0-or-later
"""A cumulus in the sun: a volume object that geometry nodes fill with noise."""

import bpy

import parts


def build(scene):
    parts.render_settings(scene, 640, 400, samples=128, volume_bounces=16)
    add_cloud((240, 180, 150))
    parts.camera((0.0, -6.8, -0.6), (0.0, 0.0, 0.12), focal_length=75.0)


def add_cloud(resolution):
    """Sky, sun and a cloud of so many voxels along each axis."""
    parts.set_world_color((0.14, 0.30, 0.72), 0.4)
    sun = bpy.data.lights.new("Sun", 'SUN')
    sun.energy, sun.angle, sun.color = 17.0, 0.02, (1.0, 0.86, 0.68)
    placed("Sun", sun).rotation_euler = parts.degrees(58.0, 0.0, -75.0)
    material, nodes = parts.new_material("Cloud")
    nodes.add("OutputMaterial", {"Volume": nodes.add("VolumePrincipled", {
        "Color": (0.98, 0.98, 0.98), "Density": 40.0, "Anisotropy": 0.3})})
    volume = bpy.data.volumes.new("Cloud")
    volume.materials.append(material)
    placed("Cloud", volume).modifiers.new("Cumulus", 'NODES').node_group = cumulus(resolution)


def placed(name, data):
    item = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(item)
    return item


def cumulus(resolution):
    """Geometry nodes that make a flat-based heap of noise, 3 metres wide."""
    tree = bpy.data.node_groups.new("Cumulus", 'GeometryNodeTree')
    tree.outputs.new('NodeSocketGeometry', "Geometry")
    nodes = parts.Nodes(tree)

    def math(operation, *operands, **settings):
        return nodes.add("Math", dict(enumerate(operands)), operation=operation, **settings)

    place = tree.nodes.new('GeometryNodeInputPosition').outputs[0]
    axes = nodes.add("SeparateXYZ", {0: place})
    below = math('MINIMUM', axes.outputs["Z"], 0.0)
    height = math('MULTIPLY_ADD', below, 3.0, axes.outputs["Z"])
    shape = nodes.add("CombineXYZ", {0: math('MULTIPLY', axes.outputs["X"], 0.62),
                                     1: math('MULTIPLY', axes.outputs["Y"], 0.8),
                                     2: math('MULTIPLY', height, 1.15)})
    out = nodes.add("VectorMath", {0: shape}, operation='LENGTH').outputs["Value"]
    heaps = nodes.add("TexNoise", {"Vector": place, "Scale": 1.7, "Detail": 2.0})
    frays = nodes.add("TexNoise", {"Vector": place, "Scale": 6.5, "Detail": 8.0,
                                   "Roughness": 0.55})
    edge = math('MULTIPLY_ADD', heaps.outputs["Fac"], 2.1, math(
        'MULTIPLY_ADD', frays.outputs["Fac"], 1.0, -0.95))
    density = math('MULTIPLY', math('SUBTRACT', edge, out), 12.0, use_clamp=True)
    cube = tree.nodes.new('GeometryNodeVolumeCube')
    cube.inputs["Min"].default_value = (-1.5, -1.1, -0.6)
    cube.inputs["Max"].default_value = (1.5, 1.1, 1.1)
    for axis, count in zip("XYZ", resolution):
        cube.inputs[f"Resolution {axis}"].default_value = count
    nodes.connect(cube.inputs["Density"], density)
    tree.links.new(cube.outputs[0], tree.nodes.new('NodeGroupOutput').inputs[0])
    return tree
