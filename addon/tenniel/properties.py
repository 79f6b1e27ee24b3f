# SPDX-License-Identifier: GPL-3.0-or-later
"""Every setting of Tenniel: `scene.tenniel`, `object.tenniel`, `material.tenniel`.

Scene settings carry the names of `scene.cycles` wherever they mean the same, so that scripts
and presets carry over.
"""

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)
from bpy.types import PropertyGroup

from .mirror_tags import MAX_DREAMS

_INACTIVE = "Not active in this version of Tenniel. "

_FILTERS = (
    ('BOX', "Box", "Every sample of a pixel counts the same; sharp, with visible stairs"),
    ('GAUSSIAN', "Gaussian", "Soft falloff; smooth edges, slightly blurred"),
    ('BLACKMAN_HARRIS', "Blackman-Harris", "Soft falloff with a narrow core; the usual choice"),
)

_ENTRIES = (
    ('REFLECTION', "Reflection", "What is mirrored is seen in the dream"),
    ('TRANSMISSION', "Transmission", "What is seen through the surface is in the dream: a portal"),
    ('BOTH', "Both", "Reflections and what is seen through the surface are in the dream"),
)

_REENTRIES = (
    ('STAY', "Stay", "A looking glass met inside a dream leads into its own dream"),
    ('TOGGLE', "Toggle",
     "The same looking glass met inside its own dream leads back to this side"),
)

_SIDES = (
    ('BOTH', "Both Sides", "Exists on this side and behind the mirror"),
    ('BEHIND', "Behind", "Exists only behind the mirror"),
    ('THIS_SIDE', "This Side", "Has no reflection in a looking glass"),
)

_DREAM_FLAGS = tuple(
    (str(number), str(number), f"Exists in dream {number}", 1 << (number - 1))
    for number in range(1, MAX_DREAMS + 1))

_SHUTTER_POSITIONS = (
    ('START', "Start on Frame", "The shutter opens at the frame"),
    ('CENTER', "Center on Frame", "The shutter is open around the frame"),
    ('END', "End on Frame", "The shutter closes at the frame"),
)

_MIRROR_VIEWS = (
    ('AS_RENDERED', "As Rendered", "Looking glasses show their dreams"),
    ('THIS_SIDE', "This Side", "Looking glasses are ordinary mirrors"),
) + tuple(
    (f'DREAM_{number}', f"Dream {number}", f"Show dream {number} directly, to place things in it")
    for number in range(1, MAX_DREAMS + 1))


class TennielDream(PropertyGroup):
    """A world behind looking glasses; its number is its place in the list, from 1."""
    name: StringProperty(name="Name", description="Name of the dream", default="Dream")
    world: PointerProperty(
        name="World", type=bpy.types.World,
        description="Surroundings seen in this dream; the scene's World if empty")


