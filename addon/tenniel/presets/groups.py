# SPDX-License-Identifier: GPL-3.0-or-later
"""The node groups behind the presets: one for metals, one for media.

Both are made of Blender's own nodes, so that a file renders in Cycles too and without this add-on.
The values of a preset are inputs of the group node: they can be seen, changed and linked. A metal's
group is marked, and the exporter hands its inputs to the core's own conductor instead: Cycles'
nodes know the angle to the surface only, the conductor that to each facet.
"""

import hashlib

import bpy

# Custom properties of a marked tree. The fingerprint is of the nodes as they were made: a group
# that was changed inside is no longer what its mark says.
KIND_PROPERTY = 'tenniel_preset'
FINGERPRINT_PROPERTY = 'tenniel_fingerprint'
METAL, MEDIUM = 'METAL', 'MEDIUM'

DISTRIBUTIONS = ('GGX', 'BECKMANN', 'SHARP')

_PER_METRE = 1000.0    # the tables are per millimetre
_CHANNELS = ('X', 'Y', 'Z')


def metal_group(distribution='GGX'):
    """The shader group for metals with this distribution of facets, made where it is missing."""
    suffix = '' if distribution == 'GGX' else f" ({distribution.title()})"
    return _existing(METAL, distribution) or _new_metal(f"Metal{suffix}", distribution)


def medium_group():
    """The shader group for homogeneous media, made where it is missing."""
    return _existing(MEDIUM) or _new_medium("Measured Medium")


def distribution_of(tree):
    """Distribution of an unchanged metal group; None for any other tree."""
    if tree.get(KIND_PROPERTY) != METAL or not is_unchanged(tree):
        return None
    glossy = next((node for node in tree.nodes if node.bl_idname == 'ShaderNodeBsdfGlossy'), None)
    return glossy.distribution if glossy and glossy.distribution in DISTRIBUTIONS else None


def is_unchanged(tree):
    """Whether a marked group computes what it did when it was made."""
    return tree.get(FINGERPRINT_PROPERTY) == fingerprint(tree)


def fingerprint(tree):
    """Text that stands for what a group computes: the same for copies, whatever its nodes are
    called and wherever they lie. The distribution of a Glossy node is left to the artist."""
    order, lines = {}, []
    output = next((node for node in tree.nodes
                   if node.type == 'GROUP_OUTPUT' and node.is_active_output), None)
    waiting = [output] if output else []
    while waiting:
        node = waiting.pop()
        parts = [_settings(node)]
        for socket in node.inputs:
            source = _source(socket)
            if source is None:
                parts.append(_value(socket))
                continue
            if source.node.name not in order:
                order[source.node.name] = len(order)
                waiting.append(source.node)
            parts.append(f"{order[source.node.name]}.{_index(source)}")
        lines.append(' '.join(parts))
    return hashlib.sha1('\n'.join(lines).encode()).hexdigest()


def _existing(kind, distribution=None):
    for tree in bpy.data.node_groups:
        if (tree.get(KIND_PROPERTY) == kind and tree.library is None and is_unchanged(tree)
                and (distribution is None or distribution_of(tree) == distribution)):
            return tree
    return None


# Fingerprint -------------------------------------------------------------------------------------

def _settings(node):
    own = set(node.bl_rna.properties.keys()) - set(bpy.types.ShaderNode.bl_rna.properties.keys())
    values = [f"{name}={getattr(node, name)}" for name in sorted(own - {'distribution'})
              if isinstance(getattr(node, name), (str, int, float, bool))]
    return ' '.join((node.bl_idname, 'muted' if node.mute else '', *values))


def _source(socket):
    while socket.is_linked:
        socket = socket.links[0].from_socket
        if socket.node.type != 'REROUTE':
            return socket
        socket = socket.node.inputs[0]
    return None


def _index(socket):
    return next(i for i, other in enumerate(socket.node.outputs) if other == socket)


def _value(socket):
    value = getattr(socket, 'default_value', None)
    if value is None or socket.hide_value:
        return '-'
    values = value if hasattr(value, '__iter__') else (value,)
    return ','.join(f"{item:.6g}" if isinstance(item, float) else str(item) for item in values)


# Building ----------------------------------------------------------------------------------------

class _Formula:
    """Writes arithmetic on vectors as nodes; operands are sockets, numbers or triples."""

    def __init__(self, tree):
        self.tree = tree
        self._columns = {}    # node name -> distance from the inputs
        self._heights = {}

    def add(self, kind, settings=None, **inputs):
        """A `ShaderNode<kind>`; inputs by name with underscores, or `at0=` and so on by index."""
        node = self.tree.nodes.new('ShaderNode' + kind)
        for name, value in (settings or {}).items():
            setattr(node, name, value)
        column = 1
        for name, value in inputs.items():
            key = int(name[2:]) if name.startswith('at') else name.replace('_', ' ')
            socket = node.inputs[key]
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, socket)
                column = max(column, self._columns.get(value.node.name, 0) + 1)
            elif isinstance(socket.default_value, float):
                socket.default_value = value
            else:
                triple = value if isinstance(value, tuple) else (value,) * 3
                socket.default_value = (*triple, 1.0)[:len(socket.default_value)]
        self.place(node, column)
        return node.outputs[0]

    def place(self, node, column):
        row = self._heights[column] = self._heights.get(column, -1) + 1
        self._columns[node.name] = column
        node.location = (200.0 * column, -180.0 * row)

    def vector(self, operation, *operands):
        inputs = {f"at{i}": operand for i, operand in enumerate(operands)}
        return self.add('VectorMath', {'operation': operation}, **inputs)

    def root(self, value):
        """Square root of each component: Vector Math has none."""
        return self.add('Gamma', Color=value, Gamma=0.5)


