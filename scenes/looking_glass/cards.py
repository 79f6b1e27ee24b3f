# SPDX-License-Identifier: GPL-3.0-or-later
"""Playing cards: a pack that slipped from a hand, and what the dream makes of it."""

import math

import bpy
import parts
import shapes
from mathutils import Vector
from parts import degrees

from .fallen import CARDS
from .layout import CARD, CARD_THICKNESS, seen_at

# Local to a soldier, in metres before scaling; he looks towards +Y.
CARD_LIFT = 0.034
MARCH = [(-0.265, -0.78, 1.30, 5), (-0.270, -1.05, 1.38, 2), (-0.275, -1.36, 1.46, 7),
         (-0.282, -1.72, 1.54, 5), (-0.290, -2.15, 1.62, 2)]


def build(looks):
    fallen_pack(looks)
    soldiers(looks)
    flying_cards(looks)


def make_card(looks, face, location, rotation):
    outline = shapes.rounded_rectangle(*CARD, 0.004)
    return shapes.outline("Card", outline, CARD_THICKNESS,
                          [looks.card_faces[face], looks.card_back, looks.card_edge], CARD,
                          location=location, rotation=rotation)


def fallen_pack(looks):
    """Where the physics left them; on this side only: behind the mirror they are up and about."""
    faces = sorted(looks.card_faces)
    cards = [make_card(looks, faces[(3 * k + 1) % len(faces)], place, turn)
             for k, (place, turn) in enumerate(CARDS)]
    # One stands against the foot of the frame.
    cards.append(make_card(looks, "hearts_1", (0.150, -0.0440, 0.0400),
                           degrees(-117, 0, 5)))
    parts.keep_on_this_side(*cards)


def flying_cards(looks):
    """The rest of the pack, in the air behind the mirror: a ribbon that rises over the rabbit."""
    faces = sorted(looks.card_faces)
    for k in range(9):
        t = k / 8.0
        angle = degrees(-12.0 + 128.0 * t)
        place = seen_at(0.055 + 0.165 * math.cos(angle), 0.235 + 0.155 * math.sin(angle),
                        -0.50 - 0.55 * t)
        turn = degrees(78 + 22 * math.sin(2.3 * k), 25 * math.cos(1.7 * k), 180 + 32 * math.sin(1.9 * k))
        parts.send_behind_mirror(make_card(looks, faces[(3 * k) % len(faces)], place, turn))


# --------------------------------------------------------------------------------- soldiers

def soldiers(looks):
    for rank, (x, y, size, pips) in enumerate(MARCH):
        root = bpy.data.objects.new("Soldier", None)
        bpy.context.scene.collection.objects.link(root)
        root.location = (x, y, 0.0)
        root.rotation_euler = degrees(0, 0, -10)
        root.scale = (size, size, size)
        pieces = soldier(looks, f"clubs_{pips}", stride=1.0 if rank % 2 else -1.0)
        for piece in pieces:
            piece.parent = root
        parts.send_behind_mirror(*pieces)


def soldier(looks, face, stride):
    """A card with head, limbs and a pike, in mid step."""
    middle = Vector((0.0, 0.0, CARD_LIFT + CARD[1] / 2.0))
    top = CARD_LIFT + CARD[1]
    body = make_card(looks, face, middle, degrees(90, 0, 180))
    body.scale = (1.0, 1.0, 2.5)
    pieces = [body]
    for side in (-1.0, 1.0):
        swing = 0.020 * side * stride
        hip = Vector((side * 0.014, 0.0, CARD_LIFT + 0.002))
        knee = hip + Vector((side * 0.002, 0.55 * swing + 0.004, -0.017))
        ankle = Vector((side * 0.016, swing, 0.004))
        pieces.append(limb(looks, "Leg", (hip, knee, ankle), 0.0030))
        shoe = shapes.sphere("Shoe", 0.005, looks.ebony, 20,
                             location=ankle + Vector((0, 0.004, 0)))
        shoe.scale = (0.8, 1.7, 0.75)
        pieces.append(shoe)
    pieces += pike_arm(looks, top) + free_arm(looks, top, stride)
    return pieces + head(looks, top)


def limb(looks, name, points, radius):
    return shapes.wire(name, list(points), [radius, radius * 1.1, radius * 0.8], looks.hose)


def pike_arm(looks, top):
    hand = Vector((0.048, 0.016, top - 0.040))
    shoulder = Vector((0.031, 0.0, top - 0.012))
    elbow = Vector((0.050, -0.002, top - 0.032))
    foot, tip = hand + Vector((0.006, 0.004, -0.075)), hand + Vector((-0.008, -0.006, 0.110))
    pike = shapes.wire("Pike", [foot, tip], 0.0014, looks.walnut, smooth=False)
    blade = shapes.lathe("Blade", [(0.0, -0.006), (0.0022, -0.004), (0.0022, 0.0), (0.0058, 0.004),
                                   (0.0, 0.026)], looks.old_gold, 24, location=tip,
                         rotation=(tip - foot).to_track_quat('Z', 'Y').to_euler())
    return [limb(looks, "Arm", (shoulder, elbow, hand), 0.0026), pike, blade,
            shapes.sphere("Hand", 0.0042, looks.skin, 20, location=hand)]


def free_arm(looks, top, stride):
    shoulder = Vector((-0.031, 0.0, top - 0.012))
    elbow = shoulder + Vector((-0.014, 0.004 * stride, -0.019))
    hand = elbow + Vector((0.001, 0.016 * stride, -0.020))
    return [limb(looks, "Arm", (shoulder, elbow, hand), 0.0026),
            shapes.sphere("Hand", 0.0042, looks.skin, 20, location=hand)]


def head(looks, top):
    """Face, ruff and a flat cap with a plume."""
    centre = Vector((0.0, 0.001, top + 0.014))
    face = shapes.sphere("Head", 0.0105, looks.skin, 32, location=centre)
    face.scale = (0.92, 0.95, 1.12)
    ruff = shapes.lathe("Ruff", shapes.smooth_profile(
        [(0.0, -0.002), (0.010, -0.003), (0.0145, 0.0), (0.010, 0.003), (0.0, 0.002)]),
        looks.card_edge, 48, location=(0.0, 0.0, top + 0.003))
    cap = shapes.lathe("Cap", shapes.smooth_profile(
        [(0.0, 0.0), (0.012, -0.001), (0.0125, 0.002), (0.0105, 0.003), (0.0135, 0.009),
         (0.010, 0.012), (0.0, 0.0125)]), looks.carmine, 48,
        location=centre + Vector((0, 0, 0.006)), rotation=degrees(-6, 8, 0))
    plume = shapes.wire("Plume", [centre + Vector((0.009, -0.002, 0.012)),
                                  centre + Vector((0.014, -0.010, 0.030)),
                                  centre + Vector((0.010, -0.024, 0.026))],
                        [0.0012, 0.0034, 0.0006], looks.old_gold)
    eyes = [shapes.sphere("Eye", 0.0014, looks.ebony, 16,
                          location=centre + Vector((side * 0.0038, 0.0092, 0.0015)))
            for side in (-1, 1)]
    nose = shapes.sphere("Nose", 0.0020, looks.skin, 16,
                         location=centre + Vector((0, 0.0105, -0.0015)))
    return [face, ruff, cap, plume, nose] + eyes