class TennielSceneSettings(PropertyGroup):
    samples: IntProperty(
        name="Samples", min=1, max=1 << 24, soft_max=4096, default=128,
        description="Paths traced for each pixel of the final render")
    preview_samples: IntProperty(
        name="Viewport Samples", min=0, max=1 << 24, soft_max=1024, default=32,
        description="Paths traced for each pixel of the viewport; 0 goes on without end")
    seed: IntProperty(
        name="Seed", min=0, max=(1 << 31) - 1, default=0,
        description="Pattern of the noise; the same seed gives the same picture, bit for bit")
    use_animated_seed: BoolProperty(
        name="Animate Seed", default=False,
        description="Give every frame its own noise pattern")
    time_limit: FloatProperty(
        name="Time Limit", min=0.0, default=0.0, step=100, precision=1, subtype='TIME_ABSOLUTE',
        unit='TIME_ABSOLUTE',
        description="Stop after this many seconds, export not counted, with the samples "
                    "reached; 0 is without limit")

    use_adaptive_sampling: BoolProperty(
        name="Noise Threshold", default=False,
        description=_INACTIVE + "Stops early in pixels whose noise is low enough")
    adaptive_threshold: FloatProperty(
        name="Noise Threshold", min=0.0, max=1.0, soft_min=0.001, default=0.01, precision=4,
        description=_INACTIVE + "Relative noise at which a pixel is finished; lower takes longer")
    use_denoising: BoolProperty(
        name="Denoise", default=False,
        description=_INACTIVE + "Removes the remaining noise from the finished picture")

    max_bounces: IntProperty(
        name="Total", min=0, max=1024, default=12,
        description="Bounces of a path over all kinds; a limit of a kind cannot exceed it")
    diffuse_bounces: IntProperty(
        name="Diffuse", min=0, max=1024, default=4,
        description="Bounces at matte surfaces")
    glossy_bounces: IntProperty(
        name="Glossy", min=0, max=1024, default=4,
        description="Reflections, sharp or rough")
    transmission_bounces: IntProperty(
        name="Transmission", min=0, max=1024, default=12,
        description="Refractions; glass needs two for each body light passes through")
    volume_bounces: IntProperty(
        name="Volume", min=0, max=1024, default=0,
        description="Times light may scatter inside fog and smoke beyond the first")
    transparent_max_bounces: IntProperty(
        name="Transparent", min=0, max=1024, default=8,
        description="Transparent surfaces a path may pass straight through; "
                    "they do not count as bounces")
    min_light_bounces: IntProperty(
        name="Min Light Bounces", min=0, max=1024, default=0,
        description="Bounces before a dim path may be ended by chance. More means less noise in "
                    "indirect light and a slower render; 0 decides from the first bounce on")
    sample_clamp_direct: FloatProperty(
        name="Direct Light", min=0.0, soft_max=100.0, default=0.0,
        description="Largest brightness one sample may add by direct light. "
                    "Removes fireflies and loses light; 0 is off")
    sample_clamp_indirect: FloatProperty(
        name="Indirect Light", min=0.0, soft_max=100.0, default=10.0,
        description="Largest brightness one sample may add by light that bounced. "
                    "Removes fireflies and loses light; 0 is off")
    blur_glossy: FloatProperty(
        name="Filter Glossy", min=0.0, max=10.0, default=1.0,
        description="Roughens reflections seen after a matte bounce, to lessen noise; 0 is off")
    caustics_reflective: BoolProperty(
        name="Reflective", default=True,
        description="Light thrown onto matte surfaces by mirrors and metals")
    caustics_refractive: BoolProperty(
        name="Refractive", default=True,
        description="Light thrown onto matte surfaces through glass and water")

    volume_step_rate: FloatProperty(
        name="Step Rate Render", min=0.01, max=100.0, soft_min=0.1, soft_max=10.0, default=1.0,
        description="Length of the steps through smoke and uneven fog; less shows more detail and "
                    "takes longer")
    volume_preview_step_rate: FloatProperty(
        name="Viewport", min=0.01, max=100.0, soft_min=0.1, soft_max=10.0, default=1.0,
        description="The same in the viewport")

    film_exposure: FloatProperty(
        name="Exposure", min=0.0, max=10.0, soft_min=0.0, default=1.0,
        description="Factor on the brightness of the rendered picture")
    pixel_filter_type: EnumProperty(
        name="Filter Type", items=_FILTERS, default='BLACKMAN_HARRIS',
        description="How samples around a pixel's centre are weighted")
    filter_width: FloatProperty(
        name="Width", min=0.01, max=10.0, default=1.5, subtype='PIXEL',
        description="Width of the filter in pixels; the box filter is always one pixel wide")

    motion_blur_position: EnumProperty(
        name="Position", items=_SHUTTER_POSITIONS, default='CENTER',
        description="When the shutter is open with respect to the frame")

    dreams: CollectionProperty(
        name="Dreams", type=TennielDream,
        description=f"Worlds behind the looking glasses, at most {MAX_DREAMS}")
    active_dream_index: IntProperty(name="Active Dream", min=0, default=0, options=set())
    mirror_view: EnumProperty(
        name="Viewport Shows", items=_MIRROR_VIEWS, default='AS_RENDERED',
        description="Which side of the mirror the viewport shows; final renders ignore it")


