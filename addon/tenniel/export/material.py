# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials -> MaterialDesc: which tree and which output node apply."""

from typing import Any, FrozenSet, NamedTuple

from . import compat, node_graph

DEFAULT_MATERIAL = -1


class ExportedMaterial(NamedTuple):
    """index: in the description. attributes: names it reads from meshes.
    instance_attributes: (attribute type, name) it reads from what is not geometry.
    node_types: of the nodes its surface is made of."""
    index: int
    attributes: FrozenSet[str]
    instance_attributes: FrozenSet[tuple]
    node_types: FrozenSet[str] = frozenset()


class ExportedTree(NamedTuple):
    """graph: NodeGraph. needs: node_graph.Needs."""
    graph: Any
    needs: Any


_NOTHING = frozenset()
# No material of an artist starts with this byte.
_PLAIN_SMOKE = '\x01smoke'
_DEFAULT = ExportedMaterial(DEFAULT_MATERIAL, _NOTHING, _NOTHING)


def export_tree(context, tree, output_type, owner):
    """ExportedTree of a material's, World's or lamp's tree as its output node for Cycles sees it.

    output_type: bl_idname of the output. owner: name for reports. Without an output node the graph
    is that of an output that nothing is linked to: black, and not the plain colour of a tree that
    is off.
    """
    output = tree.get_output_node('CYCLES') or tree.get_output_node('ALL')
    return ExportedTree(*node_graph.flatten(context, tree, output, output_type, owner))


def export_material(context, material):
    """ExportedMaterial of a material or None, adding it at its first use."""
    if material is None:
        return _DEFAULT
    known = context.materials.get(material.name_full)
    if known is None:
        material = material.evaluated_get(context.depsgraph)
        known = context.materials[material.name_full] = _add(context, material)
    return known


def export_volume_material(context, material):
    """The same for a volume object, which is smoke of its density where it has no material."""
    if material is not None:
        return export_material(context, material)
    known = context.materials.get(_PLAIN_SMOKE)
    if known is None:
        graph = context.core.NodeGraph()
        smoke = graph.add_node('ShaderNodeVolumePrincipled', "Principled Volume")
        graph.set_setting(smoke, 'density_attribute', 'density')
        graph.output = graph.add_node('ShaderNodeOutputMaterial', "Material Output")
        graph.link(smoke, 'Volume', graph.output, 'Volume')
        desc = context.core.MaterialDesc()
        desc.name = graph.name = "Default Volume"
        desc.graph = graph
        known = context.materials[_PLAIN_SMOKE] = ExportedMaterial(
            context.description.add_material(desc), frozenset({'density'}), _NOTHING)
    return known


def behind_material(material):
    """The material that stands for this one in the dreams: itself if it has none."""
    if material is None:
        return None
    return material.tenniel.behind_material or material


def _add(context, material):
    desc = context.core.MaterialDesc()
    desc.name = material.name
    desc.pass_index = material.pass_index
    desc.displacement_method = compat.lookup(material, 'displacement_method', 'BUMP')
    desc.use_transparent_shadow = bool(compat.lookup(material, 'use_transparent_shadow', True))
    desc.sample_as_light = compat.sample_as_light(material)
    desc.volume_step_rate = compat.lookup(material, 'volume_step_rate', 1.0)
    desc.volume_interpolation = compat.lookup(material, 'volume_interpolation', 'LINEAR')
    try:
        if compat.uses_nodes(material):
            tree = export_tree(context, material.node_tree, 'ShaderNodeOutputMaterial',
                               material.name)
        else:
            tree = ExportedTree(_viewport_look(context, material), node_graph.Needs())
    except Exception:
        context.report_exception(material=material.name)
        return _DEFAULT
    desc.graph = tree.graph
    return ExportedMaterial(context.description.add_material(desc),
                            frozenset(tree.needs.attributes),
                            frozenset(tree.needs.instance_attributes),
                            frozenset(tree.needs.node_types))


def _viewport_look(context, material):
    """A material without nodes is plain matte in its viewport colour, as in Cycles."""
    graph = context.core.NodeGraph()
    graph.name = material.name
    diffuse = graph.add_node('ShaderNodeBsdfDiffuse', "Viewport Color")
    graph.set_input(diffuse, 'Color', material.diffuse_color[:])
    graph.output = graph.add_node('ShaderNodeOutputMaterial', "Material Output")
    graph.link(diffuse, 'BSDF', graph.output, 'Surface')
    return graph
