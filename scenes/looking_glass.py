# SPDX-License-Identifier: GPL-3.0-or-later
"""A still life before a mirror, and the country behind it.

On this side: a table, a card house, a black pawn, a candle that is not lit. In the mirror the
table ends in a chessboard that runs to the horizon; the pawn is a white queen, the candle burns,
the card house has flown apart, and a rabbit looks out at us among mushrooms and butterflies.

x is to the right, y away from the camera, z up; the table top is z = 0 and the mirror stands at
y = 0. What is seen in it lies at negative y, towards the camera and past it.
"""

import math

import bmesh
import bpy
from mathutils import Euler, Vector

import parts
import shapes
from parts import degrees

OPENING = (0.50, 0.37)                 # the glass, width and height
FRAME_WIDTH = 0.05
CARD = (0.064, 0.090)
BOARD_SQUARE = 0.13


def build(scene):
    parts.render_settings(scene, 1280, 720, samples=256)
    parts.set_world_hdri("sunrise", strength=0.6, turn=degrees(24))
    parts.area_light("Window", (-1.0, -0.75, 1.0), (0.0, -0.1, 0.1), (0.55, 0.45), power=22.0,
                     color=(1.0, 0.86, 0.70))
    scene.view_settings.look = 'Medium High Contrast'
    parts.camera((0.17, -1.35, 0.262), (0.005, 0.0, 0.208), focal_length=45.5, f_stop=9.0,
                 focus=(0.0, 0.4, 0.2))

    looks = Looks()
    build_room(looks)
    build_mirror(looks)
    build_candle(looks)
    build_chess_swap(looks)
    build_card_house(looks)
    build_goblet(looks)
    build_dream_country(looks)
    build_rabbit(looks)
    build_mushrooms(looks)
    build_great_chessmen(looks)
    build_flying_cards(looks)
    build_butterflies(looks)


# --------------------------------------------------------------------------------- materials

class Looks:
    """The materials, each made once."""

    def __init__(self):
        self.table = wood("Table wood", scale=1.9)
        self.walnut = wood("Walnut", scale=5.0, tint=(0.60, 0.48, 0.42))
        self.wallpaper = wallpaper()
        self.mirror = parts.shader("Mirror", "BsdfGlossy", {"Color": (0.97, 0.975, 0.97),
                                                           "Roughness": 0.0}, distribution='SHARP')
        self.brass = parts.principled("Brass", (0.88, 0.62, 0.28), 0.22, metallic=1.0)
        self.old_gold = parts.principled("Old gold", (0.75, 0.52, 0.24), 0.34, metallic=1.0)
        self.wax = parts.principled("Wax", (0.84, 0.78, 0.64), 0.45, specular=0.4)
        self.wick = parts.diffuse("Wick", (0.02, 0.02, 0.02))
        self.glass = parts.shader("Glass", "BsdfGlass", {"Roughness": 0.0, "IOR": 1.5},
                                  distribution='SHARP')
        self.wine = parts.shader("Wine", "BsdfGlass", {"Color": (0.55, 0.02, 0.05), "IOR": 1.34,
                                                      "Roughness": 0.0}, distribution='SHARP')
        self.ebony = parts.principled("Ebony", (0.012, 0.010, 0.010), 0.18, clearcoat=0.6)
        self.ivory = parts.principled("Ivory", (0.82, 0.76, 0.62), 0.22, clearcoat=0.5)
        self.carmine = parts.principled("Carmine", (0.45, 0.025, 0.03), 0.2, clearcoat=0.7)
        self.paper = parts.diffuse("Card edge", (0.85, 0.82, 0.75))
        self.card_back = printed("card_back")
        self.card_faces = [printed("card_heart"), printed("card_spade")]
        self.fur = parts.principled("Fur", (0.86, 0.84, 0.81), 0.8, specular=0.15, sheen=0.8)
        self.eye = parts.principled("Eye", (0.06, 0.012, 0.012), 0.06)
        self.nose = parts.principled("Nose", (0.75, 0.35, 0.34), 0.4)
        self.stalk = parts.principled("Stalk", (0.80, 0.72, 0.58), 0.6)
        self.cap = parts.principled("Cap", (0.62, 0.035, 0.02), 0.28, clearcoat=0.4)
        self.spot = parts.principled("Spot", (0.88, 0.83, 0.74), 0.6)


