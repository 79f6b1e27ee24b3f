# SPDX-License-Identifier: GPL-3.0-or-later
"""What went wrong while a scene was exported and rendered, for the Render Report panel.

Plain data only: rows outlive the render that made them, and a reference to Blender's data
would not survive undo. Safe to use from any thread.
"""

import math
import threading
from typing import NamedTuple

SEVERITIES = ('ERROR', 'WARNING', 'INFO')

# A broken file can make a problem for each of its objects; beyond this only the number is kept.
MAX_ROWS = 500


class Row(NamedTuple):
    """One problem. `count` tells how often it occurred; the names are empty where unknown."""
    severity: str
    text: str
    object: str = ''
    material: str = ''
    node: str = ''
    file: str = ''
    count: int = 1

    def where(self):
        """The place in words, e.g. "Material 'Oak', node 'Noise'"; empty if unknown."""
        parts = (('object', self.object), ('material', self.material),
                 ('node', self.node), ('file', self.file))
        text = ', '.join(f"{kind} '{name}'" for kind, name in parts if name)
        return text[:1].upper() + text[1:]


class Coverage(NamedTuple):
    """How many shader nodes a render used, and how many of them a problem names."""
    nodes: int
    reported: int

    def text(self):
        if self.reported == 0:
            return f"All {self.nodes} shader nodes are covered"
        # Rounded down: 100 % is said of all only.
        percent = math.floor(1000 * (1 - self.reported / self.nodes)) / 10
        return f"{percent:g} % of {self.nodes} shader nodes are covered"


_lock = threading.Lock()
_counts = {}          # scene name -> {Row with count 1: count}, in order of first occurrence
_not_kept = {}        # scene name -> occurrences of rows beyond MAX_ROWS
_node_counts = {}     # scene name -> {material, World or lamp: number of nodes in use}
_current_scene = ''   # the scene whose render began last


def begin(scene):
    """Makes `scene` (a name) the one that later calls mean, and forgets its rows."""
    global _current_scene
    with _lock:
        _current_scene = scene
        _forget(scene)


def add(severity, text, object='', material='', node='', file='', scene=None):
    """Adds a problem, or counts it once more if the same one is known.

    severity: 'ERROR', 'WARNING' or 'INFO'. scene: a name; the scene of the last begin() if None.
    """
    if severity not in SEVERITIES:
        raise ValueError(f"severity is '{severity}', must be one of {', '.join(SEVERITIES)}")
    row = Row(severity, str(text), object, material, node, file)
    with _lock:
        scene = _current_scene if scene is None else scene
        counts = _counts.setdefault(scene, {})
        if row in counts or len(counts) < MAX_ROWS:
            counts[row] = counts.get(row, 0) + 1
        else:
            _not_kept[scene] = _not_kept.get(scene, 0) + 1


def count_nodes(owner, count):
    """Notes how many nodes of a material, World or lamp (a name) the current scene uses."""
    with _lock:
        _node_counts.setdefault(_current_scene, {})[owner] = count


def coverage(scene):
    """Coverage of the scene's (a name) last export, or None if it used no nodes."""
    with _lock:
        counts = _node_counts.get(scene, {})
        named = {(row.material, row.node) for row in _counts.get(scene, {})
                 if row.node and row.severity != 'INFO' and row.material in counts}
        nodes = sum(counts.values())
    return Coverage(nodes, min(len(named), nodes)) if nodes else None


def rows(scene=None):
    """Rows of a scene (a name; the last begun if None): errors first, then in order of arrival."""
    with _lock:
        scene = _current_scene if scene is None else scene
        found = [row._replace(count=count) for row, count in _counts.get(scene, {}).items()]
        surplus = _not_kept.get(scene, 0)
    found.sort(key=lambda row: SEVERITIES.index(row.severity))
    if surplus:
        found.append(Row('INFO', "Further problems not listed", count=surplus))
    return found


def clear(scene=None):
    """Forgets the rows of a scene (a name), or of all scenes if None."""
    with _lock:
        if scene is None:
            _counts.clear()
            _not_kept.clear()
            _node_counts.clear()
        else:
            _forget(scene)


def _forget(scene):
    _counts.pop(scene, None)
    _not_kept.pop(scene, None)
    _node_counts.pop(scene, None)
