# SPDX-License-Identifier: GPL-3.0-or-later
"""More of the table of node parity: procedural textures, curves, ranges, vectors and spectra."""
import itertools

from .node_variants import COLORS, VECTORS, Variant, zip_inputs
from .tile_grid import enum_items

# Away from the borders of cells, where a last bit decides between two values.
_POINTS = [(0.13, 0.27, 0.41), (-0.63, 1.91, 0.37), (2.53, 0.47, -7.71), (31.7, -12.3, 5.9)]


def _over(names, *columns):
    """Input sets whose values come from `columns`, each repeated as long as the longest."""
    count = max(len(column) for column in columns)
    rows = [[column[i % len(column)] for column in columns] for i in range(count)]
    return zip_inputs(names, *rows)


def noise_variants():
    node = "ShaderNodeTexNoise"
    sets = _over(("Vector", "W", "Scale", "Detail", "Roughness", "Distortion"), _POINTS,
                 (0.7, -3.2), (5.0, 1.3, 2.1), (2.0, 0.0, 3.5, 15.0), (0.5, 0.0, 1.0), (0.0, 1.7))
    return [Variant(node, {"noise_dimensions": d}, sets, output)
            for d in enum_items(node, "noise_dimensions") for output in ("Fac", "Color")]


def white_noise_variants():
    node = "ShaderNodeTexWhiteNoise"
    sets = _over(("Vector", "W"), _POINTS, (0.7, -3.2))
    return [Variant(node, {"noise_dimensions": d}, sets, output)
            for d in enum_items(node, "noise_dimensions") for output in ("Value", "Color")]


def musgrave_variants():
    node = "ShaderNodeTexMusgrave"
    sets = _over(("Vector", "W", "Scale", "Detail", "Dimension", "Lacunarity", "Offset", "Gain"),
                 _POINTS, (0.7, -3.2), (5.0, 1.3, 2.1), (2.0, 0.0, 3.5, 7.0), (2.0, 0.0, 0.9),
                 (2.0, 1.3), (0.0, 0.8), (1.0, 2.5))
    return [Variant(node, {"musgrave_dimensions": d, "musgrave_type": kind}, sets)
            for d in enum_items(node, "musgrave_dimensions")
            for kind in enum_items(node, "musgrave_type")]


def _voronoi_outputs(dimensions, feature):
    if feature == "DISTANCE_TO_EDGE":
        return ["Distance"]
    if feature == "N_SPHERE_RADIUS":
        return ["Radius"]
    return (["Distance", "Color"] + (["Position"] if dimensions != "1D" else [])
            + (["W"] if dimensions in ("1D", "4D") else []))


def voronoi_variants():
    node = "ShaderNodeTexVoronoi"
    sets = _over(("Vector", "W", "Scale", "Smoothness", "Exponent", "Randomness"), _POINTS,
                 (0.7, -3.2), (5.0, 1.3, 2.1), (1.0, 0.3), (0.5, 2.0, 1.3), (1.0, 0.6, 0.9))
    variants = []
    for d, feature in itertools.product(enum_items(node, "voronoi_dimensions"),
                                        enum_items(node, "feature")):
        # One number is as far away by any metric, and two features know Euclid's only.
        fixed = d == "1D" or feature in ("DISTANCE_TO_EDGE", "N_SPHERE_RADIUS")
        for metric in ["EUCLIDEAN"] if fixed else enum_items(node, "distance"):
            settings = {"voronoi_dimensions": d, "feature": feature, "distance": metric}
            variants += [Variant(node, settings, sets, output)
                         for output in _voronoi_outputs(d, feature)]
    return variants