def wood(name, scale, tint=(1.0, 1.0, 1.0)):
    """Painted boards with their roughness and normals; `scale` is repeats per metre."""
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
    relief = nodes.add("NormalMap", {"Strength": 0.7, "Color": normals})
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": color, "Roughness": roughness,
                                               "Normal": relief, "Clearcoat": 0.25}))
    return material


def wallpaper():
    material, nodes = parts.new_material("Wallpaper")
    mapping = nodes.add("Mapping", {"Vector": nodes.add("TexCoord").outputs["UV"],
                                    "Scale": (15.0, 7.5, 1.0)})
    picture = nodes.picture("wallpaper")
    nodes.connect(picture.inputs["Vector"], mapping)
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": picture, "Roughness": 0.55,
                                               "Specular": 0.3}))
    return material


def printed(picture_name):
    material, nodes = parts.new_material(picture_name.replace("_", " ").capitalize())
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": nodes.picture(picture_name),
                                               "Roughness": 0.4, "Specular": 0.35}))
    return material


# -------------------------------------------------------------------------- room and mirror

def build_room(looks):
    shapes.box("Table", (1.9, 0.95, 0.04), looks.table, bevel=0.006,
               location=(0.0, -0.095, -0.02))
    shapes.plane("Wall", (3.0, 1.5), looks.wallpaper, location=(0.0, 0.42, 0.5),
                 rotation=degrees(90, 0, 0))


def build_mirror(looks):
    """The glass and its carved frame hang on one empty, which leans back a little."""
    stand = bpy.data.objects.new("Mirror", None)
    bpy.context.scene.collection.objects.link(stand)
    stand.location = (0.0, 0.0, FRAME_WIDTH + OPENING[1] / 2.0)
    stand.rotation_euler = degrees(-0.6, 0, 0)

    glass = shapes.plane("Looking glass", OPENING, looks.mirror, location=(0.0, -0.004, 0.0),
                         rotation=degrees(90, 0, 0))
    parts.make_looking_glass(glass)
    profile = shapes.smooth_profile(
        [(-0.003, -0.012), (-0.003, 0.004), (-0.003, 0.004), (0.002, 0.010), (0.007, 0.006),
         (0.007, 0.006), (0.013, 0.009), (0.022, 0.021), (0.033, 0.025), (0.042, 0.020),
         (0.046, 0.013), (0.046, 0.013), (0.050, 0.011), (0.050, -0.012)], steps=4)
    pieces = [glass, shapes.frame("Frame", OPENING, profile, looks.walnut),
              shapes.box("Mirror back", (0.59, 0.006, 0.46), looks.walnut,
                         location=(0.0, 0.012, 0.0))]
    pieces += frame_beads(looks) + frame_rosettes(looks)
    for piece in pieces:
        piece.parent = stand


def frame_beads(looks):
    """A row of beads around the opening; one mesh, many objects."""
    bead = shapes.sphere("Bead", 0.0042, looks.old_gold, segments=16)
    spots = around_opening(0.0045, 0.0107)
    bead.location = (spots[0][0], -0.0085, spots[0][1])
    return [bead] + [shapes.copy_of(bead, (x, -0.0085, z)) for x, z in spots[1:]]


