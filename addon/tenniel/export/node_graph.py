# SPDX-License-Identifier: GPL-3.0-or-later
"""Flattens a shader tree into the core's NodeGraph.

Groups, reroutes and muted nodes disappear here. What is copied of a node follows from the core's
own table of node types, so a new node in the core needs nothing here; the few nodes whose data is
in neither sockets nor plain settings have a reader in node_readers.py.
"""

from typing import Any, NamedTuple

from . import node_readers
from .node_readers import Needs

__all__ = ('Needs', 'flatten')

# A link may pass through this many reroutes and group borders; more is a loop in a broken file.
_MAX_HOPS = 1000

# Socket types that carry one number.
_NUMBERS = {'VALUE', 'INT', 'BOOLEAN'}
_VALUES = _NUMBERS | {'VECTOR', 'RGBA'}

# Kinds of settings that are attributes of the node as they are.
_PLAIN_KINDS = {'boolean', 'integer', 'number', 'choice', 'text', 'attribute'}

_LUMINANCE = (0.2126, 0.7152, 0.0722)

# What the core inserts by itself when it feeds a number from a link is the mean of a vector and
# the luminance of a colour. Where a link changed its type on the way, these nodes do it instead.
_THIRD = (1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0)


class Scope(NamedTuple):
    """Where a node stands: in the tree itself, or in one use of a group.

    tree: the NodeTree. group: the group node whose inside this is, parent: the scope of that node;
    both None for the outermost tree. path: names of the group nodes on the way, for reports.
    """
    tree: Any
    group: Any = None
    parent: Any = None
    path: tuple = ()

    def inside(self, node):
        """The scope of the nodes in a group node of this one."""
        return Scope(node.node_tree, node, self, (*self.path, node.name))

    def contains(self, tree):
        """Whether `tree` is this tree or one around it."""
        return tree == self.tree or (self.parent is not None and self.parent.contains(tree))


class Link(NamedTuple):
    """What feeds a socket: an output of a node of the graph.

    type: as the last socket on the way had it. native: type of the output itself.
    """
    node: int
    socket: str
    type: str
    native: str


class Constant(NamedTuple):
    """What feeds a socket: a value of 1, 3 or 4 floats, or None for a socket without one."""
    value: Any
    type: str


def flatten(context, tree, output, output_type, owner):
    """(NodeGraph, Needs) of all that `output` depends on; `owner` is a name for reports.

    output: output node of `tree`, or None: the graph then is an output of `output_type` (a
    bl_idname) with nothing linked.
    """
    return _Flattener(context, tree, owner).run(output, output_type)


