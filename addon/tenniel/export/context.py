# SPDX-License-Identifier: GPL-3.0-or-later
"""What all exporters share while one scene is described to the core."""

import traceback
from typing import Any, Callable, NamedTuple

from .. import mirror_tags, reports
from ..presets import groups

# Attribute names with a meaning of their own; no attribute of an artist starts with this byte.
ACTIVE_UV = ''
ACTIVE_COLOR = '\x01color'
GENERATED = '\x01generated'
ISLAND = '\x01island'
# The Pointiness of the Geometry node, which the core makes where it is given the edges.
POINTINESS = '\x01pointiness'

# Bits of `ray_kinds`, in the core's order, by the object flag that switches them.
RAY_KIND_FLAGS = ('visible_camera', 'visible_diffuse', 'visible_glossy', 'visible_transmission',
                  'visible_volume_scatter', 'visible_shadow')
CAMERA_BIT = 1
ALL_RAY_KINDS = 0x3f


class Cancelled(Exception):
    """The user stopped the render while the scene was exported."""


class ExportError(Exception):
    """The scene cannot be rendered at all; the message is a sentence for the artist."""


class View(NamedTuple):
    """The picture to be made.

    width, height: pixels of the whole picture. border: (x, y, width, height) in pixels with y up,
    or None. is_viewport: what is drawn in a 3D view, with its own samples and mirror view.
    """
    width: int
    height: int
    border: Any = None
    is_viewport: bool = False


class ExportContext:
    """The description being filled, and what has been put into it so far.

    core: the native module (or what stands for it in a test). depsgraph: evaluated.
    test_break: called between objects; true stops the export with Cancelled.
    """

    def __init__(self, core, depsgraph, view, test_break: Callable[[], bool] = lambda: False):
        self.core = core
        self.depsgraph = depsgraph
        self.scene = depsgraph.scene_eval
        self.view_layer = depsgraph.view_layer_eval
        self.view = view
        self.description = core.SceneDescription()
        self.node_types = NodeTypes(core.node_types())
        self.materials = {}   # material.name_full -> ExportedMaterial
        self.images = {}      # (image.name_full, frame) -> index
        self.meshes = {}      # see mesh.py
        self.volumes = {}     # see volume.py
        self._links = {}      # node tree -> {input socket: link}, by address
        self._metals = {}     # node tree -> distribution or None, by address
        self.aovs = set()     # names of the passes that AOV Output nodes write
        self.motion = None    # motion.Motion while the shutter is open
        self.has_looking_glass = False
        self.behind_objects = []
        self.has_grids = None         # not looked for yet, see grids.py
        self._test_break = test_break

    def check_break(self):
        """Raises Cancelled if the user wants to stop."""
        if self._test_break():
            raise Cancelled()

    def report(self, severity, text, **where):
        """Adds a row to the Render Report; `where`: object, material, node, file."""
        reports.add(severity, text, **where)

    def count_nodes(self, owner, count):
        """Notes how many shader nodes of `owner` (a name) are used, for the Render Report."""
        reports.count_nodes(owner, count)

    def report_exception(self, what='', **where):
        """For the handler of an exception that costs one data-block, not the render.

        what: its name, where `where` does not say it.
        """
        traceback.print_exc()
        error = traceback.format_exc(limit=0).strip().splitlines()[-1]
        start = f"{what} could" if what else "Could"
        self.report('ERROR', f"{start} not be exported and is left out ({error})", **where)

    def link_to(self, socket):
        """The link in force that ends at an input socket, or None."""
        if not socket.is_linked:
            return None
        tree = socket.id_data
        # Blender searches all links of a tree for those of a socket, so each tree is read once.
        links = self._links.get(tree.as_pointer())
        if links is None:
            links = self._links[tree.as_pointer()] = {
                link.to_socket.as_pointer(): link for link in tree.links
                if link.is_valid and not link.is_muted}
        return links.get(socket.as_pointer())

    def metal_distribution(self, tree):
        """Distribution of the group of a metal, None for any other tree and for one that was
        changed inside: its own nodes are rendered then."""
        key = tree.as_pointer()
        if key not in self._metals:
            self._metals[key] = groups.distribution_of(tree)
            if self._metals[key] is None and tree.get(groups.KIND_PROPERTY) == groups.METAL:
                self.report('INFO', f"The nodes inside the group '{tree.name}' were changed: they "
                            "are rendered as they are, not as a measured metal")
        return self._metals[key]

    @property
    def mirror_view(self):
        """How looking glasses are shown: 'AS_RENDERED', 'THIS_SIDE' or 'DREAM_n'."""
        return self.scene.tenniel.mirror_view if self.view.is_viewport else 'AS_RENDERED'

    def dream_index(self, number, object_name):
        """The dream that `number` of an object means: 1 where the scene has no such dream."""
        count = len(self.scene.tenniel.dreams)
        if 1 <= number <= min(max(count, 1), mirror_tags.MAX_DREAMS):
            return number
        self.report('WARNING', f"The scene has no dream {number}, dream 1 is shown instead",
                    object=object_name)
        return 1


class NodeTypes:
    """The core's table of shader nodes as plain Python data, for fast look-up."""

    def __init__(self, table):
        self._types = {name: NodeType(frozenset(info.inputs), frozenset(info.outputs),
                                      dict(info.settings))
                       for name, info in table.items()}

    def get(self, name):
        """NodeType, or None for a node the core does not know."""
        return self._types.get(name)


class NodeType(NamedTuple):
    """Socket identifiers, and settings as RNA name -> kind (see `_core.pyi`)."""
    inputs: frozenset
    outputs: frozenset
    settings: dict


def ray_kinds(obj):
    """Bits of the ray kinds that see an object."""
    return sum(1 << bit for bit, flag in enumerate(RAY_KIND_FLAGS) if getattr(obj, flag, True))


def world_bits(tags):
    """Bits of the worlds an object with these MirrorTags exists in."""
    return sum(1 << world for world in mirror_tags.worlds(tags))


def filled(buffer, values):
    """A buffer of the core with the values of an array of the same type and length."""
    memoryview(buffer).cast('B')[:] = memoryview(values).cast('B')
    return buffer


def matrix_rows(matrix):
    """The upper three rows of a 4x4 matrix as 12 floats."""
    return (*matrix[0], *matrix[1], *matrix[2])
