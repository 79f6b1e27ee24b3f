# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours the nodes that the Render Report names, and gives them their own colour back.

Only when asked for: a render leaves the artist's file as it is. What a node looked like is kept in
the node itself, so that marks can be cleared after the file was saved and opened again.
"""

import bpy
from bpy.types import Operator

from . import reports

_COLOR = (0.65, 0.18, 0.06)
_KEPT = 'tenniel_mark'    # custom property of a marked node: use_custom_color and color as before


def reported_nodes(scene_name):
    """(found nodes, number of those that belong to a library and cannot be changed)."""
    found, fixed = [], 0
    places = {(row.material, row.node) for row in reports.rows(scene_name)
              if row.material and row.node}
    for owner, path in sorted(places):
        node, is_editable = _find(_tree_of(owner), path)
        if node is None:
            continue
        if is_editable:
            found.append(node)
        else:
            fixed += 1
    return found, fixed


def _tree_of(owner):
    """Node tree of the material, World or lamp of this name; None if it is gone."""
    for collection in (bpy.data.materials, bpy.data.worlds, bpy.data.lights):
        data = collection.get(owner)
        if data is not None and data.node_tree is not None:
            return data.node_tree
    lamp = bpy.data.objects.get(owner)
    return lamp.data.node_tree if lamp is not None and lamp.type == 'LIGHT' else None


def _find(tree, path):
    """(node, whether it may be changed) at "Group/Node" below `tree`; (None, False) if gone.

    Names may contain slashes themselves.
    """
    if tree is None:
        return None, False
    for node in tree.nodes:
        if node.name == path:
            return node, tree.library is None
        inside = getattr(node, 'node_tree', None)
        if inside is not None and path.startswith(node.name + '/'):
            found = _find(inside, path[len(node.name) + 1:])
            if found[0] is not None:
                return found
    return None, False


def mark(node):
    """Colours a node, remembering its looks; one that is marked already stays as it is."""
    if _KEPT in node:
        return
    node[_KEPT] = [float(node.use_custom_color), *node.color]
    node.use_custom_color = True
    node.color = _COLOR


def clear(node):
    """True if the node was marked; it has its former looks again."""
    kept = node.get(_KEPT)
    if kept is None:
        return False
    node.color = kept[1:4]
    node.use_custom_color = bool(kept[0])
    del node[_KEPT]
    return True


def _all_trees():
    """Every tree of shader nodes of the file that may be changed."""
    for collection in (bpy.data.materials, bpy.data.worlds, bpy.data.lights):
        for data in collection:
            if data.library is None and data.node_tree is not None:
                yield data.node_tree
    for tree in bpy.data.node_groups:
        if tree.library is None and tree.type == 'SHADER':
            yield tree


class TENNIEL_OT_mark_nodes(Operator):
    """Colour the shader nodes that the Render Report names"""
    bl_idname = 'tenniel.mark_nodes'
    bl_label = "Mark Nodes"
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context):
        if any(row.node for row in reports.rows(context.scene.name)):
            return True
        cls.poll_message_set("The report names no node")
        return False

    def execute(self, context):
        nodes, fixed = reported_nodes(context.scene.name)
        for node in nodes:
            mark(node)
        text = f"{_count(len(nodes))} marked"
        if fixed:
            text += f"; {_count(fixed)} of linked libraries cannot be"
        self.report({'INFO'}, text)
        return {'FINISHED'}


class TENNIEL_OT_clear_node_marks(Operator):
    """Give all marked shader nodes of the file their own colour back"""
    bl_idname = 'tenniel.clear_node_marks'
    bl_label = "Clear Marks"
    bl_options = {'REGISTER', 'UNDO'}

    def execute(self, _context):
        count = sum(clear(node) for tree in _all_trees() for node in tree.nodes)
        self.report({'INFO'}, f"{_count(count)} cleared")
        return {'FINISHED'}


def _count(number):
    return "1 node" if number == 1 else f"{number} nodes"


_CLASSES = (TENNIEL_OT_mark_nodes, TENNIEL_OT_clear_node_marks)


def register():
    for cls in _CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
