# SPDX-License-Identifier: GPL-3.0-or-later
"""Chessmen, turned: two queens on the table, and great ones in the dream."""

import math

import parts
import shapes

from .layout import DARK_QUEEN, WHITE_QUEEN

# (radius, height) from the foot up; a point given twice makes an edge.
PAWN = [(0.0, 0.0), (0.0, 0.0), (0.0168, 0.0), (0.0178, 0.0010), (0.0180, 0.005), (0.0150, 0.008),
        (0.0150, 0.008), (0.0110, 0.013), (0.0075, 0.022), (0.0060, 0.033), (0.0065, 0.037),
        (0.0065, 0.037), (0.0110, 0.0385), (0.0110, 0.0405), (0.0065, 0.042), (0.0065, 0.042),
        (0.0100, 0.0475), (0.0108, 0.053), (0.0085, 0.0600), (0.0, 0.0635)]
QUEEN = [(0.0, 0.0), (0.0, 0.0), (0.0222, 0.0), (0.0232, 0.0010), (0.0232, 0.0052),
         (0.0220, 0.0066), (0.0220, 0.0066), (0.0196, 0.0078), (0.0204, 0.0100), (0.0196, 0.0124),
         (0.0196, 0.0124), (0.0164, 0.0152), (0.0120, 0.0240), (0.0090, 0.0400), (0.0074, 0.0620),
         (0.0078, 0.0690), (0.0078, 0.0690), (0.0100, 0.0700), (0.0104, 0.0712), (0.0096, 0.0724),
         (0.0096, 0.0724), (0.0136, 0.0738), (0.0144, 0.0750), (0.0136, 0.0762), (0.0136, 0.0762),
         (0.0092, 0.0780), (0.0092, 0.0780), (0.0102, 0.0850), (0.0128, 0.0930), (0.0156, 0.0985),
         (0.0160, 0.0995), (0.0152, 0.1000), (0.0152, 0.1000), (0.0128, 0.0980), (0.0118, 0.0985),
         (0.0118, 0.0985), (0.0080, 0.1025), (0.0040, 0.1046), (0.0040, 0.1046), (0.0034, 0.1056),
         (0.0052, 0.1084), (0.0048, 0.1120), (0.0, 0.1140)]
ROOK = [(0.0, 0.0), (0.0, 0.0), (0.0195, 0.0), (0.0205, 0.0010), (0.0210, 0.006), (0.0170, 0.010),
        (0.0170, 0.010), (0.0145, 0.017), (0.0115, 0.030), (0.0110, 0.046), (0.0120, 0.050),
        (0.0120, 0.050), (0.0165, 0.054), (0.0165, 0.054), (0.0165, 0.066), (0.0165, 0.066),
        (0.0115, 0.066), (0.0115, 0.066), (0.0110, 0.060), (0.0, 0.060)]


def build(looks):
    queen("White queen", looks.marble, (*WHITE_QUEEN, 0.0))
    dark = queen("Dark queen", looks.dark_marble, (*DARK_QUEEN, 0.0))
    red = queen("Red queen", looks.carmine, (*DARK_QUEEN, 0.0))
    parts.keep_on_this_side(*dark)
    parts.send_behind_mirror(*red)
    great_chessmen(looks)


def queen(name, look, place, scale=1.0):
    """The turned body and the pearls of her coronet."""
    body = shapes.lathe(name, shapes.smooth_profile(QUEEN), look, segments=96, location=place)
    body.scale = (scale, scale, scale)
    pearls = []
    for k in range(10):
        angle = 2.0 * math.pi * k / 10
        spot = (place[0] + scale * 0.0146 * math.cos(angle),
                place[1] + scale * 0.0146 * math.sin(angle), place[2] + scale * 0.1010)
        if not pearls:
            pearls.append(shapes.sphere("Pearl", 0.0027, look, 24, location=spot))
            pearls[0].scale = (scale, scale, scale)
        else:
            pearls.append(shapes.copy_of(pearls[0], spot))
    return [body] + pearls


def great_chessmen(looks):
    """Some of the pieces of the great game that is being played there."""
    parts.send_behind_mirror(*queen("Great red queen", looks.carmine, (-0.42, -3.6, 0.0), 6.4))
    parts.send_behind_mirror(*queen("Great white queen", looks.ivory, (0.03, -7.5, 0.0), 8.5))
    for name, profile, look, x, y, scale in (
            ("White rook", ROOK, looks.ivory, -1.60, -7.0, 9.0),
            ("Red pawn", PAWN, looks.carmine, -0.52, -2.5, 3.6)):
        man = shapes.lathe(name, shapes.smooth_profile(profile), look, location=(x, y, 0.0))
        man.scale = (scale, scale, scale)
        parts.send_behind_mirror(man)
