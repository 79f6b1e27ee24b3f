# SPDX-License-Identifier: GPL-3.0-or-later
"""Types of the native module (`_core_v2`, `_core_v3` or `_core_v4`; see native.py).

Every struct is filled by plain attribute assignment. List attributes are *replaced* as a whole
(`desc.attributes = [...]`), never appended in place: reading one returns a copy. Structs of a scene
are added by the `add_*` methods, which copy the struct (its buffers are shared, not copied) and
return its index. Matrices are flat sequences of 12 floats: three rows of four. Indices -1 = none.
A wrong type raises TypeError, a wrong size or name ValueError that names the field.
"""

from typing import Sequence

version: str
isa: str  # "v2", "v3" or "v4"
python_version: str  # it was built for, e.g. "3.11"
embree_version: str
oiio_version: str

class FloatBuffer:
    """n float32, zeroed. Supports the buffer protocol, len() and indexing: for foreach_get/set."""
    def __init__(self, size: int) -> None: ...
    def __len__(self) -> int: ...
    def __getitem__(self, i: int) -> float: ...
    def __setitem__(self, i: int, value: float) -> None: ...

class UIntBuffer:
    """n uint32, for RNA types read as unsigned (vertex_index, loop_triangles.loops)."""
    def __init__(self, size: int) -> None: ...
    def __len__(self) -> int: ...
    def __getitem__(self, i: int) -> int: ...
    def __setitem__(self, i: int, value: int) -> None: ...

class IntBuffer:
    """n int32 >= 0 (loop_start, loop_total, material_index); buffer format 'I', as RNA has them."""
    def __init__(self, size: int) -> None: ...
    def __len__(self) -> int: ...
    def __getitem__(self, i: int) -> int: ...
    def __setitem__(self, i: int, value: int) -> None: ...

class ByteBuffer:
    """n uint8 / bool (use_smooth); buffer format '?'."""
    def __init__(self, size: int) -> None: ...
    def __len__(self) -> int: ...
    def __getitem__(self, i: int) -> int: ...
    def __setitem__(self, i: int, value: int) -> None: ...

class NodeGraph:
    """A shader tree, flattened. Sockets and settings by Blender's identifiers."""
    name: str
    output: int  # index of the output node, -1 = none
    aov_outputs: list[int]  # AOV Output nodes
    def add_node(self, type: str, name: str) -> int: ...
    def set_input(self, node: int, socket: str, value: Sequence[float]) -> None:
        """1, 3 or 4 floats."""
    def set_setting(self, node: int, name: str,
                    value: bool | int | float | str | Sequence[float] | FloatBuffer) -> None: ...
    def link(self, from_node: int, from_socket: str, to_node: int, to_socket: str) -> None: ...
    @property
    def node_count(self) -> int: ...

class AttributeDesc:
    name: str  # "" = active UV map, "\x01color" = active colour attribute
    domain: str  # POINT, CORNER, FACE
    channels: int  # 1, 2, 3, 4
    data: FloatBuffer  # (elements, channels)

class MeshDesc:
    name: str
    positions: FloatBuffer  # (vertices, 3) object space
    corner_vertices: UIntBuffer  # (corners)
    polygon_starts: IntBuffer  # (polygons)
    polygon_sizes: IntBuffer  # (polygons)
    triangle_corners: UIntBuffer  # (triangles, 3)
    material_indices: IntBuffer | None  # (polygons)
    smooth_flags: ByteBuffer | None  # (polygons)
    vertex_normals: FloatBuffer | None  # (vertices, 3); None: made of the polygons
    corner_normals: FloatBuffer | None  # (corners, 3); wins over vertex_normals
    attributes: list[AttributeDesc]
    texture_space_location: Sequence[float]
    texture_space_size: Sequence[float]
    # FACES, or hairs (RIBBONS, TUBES) or points (SPHERES): `positions` are their keys, attributes
    # lie on POINT (key) or FACE (hair, point), and what faces need is not set.
    shape: str
    radii: FloatBuffer | None  # (positions); without them hairs taper as these four say
    root_radius: float
    tip_radius: float
    radius_shape: float  # < 0: thick for long, > 0: thin soon
    closes_tip: bool  # the last key of each hair has no radius
    strand_sizes: IntBuffer | None  # (hairs) keys of each
    to_object: Sequence[float]  # from where the keys' positions are to object space
    ribbon_pieces: int  # flat ones between two keys
    first_strand: int  # number of the first, for the random numbers