def frame_rosettes(looks):
    """Carved flowers along the frame and brass rosettes on its corners."""
    half_width = OPENING[0] / 2.0 + 0.5 * FRAME_WIDTH + 0.002
    half_height = OPENING[1] / 2.0 + 0.5 * FRAME_WIDTH + 0.002
    corner = shapes.rosette("Corner", 0.034, 8, 0.015, looks.brass,
                            location=(-half_width, -0.020, -half_height))
    made = [corner]
    made += [shapes.copy_of(corner, (sx * half_width, -0.020, sz * half_height))
             for sx, sz in ((1, -1), (1, 1), (-1, 1))]
    flower = None
    for x, z in around_opening(0.031, 0.0465):
        if abs(x) > half_width - 0.045 and abs(z) > half_height - 0.045:
            continue
        if flower is None:
            flower = shapes.rosette("Flower", 0.0135, 6, 0.006, looks.old_gold)
            flower.location = (x, -0.024, z)
            made.append(flower)
        else:
            made.append(shapes.copy_of(flower, (x, -0.024, z)))
    made.append(shapes.rosette("Crest", 0.044, 12, 0.022, looks.brass,
                               location=(0.0, -0.018, half_height + 0.016)))
    return made


def around_opening(outwards, spacing):
    """Points (x, z) at even steps around the opening, `outwards` from its edge."""
    half_width, half_height = OPENING[0] / 2.0 + outwards, OPENING[1] / 2.0 + outwards
    points = []
    for half, other, swap in ((half_width, half_height, False), (half_height, half_width, True)):
        count = round(2.0 * half / spacing)
        for k in range(count if not swap else count - 1):
            t = -half + 2.0 * half * (k + (0.0 if not swap else 1.0)) / count
            points += [(other, t), (-other, t)] if swap else [(t, other), (-t, -other)]
    return points


# ------------------------------------------------------------------------------- still life

def build_candle(looks):
    """A candle that burns behind the mirror only: flame and light belong to the dream."""
    x, y = -0.245, -0.17
    profile = shapes.smooth_profile(
        [(0.0, 0.0), (0.0, 0.0), (0.042, 0.0), (0.042, 0.0), (0.043, 0.006), (0.034, 0.011),
         (0.013, 0.018), (0.008, 0.030), (0.014, 0.044), (0.008, 0.056), (0.006, 0.085),
         (0.011, 0.102), (0.007, 0.112), (0.020, 0.124), (0.021, 0.128), (0.021, 0.128),
         (0.012, 0.128), (0.012, 0.128), (0.0, 0.126)])
    shapes.lathe("Candlestick", profile, looks.brass, location=(x, y, 0.0))
    wax = [(0.0, 0.0), (0.0102, 0.0), (0.0100, 0.11), (0.0094, 0.1125), (0.006, 0.1105),
           (0.0, 0.110)]
    shapes.lathe("Candle", wax, looks.wax, location=(x, y, 0.127))
    shapes.lathe("Wick", [(0.0, 0.0), (0.0008, 0.0), (0.0006, 0.010), (0.0, 0.0102)], looks.wick,
                 segments=12, location=(x, y, 0.2365))
    flame = shapes.lathe(
        "Flame", shapes.smooth_profile([(0.0, 0.0), (0.0045, 0.006), (0.0055, 0.012),
                                        (0.0035, 0.024), (0.0, 0.036)]),
        parts.emission("Flame", (1.0, 0.50, 0.14), 28.0), segments=24, location=(x, y, 0.242))
    glow = parts.point_light("Candle light", (x, y, 0.30), 0.012, power=1.2,
                             color=(1.0, 0.58, 0.24))
    parts.send_behind_mirror(flame, glow)


PAWN = [(0.0, 0.0), (0.0, 0.0), (0.0175, 0.0), (0.0175, 0.0), (0.0180, 0.005), (0.0150, 0.008),
        (0.0150, 0.008), (0.0110, 0.013), (0.0075, 0.022), (0.0060, 0.033), (0.0065, 0.037),
        (0.0065, 0.037), (0.0110, 0.0385), (0.0110, 0.0405), (0.0065, 0.042), (0.0065, 0.042),
        (0.0100, 0.0475), (0.0108, 0.053), (0.0085, 0.0600), (0.0, 0.0635)]