class TennielObjectSettings(PropertyGroup):
    use_motion_blur: BoolProperty(
        name="Motion Blur", default=True, override={'LIBRARY_OVERRIDABLE'},
        description="Blur this object where it moves while the shutter is open")
    motion_steps: IntProperty(
        name="Steps", min=1, max=7, default=1, override={'LIBRARY_OVERRIDABLE'},
        description="How finely its way is followed: 1 looks at three times of the shutter, each "
                    "more at twice as many")
    looking_glass: BoolProperty(
        name="Looking Glass", default=False, override={'LIBRARY_OVERRIDABLE'},
        description="This surface shows a dream: the world behind the mirror")
    dream: IntProperty(
        name="Dream", min=1, max=MAX_DREAMS, default=1, override={'LIBRARY_OVERRIDABLE'},
        description="Number of the dream this looking glass shows, "
                    "as listed in the Scene properties")
    entry: EnumProperty(
        name="Enter By", items=_ENTRIES, default='REFLECTION', override={'LIBRARY_OVERRIDABLE'},
        description="Which light paths enter the dream at this surface")
    reenter: EnumProperty(
        name="Mirror in Mirror", items=_REENTRIES, default='STAY',
        override={'LIBRARY_OVERRIDABLE'},
        description="What this looking glass does to a path that is in its dream already")
    first_seen_only: BoolProperty(
        name="Seen Directly Only", default=False, override={'LIBRARY_OVERRIDABLE'},
        description="The dream is seen by the camera, directly or by mirrors and glass; "
                    "for indirect light the surface is an ordinary mirror")
    side: EnumProperty(
        name="Side", items=_SIDES, default='BOTH', override={'LIBRARY_OVERRIDABLE'},
        description="On which side of the looking glasses this object exists")
    dreams: EnumProperty(
        name="Dreams", items=_DREAM_FLAGS, default=set(), options={'ENUM_FLAG'},
        override={'LIBRARY_OVERRIDABLE'},
        description="Dreams in which an object behind the mirror exists; all if none is chosen")
    behind_material: PointerProperty(
        name="Material Behind", type=bpy.types.Material, override={'LIBRARY_OVERRIDABLE'},
        poll=lambda _self, material: not material.is_grease_pencil,
        description="Material that replaces all materials of this object behind the mirror")


class TennielViewLayerSettings(PropertyGroup):
    use_pass_mirror_world: BoolProperty(
        name="Mirror World", default=False,
        description="Number of the dream that is seen first (Mirror World), and how much of each "
                    "pixel shows one (Mirror Coverage)")
    use_pass_dream: BoolProperty(
        name="Dream", default=False,
        description="What of the picture came through a looking glass")


class TennielMaterialSettings(PropertyGroup):
    behind_material: PointerProperty(
        name="Material Behind", type=bpy.types.Material, override={'LIBRARY_OVERRIDABLE'},
        poll=lambda self, material: material != self.id_data and not material.is_grease_pencil,
        description="Material that replaces this one behind the mirror")


_CLASSES = (
    TennielDream,
    TennielSceneSettings,
    TennielObjectSettings,
    TennielViewLayerSettings,
    TennielMaterialSettings,
)

_OWNERS = (
    (bpy.types.Scene, TennielSceneSettings, "Render settings of Tenniel"),
    (bpy.types.Object, TennielObjectSettings, "What this object is to the magic mirror"),
    (bpy.types.ViewLayer, TennielViewLayerSettings, "Passes that Tenniel alone has"),
    (bpy.types.Material, TennielMaterialSettings, "Look of this material behind the mirror"),
)


def register():
    for cls in _CLASSES:
        bpy.utils.register_class(cls)
    for owner, group, description in _OWNERS:
        owner.tenniel = PointerProperty(name="Tenniel", description=description, type=group)


def unregister():
    for owner, _group, _description in _OWNERS:
        del owner.tenniel
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