class InstanceDesc:
    name: str
    mesh: int
    object_to_world: Sequence[float]
    motion: Sequence[Sequence[float]]  # matrices, equally far apart over the shutter; or empty
    worlds: int  # bit w: exists in world w (0 this side, 1..4 dreams)
    ray_kinds: int  # bits 0 camera, 1 diffuse, 2 glossy, 3 transmission, 4 volume scatter, 5 shadow
    dream: int  # looking glass of this dream; 0 = none
    entry: str  # REFLECTION, TRANSMISSION, BOTH
    reentry: str  # STAY, TOGGLE
    first_seen_only: bool
    materials: list[int]  # per slot; -1 = default material
    behind_materials: list[int]  # empty = the same
    color: Sequence[float]  # 4
    pass_index: float
    random: float
    is_holdout: bool
    terminator_cutoff: float  # cosine; 0 = shadow rays leave from the flat faces
    generated: Sequence[float]  # 3
    instancer_uv: Sequence[float]  # 2
    attributes: dict[str, Sequence[float]]  # 4 floats each: Attribute nodes of type OBJECT etc.
    grids: list[int]  # indices of what fills it, each by its name as an attribute
    has_scaled_density: bool  # its medium is thinner the larger the object is scaled

class MaterialDesc:
    name: str
    graph: NodeGraph
    pass_index: float
    displacement_method: str  # BUMP, DISPLACEMENT, BOTH
    use_transparent_shadow: bool
    sample_as_light: bool
    volume_interpolation: str  # LINEAR, CUBIC: between voxels
    volume_step_rate: float

class LightDesc:
    name: str
    type: str  # POINT, SPOT, AREA, SUN
    object_to_world: Sequence[float]
    color: Sequence[float]
    energy: float  # W; sun W/m^2
    radius: float
    spot_size: float
    spot_blend: float
    shape: str  # SQUARE, RECTANGLE, DISK, ELLIPSE
    size_x: float
    size_y: float
    spread: float
    angle: float
    graph: NodeGraph  # empty = no nodes
    worlds: int
    ray_kinds: int
    casts_shadow: bool
    use_mis: bool
    max_bounces: int
    random: float

class WorldDesc:
    name: str
    graph: NodeGraph  # empty: `color`
    color: Sequence[float]
    ray_kinds: int
    sampling: str  # NONE, AUTOMATIC, MANUAL
    map_resolution: int
    volume_step_size: float  # metres
    max_bounces: int

class ImageTileDesc:
    number: int  # 0, or UDIM 1001...
    path: str
    pixels: FloatBuffer | None  # (height, width, 4), bottom row first: instead of a path
    width: int
    height: int

class ImageDesc:
    name: str
    tiles: list[ImageTileDesc]  # empty = missing: magenta
    colorspace: str
    alpha_mode: str  # STRAIGHT, PREMUL, CHANNEL_PACKED, NONE
    is_data: bool
    is_float: bool

class GridDesc:
    name: str  # of the attribute
    path: str  # of an OpenVDB file that has a grid of that name; the rest is not used then
    width: int
    height: int
    depth: int
    channels: int
    values: FloatBuffer | None  # (depth, height, width, channels)

class AovDesc:
    name: str
    is_color: bool  # RGBA, else one number

class CameraDesc:
    type: str  # PERSP, ORTHO, PANO
    camera_to_world: Sequence[float]
    motion: Sequence[Sequence[float]]
    lens: float  # mm
    sensor_width: float
    sensor_height: float
    sensor_fit: str  # AUTO, HORIZONTAL, VERTICAL
    shift_x: float
    shift_y: float
    ortho_scale: float
    clip_start: float
    clip_end: float
    aperture_radius: float  # metres; 0 = no depth of field
    focus_distance: float
    aperture_blades: int
    aperture_rotation: float
    aperture_ratio: float
    longitude_min: float
    longitude_max: float
    latitude_min: float
    latitude_max: float
    pixel_aspect_x: float
    pixel_aspect_y: float

