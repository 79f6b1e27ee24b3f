# SPDX-License-Identifier: GPL-3.0-or-later
"""Stands for the native module while the exporter is tested: keeps what it is given.

Structs take exactly the attributes that `_core.pyi` declares for them, so that a misspelt field
fails here as it would there.
"""
import array
import ast
import copy
import pathlib

import tenniel

_STUB = pathlib.Path(tenniel.__file__).with_name("_core.pyi")


def _declared_fields(stub=_STUB):
    """Class name -> {field: annotation} of the stub."""
    tree = ast.parse(stub.read_text(encoding="utf-8"))
    return {node.name: {item.target.id: ast.unparse(item.annotation) for item in node.body
                        if isinstance(item, ast.AnnAssign)}
            for node in tree.body if isinstance(node, ast.ClassDef)}


_FIELDS = _declared_fields()


class Struct:
    """A struct of the stub; lists and dicts start empty, all else starts as None."""

    def __init__(self):
        for name, annotation in _FIELDS[type(self).__name__].items():
            start = [] if annotation.startswith("list") else {} if annotation.startswith("dict") \
                else None
            object.__setattr__(self, name, start)

    def __setattr__(self, name, value):
        if name not in _FIELDS[type(self).__name__]:
            raise AttributeError(f"{type(self).__name__} has no field '{name}'")
        object.__setattr__(self, name, value)


def _struct(name, **defaults):
    def initialise(self):
        Struct.__init__(self)
        for field, value in defaults.items():
            setattr(self, field, value)
    return type(name, (Struct,), {"__init__": initialise})


def _buffer(code):
    def make(size):
        return array.array(code, bytes(size * array.array(code).itemsize))
    return staticmethod(make)


class NodeGraph:
    def __init__(self):
        self.name = ""
        self.output = -1
        self.aov_outputs = []
        self.nodes = []
        self.links = []

    @property
    def node_count(self):
        return len(self.nodes)

    def add_node(self, type, name):
        self.nodes.append({"type": type, "name": name, "inputs": {}, "settings": {}})
        return len(self.nodes) - 1

    def set_input(self, node, socket, value):
        assert len(value) in (1, 3, 4), (socket, value)
        self.nodes[node]["inputs"][socket] = tuple(float(v) for v in value)

    def set_setting(self, node, name, value):
        self.nodes[node]["settings"][name] = value

    def link(self, from_node, from_socket, to_node, to_socket):
        self.links.append((from_node, from_socket, to_node, to_socket))

    def find(self, type):
        """Nodes of a bl_idname, as dicts with type, name, inputs, settings."""
        return [node for node in self.nodes if node["type"] == type]

    def source(self, node, socket):
        """(node dict, output socket) that feeds an input of `node` (a dict), or None."""
        target = next(i for i, item in enumerate(self.nodes) if item is node)
        for from_node, from_socket, to_node, to_socket in self.links:
            if (to_node, to_socket) == (target, socket):
                return self.nodes[from_node], from_socket
        return None


class SceneDescription:
    def __init__(self):
        self.camera = None
        self.settings = None
        self.meshes, self.instances, self.materials = [], [], []
        self.lights, self.worlds, self.images, self.aovs = [], [], [], []
        self.grids = []

    @staticmethod
    def _add(items, item):
        items.append(copy.copy(item))
        return len(items) - 1

    def add_mesh(self, mesh):
        return self._add(self.meshes, mesh)

    def add_instance(self, instance):
        return self._add(self.instances, instance)

    def add_material(self, material):
        return self._add(self.materials, material)

    def add_light(self, light):
        return self._add(self.lights, light)

    def add_world(self, world):
        return self._add(self.worlds, world)

    def add_image(self, image):
        return self._add(self.images, image)

    def add_grid(self, grid):
        return self._add(self.grids, grid)

    def add_aov(self, aov):
        return self._add(self.aovs, aov)


class NodeTypeInfo:
    def __init__(self, inputs, outputs, settings):
        self.inputs, self.outputs, self.settings = inputs, outputs, settings


class PassInfo:
    def __init__(self, name, channels, channel_ids):
        self.name, self.channels, self.channel_ids = name, channels, channel_ids