class _Flattener:

    def __init__(self, context, tree, owner):
        self._context = context
        self._tree = tree
        self._owner = owner
        self._graph = context.core.NodeGraph()
        self._graph.name = owner
        self._needs = Needs()
        self._indices = {}    # (path, node name) -> index
        self._waiting = []    # (scope, node, index) whose inputs are still to be followed
        self._converters = {}
        self._has_alpha_switch = {}    # index -> whether its colour depends on the use of Alpha

    def run(self, output, output_type):
        if output is None:
            self._graph.output = self._graph.add_node(output_type, "")
            return self._graph, self._needs
        self._graph.output = self._index_of(Scope(self._tree), output)
        if output_type == 'ShaderNodeOutputMaterial' and self._context.aovs:
            self._graph.aov_outputs = list(self._aov_outputs(Scope(self._tree)))
        # No recursion: a chain of nodes may be longer than Python's stack is deep.
        while self._waiting:
            self._fill(*self._waiting.pop())
        self._context.count_nodes(self._owner, len(self._indices))
        return self._graph, self._needs

    # One node ------------------------------------------------------------------------------------

    def _aov_outputs(self, scope):
        """Indices of the AOV Outputs of a tree and of the groups in it, linked to or not."""
        for node in scope.tree.nodes:
            if node.mute:
                continue
            if node.bl_idname == 'ShaderNodeOutputAOV':
                if node_readers.aov_name(node) in self._context.aovs:
                    # What Blender shows as its name is that of the pass: several may share it.
                    yield self._index_of(scope, node, node.as_pointer())
            elif node.type == 'GROUP' and node.node_tree is not None \
                    and not self._is_metal(node) and not scope.contains(node.node_tree):
                yield from self._aov_outputs(scope.inside(node))

    def _index_of(self, scope, node, name=None):
        key = (scope.path, name or node.name)
        index = self._indices.get(key)
        if index is None:
            label = '/'.join((*scope.path, node.name))
            index = self._indices[key] = self._graph.add_node(self._type_of(node), label)
            self._needs.node_types.add(self._type_of(node))
            self._has_alpha_switch[index] = self._knows(node, 'alpha_is_linked')
            self._waiting.append((scope, node, index))
        return index

    def _knows(self, node, setting):
        known = self._context.node_types.get(node.bl_idname)
        return known is not None and setting in known.settings

    def _type_of(self, node):
        """The core's name of what this node is: its own, but for a metal's group."""
        return node_readers.CONDUCTOR if self._is_metal(node) else node.bl_idname

    def _is_metal(self, node):
        if node.type != 'GROUP' or node.node_tree is None:
            return False
        if self._context.node_types.get(node_readers.CONDUCTOR) is None:
            return False
        return self._context.metal_distribution(node.node_tree) is not None

    def _fill(self, scope, node, index):
        """Copies settings and inputs of a node as far as the core knows them."""
        known = self._context.node_types.get(self._type_of(node))
        if known is None:
            # The core stands in for it, and reports it.
            return
        for name, value in self._settings(scope, node, known).items():
            try:
                self._graph.set_setting(index, name, value)
            except (TypeError, ValueError) as error:
                self._report(scope, node, f"Setting '{name}' cannot be used ({error})")
        names = set()
        for name, socket in self._inputs(node):
            names.add(name)
            if name in known.inputs and _is_in_use(socket):
                self._connect(scope, socket, index, name)
        # The value of some nodes is that of their output socket.
        if node.type == 'NORMAL':
            self._graph.set_input(index, 'Direction', _socket_value(node.outputs[0]))
        for socket in node.outputs:
            if socket.identifier in known.inputs and socket.identifier not in names:
                self._graph.set_input(index, socket.identifier, _socket_value(socket))

    def _inputs(self, node):
        """(the core's name, socket) of each input."""
        if self._is_metal(node):
            return zip(node_readers.CONDUCTOR_INPUTS, node.inputs)
        return ((socket.identifier, socket) for socket in node.inputs)

    def _settings(self, scope, node, known):
        report = lambda text, **where: self._report(scope, node, text, **where)  # noqa: E731
        values = node_readers.read(self._context, node, known, self._needs, report)
        for name, kind in known.settings.items():
            if name not in values and kind in _PLAIN_KINDS and hasattr(node, name):
                values[name] = getattr(node, name)
        return {name: value for name, value in values.items() if name in known.settings}

    def _connect(self, scope, socket, index, name):
        """Lets input `name` of node `index` have what feeds `socket`."""
        source = self._source_of(scope, socket)
        if isinstance(source, Link):
            if socket.type in _NUMBERS and source.type != source.native:
                source = self._as_number(source)
            self._graph.link(source.node, source.socket, index, name)
            if source.socket == 'Alpha' and self._has_alpha_switch.get(source.node):
                self._graph.set_setting(source.node, 'alpha_is_linked', True)
        elif source.value is not None:
            self._graph.set_input(index, name,
                                  _convert(source.value, source.type, socket.type))

    # Where a link comes from ---------------------------------------------------------------------

    def _source_of(self, scope, socket):
        """Link or Constant that feeds an input socket, through whatever lies between."""
        end = socket
        border_types = []
        value_socket = socket    # whose own value counts if the way ends here
        for _hop in range(_MAX_HOPS):
            link = self._context.link_to(socket)
            if link is None:
                break
            node, output = link.from_node, link.from_socket
            step = self._step(scope, node, output)
            if step is None:
                name = 'BSDF' if self._is_metal(node) else output.identifier
                return self._through(border_types, Link(self._index_of(scope, node), name,
                                                        output.type, output.type))
            scope, socket = step
            if socket is None:
                # Nothing behind it: as if the link were not there.
                break
            # A muted node passes links on but no values: Cycles takes 0 for those.
            value_socket = None if node.mute else socket
            border_types.append(output.type if node.mute else socket.type)
        else:
            self._context.report('WARNING', "A loop of links has no end and is ignored",
                                 material=self._owner)
        # A socket whose value is hidden implies one (a normal, a coordinate), also where it is
        # fed by nothing but the unlinked input of a group.
        if value_socket is None:
            return self._through(border_types, Constant(None if end.hide_value else (0.0,), 'VALUE'))
        has_value = value_socket.type in _VALUES and not end.hide_value
        value = _socket_value(value_socket) if has_value else None
        return self._through(border_types, Constant(value, value_socket.type))

    def _step(self, scope, node, output):
        """The input socket that `output` of `node` passes on, as (scope, socket).

        None: the node makes its outputs itself. (scope, None): nothing comes out of it.
        """
        if node.mute:
            inner = [link.from_socket for link in node.internal_links if link.to_socket == output]
            return scope, (inner[0] if inner else None)
        if node.type == 'REROUTE':
            return scope, node.inputs[0]
        if node.type == 'GROUP_INPUT':
            if scope.group is None:
                return scope, None
            return scope.parent, _by_identifier(scope.group.inputs, output.identifier)
        if node.type == 'GROUP' and not self._is_metal(node):
            return self._enter(scope, node, output)
        return None

    def _enter(self, scope, node, output):
        tree = node.node_tree
        if tree is None:
            self._report(scope, node, "The node group is missing")
            return scope, None
        if scope.contains(tree):
            self._report(scope, node, "The node group contains itself and is ignored")
            return scope, None
        inside = scope.inside(node)
        for candidate in tree.nodes:
            if candidate.type == 'GROUP_OUTPUT' and candidate.is_active_output:
                return inside, _by_identifier(candidate.inputs, output.identifier)
        return scope, None

    # Types on the way ----------------------------------------------------------------------------

    def _through(self, border_types, source):
        """`source` after the sockets of groups and reroutes between it and its end."""
        for kind in reversed(border_types):
            if kind not in _VALUES or source.type not in _VALUES:
                continue
            if isinstance(source, Constant):
                if source.value is not None:
                    source = Constant(_convert(source.value, source.type, kind), kind)
            elif kind in _NUMBERS and source.type not in _NUMBERS:
                source = self._as_number(source)
            elif source.native not in _NUMBERS:
                source = source._replace(type=kind)
        return source

    def _as_number(self, source):
        """Link to a node that makes a number of `source` as its type says."""
        key = (source.node, source.socket, source.type)
        index = self._converters.get(key)
        if source.type == 'VECTOR':
            if index is None:
                index = self._graph.add_node('ShaderNodeVectorMath', "Vector to Value")
                self._graph.set_setting(index, 'operation', 'DOT_PRODUCT')
                self._graph.set_input(index, 'Vector_001', _THIRD)
                self._graph.link(source.node, source.socket, index, 'Vector')
            result = Link(index, 'Value', 'VALUE', 'VALUE')
        else:
            if index is None:
                index = self._graph.add_node('ShaderNodeRGBToBW', "Color to Value")
                self._graph.link(source.node, source.socket, index, 'Color')
            result = Link(index, 'Val', 'VALUE', 'VALUE')
        self._converters[key] = index
        return result

    def _report(self, scope, node, text, severity='WARNING', **where):
        self._context.report(severity, text, material=self._owner,
                             node='/'.join((*scope.path, node.name)), **where)


def _is_in_use(socket):
    # `hide` only folds a socket away in the editor; its value still counts.
    return socket.enabled and not getattr(socket, 'is_unavailable', False)


def _by_identifier(sockets, identifier):
    for socket in sockets:
        if socket.identifier == identifier:
            return socket
    return None


def _socket_value(socket):
    """1, 3 or 4 floats."""
    value = getattr(socket, 'default_value', None)
    if value is None:
        return None
    if isinstance(value, (bool, int, float)):
        return (float(value),)
    return tuple(value)


def _convert(value, source, target):
    """A constant of one socket type as another wants it, by Blender's implicit conversion."""
    if target in _NUMBERS:
        if source == 'RGBA':
            return (sum(weight * x for weight, x in zip(_LUMINANCE, value)),)
        return (sum(value) / len(value),)
    if target == 'VECTOR':
        return value * 3 if len(value) == 1 else value[:3]
    if target == 'RGBA':
        return (value * 3 if len(value) == 1 else value[:3]) + (1.0,) if len(value) < 4 else value
    return value