class RenderSettings:
    width: int  # of the whole picture
    height: int
    border_x: int
    border_y: int
    border_width: int  # 0 = the whole picture
    border_height: int
    samples: int
    sample_offset: int
    seed: int
    threads: int  # 0 = all
    time_limit: float  # s, 0 = none
    max_bounces: int
    diffuse_bounces: int
    glossy_bounces: int
    transmission_bounces: int
    volume_bounces: int
    transparent_max_bounces: int
    min_light_bounces: int
    use_radiance_cache: bool
    clamp_direct: float
    clamp_indirect: float
    blur_glossy: float
    caustics_reflective: bool
    caustics_refractive: bool
    film_transparent: bool
    film_exposure: float
    pass_alpha_threshold: float  # what is less opaque leaves Depth, Normal and AOVs to what is behind
    pixel_filter: str  # BOX, GAUSSIAN, BLACKMAN_HARRIS
    filter_width: float
    occlusion_distance: float  # metres, of Ambient Occlusion nodes whose Distance is 0
    volume_step_rate: float
    texture_limit: int
    start_world: int

class SceneDescription:
    camera: CameraDesc  # a reference: assign a whole CameraDesc
    settings: RenderSettings
    def add_mesh(self, mesh: MeshDesc) -> int: ...
    def add_instance(self, instance: InstanceDesc) -> int: ...
    def add_material(self, material: MaterialDesc) -> int: ...
    def add_light(self, light: LightDesc) -> int: ...
    def add_world(self, world: WorldDesc) -> int:
        """The first is the scene's World; the next four are those of dreams 1..4."""
    def add_image(self, image: ImageDesc) -> int: ...
    def add_grid(self, grid: GridDesc) -> int: ...
    def add_aov(self, aov: AovDesc) -> int:
        """A pass that `RenderSession.read_pass` knows by this name too."""

class Diagnostic:
    severity: str
    text: str
    object: str
    material: str
    node: str
    file: str

class PassInfo:
    name: str  # Combined, Depth, Normal, Mirror World, Mirror Coverage, Dream
    channels: int
    channel_ids: str  # RGBA, Z, XYZ, X, RGB

def passes() -> list[PassInfo]:
    """Every pass the core can deliver."""

def node_types() -> dict[str, "NodeTypeInfo"]:
    """bl_idname -> what the core reads of it."""

class NodeTypeInfo:
    inputs: list[str]  # socket identifiers
    outputs: list[str]
    # RNA name -> kind: boolean, integer, number, choice, text, table, image, attribute, aov
    settings: dict[str, str]

class Progress:
    # For the artist: "Waiting", then e.g. "Compiling shaders", "Building BVH", "Rendering"; at the
    # end "Done", "Cancelled" or "Failed"; "Closed" after close().
    stage: str
    samples_done: int  # finished passes over the whole picture
    samples_total: int
    fraction: float  # [0, 1] of all pixel samples
    elapsed: float  # s since the render (not the compile) began
    remaining: float  # s, an estimate; -1 while unknown
    memory_bytes: int  # of the core: meshes, BVH, textures, film
    peak_memory_bytes: int
    dropped_samples: int  # not finite
    generation: int  # rises whenever new pixels can be read

class RenderSession:
    """Renders on native threads. No method calls Python; all release the GIL and may be called
    from several Python threads. RuntimeError: read_pass of a closed session."""
    def __init__(self, scene: SceneDescription) -> None:
        """Takes the contents of `scene` (it is empty afterwards). Starts nothing."""
    def start(self) -> None:
        """Compiles and renders in the background."""
    def wait(self, seconds: float) -> bool:
        """Until done or `seconds` are over; True when finished (done, cancelled or failed)."""
    def cancel(self) -> None: ...
    @property
    def progress(self) -> Progress: ...
    @property
    def error(self) -> str:
        """A sentence when the render failed, else empty."""
    def take_diagnostics(self) -> list[Diagnostic]: ...
    def finished_tiles(self) -> list[tuple[int, int, int, int]]:
        """Tiles (x, y, width, height) finished since the last call, within the border, y up."""
    def read_pass(self, name: str, target: FloatBuffer, x: int = 0, y: int = 0,
                  width: int = 0, height: int = 0) -> None:
        """Copies a rectangle of the bordered picture (0 sizes = to its edge), bottom row first,
        channels interleaved, averaged over the samples taken so far."""
    def close(self) -> None:
        """Cancels, joins and frees; harmless twice."""

def write_image(path: str, pixels: FloatBuffer, width: int, height: int) -> None:
    """Linear RGBA (height, width, 4), bottom row first, as EXR or PNG. OSError if it cannot."""
