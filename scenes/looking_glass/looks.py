# SPDX-License-Identifier: GPL-3.0-or-later
"""The materials of the scene, each made once."""

import parts

from . import stone
from .engraved import engraved

CARD_FACES = ("hearts_1", "hearts_7", "diamonds_9", "spades_1", "spades_3", "clubs_2", "clubs_5",
              "clubs_7")


class Looks:
    def __init__(self):
        self._furniture()
        self._paper()
        self._glass_and_stone()
        self._food()
        self._dream()

    def _furniture(self):
        self.table = wood("Table wood", scale=1.5, tint=(0.56, 0.47, 0.42), smudges=0.12)
        self.walnut = wood("Walnut", scale=5.0, tint=(0.60, 0.48, 0.42))
        self.wallpaper = wallpaper()
        self.mirror = parts.shader("Mirror", "BsdfGlossy", {"Color": (0.97, 0.975, 0.97),
                                                           "Roughness": 0.0}, distribution='SHARP')
        self.brass = metal("Brass", (0.88, 0.62, 0.28), 0.16, 0.34)
        self.old_gold = metal("Old gold", (0.78, 0.54, 0.24), 0.28, 0.46)
        self.gold = gold()
        self.wax = parts.principled("Wax", (0.84, 0.78, 0.64), 0.45, specular=0.4)
        self.wick = parts.diffuse("Wick", (0.02, 0.02, 0.02))

    def _paper(self):
        self.card_edge = parts.diffuse("Card edge", (0.72, 0.69, 0.62))
        self.card_back = printed("card_back")
        self.card_faces = {face: printed(f"card_{face}") for face in CARD_FACES}
        self.label = printed("drink_me", roughness=0.7, specular=0.2)
        self.engraving = printed("rabbit_engraving", roughness=0.8, specular=0.1,
                                 tint=(0.72, 0.70, 0.66))
        self.mount = parts.diffuse("Mount", (0.46, 0.41, 0.31))

    def _glass_and_stone(self):
        self.bottle_glass = parts.shader("Bottle glass", "BsdfGlass",
                                         {"Color": (0.93, 0.98, 0.95), "Roughness": 0.0,
                                          "IOR": 1.5}, distribution='SHARP')
        self.potion = potion()
        self.cork = cork()
        self.marble = stone.white_marble()
        self.dark_marble = stone.dark_marble()
        self.ebony = parts.principled("Ebony", (0.012, 0.010, 0.010), 0.18, clearcoat=0.6)
        self.ivory = parts.principled("Ivory", (0.82, 0.76, 0.62), 0.22, clearcoat=0.5)
        self.carmine = parts.principled("Carmine", (0.52, 0.018, 0.03), 0.16, clearcoat=0.8)

    def _food(self):
        self.china = china()
        self.biscuit = biscuit()

    def _dream(self):
        self.fur = engraved("Engraved fur", 0.0)
        self.coat = engraved("Engraved coat", 0.42, pitch=0.40, paper=(0.085, 0.20, 0.52))
        self.waistcoat = engraved("Engraved waistcoat", 0.18, slant=(0.9, 0.0, 0.25),
                                  pitch=0.40, paper=(0.80, 0.56, 0.13))
        self.bow = engraved("Engraved bow", 0.2, pitch=0.34, paper=(0.62, 0.04, 0.035))
        self.linen = engraved("Engraved linen", 0.0)
        self.linen_dial = parts.diffuse("Dial", (0.85, 0.82, 0.74))
        self.ear = engraved("Engraved ear", 0.40)
        self.eye = parts.principled("Eye", (0.02, 0.012, 0.012), 0.05)
        self.gleam = parts.emission("Gleam", (1.0, 0.95, 0.85), 1.6)
        self.stalk = parts.principled("Stalk", (0.80, 0.72, 0.58), 0.6)
        self.cap = parts.principled("Cap", (0.70, 0.025, 0.02), 0.24, clearcoat=0.5)
        self.spot = parts.principled("Spot", (0.88, 0.83, 0.74), 0.6)
        self.hose = parts.principled("Hose", (0.05, 0.10, 0.30), 0.7, sheen=0.5)
        self.skin = parts.principled("Skin", (0.80, 0.52, 0.38), 0.5)


def wood(name, scale, tint=(1.0, 1.0, 1.0), smudges=0.0):
    """Painted boards with their roughness and normals; `scale` is repeats per metre. `smudges` is
    how much the polish varies from place to place, as hands and cloths leave it."""
    material, nodes = parts.new_material(name)
    mapping = nodes.add("Mapping", {"Vector": nodes.add("TexCoord").outputs["UV"],
                                    "Scale": (0.5 * scale, scale, 1.0)})
    albedo = nodes.picture("wood_albedo")
    roughness = nodes.picture("wood_roughness", data=True)
    normals = nodes.picture("wood_normal", data=True)
    for picture in (albedo, roughness, normals):
        nodes.connect(picture.inputs["Vector"], mapping)
    color = nodes.add("MixRGB", {"Fac": 1.0, "Color1": albedo, "Color2": tint},
                      blend_type='MULTIPLY')
    relief = nodes.add("NormalMap", {"Strength": 0.55, "Color": normals})
    gloss = roughness
    if smudges:
        gloss = nodes.add("Math", {0: roughness, 1: varied(nodes, 7.0, -smudges, smudges)},
                          operation='ADD', use_clamp=True)
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": color, "Roughness": gloss,
                                               "Normal": relief, "Clearcoat": 0.25,
                                               "Clearcoat Roughness": 0.12}))
    return material