class RecordingCore:
    """Everything of the native module that the exporter uses.

    node_types: {bl_idname: (inputs, outputs, {setting: kind})}; the nodes this core knows.
    """
    FloatBuffer = _buffer("f")
    IntBuffer = _buffer("i")
    UIntBuffer = _buffer("I")
    ByteBuffer = _buffer("b")
    NodeGraph = NodeGraph
    SceneDescription = SceneDescription
    AttributeDesc = _struct("AttributeDesc")
    MeshDesc = _struct("MeshDesc")
    InstanceDesc = _struct("InstanceDesc", dream=0, materials=[], behind_materials=[],
                           generated=(0.0, 0.0, 0.0), instancer_uv=(0.0, 0.0))
    MaterialDesc = _struct("MaterialDesc")
    LightDesc = _struct("LightDesc")
    WorldDesc = _struct("WorldDesc")
    ImageTileDesc = _struct("ImageTileDesc")
    ImageDesc = _struct("ImageDesc")
    GridDesc = _struct("GridDesc")
    AovDesc = _struct("AovDesc")
    CameraDesc = _struct("CameraDesc", aperture_radius=0.0)
    RenderSettings = _struct("RenderSettings", border_width=0, border_height=0)

    def __init__(self, node_types):
        self._node_types = node_types

    def node_types(self):
        return {name: NodeTypeInfo(*parts) for name, parts in self._node_types.items()}

    @staticmethod
    def passes():
        return [PassInfo("Combined", 4, "RGBA"), PassInfo("Depth", 1, "Z"),
                PassInfo("Normal", 3, "XYZ")]


# Nodes that the tests of the exporter use: inputs, outputs, settings.
NODE_TYPES = {
    "ShaderNodeOutputMaterial": (["Surface", "Displacement"], [], {}),
    "ShaderNodeOutputWorld": (["Surface"], [], {}),
    "ShaderNodeOutputLight": (["Surface"], [], {}),
    "ShaderNodeBsdfPrincipled": (["Base Color", "Roughness", "Normal"], ["BSDF"],
                                 {"distribution": "choice"}),
    "ShaderNodeBsdfDiffuse": (["Color", "Roughness", "Normal"], ["BSDF"], {}),
    "ShaderNodeBsdfGlossy": (["Color", "Roughness", "Normal"], ["BSDF"],
                             {"distribution": "choice"}),
    "TennielConductor": (["Eta", "K", "Roughness", "Normal"], ["BSDF"],
                         {"distribution": "choice"}),
    "ShaderNodeEmission": (["Color", "Strength"], ["Emission"], {}),
    "ShaderNodeBackground": (["Color", "Strength"], ["Background"], {}),
    "ShaderNodeMixShader": (["Fac", "Shader", "Shader_001"], ["Shader"], {}),
    "ShaderNodeMath": (["Value", "Value_001", "Value_002"], ["Value"],
                       {"operation": "choice", "use_clamp": "boolean"}),
    "ShaderNodeVectorMath": (["Vector", "Vector_001", "Vector_002", "Scale"], ["Vector", "Value"],
                             {"operation": "choice"}),
    "ShaderNodeRGBToBW": (["Color"], ["Val"], {}),
    "ShaderNodeMapping": (["Vector", "Location", "Rotation", "Scale"], ["Vector"],
                          {"vector_type": "choice"}),
    "ShaderNodeMix": (["Factor_Float", "A_Float", "B_Float", "A_Color", "B_Color"],
                      ["Result_Float", "Result_Color"], {"data_type": "choice"}),
    "ShaderNodeRGB": (["Color"], ["Color"], {}),
    "ShaderNodeValue": (["Value"], ["Value"], {}),
    "ShaderNodeValToRGB": (["Fac"], ["Color", "Alpha"],
                           {"color_ramp": "table", "interpolation": "choice"}),
    "ShaderNodeRGBCurve": (["Fac", "Color"], ["Color"],
                           {"mapping": "table", "min_x": "number", "max_x": "number",
                            "extrapolate": "boolean"}),
    "ShaderNodeTexImage": (["Vector"], ["Color", "Alpha"],
                           {"image": "image", "interpolation": "choice", "extension": "choice",
                            "projection": "choice", "projection_blend": "number",
                            "texture_mapping": "table", "alpha_is_linked": "boolean"}),
    "ShaderNodeTexChecker": (["Vector", "Color1", "Color2", "Scale"], ["Color", "Fac"],
                             {"texture_mapping": "table"}),
    "ShaderNodeTexCoord": ([], ["Generated", "Normal", "UV", "Object"],
                           {"from_instancer": "boolean", "object_transform": "table"}),
    "ShaderNodeUVMap": ([], ["UV"], {"uv_map": "attribute", "from_instancer": "boolean"}),
    "ShaderNodeVertexColor": ([], ["Color", "Alpha"], {"layer_name": "attribute"}),
    "ShaderNodeAttribute": ([], ["Color", "Vector", "Fac", "Alpha"],
                            {"attribute_type": "choice", "attribute_name": "attribute"}),
}