QUEEN = [(0.0, 0.0), (0.0, 0.0), (0.0215, 0.0), (0.0215, 0.0), (0.0220, 0.006), (0.0180, 0.010),
         (0.0180, 0.010), (0.0165, 0.015), (0.0110, 0.023), (0.0080, 0.040), (0.0068, 0.064),
         (0.0075, 0.071), (0.0075, 0.071), (0.0135, 0.0735), (0.0135, 0.0755), (0.0085, 0.078),
         (0.0085, 0.078), (0.0105, 0.085), (0.0160, 0.098), (0.0160, 0.098), (0.0130, 0.098),
         (0.0110, 0.0950), (0.0110, 0.0950), (0.0045, 0.1010), (0.0045, 0.1010), (0.0062, 0.1055),
         (0.0045, 0.1100), (0.0, 0.1118)]
ROOK = [(0.0, 0.0), (0.0, 0.0), (0.0205, 0.0), (0.0205, 0.0), (0.0210, 0.006), (0.0170, 0.010),
        (0.0170, 0.010), (0.0145, 0.017), (0.0115, 0.030), (0.0110, 0.046), (0.0120, 0.050),
        (0.0120, 0.050), (0.0165, 0.054), (0.0165, 0.054), (0.0165, 0.066), (0.0165, 0.066),
        (0.0115, 0.066), (0.0115, 0.066), (0.0110, 0.060), (0.0, 0.060)]


def build_chess_swap(looks):
    """A pawn on this side; on the same square behind the mirror, a queen."""
    place = (-0.075, -0.30, 0.0)
    pawn = shapes.lathe("Pawn", shapes.smooth_profile(PAWN), looks.ebony, location=place)
    queen = shapes.lathe("Queen", shapes.smooth_profile(QUEEN), looks.ivory, location=place)
    parts.keep_on_this_side(pawn)
    parts.send_behind_mirror(queen)


def make_card(looks, face, location, rotation):
    outline = shapes.rounded_rectangle(*CARD, 0.004)
    return shapes.outline("Card", outline, 0.0004, [looks.card_faces[face], looks.card_back,
                                                    looks.paper], CARD,
                          location=location, rotation=rotation)


def build_card_house(looks):
    """Two storeys of cards; it has no reflection."""
    x, y, lean = 0.285, -0.15, 20.0
    half_span = 0.5 * CARD[1] * math.sin(degrees(lean))
    rise = CARD[1] * math.cos(degrees(lean))
    turn = 47.0
    spot = Vector((x, y, 0.0))
    across = Euler(degrees(0, 0, turn)).to_matrix() @ Vector((1.0, 0.0, 0.0))
    cards = []

    def tent(offset, floor, faces):
        for side, face in zip((-1.0, 1.0), faces):
            centre = spot + across * (offset + side * half_span)
            centre.z = floor + 0.5 * rise
            upright = Euler((degrees(90), 0.0, degrees(90)))
            rotation = upright.to_matrix()
            rotation = Euler((0.0, degrees(-side * lean), 0.0)).to_matrix() @ rotation
            rotation = Euler((0.0, 0.0, degrees(turn))).to_matrix() @ rotation
            cards.append(make_card(looks, face, centre, rotation.to_euler()))

    tent(-2.0 * half_span, 0.0, (0, 1))
    tent(2.0 * half_span, 0.0, (1, 0))
    bridge = spot + Vector((0.0, 0.0, rise + 0.0006))
    cards.append(make_card(looks, 1, bridge, degrees(180, 0, turn + 90)))
    tent(0.0, rise + 0.001, (0, 0))
    parts.keep_on_this_side(*cards)
    for angle, face, dx, dy in ((25, 0, -0.17, -0.125), (62, 1, -0.125, -0.14)):
        make_card(looks, face, (x + dx, y + dy, 0.0006 + 0.0006 * face), degrees(0, 0, angle))


