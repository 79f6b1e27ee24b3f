# SPDX-License-Identifier: GPL-3.0-or-later
"""Small scenes, each of which shows one feature; `./tenniel gallery` renders them all.

Every builder takes nothing, fills the empty scene and is a few lines long: what it shows is in
them, and what all share is in stage.py. A new one is a function with `@exhibit` before it.
"""

from typing import Callable, NamedTuple


class Exhibit(NamedTuple):
    """name: of the file. title, text: for the page. in_cycles: whether Cycles can show it too."""
    name: str
    title: str
    text: str
    build: Callable
    samples: int = 64
    in_cycles: bool = True


EXHIBITS = []


def exhibit(title, text, **others):
    """Puts the function that follows into the gallery, under its own name."""
    def register(build):
        EXHIBITS.append(Exhibit(build.__name__, title, text, build, **others))
        return build
    return register
