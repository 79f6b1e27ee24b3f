# SPDX-License-Identifier: GPL-3.0-or-later
"""A still life before a looking glass, and the dream behind it, after the story.

On this side a table, as an afternoon left it: a pack of cards let slip, a bottle, biscuits, two
chess queens, a candle that is not lit, the portrait of a rabbit. In the glass the table ends in a
chessboard that runs to the hills; the candle burns there, the dark queen is red, the cards march,
and the rabbit has stepped out of his engraving. Each module here builds one thing.
"""

import parts

from . import (biscuits, bottle, candle, cards, chess, dream, garden, light, mirror, portrait,
               rabbit, room)
from .looks import Looks

SAMPLES = 160                           # a first picture; README.md's has 512


def build(scene, evening=False, dreaming=True):
    """`evening` lights candles; without `dreaming` the glass is a mirror like any other."""
    parts.render_settings(scene, 1280, 720, samples=SAMPLES, volume_bounces=4,
                          sample_clamp_indirect=3.0)
    parts.camera((0.17, -1.75, 0.44), (0.015, 0.0, 0.192), focal_length=54.0, f_stop=18.0,
                 focus=(0.0, 0.15, 0.2))
    looks = Looks()
    light.build(scene, evening)
    room.build(looks)
    if not dreaming:
        room.build_opposite(looks)
    mirror.build(looks, dreaming)
    candle.build(looks, lit=evening)
    chess.build(looks)
    cards.build(looks)
    bottle.build(looks)
    biscuits.build(looks)
    portrait.build(looks)
    dream.build(looks)
    garden.build(looks)
    rabbit.build(looks)
