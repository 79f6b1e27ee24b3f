# SPDX-License-Identifier: GPL-3.0-or-later
"""Volume objects to test with: made by geometry nodes, by a modifier, or read from a file."""
import bpy

from . import scene_factory


def made_volume(scene, size=2.0, resolution=(24, 20, 16), **placement):
    """A volume object that geometry nodes make: a box of noise, with holes, as its density."""
    obj = scene_factory.link(scene, bpy.data.volumes.new("Noise"), **placement)
    tree = bpy.data.node_groups.new("Noise", "GeometryNodeTree")
    tree.outputs.new("NodeSocketGeometry", "Geometry")
    nodes = scene_factory.Nodes(tree)
    noise = nodes.add("ShaderNodeTexNoise", None, {"Scale": 1.3})
    holes = nodes.add("ShaderNodeMath", {"operation": "SUBTRACT"},
                      {0: noise.outputs["Fac"], 1: 0.4})
    density = nodes.add("ShaderNodeMath", {"operation": "MULTIPLY", "use_clamp": True},
                        {0: holes, 1: 5.0})
    cube = nodes.add("GeometryNodeVolumeCube", None, {
        "Density": density, "Min": (-0.5 * size,) * 3, "Max": (0.5 * size,) * 3,
        **{f"Resolution {axis}": n for axis, n in zip("XYZ", resolution)}})
    output = nodes.add("NodeGroupOutput")
    tree.links.new(cube.outputs[0], output.inputs[0])
    obj.modifiers.new("Nodes", "NODES").node_group = tree
    return obj


def solid_volume(scene, mesh_object, voxel=0.12, **placement):
    """A volume object that a modifier makes of a mesh: the same density all through it."""
    obj = scene_factory.link(scene, bpy.data.volumes.new("Solid"), **placement)
    modifier = obj.modifiers.new("Mesh to Volume", "MESH_TO_VOLUME")
    modifier.object = mesh_object
    modifier.resolution_mode = "VOXEL_SIZE"
    modifier.voxel_size = voxel
    return obj


def save(obj, path):
    """Writes the grids of a volume object as an OpenVDB file."""
    grids = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.grids
    if not grids.save(filepath=str(path)):
        raise OSError(grids.error_message)


def volume_from_file(scene, path, material=None, space="OBJECT", **placement):
    data = bpy.data.volumes.new("File")
    data.filepath = str(path)
    data.render.space = space
    if material is not None:
        data.materials.append(material)
    return scene_factory.link(scene, data, **placement)
