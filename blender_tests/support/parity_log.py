# SPDX-License-Identifier: GPL-3.0-or-later
"""What each comparison says about the nodes in it, for the parity page (parity_page.py).

A comparison counts for every node of the materials, the World and the lamps that it shows. Nodes
that only carry values to the one under test are left out where another is there to be tested.
"""
import json

import bpy

_CARRIERS = {"ShaderNodeEmission", "ShaderNodeAttribute", "ShaderNodeBackground"}
_OUTPUTS = {"ShaderNodeOutputMaterial", "ShaderNodeOutputWorld", "ShaderNodeOutputLight"}

_path = None
_entries = {}    # bl_idname -> entry, see _entry


def open_log(path):
    """Collect from now on; `save` writes to `path`."""
    global _path
    _path = path


def save():
    if _path is None:
        return
    nodes = {cls.__name__: _facts(cls) for cls in _node_classes()}
    with open(_path, "w", encoding="utf-8") as stream:
        json.dump({"nodes": nodes, "entries": _entries}, stream, default=sorted)


def tile(material, difference, limit):
    """One value of one graph: `difference` relative to max(1, |value|)."""
    if _path is not None:
        _record(_subjects([material.node_tree]), "value", difference, difference <= limit)


def picture(difference, noise, passed):
    """Whole pictures of the context's scene: relative difference of the means, its statistical
    error, and whether the test is content with them."""
    if _path is None:
        return
    scene = bpy.context.scene
    trees = []
    for obj in scene.objects:
        if obj.type == "LIGHT":
            trees.append(obj.data.node_tree if obj.data.use_nodes else None)
        trees += [slot.material.node_tree for slot in obj.material_slots if slot.material]
    if scene.world is not None and scene.world.use_nodes:
        trees.append(scene.world.node_tree)
    _record(_subjects([tree for tree in trees if tree]), "picture", difference, passed, noise)


def _subjects(trees):
    nodes = [node for tree in trees for node in _nodes_of(tree, set())]
    tested = [node for node in nodes if node.bl_idname not in _CARRIERS]
    return tested or nodes


def _nodes_of(tree, seen):
    if tree in seen:
        return
    seen.add(tree)
    for node in tree.nodes:
        if node.bl_idname in _OUTPUTS or node.mute:
            continue
        yield node
        if getattr(node, "node_tree", None):
            yield from _nodes_of(node.node_tree, seen)


def _record(nodes, kind, difference, passed, noise=0.0):
    for idname in {node.bl_idname for node in nodes}:
        entry = _entries.setdefault(idname, {
            "value": {"count": 0, "worst": 0.0, "failed": 0},
            "picture": {"count": 0, "worst": 0.0, "failed": 0, "noise": 0.0},
            "settings": {}})
        part = entry[kind]
        part["count"] += 1
        part["failed"] += not passed
        if difference >= part["worst"]:
            part["worst"] = difference
            if kind == "picture":
                part["noise"] = noise
    for node in nodes:
        settings = _entries[node.bl_idname]["settings"]
        for name in _settings(type(node)):
            settings.setdefault(name, set()).add(str(getattr(node, name)))


def _settings(node_class):
    """Names of the node's own enums and switches."""
    inherited = bpy.types.ShaderNode.bl_rna.properties
    return [p.identifier for p in node_class.bl_rna.properties
            if p.identifier not in inherited and p.type in {"ENUM", "BOOLEAN"}
            and not p.is_readonly]


def _node_classes():
    names = (name for name in dir(bpy.types) if name.startswith("ShaderNode"))
    return [getattr(bpy.types, name) for name in names
            if name not in {"ShaderNode", "ShaderNodeTree", "ShaderNodeCustomGroup"}]


def _facts(node_class):
    """Label, and how many items each enum has (2 for a switch)."""
    items = {}
    for name in _settings(node_class):
        prop = node_class.bl_rna.properties[name]
        items[name] = len(prop.enum_items) if prop.type == "ENUM" else 2
    return {"label": node_class.bl_rna.name, "items": items}