def varied(nodes, scale, low, high):
    """A value that wanders between `low` and `high` over the object."""
    clouds = nodes.add("TexNoise", {"Vector": nodes.add("TexCoord").outputs["Object"],
                                    "Scale": scale, "Detail": 4.0, "Roughness": 0.6})
    return nodes.add("MapRange", {"Value": clouds, "From Min": 0.3, "From Max": 0.7,
                                  "To Min": low, "To Max": high})


def metal(name, color, low, high):
    """Brass and the like, polished where it is touched."""
    material, nodes = parts.new_material(name)
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": color, "Metallic": 1.0,
                                               "Roughness": varied(nodes, 60.0, low, high)}))
    return material


def gold():
    """A rough conductor by its measured index."""
    material, nodes = parts.new_material("Gold")
    nodes.surface(parts.measured_metal(nodes, "Gold", varied(nodes, 60.0, 0.16, 0.36),
                                       stand_in=(0.94, 0.69, 0.30)))
    return material


def wallpaper():
    material, nodes = parts.new_material("Wallpaper")
    mapping = nodes.add("Mapping", {"Vector": nodes.add("TexCoord").outputs["UV"],
                                    "Scale": (24.0, 12.0, 1.0)})
    picture = nodes.picture("wallpaper")
    nodes.connect(picture.inputs["Vector"], mapping)
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": picture, "Roughness": 0.55,
                                               "Specular": 0.3}))
    return material


def printed(picture_name, roughness=0.38, specular=0.35, tint=(0.84, 0.83, 0.80)):
    material, nodes = parts.new_material(picture_name.replace("_", " ").capitalize())
    color = nodes.add("MixRGB", {"Fac": 1.0, "Color1": nodes.picture(picture_name),
                                 "Color2": tint}, blend_type='MULTIPLY')
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": color, "Roughness": roughness, "Specular": specular}))
    return material


def potion():
    """Water that swallows green: thin it is rose, deep it is ruby."""
    material, nodes = parts.new_material("Potion")
    water = nodes.add("BsdfGlass", {"Roughness": 0.0, "IOR": 1.34}, distribution='SHARP')
    dye = nodes.add("VolumeAbsorption", {"Color": (0.93, 0.22, 0.30), "Density": 42.0})
    nodes.surface(water, volume=dye)
    return material


def cork():
    material, nodes = parts.new_material("Cork")
    grain = nodes.add("TexVoronoi", {"Vector": nodes.add("TexCoord").outputs["Object"],
                                     "Scale": 420.0})
    color = nodes.add("MixRGB", {"Fac": grain.outputs["Distance"], "Color1": (0.26, 0.13, 0.06),
                                 "Color2": (0.62, 0.41, 0.22)})
    relief = nodes.add("Bump", {"Strength": 0.6, "Distance": 0.0006, "Height": grain})
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": color, "Roughness": 0.8,
                                               "Normal": relief}))
    return material


def china():
    """White glaze with two gold lines on the rim, by distance from the middle."""
    material, nodes = parts.new_material("China")
    place = nodes.add("SeparateXYZ", {0: nodes.add("TexCoord").outputs["Object"]})
    squares = [nodes.add("Math", {0: place.outputs[axis], 1: 2.0}, operation='POWER')
               for axis in "XY"]
    radius = nodes.add("Math", {0: nodes.add("Math", {0: squares[0], 1: squares[1]},
                                             operation='ADD'), 1: 0.5}, operation='POWER')
    gold = None
    for middle, half in ((0.0866, 0.0009), (0.0815, 0.0004), (0.0575, 0.0004)):
        line = nodes.add("Math", {0: radius, 1: middle, 2: half}, operation='COMPARE')
        gold = line if gold is None else nodes.add("Math", {0: gold, 1: line},
                                                   operation='MAXIMUM')
    glaze = nodes.add("BsdfPrincipled", {"Base Color": (0.80, 0.80, 0.76), "Roughness": 0.08,
                                         "Clearcoat": 0.5})
    rim = nodes.add("BsdfPrincipled", {"Base Color": (0.83, 0.60, 0.28), "Metallic": 1.0,
                                       "Roughness": 0.24})
    nodes.surface(nodes.add("MixShader", {0: gold, 1: glaze, 2: rim}))
    return material


def biscuit():
    """Butter yellow, browned where the mesh says `toast`, with a crumb."""
    material, nodes = parts.new_material("Biscuit")
    crumb = nodes.add("TexNoise", {"Vector": nodes.add("TexCoord").outputs["Object"],
                                   "Scale": 330.0, "Detail": 6.0, "Roughness": 0.7})
    toast = nodes.add("Attribute", attribute_name="toast").outputs["Fac"]
    baked = nodes.add("Math", {0: crumb, 1: 0.35, 2: toast}, operation='MULTIPLY_ADD')
    ramp = nodes.add("ValToRGB", {"Fac": baked})
    first, last = ramp.color_ramp.elements
    first.position, first.color = 0.10, (0.72, 0.46, 0.20, 1.0)
    last.position, last.color = 1.10, (0.30, 0.115, 0.030, 1.0)
    relief = nodes.add("Bump", {"Strength": 0.5, "Distance": 0.0007, "Height": crumb})
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": ramp, "Roughness": 0.62,
                                               "Specular": 0.3, "Normal": relief}))
    return material