def _new_tree(name, kind, inputs, output):
    """(tree, _Formula, sockets of the Group Input); inputs: (type, name, default, max or None)."""
    tree = bpy.data.node_groups.new(name, 'ShaderNodeTree')
    tree[KIND_PROPERTY] = kind
    for socket_type, label, default, highest in inputs:
        socket = tree.inputs.new(socket_type, label)
        if default is None:
            socket.hide_value = True
            continue
        socket.default_value = default
        socket.min_value = 0.0
        if highest is not None:
            socket.max_value = highest
    tree.outputs.new('NodeSocketShader', output)
    formula = _Formula(tree)
    source = tree.nodes.new('NodeGroupInput')
    formula.place(source, 0)
    return tree, formula, source.outputs


def _finish(tree, formula, shader):
    end = tree.nodes.new('NodeGroupOutput')
    tree.links.new(shader, end.inputs[0])
    formula.place(end, formula._columns[shader.node.name] + 1)
    tree[FINGERPRINT_PROPERTY] = fingerprint(tree)
    return tree


def _new_metal(name, distribution):
    tree, formula, (eta, k, roughness, normal, *_) = _new_tree(name, METAL, (
        ('NodeSocketVector', "Refractive Index", (0.2, 0.9, 1.1), None),
        ('NodeSocketVector', "Extinction", (3.9, 2.5, 2.2), None),
        ('NodeSocketFloatFactor', "Roughness", 0.1, 1.0),
        ('NodeSocketVector', "Normal", None, None),
    ), "BSDF")
    facing = formula.tree.nodes.new('ShaderNodeLayerWeight')
    facing.inputs['Blend'].default_value = 0.5
    tree.links.new(normal, facing.inputs['Normal'])
    formula.place(facing, 1)
    cosine = formula.add('Math', {'operation': 'SUBTRACT'}, at0=1.0, at1=facing.outputs['Facing'])
    color = _reflectance(formula, eta, k, cosine)
    return _finish(tree, formula, formula.add(
        'BsdfGlossy', {'distribution': distribution}, Color=color, Roughness=roughness,
        Normal=normal))


def _reflectance(formula, eta, k, cosine):
    """Exact Fresnel reflectance of a conductor (Pharr, Jakob, Humphreys 2016, section 8.2.1)."""
    vector = formula.vector
    cos2 = vector('MULTIPLY', cosine, cosine)
    sin2 = vector('SUBTRACT', 1.0, cos2)
    eta2, k2 = vector('MULTIPLY', eta, eta), vector('MULTIPLY', k, k)
    t0 = vector('SUBTRACT', vector('SUBTRACT', eta2, k2), sin2)
    product = vector('MULTIPLY', vector('MULTIPLY', eta2, k2), 4.0)
    a2_plus_b2 = formula.root(vector('MULTIPLY_ADD', t0, t0, product))
    a = formula.root(vector('MULTIPLY', vector('ADD', a2_plus_b2, t0), 0.5))
    s_sum = vector('ADD', a2_plus_b2, cos2)
    s_product = vector('MULTIPLY', vector('MULTIPLY', cosine, 2.0), a)
    p_sum = vector('MULTIPLY_ADD', cos2, a2_plus_b2, vector('MULTIPLY', sin2, sin2))
    p_product = vector('MULTIPLY', s_product, sin2)
    perpendicular = _contrast(vector, s_sum, s_product)
    parallel = vector('MULTIPLY', perpendicular, _contrast(vector, p_sum, p_product))
    return vector('MULTIPLY', vector('ADD', perpendicular, parallel), 0.5)


def _contrast(vector, a, b):
    return vector('DIVIDE', vector('SUBTRACT', a, b), vector('ADD', a, b))


def _new_medium(name):
    """Each channel scatters and absorbs on its own: Blender's nodes know one anisotropy each."""
    tree, formula, (scattering, absorption, anisotropy, scale, *_) = _new_tree(name, MEDIUM, (
        ('NodeSocketVector', "Scattering (1/mm)", (1.0, 1.0, 1.0), None),
        ('NodeSocketVector', "Absorption (1/mm)", (0.0, 0.0, 0.0), None),
        ('NodeSocketVector', "Anisotropy", (0.0, 0.0, 0.0), 1.0),
        ('NodeSocketFloat', "Scale", 1.0, None),
    ), "Volume")
    per_metre = formula.add('Math', {'operation': 'MULTIPLY'}, at0=scale, at1=_PER_METRE)
    parts = {}
    for label, value, factor in (('s', scattering, per_metre), ('a', absorption, per_metre),
                                 ('g', anisotropy, None)):
        if factor is not None:
            value = formula.vector('MULTIPLY', value, factor)
        parts[label] = formula.add('SeparateXYZ', Vector=value).node.outputs
    shader = None
    for channel, axis in enumerate(_CHANNELS):
        own = tuple(float(i == channel) for i in range(3))
        others = tuple(1.0 - value for value in own)
        for closure in (
                formula.add('VolumeScatter', Color=own, Density=parts['s'][axis],
                            Anisotropy=parts['g'][axis]),
                formula.add('VolumeAbsorption', Color=others, Density=parts['a'][axis])):
            shader = closure if shader is None else formula.add('AddShader', at0=shader,
                                                               at1=closure)
    return _finish(tree, formula, shader)