def wave_variants():
    node = "ShaderNodeTexWave"
    sets = _over(("Vector", "Scale", "Distortion", "Detail", "Detail Scale", "Detail Roughness",
                  "Phase Offset"), _POINTS[:3], (5.0, 0.7), (0.0, 3.0), (2.0, 4.5), (1.0, 2.0),
                 (0.5, 0.8), (0.0, 1.1, -2.0))
    variants = []
    for kind, profile in itertools.product(enum_items(node, "wave_type"),
                                           enum_items(node, "wave_profile")):
        name = "bands_direction" if kind == "BANDS" else "rings_direction"
        variants += [Variant(node, {"wave_type": kind, "wave_profile": profile, name: direction},
                             sets, "Fac") for direction in enum_items(node, name)]
    return variants + [Variant(node, {}, sets, "Color")]


def magic_variants():
    sets = _over(("Vector", "Scale", "Distortion"), _POINTS[:3], (5.0, 0.7), (1.0, 0.3, 2.5))
    return [Variant("ShaderNodeTexMagic", {"turbulence_depth": depth}, sets, output)
            for depth in (0, 1, 2, 5, 10) for output in ("Color", "Fac")]


def gradient_variants():
    node = "ShaderNodeTexGradient"
    sets = [{"Vector": v} for v in _POINTS + VECTORS + [(0.3, 0.2, 0.1), (-0.2, -0.4, 0.1)]]
    return [Variant(node, {"gradient_type": kind}, sets, output)
            for kind in enum_items(node, "gradient_type") for output in ("Color", "Fac")]


def brick_variants():
    sets = _over(("Vector", "Color1", "Color2", "Mortar", "Scale", "Mortar Size", "Mortar Smooth",
                  "Bias", "Brick Width", "Row Height"), _POINTS, COLORS[:3], COLORS[1:3],
                 COLORS[2:5], (5.0, 1.3, 2.1), (0.02, 0.1, 0.07), (0.1, 0.0, 1.0),
                 (0.0, 0.5, -0.6), (0.5, 0.8), (0.25, 0.4))
    settings = ({}, {"offset": 0.2, "offset_frequency": 3}, {"squash": 1.7, "squash_frequency": 3},
                {"offset": 1.0, "offset_frequency": 1, "squash": 0.4, "squash_frequency": 1})
    return [Variant("ShaderNodeTexBrick", s, sets, output)
            for s in settings for output in ("Color", "Fac")]


def map_range_variants():
    node = "ShaderNodeMapRange"
    numbers = zip_inputs(("Value", "From Min", "From Max", "To Min", "To Max", "Steps"),
                         (0.3, 0.0, 1.0, 0.0, 1.0, 4.0), (1.7, -1.0, 2.0, 3.0, -5.0, 3.0),
                         (-2.0, 1.0, 0.0, 0.2, 0.8, 0.0), (0.5, 0.4, 0.4, 1.0, 2.0, 2.0))
    vectors = zip_inputs(("Vector", "From_Min_FLOAT3", "From_Max_FLOAT3", "To_Min_FLOAT3",
                          "To_Max_FLOAT3", "Steps_FLOAT3"),
                         ((0.3, 0.7, -0.2), (0, 0, 0), (1, 1, 1), (0, 0.5, 2), (1, 1, -1),
                          (4, 3, 2)),
                         ((1.7, -0.4, 0.5), (-1, 0.4, 1), (2, 0.4, 0), (3, 1, 0), (-5, 2, 1),
                          (0, 2, 5)))
    return [Variant(node, {"data_type": data, "interpolation_type": shape, "clamp": clamp}, sets,
                    output, linked_only=data == "FLOAT_VECTOR")
            for data, sets, output in (("FLOAT", numbers, "Result"),
                                       ("FLOAT_VECTOR", vectors, "Vector"))
            for shape in enum_items(node, "interpolation_type") for clamp in (False, True)]


def clamp_variants():
    node = "ShaderNodeClamp"
    sets = zip_inputs(("Value", "Min", "Max"), (0.5, 0.0, 1.0), (-2.0, -1.0, 1.0),
                      (3.0, 2.0, 1.0), (0.2, 0.9, 0.1))
    return [Variant(node, {"clamp_type": kind}, sets) for kind in enum_items(node, "clamp_type")]


