# SPDX-License-Identifier: GPL-3.0-or-later
"""Exhibits of light below surfaces, lit from behind. Radii are in metres: the pawns are large."""

import parts

from . import exhibit, stage


def against_the_light(width, height):
    stage.sweep("Backdrop", parts.diffuse("Backdrop", (0.12, 0.12, 0.13)))
    parts.set_world_color((0.55, 0.62, 0.72), 0.18)
    parts.area_light("Behind", (1.6, 2.2, 2.6), (0.0, 0.0, 0.6), (1.2, 1.2), power=420.0,
                     color=(1.0, 0.92, 0.82))
    parts.area_light("Key", (-3.2, -3.4, 3.6), (0.0, 0.0, 0.4), (1.6, 1.6), power=90.0)
    stage.view(width, height, 0.16)


def wax(method):
    """Principled, so that it has a polish."""
    return parts.shader(f"Wax {method}", "BsdfPrincipled", {
        "Base Color": (0.85, 0.55, 0.35), "Subsurface": 1.0, "Roughness": 0.35,
        "Subsurface Color": (0.85, 0.55, 0.35), "Subsurface Radius": (0.30, 0.10, 0.05)},
        subsurface_method=method)


@exhibit("Wax", "Light that enters and leaves elsewhere: by the profile of Christensen and Burley, "
                "and by random walks of fixed and of scaled radius.")
def wax_by_method():
    against_the_light(3.0, 0.62)
    for method, x in zip(("BURLEY", "RANDOM_WALK_FIXED_RADIUS", "RANDOM_WALK"), stage.row(3, 1.0)):
        stage.pawn(wax(method), x)


@exhibit("Jade", "The same stone with radii of two, six and twenty centimetres, in a pawn "
                 "that is a metre and a quarter high.")
def jade():
    against_the_light(3.0, 0.62)
    for length, x in zip((0.02, 0.06, 0.20), stage.row(3, 1.0)):
        stage.pawn(parts.shader(f"Jade {length}", "BsdfPrincipled", {
            "Base Color": (0.35, 0.70, 0.45), "Subsurface": 1.0, "Roughness": 0.12,
            "Subsurface Color": (0.35, 0.70, 0.45),
            "Subsurface Radius": (0.7 * length, length, 0.6 * length)}), x)
