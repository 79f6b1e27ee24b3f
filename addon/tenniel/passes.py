# SPDX-License-Identifier: GPL-3.0-or-later
"""Render passes: which there are, and how pixels get into Blender's RenderResult.

Combined, Depth and Normal bear these names in every version of Blender. Blender makes room for its
own passes by itself; those it does not know, and the AOVs of the view layer, are added to the result
before the first picture.
"""

# Core pass -> (view layer switch or '' for always, Blender's type of the pass). Switches that begin
# with "tenniel." are ours, and so are their passes.
_OURS = 'tenniel.'
_SWITCHES = {
    'Combined': ('', 'COLOR'),
    'Depth': ('use_pass_z', 'VALUE'),
    'Normal': ('use_pass_normal', 'VECTOR'),
    'Mirror World': ('tenniel.use_pass_mirror_world', 'VALUE'),
    'Mirror Coverage': ('tenniel.use_pass_mirror_world', 'VALUE'),
    'Dream': ('tenniel.use_pass_dream', 'COLOR'),
}

_takes_flat_rect = None    # whether RenderPass.rect takes a flat array; known after the first write


def register_passes(engine, core, scene, view_layer):
    """Tells Blender which passes this view layer will get."""
    for info, _switch, kind in _wanted(core, view_layer):
        engine.register_pass(scene, view_layer, info.name, info.channels, info.channel_ids, kind)
    for aov in _aovs(view_layer):
        engine.register_pass(scene, view_layer, *aov)


def add_passes(engine, core, view_layer):
    """Makes room for our own passes in the result of the render that begins."""
    for info, switch, _kind in _wanted(core, view_layer):
        if switch.startswith(_OURS):
            engine.add_pass(info.name, info.channels, info.channel_ids, layer=view_layer.name)
    for name, channels, channel_ids, _kind in _aovs(view_layer):
        engine.add_pass(name, channels, channel_ids, layer=view_layer.name)


def _wanted(core, view_layer):
    """(PassInfo, switch, type) of each pass that is on."""
    for info in core.passes():
        switch, kind = _SWITCHES.get(info.name, ('', None))
        if kind and (not switch or view_layer.path_resolve(switch)):
            yield info, switch, kind


def _aovs(view_layer):
    """(name, channels, channel ids, type) of each pass that AOV Output nodes write."""
    for aov in view_layer.aovs:
        if aov.is_valid:
            yield (aov.name, *((4, 'RGBA', 'COLOR') if aov.type == 'COLOR' else (1, 'X', 'VALUE')))


class PassWriter:
    """Copies the passes of a session into RenderResults of one size.

    core: the native module. width, height: of the results, which is that of the border.
    """

    def __init__(self, core, width, height, view_layer):
        self._core = core
        self._pixels = width * height
        self._buffers = {}    # pass name -> FloatBuffer
        self._joined = None
        self._known = {info.name: info.channels for info in core.passes()}
        self._known.update((name, channels) for name, channels, *_ in _aovs(view_layer))

    def write(self, session, layer):
        """Fills all passes of a RenderLayer with what `session` has so far."""
        buffers = []
        for render_pass in layer.passes:
            buffer = self._buffer(render_pass)
            if self._known.get(render_pass.name) == render_pass.channels:
                session.read_pass(render_pass.name, buffer)
            buffers.append(buffer)
        self._upload(layer.passes, buffers)

    def _buffer(self, render_pass):
        buffer = self._buffers.get(render_pass.name)
        if buffer is None:
            buffer = self._core.FloatBuffer(self._pixels * render_pass.channels)
            self._buffers[render_pass.name] = buffer
        return buffer

    def _upload(self, render_passes, buffers):
        """Blender 4.2 takes each pass as a flat array, earlier ones all passes in one."""
        global _takes_flat_rect
        if _takes_flat_rect is not False and buffers:
            try:
                for render_pass, buffer in zip(render_passes, buffers):
                    render_pass.rect.foreach_set(buffer)
                _takes_flat_rect = True
                return
            except TypeError:
                # Nothing was written: the size is compared first.
                _takes_flat_rect = False
        render_passes.foreach_set('rect', self._join(buffers))

    def _join(self, buffers):
        if len(buffers) == 1:
            return buffers[0]
        if self._joined is None:
            self._joined = self._core.FloatBuffer(sum(len(buffer) for buffer in buffers))
        target, start = memoryview(self._joined), 0
        for buffer in buffers:
            target[start:start + len(buffer)] = memoryview(buffer)
            start += len(buffer)
        return self._joined
