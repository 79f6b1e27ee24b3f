# SPDX-License-Identifier: GPL-3.0-or-later
"""Where things stand. x is to the right, y away from the camera, z up; the table top is z = 0 and
the mirror stands at y = 0. What is seen in it lies at negative y, towards the camera and past it.
Plain numbers: the physics run (drop.py) reads them too."""

OPENING = (0.50, 0.37)                 # the glass, width and height
FRAME_WIDTH = 0.05
MIRROR_LEAN = 3.0                      # degrees

CARD = (0.064, 0.090)
CARD_THICKNESS = 0.0005

WHITE_QUEEN = (-0.120, -0.235)
DARK_QUEEN = (-0.020, -0.170)
QUEEN_RADIUS = 0.024
BOTTLE = (-0.345, -0.215)
BOTTLE_RADIUS = 0.034
CANDLE = (-0.262, -0.095)
CANDLE_RADIUS = 0.043
PLATE = (0.290, -0.200)
PLATE_RADIUS = 0.088
PLATE_PROFILE = [(0.0, 0.002), (0.048, 0.002), (0.048, 0.002), (0.052, 0.0), (0.055, 0.0),
                 (0.056, 0.002), (0.066, 0.0065), (0.086, 0.0120), (0.088, 0.0127),
                 (0.0872, 0.0136), (0.066, 0.0088), (0.055, 0.0046), (0.050, 0.0040),
                 (0.050, 0.0040), (0.0, 0.0038)]
BISCUIT = (0.068, 0.048, 0.0078)
PHOTOGRAPH = (0.415, -0.035)

# The camera, mirrored in the glass: whoever stands here sees the dream as the picture shows it.
EYE = (0.17, 1.76, 0.256)


def seen_at(across, height, y):
    """The place at depth `y` that is seen at this point of the glass: `across` from its middle,
    `height` above the table."""
    away = (EYE[1] - y) / EYE[1]
    return EYE[0] + (across - EYE[0]) * away, y, EYE[2] + (height - EYE[2]) * away