def build_goblet(looks):
    """A wine glass: outer wall, inner wall, and the wine inside a hair's breadth from it."""
    place = (-0.345, -0.06, 0.0)
    outer = [(0.0, 0.0), (0.0, 0.0), (0.034, 0.0), (0.034, 0.0), (0.034, 0.002), (0.020, 0.005),
             (0.006, 0.012), (0.0042, 0.030), (0.0042, 0.075), (0.0075, 0.085), (0.024, 0.098),
             (0.035, 0.120), (0.037, 0.145), (0.033, 0.175), (0.031, 0.188)]
    inner = [(0.031, 0.188), (0.0302, 0.1885), (0.0318, 0.175), (0.0357, 0.145), (0.0337, 0.121),
             (0.0230, 0.100), (0.0080, 0.0895), (0.0, 0.0885)]
    profile = shapes.smooth_profile(outer) + shapes.smooth_profile(inner)[1:]
    shapes.lathe("Goblet", profile, looks.glass, location=place)
    wine = shapes.smooth_profile([(0.0, 0.0888), (0.0079, 0.0898), (0.0228, 0.1003),
                                  (0.0334, 0.1213), (0.0350, 0.132)])
    shapes.lathe("Wine", wine + [(0.0, 0.132)], looks.wine, location=place)


# ------------------------------------------------------------------------ behind the mirror

def build_dream_country(looks):
    """A chessboard from the table's edge to the horizon, and hills at its end."""
    material, nodes = parts.new_material("Board")
    checker = nodes.add("TexChecker", {"Vector": nodes.add("TexCoord").outputs["Object"],
                                       "Color1": (0.62, 0.55, 0.42), "Color2": (0.10, 0.19, 0.10),
                                       "Scale": 1.0 / BOARD_SQUARE})
    nodes.surface(nodes.add("BsdfPrincipled", {"Base Color": checker, "Roughness": 0.3,
                                               "Specular": 0.4}))
    board = shapes.plane("Board", (40.0, 24.0), material, location=(0.0, -12.57, -0.001))
    parts.send_behind_mirror(board)
    meadow = parts.diffuse("Meadow", (0.10, 0.22, 0.06))
    for x, y, radius, height in ((-4.2, -15, 4.5, 0.95), (1.5, -17, 5.0, 0.7),
                                 (-1.6, -21, 5.5, 1.5)):
        hill = shapes.sphere("Hill", 1.0, meadow, location=(x, y, -0.05))
        hill.scale = (radius, radius, height)
        parts.send_behind_mirror(hill)


