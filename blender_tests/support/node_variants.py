# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of node parity: for each node its settings, input sets and outputs.

Enum settings are read from the running Blender, so that no item is forgotten. `NODE_TABLE` maps a
name to a function that returns the `Variant`s of one node type without textures; images, geometry
and objects are in the test itself because they need data.
"""
import itertools
from dataclasses import dataclass, field
from typing import Callable, Optional

from .tile_grid import emission_of, enum_items


@dataclass
class Variant:
    """One node with settings, read at `output` (None: its first enabled output).

    `input_sets` are dicts {socket: float or 3 floats}; `prepare(node)` sets what is no plain
    attribute.
    """
    node_type: str
    settings: dict = field(default_factory=dict)
    input_sets: list = field(default_factory=lambda: [{}])
    output: Optional[str] = None
    prepare: Optional[Callable] = None
    note: str = ""
    linked_only: bool = False    # a socket of it shows no value: nobody can set one

    @property
    def label(self):
        words = [self.node_type.removeprefix("ShaderNode"), self.note, self.output or ""]
        words += [f"{k}={getattr(v, 'name', v)}" for k, v in self.settings.items()]
        return " ".join(str(w) for w in words if w)

    def add_to(self, grid, uv=(0.0, 0.0), normal=(0.0, 0.0, 1.0)):
        """Add tiles with socket values, and tiles whose inputs are linked to attributes.

        A texture ignores the value of its Vector socket and takes coordinates that vary over the
        tile, so it gets linked tiles only.
        """
        needs_link = self.linked_only or (
            self.node_type.startswith("ShaderNodeTex") and any(self.input_sets))
        for inputs in () if needs_link else self.input_sets:
            material = self._material(inputs, linked=False)
            grid.add(f"{self.label} {inputs or ''}", material, uv=uv, normal=normal)
        if not any(self.input_sets):
            return
        material = self._material(self.input_sets[0], linked=True)
        for inputs in self.input_sets:
            attributes = {f"{self._kind(v)}{i}": v for i, v in enumerate(inputs.values())}
            grid.add(f"{self.label} {inputs} linked", material, attributes=attributes, uv=uv,
                     normal=normal)

    @staticmethod
    def _kind(value):
        return "scalar" if isinstance(value, (int, float)) else "vector"

    def _material(self, inputs, linked):
        def build(nodes):
            node = nodes.add(self.node_type, self.settings)
            if self.prepare:
                self.prepare(node)
            for index, (key, value) in enumerate(inputs.items()):
                socket = find_enabled(node.inputs, key)
                if socket is None:
                    continue
                if linked:
                    source = nodes.add("ShaderNodeAttribute",
                                       {"attribute_name": f"{self._kind(value)}{index}"})
                    value = source.outputs["Fac" if self._kind(value) == "scalar" else "Vector"]
                nodes.set(socket, value)
            if self.output:
                return find_enabled(node.outputs, self.output)
            return node
        return emission_of(self.label[:60], build)


def find_enabled(sockets, key):
    """Socket by identifier or name if it is in use under the node's settings, else None."""
    for attribute in ("identifier", "name"):
        for socket in sockets:
            if getattr(socket, attribute) == key:
                return socket if socket.enabled else None
    raise KeyError(key)


def zip_inputs(names, *rows):
    return [dict(zip(names, row)) for row in rows]


COLORS = [(0.1, 0.4, 0.8), (0.9, 0.2, 0.05), (0.5, 0.5, 0.5), (0.0, 0.0, 0.0), (1.0, 1.0, 1.0),
          (2.5, 0.7, 1.2), (0.3, 0.8, 0.8)]
VECTORS = [(0.3, 0.7, -0.2), (-1.4, 2.25, 0.5), (0.0, 0.0, 0.0), (1.0, -1.0, 2.0)]


def math_variants():
    names = ("Value", "Value_001", "Value_002")
    sets = zip_inputs(names, (0.3, 0.7, 0.2), (-0.45, 1.6, 0.5), (2.25, -0.75, 1.1), (0, 0, 0),
                      (1, 0, -1), (-2, 3, 0.25), (0.5, 0.5, 0), (-1.3, -0.4, 3), (7.3, 2, 4.5))
    return [Variant("ShaderNodeMath", {"operation": operation, "use_clamp": clamp}, sets)
            for operation in enum_items("ShaderNodeMath", "operation") for clamp in (False, True)]


