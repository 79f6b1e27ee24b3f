# SPDX-License-Identifier: GPL-3.0-or-later
"""What an object is to the magic mirror: its tags, and what follows from them.

Export and panels both ask here, so that what is shown is what is rendered. Works on anything
that looks like a Blender object; `bpy` is not needed.
"""

from typing import Any, FrozenSet, NamedTuple

MAX_DREAMS = 4
THIS_WORLD = 0
ALL_DREAMS = frozenset(range(1, MAX_DREAMS + 1))
ALL_WORLDS = ALL_DREAMS | {THIS_WORLD}

# Custom properties on an object, for scripts and imported files; any true value counts.
LOOKING_GLASS_PROPERTY = 'looking_glass'
BEHIND_MIRROR_PROPERTY = 'behind_mirror'


class MirrorTags(NamedTuple):
    """The tags in force on an object.

    dream: the world (1..4) a looking glass opens.
    entry: 'REFLECTION', 'TRANSMISSION' or 'BOTH'. reenter: 'STAY' or 'TOGGLE'.
    side: 'BOTH', 'BEHIND' or 'THIS_SIDE'.
    dreams: the dreams (1..4) a 'BEHIND' object exists in, never empty.
    behind_material: bpy Material that replaces all slots in the dreams, or None.
    from_custom_property: names of the custom properties that set something the panel did not.
    """
    looking_glass: bool = False
    dream: int = 1
    entry: str = 'REFLECTION'
    reenter: str = 'STAY'
    first_seen_only: bool = False
    side: str = 'BOTH'
    dreams: FrozenSet[int] = ALL_DREAMS
    behind_material: Any = None
    from_custom_property: FrozenSet[str] = frozenset()


def effective_tags(obj):
    """MirrorTags of an object (original or evaluated).

    A custom property adds a tag and never takes one away: `behind_mirror` on an object whose
    panel says *This Side* is overruled, because that choice was made by hand.
    """
    tags = _panel_tags(getattr(obj, 'tenniel', None))
    in_force = set()
    if not tags.looking_glass and _is_true(obj, LOOKING_GLASS_PROPERTY):
        tags = tags._replace(looking_glass=True)
        in_force.add(LOOKING_GLASS_PROPERTY)
    if tags.side == 'BOTH' and _is_true(obj, BEHIND_MIRROR_PROPERTY):
        tags = tags._replace(side='BEHIND')
        in_force.add(BEHIND_MIRROR_PROPERTY)
    return tags._replace(from_custom_property=frozenset(in_force)) if in_force else tags


def with_instancer(tags, instancer_tags):
    """Tags of an instance: its own object's, but on the side of its instancer if that takes one."""
    if instancer_tags.side == 'BOTH':
        return tags
    return tags._replace(side=instancer_tags.side, dreams=instancer_tags.dreams)


def worlds(tags):
    """Worlds (frozenset of 0..4) in which an object with these tags exists."""
    if tags.side == 'BEHIND':
        return tags.dreams
    if tags.side == 'THIS_SIDE':
        return frozenset({THIS_WORLD})
    return ALL_WORLDS


def is_tagged(tags):
    """Whether these tags make the object differ from an ordinary one."""
    return tags.looking_glass or tags.side != 'BOTH' or tags.behind_material is not None


def tagged_objects(objects):
    """(object, MirrorTags) of those that are tagged, in the order given."""
    pairs = ((obj, effective_tags(obj)) for obj in objects)
    return [(obj, tags) for obj, tags in pairs if is_tagged(tags)]


def _panel_tags(settings):
    if settings is None:
        return MirrorTags()
    return MirrorTags(
        looking_glass=settings.looking_glass,
        dream=settings.dream,
        entry=settings.entry,
        reenter=settings.reenter,
        first_seen_only=settings.first_seen_only,
        side=settings.side,
        dreams=frozenset(int(name) for name in settings.dreams) or ALL_DREAMS,
        behind_material=settings.behind_material,
    )


def _is_true(obj, name):
    value = obj.get(name)
    # An array property counts by its elements: a vector of zeros is not a "yes".
    if hasattr(value, 'to_list'):
        return any(value.to_list())
    return bool(value)
