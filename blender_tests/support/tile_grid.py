# SPDX-License-Identifier: GPL-3.0-or-later
"""Evaluate many shader graphs in one render: each is the emission of one small tile.

A graph's inputs are constant over its tile: socket values, or attributes of the face domain that
the engine cannot fold away. So the value does not depend on where in the pixel an engine puts its
sample, and a comparison at 1e-4 is sound at one sample a pixel. Values that must vary over the tile
(`FieldGrid`) are averaged over the pixel instead and get a tolerance from their own gradient.
"""
import math
from dataclasses import dataclass, field

import bpy

from . import parity_log, scene_factory
from .render import REFERENCE_ENGINE, TESTED_ENGINE, render

PIXELS_PER_TILE = 3
TOLERANCE = 1e-4


@dataclass
class Tile:
    """One face: material, attributes {name: float or 3 floats}, uv and normal (+Z half)."""
    label: str
    material: object
    attributes: dict = field(default_factory=dict)
    uv: tuple = (0.0, 0.0)
    normal: tuple = (0.0, 0.0, 1.0)


def _columns(count):
    return max(1, math.ceil(math.sqrt(count)))


def _quad(column, row, normal):
    """Corners of a unit square seen from +Z whose plane has `normal`."""
    nx, ny, nz = normal
    corners = []
    for dx, dy in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)):
        corners.append((column + dx, row + dy, -(nx * dx + ny * dy) / nz))
    return corners


def _frame(scene, columns, rows, pitch=1.0, pixels=PIXELS_PER_TILE):
    """Camera over the grid; returns the resolution. Blender draws at least 4 x 4 pixels."""
    columns, rows = max(columns, 2), max(rows, 2)
    centre = (pitch * (columns - 1) / 2, pitch * (rows - 1) / 2)
    scene_factory.top_camera(scene, pitch * max(columns, rows), centre, 50.0)
    return columns * pixels, rows * pixels