def vector_math_variants():
    names = ("Vector", "Vector_001", "Vector_002", "Scale")
    sets = zip_inputs(names,
                      ((0.3, 0.7, -0.2), (0.5, -1.2, 2.0), (0.2, 0.1, -0.6), 0.7),
                      ((-1.4, 2.25, 0.5), (3.0, 0.4, -0.3), (1.0, 2.0, 3.0), 1.45),
                      ((0, 0, 0), (0, 0, 0), (0, 0, 0), 0.0),
                      ((1, -1, 2), (0.6, 0, 0.8), (-1, 0.5, 0.25), -2.0),
                      ((0, 0.6, -0.8), (0, 0, 1), (0, 1, 0), 1.0))
    return [Variant("ShaderNodeVectorMath", {"operation": operation}, sets)
            for operation in enum_items("ShaderNodeVectorMath", "operation")]


def _mix_colors(names):
    pairs = list(zip(COLORS, COLORS[1:] + COLORS[:1])) + [(COLORS[0], COLORS[3]),
                                                         (COLORS[5], COLORS[2])]
    factors = itertools.cycle((0.35, 1.0, 0.0, 0.8, 1.7, -0.6))
    return [dict(zip(names, (factor, a, b))) for factor, (a, b) in zip(factors, pairs)]


def mix_variants():
    node = "ShaderNodeMix"
    clamps = list(itertools.product((False, True), repeat=2))
    variants = []
    for blend in enum_items(node, "blend_type"):
        for clamp_factor, clamp_result in clamps:
            settings = {"data_type": "RGBA", "blend_type": blend, "clamp_factor": clamp_factor,
                        "clamp_result": clamp_result}
            variants.append(Variant(node, settings,
                                    _mix_colors(("Factor_Float", "A_Color", "B_Color"))))
    floats = zip_inputs(("Factor_Float", "A_Float", "B_Float"),
                        (0.3, 1.0, -2.0), (1.5, 0.2, 0.9), (-0.4, 3.0, 1.0))
    vectors = zip_inputs(("Factor_Float", "A_Vector", "B_Vector"), (0.3, VECTORS[0], VECTORS[1]),
                         (1.5, VECTORS[1], VECTORS[3]))
    each = zip_inputs(("Factor_Vector", "A_Vector", "B_Vector"),
                      ((0.2, 1.4, -0.5), VECTORS[0], VECTORS[1]))
    for clamp in (False, True):
        variants.append(Variant(node, {"data_type": "FLOAT", "clamp_factor": clamp}, floats))
        for mode, sets in (("UNIFORM", vectors), ("NON_UNIFORM", each)):
            variants.append(Variant(node, {"data_type": "VECTOR", "factor_mode": mode,
                                           "clamp_factor": clamp}, sets))
    return variants


def legacy_mix_variants():
    sets = _mix_colors(("Fac", "Color1", "Color2"))
    return [Variant("ShaderNodeMixRGB", {"blend_type": blend, "use_clamp": clamp}, sets)
            for blend in enum_items("ShaderNodeMixRGB", "blend_type") for clamp in (False, True)]


RAMPS = {
    "two stops": [(0.0, (0.1, 0.2, 0.9, 1.0)), (1.0, (0.9, 0.8, 0.1, 0.2))],
    "three stops": [(0.15, (0.9, 0.1, 0.1, 0.3)), (0.4, (0.1, 0.7, 0.2, 1.0)),
                    (0.85, (0.2, 0.2, 1.0, 0.6))],
    "one stop": [(0.5, (0.3, 0.6, 0.9, 0.5))],
    "close stops": [(0.3, (1.0, 0.0, 0.0, 1.0)), (0.3, (0.0, 1.0, 0.0, 1.0)),
                    (0.7, (0.2, 0.3, 0.3, 1.0)), (1.0, (1.0, 1.0, 1.0, 0.0))],
}