def _curves(count, extend):
    def prepare(node):
        mapping = node.mapping
        mapping.extend = extend
        for i in range(count):
            curve = mapping.curves[i]
            curve.points[0].location = (-0.5 if i == 1 else 0.0, 0.1 * i)
            curve.points[-1].location = (1.0, 0.9 - 0.2 * i)
            curve.points.new(0.4, 0.75 - 0.15 * i)
        mapping.update()
    return prepare


def curve_variants():
    variants = []
    for extend in ("HORIZONTAL", "EXTRAPOLATED"):
        variants += [
            Variant("ShaderNodeFloatCurve", {}, _over(
                ("Factor", "Value"), (1.0, 0.3), (0.2, 0.55, 0.9, -0.4, 1.6)),
                prepare=_curves(1, extend), note=extend),
            Variant("ShaderNodeRGBCurve", {}, _over(
                ("Fac", "Color"), (1.0, 0.3), COLORS + [(-0.3, 0.5, 1.4)]),
                prepare=_curves(4, extend), note=extend),
            Variant("ShaderNodeVectorCurve", {}, _over(
                ("Fac", "Vector"), (1.0, 0.3), VECTORS + [(0.3, 0.6, -0.8)]),
                prepare=_curves(3, extend), note=extend)]
    return variants


def vector_variants():
    def turned(node):
        node.outputs["Normal"].default_value = (0.48, -0.6, 0.64)
    rotate, transform = "ShaderNodeVectorRotate", "ShaderNodeVectorTransform"
    turns = zip_inputs(("Vector", "Center", "Axis", "Angle", "Rotation"),
                       ((0.3, 0.7, -0.2), (0, 0, 0), (0, 0, 1), 0.7, (0.4, -1.1, 2.3)),
                       ((-1.4, 2.25, 0.5), (1, 2, 3), (0.3, -2.0, 0.6), -2.5, (3.2, 0.1, -0.7)),
                       ((1, 2, 3), (0.5, 0, 0), (0, 0, 0), 1.0, (0, 0, 0)))
    frames = enum_items(transform, "convert_from")
    return [
        *[Variant(rotate, {"rotation_type": kind, "invert": invert}, turns,
                  linked_only=True)
          for kind in enum_items(rotate, "rotation_type") for invert in (False, True)],
        *[Variant(transform, {"vector_type": kind, "convert_from": a, "convert_to": b},
                  [{"Vector": v} for v in VECTORS])
          for kind in enum_items(transform, "vector_type")
          for a in frames for b in frames],
        *[Variant("ShaderNodeNormal", {}, [{"Normal": v} for v in VECTORS], output,
                  prepare=turned) for output in ("Normal", "Dot")],
    ]


def spectrum_variants():
    return [
        Variant("ShaderNodeRGBToBW", {}, [{"Color": c} for c in COLORS]),
        Variant("ShaderNodeBlackbody", {}, [
            {"Temperature": t} for t in (500.0, 900.0, 1500.0, 3000.0, 6500.0, 11000.0, 13000.0)]),
        Variant("ShaderNodeWavelength", {}, [
            {"Wavelength": w} for w in (300.0, 380.0, 450.0, 513.0, 580.0, 660.0, 780.0, 900.0)]),
    ]


PATTERN_TABLE = {
    "noise": noise_variants,
    "white_noise": white_noise_variants,
    "musgrave": musgrave_variants,
    "voronoi": voronoi_variants,
    "wave": wave_variants,
    "magic": magic_variants,
    "gradient": gradient_variants,
    "brick": brick_variants,
    "map_range": map_range_variants,
    "clamp": clamp_variants,
    "curves": curve_variants,
    "vectors": vector_variants,
    "spectra": spectrum_variants,
}