def build_rabbit(looks):
    """The white rabbit, facing the glass; all in centimetres, under one scaled empty."""
    body = [((side * 3.4, 3.0, 1.5), (2.0, 4.2, 1.6), None) for side in (-1, 1)]
    body += [((0, 0, 7.6), (5.6, 5.2, 7.2), None), ((0, 1.0, 13.0), (4.1, 3.8, 4.6), None),
             ((0, 2.2, 19.2), (3.9, 4.4, 3.8), None), ((0, 5.4, 18.2), (2.2, 1.9, 1.7), None),
             ((0, -5.6, 5.0), (2.2, 2.2, 2.2), None)]
    for side in (-1, 1):
        body.append(((side * 2.4, 0.9, 26.4), (1.25, 0.75, 5.4), turned(0, side * 11, 0)))
        body.append(((side * 4.3, 3.0, 12.6), (1.4, 3.6, 1.5), turned(-32, 0, side * 18)))
    rabbit = shapes.blend_of_spheres("Rabbit", body, looks.fur, voxel=0.34)
    pieces = [rabbit]
    for side in (-1, 1):
        pieces.append(shapes.sphere("Eye", 0.62, looks.eye, 24, location=(side * 2.35, 5.05, 20.0)))
    pieces.append(shapes.sphere("Nose", 0.55, looks.nose, 24, location=(0.0, 7.15, 18.7)))
    scarf = shapes.smooth_profile([(3.0, 15.0), (4.3, 14.9), (4.7, 15.8), (4.2, 16.7), (3.0, 16.6)])
    pieces.append(shapes.lathe("Scarf", scarf, looks.carmine, location=(0.0, 1.5, 0.0),
                               rotation=degrees(-8, 0, 0)))
    pieces.append(shapes.lathe("Watch", [(0.0, -0.25), (1.5, -0.25), (1.7, 0.0), (1.5, 0.25),
                                         (0.0, 0.25)], looks.brass, location=(2.6, 6.3, 12.2),
                               rotation=degrees(80, 0, -20)))
    root = bpy.data.objects.new("Rabbit root", None)
    bpy.context.scene.collection.objects.link(root)
    root.location = (0.035, -0.98, 0.0)
    root.rotation_euler = degrees(0, 0, 10)
    root.scale = (0.0115, 0.0115, 0.0115)
    for piece in pieces:
        piece.parent = root
    parts.send_behind_mirror(*pieces)


def turned(*angles):
    return Euler(degrees(*angles)).to_quaternion()


def build_mushrooms(looks):
    """(x, y, height) of each; caps carry spots on a golden spiral."""
    for x, y, height in ((-0.62, -1.75, 0.56), (0.27, -2.3, 0.62), (-0.30, -1.32, 0.17),
                         (-0.40, -1.22, 0.10), (0.205, -1.12, 0.13), (-1.25, -3.4, 0.95),
                         (0.17, -1.02, 0.075)):
        build_mushroom(looks, (x, y, 0.0), height)


def build_mushroom(looks, location, height):
    """Proportions for a height of one, then scaled."""
    stalk = shapes.lathe("Stalk", shapes.smooth_profile(
        [(0.0, 0.0), (0.15, 0.0), (0.14, 0.10), (0.09, 0.35), (0.075, 0.65), (0.09, 0.74),
         (0.0, 0.76)]), looks.stalk, location=location)
    cap = shapes.lathe("Cap", shapes.smooth_profile(
        [(0.0, 0.70), (0.10, 0.70), (0.36, 0.66), (0.43, 0.67), (0.42, 0.74), (0.33, 0.87),
         (0.18, 0.97), (0.0, 1.0)]), looks.cap, location=location)
    made = [stalk, cap]
    spot = None
    for k in range(22):
        angle, t = k * math.pi * (3.0 - math.sqrt(5.0)), math.sqrt((k + 0.5) / 22)
        radius = 0.41 * t
        z = 1.0 - 0.9 * radius ** 2 - 3.2 * radius ** 4
        local = Vector((radius * math.cos(angle), radius * math.sin(angle), z))
        outwards = Vector((local.x, local.y, 0.25)).to_track_quat('Z', 'Y').to_euler()
        where = Vector(location) + local * height
        if spot is None:
            spot = shapes.sphere("Spot", 0.042, looks.spot, 20, location=where, rotation=outwards)
            spot.scale = (1.0, 1.0, 0.3)
            made.append(spot)
        else:
            made.append(shapes.copy_of(spot, where, outwards, 0.6 + 0.4 * math.cos(2.3 * k)))
    for piece in made:
        piece.scale = [height * s for s in piece.scale]
    parts.send_behind_mirror(*made)


def build_great_chessmen(looks):
    for name, profile, look, x, y, scale in (
            ("Red queen", QUEEN, looks.carmine, -0.63, -2.6, 5.0),
            ("White rook", ROOK, looks.ivory, -0.28, -2.75, 6.0),
            ("Red pawn", PAWN, looks.carmine, -0.45, -1.85, 2.7),
            ("White queen", QUEEN, looks.ivory, 0.43, -4.2, 7.0),
            ("Black rook", ROOK, looks.ebony, -0.95, -4.6, 7.5)):
        man = shapes.lathe(name, shapes.smooth_profile(profile), look, location=(x, y, 0.0))
        man.scale = (scale, scale, scale)
        parts.send_behind_mirror(man)