def set_ramp(ramp, stops, color_mode="RGB", interpolation="LINEAR", hue="NEAR"):
    ramp.color_mode = color_mode
    ramp.interpolation = interpolation
    ramp.hue_interpolation = hue
    while len(ramp.elements) > 1:
        ramp.elements.remove(ramp.elements[-1])
    for index, (position, color) in enumerate(stops):
        element = ramp.elements[0] if index == 0 else ramp.elements.new(position)
        element.position = position
        element.color = color


def ramp_variants():
    sets = zip_inputs(("Fac",), (-0.5,), (0.0,), (0.1,), (0.3,), (0.333,), (0.52,), (0.77,), (1.0,),
                      (1.4,))
    modes = [("RGB", i, "NEAR") for i in ("LINEAR", "EASE", "CARDINAL", "B_SPLINE", "CONSTANT")]
    modes += [(mode, "LINEAR", hue) for mode in ("HSV", "HSL")
              for hue in ("NEAR", "FAR", "CW", "CCW")]
    variants = []
    for (name, stops), mode in itertools.product(RAMPS.items(), modes):
        for output in ("Color", "Alpha"):
            variants.append(Variant(
                "ShaderNodeValToRGB", {}, sets, output,
                prepare=lambda node, s=stops, m=mode: set_ramp(node.color_ramp, s, *m),
                note=f"{name} {' '.join(mode)}"))
    return variants


def separate_variants():
    colors = [{"Color": c} for c in COLORS + [(0.2, 0.9, 0.2), (-0.3, 0.5, 0.1)]]
    variants = [Variant("ShaderNodeSeparateColor", {"mode": mode}, colors, output)
                for mode in enum_items("ShaderNodeSeparateColor", "mode")
                for output in ("Red", "Green", "Blue")]
    variants += [Variant("ShaderNodeSeparateXYZ", {}, [{"Vector": v} for v in VECTORS], output)
                 for output in "XYZ"]
    variants += [Variant("ShaderNodeSeparateRGB", {}, [{"Image": c} for c in COLORS], output)
                 for output in "RGB"]
    variants += [Variant("ShaderNodeSeparateHSV", {}, colors, output) for output in "HSV"]
    return variants


def combine_variants():
    rows = [(0.1, 0.6, 0.9), (0.55, 1.0, 0.4), (0.0, 0.0, 0.0), (0.95, 0.3, 1.7), (-0.2, 0.5, 0.5),
            (1.3, 0.8, 0.25)]
    variants = [Variant("ShaderNodeCombineColor", {"mode": mode},
                        zip_inputs(("Red", "Green", "Blue"), *rows))
                for mode in enum_items("ShaderNodeCombineColor", "mode")]
    for node, names in (("XYZ", "XYZ"), ("RGB", "RGB"), ("HSV", "HSV")):
        variants.append(Variant(f"ShaderNodeCombine{node}", {}, zip_inputs(names, *rows)))
    return variants


def color_variants():
    colors = COLORS + [(-0.3, 0.5, 0.1)]
    factors = itertools.cycle((1.0, 0.0, 0.4, 0.75))
    hue_rows = [(h, s, v, f, c) for (h, s, v, f), c in zip(itertools.cycle(
        [(0.5, 1.0, 1.0, 1.0), (0.2, 0.5, 1.5, 1.0), (0.9, 2.0, 0.3, 0.6), (0.0, 0.0, 1.0, 1.0),
         (1.0, 1.3, 2.0, 0.9)]), colors * 2)]
    gammas = itertools.cycle((1.0, 2.2, 0.45, 0.0))
    bright = itertools.cycle(((0.0, 0.0), (0.3, 0.0), (-0.2, 0.5), (0.1, -0.7), (1.0, 1.0)))
    return [
        Variant("ShaderNodeInvert", {}, zip_inputs(("Fac", "Color"), *zip(factors, colors))),
        Variant("ShaderNodeHueSaturation", {},
                zip_inputs(("Hue", "Saturation", "Value", "Fac", "Color"), *hue_rows)),
        Variant("ShaderNodeGamma", {}, zip_inputs(("Color", "Gamma"), *zip(colors, gammas))),
        Variant("ShaderNodeBrightContrast", {},
                zip_inputs(("Color", "Bright", "Contrast"),
                           *[(c, *next(bright)) for c in colors])),
    ]