class TileGrid:
    """Tiles as the faces of one mesh, with one material slot for each different material."""

    def __init__(self, scene):
        self.scene = scene
        self.tiles = []

    def add(self, label, material, **options):
        self.tiles.append(Tile(label, material, **options))

    def build(self):
        """Make mesh and camera; returns the resolution."""
        columns = _columns(len(self.tiles))
        rows = math.ceil(len(self.tiles) / columns)
        vertices, faces, uv = [], [], []
        for index, tile in enumerate(self.tiles):
            base = len(vertices)
            vertices += _quad(index % columns, index // columns, tile.normal)
            faces.append(range(base, base + 4))
            uv += [tile.uv] * 4
        data = scene_factory.mesh("Tiles", vertices, faces, uv=uv)
        slots = list(dict.fromkeys(tile.material for tile in self.tiles))
        for material in slots:
            data.materials.append(material)
        slot_of = {material: i for i, material in enumerate(slots)}
        data.polygons.foreach_set("material_index", [slot_of[t.material] for t in self.tiles])
        self._add_attributes(data)
        scene_factory.link(self.scene, data)
        return _frame(self.scene, columns, rows)

    def _add_attributes(self, data):
        kinds = {}
        for tile in self.tiles:
            for name, value in tile.attributes.items():
                kinds[name] = "FLOAT" if isinstance(value, (int, float)) else "FLOAT_VECTOR"
        for name, kind in kinds.items():
            layer = data.attributes.new(name, kind, "FACE")
            if kind == "FLOAT":
                layer.data.foreach_set("value", [t.attributes.get(name, 0.0) for t in self.tiles])
            else:
                layer.data.foreach_set("vector", [
                    c for t in self.tiles for c in t.attributes.get(name, (0.0, 0.0, 0.0))])

    def values(self, engine, resolution):
        """RGB at the centre of each tile."""
        picture = render(engine, samples=1, resolution=resolution, max_bounces=0)
        return [picture.pixel(*centre_pixel(i, len(self.tiles)))[:3]
                for i in range(len(self.tiles))]

    def compare(self, tolerance=TOLERANCE):
        """Render with both engines; returns a list of texts, one for each tile that differs."""
        resolution = self.build()
        tested = self.values(TESTED_ENGINE, resolution)
        reference = self.values(REFERENCE_ENGINE, resolution)
        for tile, t, r in zip(self.tiles, tested, reference):
            parity_log.tile(tile.material, excess(t, r), tolerance)
        return [mismatch(tile.label, t, r)
                for tile, t, r in zip(self.tiles, tested, reference)
                if not agree(t, r, tolerance=tolerance)]


class FieldGrid:
    """Tiles as separate objects whose value may vary; compared as means over a pixel.

    256 stratified samples give the mean of a smooth field over the pixel to a few thousandths of
    its change per pixel, so the tolerance adds GRADIENT_SHARE of the difference to the neighbours.
    """
    SAMPLES = 256
    GRADIENT_SHARE = 0.01
    PITCH = 1.5
    PIXELS = 7
    # Off centre, so that neither the middle of the generated coordinates nor a diagonal, where
    # tangents and parametric coordinates have a kink, falls into the pixel that is read.
    X_RANGE = (-0.36, 0.7)
    Y_RANGE = (-0.34, 0.6)

    def __init__(self, scene):
        self.scene = scene
        self.labels = []
        self.objects = []

    def add(self, label, material, data=None, rotation=(0, 0, 0), scale=(1, 1, 1)):
        """Add an object (default: one quad over X_RANGE and Y_RANGE) and return it.

        Seen from above it must cover |x|, |y| < 0.32 and stay within 1.18 of its origin.
        """
        if data is None:
            (x0, x1), (y0, y1) = self.X_RANGE, self.Y_RANGE
            data = scene_factory.mesh("Tile", [(x1, y0, 0), (x1, y1, 0), (x0, y1, 0), (x0, y0, 0)],
                                      [(0, 1, 2, 3)], uv=[(1, 0), (1, 1), (0, 1), (0, 0)])
        data.materials.append(material)
        obj = scene_factory.link(self.scene, data, label, rotation=rotation, scale=scale)
        self.labels.append(label)
        self.objects.append(obj)
        return obj

    def compare(self, tolerance=TOLERANCE):
        """Render with both engines; returns a list of texts, one for each tile that differs."""
        count = len(self.objects)
        columns = _columns(count)
        for i, obj in enumerate(self.objects):
            obj.location = (self.PITCH * (i % columns), self.PITCH * (i // columns), 0)
        resolution = _frame(self.scene, columns, math.ceil(count / columns), self.PITCH,
                            self.PIXELS)
        pictures = [render(engine, self.SAMPLES, seed, resolution, max_bounces=0)
                    for engine, seed in ((TESTED_ENGINE, 0), (REFERENCE_ENGINE, 1000))]
        failures = []
        for i, label in enumerate(self.labels):
            x, y = centre_pixel(i, count, self.PIXELS)
            tested, reference = (p.pixel(x, y)[:3] for p in pictures)
            neighbours = [pictures[1].pixel(x + dx, y + dy)
                          for dx, dy in ((-1, 0), (1, 0), (0, -1), (0, 1))]
            slack = [self.GRADIENT_SHARE * max(abs(n[c] - reference[c]) for n in neighbours)
                     for c in range(3)]
            parity_log.tile(self.objects[i].data.materials[0], excess(tested, reference, slack),
                            tolerance)
            if not agree(tested, reference, slack, tolerance):
                failures.append(mismatch(label, tested, reference))
        return failures


def centre_pixel(index, count, pixels=PIXELS_PER_TILE):
    columns = _columns(count)
    return (pixels * (index % columns) + pixels // 2, pixels * (index // columns) + pixels // 2)


def excess(tested, reference, slack=(0.0, 0.0, 0.0)):
    """Largest difference beyond `slack`, relative to values above 1; infinite for NaN."""
    return max((d if (d := (abs(t - r) - s) / max(1.0, abs(r))) == d else math.inf
                for t, r, s in zip(tested, reference, slack)), default=0.0)


def agree(tested, reference, slack=(0.0, 0.0, 0.0), tolerance=TOLERANCE):
    return all(abs(t - r) <= tolerance * max(1.0, abs(r)) + s
               for t, r, s in zip(tested, reference, slack))


def mismatch(label, tested, reference):
    def show(values):
        return "(" + ", ".join(f"{v:.6g}" for v in values) + ")"
    return f"{label}: {show(tested)} instead of {show(reference)}"


def emission_of(name, build):
    """Material that emits what `build(Nodes)` returns (a socket or node), strength 1."""
    return scene_factory.node_material(
        name, lambda n: n.add("ShaderNodeEmission", None, {"Color": build(n)}))


def enum_items(node_type, name):
    """Identifiers of an enum setting as the running Blender has them."""
    node_class = getattr(bpy.types, node_type)
    return [item.identifier for item in node_class.bl_rna.properties[name].enum_items]