def build_flying_cards(looks):
    """What has become of the card house."""
    for face, location, rotation in (
            (0, (0.20, -0.52, 0.275), (70, 15, 160)), (1, (0.255, -0.80, 0.36), (105, -20, 200)),
            (0, (0.10, -0.95, 0.45), (60, 30, 150)), (1, (0.17, -0.62, 0.17), (80, -35, 215)),
            (0, (-0.12, -1.3, 0.50), (75, 40, 190)), (1, (0.30, -1.25, 0.28), (110, 10, 165))):
        parts.send_behind_mirror(make_card(looks, face, location, degrees(*rotation)))


def build_butterflies(looks):
    colors = ((0.10, 0.32, 0.95), (1.0, 0.48, 0.05), (0.85, 0.10, 0.50))
    meshes = [butterfly_mesh(f"Butterfly {k + 1}", wing(f"Wing {k + 1}", color), looks.ebony)
              for k, color in enumerate(colors)]
    for kind, location, turn in ((0, (-0.30, -0.80, 0.36), 30), (1, (-0.145, -0.62, 0.315), -40),
                                 (2, (-0.42, -1.05, 0.30), 75), (0, (0.00, -1.15, 0.47), -20),
                                 (1, (-0.52, -1.35, 0.55), 10), (2, (0.13, -0.72, 0.385), 50),
                                 (1, (-0.10, -0.62, 0.17), 120)):
        item = shapes.add_object(meshes[kind].name, meshes[kind], None, location,
                                 degrees(62, 12 * kind - 12, turn))
        parts.send_behind_mirror(item)


def wing(name, color):
    """Thin and lit from both sides."""
    material, nodes = parts.new_material(name)
    front = nodes.add("BsdfDiffuse", {"Color": color})
    through = nodes.add("BsdfTranslucent", {"Color": color})
    nodes.surface(nodes.add("MixShader", {0: 0.45, 1: front, 2: through}))
    return material


def butterfly_mesh(name, wing_look, body_look, fold=28.0):
    """Two pairs of wings, folded up by `fold` degrees from flat, and a body; 6 cm across."""
    builder = bmesh.new()
    layer = builder.loops.layers.uv.new("UVMap")
    upper = [(0.0, 0.002), (0.010, 0.014), (0.024, 0.024), (0.032, 0.022), (0.031, 0.010),
             (0.022, 0.001), (0.0, -0.002)]
    lower = [(0.0, -0.001), (0.018, -0.001), (0.025, -0.009), (0.021, -0.020), (0.012, -0.021),
             (0.004, -0.012), (0.0, -0.006)]
    for side in (-1.0, 1.0):
        for points in (upper, lower):
            verts = [builder.verts.new((side * x * math.cos(degrees(fold)), y,
                                        x * math.sin(degrees(fold)))) for x, y in points]
            face = builder.faces.new(verts if side > 0 else verts[::-1])
            for loop in face.loops:
                loop[layer].uv = loop.vert.co.xy * 15.0 + Vector((0.5, 0.5))
    before = len(builder.faces)
    bmesh.ops.create_uvsphere(builder, u_segments=12, v_segments=8, radius=0.0022)
    builder.faces.ensure_lookup_table()
    for face in builder.faces[before:]:
        face.material_index = 1
    for vert in {v for face in builder.faces[before:] for v in face.verts}:
        vert.co.y *= 6.0
    mesh = bpy.data.meshes.new(name)
    builder.to_mesh(mesh)
    builder.free()
    for material in (wing_look, body_look):
        mesh.materials.append(material)
    return mesh