def mapping_variants():
    names = ("Vector", "Location", "Rotation", "Scale")
    sets = zip_inputs(names,
                      ((0.3, 0.7, -0.2), (0, 0, 0), (0, 0, 0), (1, 1, 1)),
                      ((0.3, 0.7, -0.2), (1.5, -0.5, 0.25), (0.4, -1.1, 2.3), (2, 0.5, -1.5)),
                      ((-1.4, 2.25, 0.5), (0.2, 0.1, 3), (3.2, 0.1, -0.7), (0, 1, 3)),
                      ((0, 0, 0), (0.2, 0.1, 3), (1, 1, 1), (1, 1, 1)))
    return [Variant("ShaderNodeMapping", {"vector_type": kind}, sets)
            for kind in enum_items("ShaderNodeMapping", "vector_type")]


def checker_variants():
    rows = [((0.13, 0.27, 0.41), COLORS[0], COLORS[1], 5.0),
            ((-0.6, 1.9, 0.3), COLORS[0], COLORS[1], 1.0),
            ((2.5, 0.4, -7.7), COLORS[4], COLORS[3], 2.3),
            ((1.0, 2.0, 3.0), COLORS[1], COLORS[2], 1.0),
            ((0.0, 0.0, 0.0), COLORS[1], COLORS[2], 8.0)]
    sets = zip_inputs(("Vector", "Color1", "Color2", "Scale"), *rows)
    variants = [Variant("ShaderNodeTexChecker", {}, sets, output) for output in ("Color", "Fac")]
    for name, settings in TEXTURE_MAPPINGS.items():
        variants.append(Variant("ShaderNodeTexChecker", settings, sets, "Color", note=name))
    return variants


TEXTURE_MAPPINGS = {
    "moved": {"texture_mapping.translation": (0.3, -0.2, 0.7)},
    "turned": {"texture_mapping.rotation": (0.4, 1.1, -0.3)},
    "scaled": {"texture_mapping.scale": (2.0, 0.7, -1.0)},
    "texture type": {"texture_mapping.vector_type": "TEXTURE",
                     "texture_mapping.translation": (0.3, -0.2, 0.7),
                     "texture_mapping.rotation": (0.4, 1.1, -0.3),
                     "texture_mapping.scale": (2.0, 0.7, 1.3)},
    "swizzled": {"texture_mapping.mapping_x": "Z", "texture_mapping.mapping_y": "X",
                 "texture_mapping.mapping_z": "NONE"},
    "limited": {"texture_mapping.use_min": True, "texture_mapping.use_max": True,
                "texture_mapping.min": (0.1, 0.1, 0.1), "texture_mapping.max": (0.5, 0.5, 0.9)},
}


def fresnel_variants():
    normals = [(0, 0, 1), (0.6, 0, 0.8), (0.3, -0.9, 0.3162278)]
    return [
        Variant("ShaderNodeFresnel", {},
                zip_inputs(("IOR",), (1.45,), (1.0,), (0.7,), (2.5,), (0.0,))),
        Variant("ShaderNodeFresnel", {}, [{"IOR": 1.33, "Normal": n} for n in normals]),
        *[Variant("ShaderNodeLayerWeight", {},
                  zip_inputs(("Blend",), (0.5,), (0.0,), (0.2,), (0.9,), (1.0,)), output)
          for output in ("Fresnel", "Facing")],
        *[Variant("ShaderNodeLayerWeight", {}, [{"Blend": 0.3, "Normal": n} for n in normals],
                  output) for output in ("Fresnel", "Facing")],
    ]


def _set_first_output(value):
    def prepare(node):
        node.outputs[0].default_value = value
    return prepare


def constant_variants():
    return [Variant("ShaderNodeValue", prepare=_set_first_output(v), note=str(v))
            for v in (0.25, 7.5, -1.5)] + \
           [Variant("ShaderNodeRGB", prepare=_set_first_output((*c, 1.0)), note=str(c))
            for c in COLORS]


NODE_TABLE = {
    "math": math_variants,
    "vector_math": vector_math_variants,
    "mix": mix_variants,
    "legacy_mix": legacy_mix_variants,
    "color_ramp": ramp_variants,
    "separate": separate_variants,
    "combine": combine_variants,
    "color": color_variants,
    "mapping": mapping_variants,
    "checker": checker_variants,
    "rgb_and_value": constant_variants,
}
