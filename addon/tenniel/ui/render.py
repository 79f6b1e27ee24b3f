# SPDX-License-Identifier: GPL-3.0-or-later
"""Render properties: sampling, light paths, film, performance, and what went wrong."""

from bpy.types import Panel

from .. import native, reports
from .base import (
    PropertiesPanel,
    draw_wrapped,
    property_column,
    register_classes,
    unregister_classes,
)

_SEVERITY_ICONS = {'ERROR': 'CANCEL', 'WARNING': 'ERROR', 'INFO': 'INFO'}

# A panel of thousands of rows takes seconds to draw; who has that many starts at the top.
_MAX_ROWS_SHOWN = 40


class RenderPanel(PropertiesPanel):
    bl_context = 'render'


class TENNIEL_RENDER_PT_sampling(RenderPanel, Panel):
    bl_label = "Sampling"

    def draw(self, context):
        settings = context.scene.tenniel
        column = property_column(self.layout)
        samples = column.column(align=True)
        samples.prop(settings, 'samples', text="Samples: Render")
        samples.prop(settings, 'preview_samples', text="Viewport")
        column.prop(settings, 'time_limit')
        row = column.row(align=True)
        row.prop(settings, 'seed')
        row.prop(settings, 'use_animated_seed', text="", icon='TIME')
        if getattr(context.scene, 'cycles', None) is not None:
            self.layout.operator('tenniel.copy_cycles_settings', icon='PASTEDOWN')


class TENNIEL_RENDER_PT_sampling_inactive(RenderPanel, Panel):
    bl_label = "Noise Threshold and Denoising"
    bl_parent_id = 'TENNIEL_RENDER_PT_sampling'
    bl_options = {'DEFAULT_CLOSED'}

    def draw(self, context):
        settings = context.scene.tenniel
        self.layout.label(text="Not active in this version", icon='INFO')
        column = property_column(self.layout)
        column.active = False
        row = column.row(heading="Noise Threshold")
        row.prop(settings, 'use_adaptive_sampling', text="")
        row.prop(settings, 'adaptive_threshold', text="")
        column.prop(settings, 'use_denoising')


class TENNIEL_RENDER_PT_light_paths(RenderPanel, Panel):
    bl_label = "Light Paths"
    bl_options = {'DEFAULT_CLOSED'}

    def draw(self, context):
        """The sub-panels say it all."""


class TENNIEL_RENDER_PT_light_paths_max_bounces(RenderPanel, Panel):
    bl_label = "Max Bounces"
    bl_parent_id = 'TENNIEL_RENDER_PT_light_paths'

    def draw(self, context):
        settings = context.scene.tenniel
        column = property_column(self.layout)
        column.prop(settings, 'max_bounces')
        kinds = column.column(align=True)
        kinds.prop(settings, 'diffuse_bounces')
        kinds.prop(settings, 'glossy_bounces')
        kinds.prop(settings, 'transmission_bounces')
        kinds.prop(settings, 'volume_bounces')
        column.prop(settings, 'transparent_max_bounces')
        column.prop(settings, 'min_light_bounces')


class TENNIEL_RENDER_PT_light_paths_clamping(RenderPanel, Panel):
    bl_label = "Clamping"
    bl_parent_id = 'TENNIEL_RENDER_PT_light_paths'

    def draw(self, context):
        settings = context.scene.tenniel
        column = property_column(self.layout).column(align=True)
        column.prop(settings, 'sample_clamp_direct')
        column.prop(settings, 'sample_clamp_indirect')


class TENNIEL_RENDER_PT_light_paths_caustics(RenderPanel, Panel):
    bl_label = "Caustics"
    bl_parent_id = 'TENNIEL_RENDER_PT_light_paths'

    def draw(self, context):
        settings = context.scene.tenniel
        column = property_column(self.layout)
        column.prop(settings, 'blur_glossy')
        switches = column.column(heading="Caustics", align=True)
        switches.prop(settings, 'caustics_reflective')
        switches.prop(settings, 'caustics_refractive')


class TENNIEL_RENDER_PT_volumes(RenderPanel, Panel):
    bl_label = "Volumes"
    bl_options = {'DEFAULT_CLOSED'}

    def draw(self, context):
        settings = context.scene.tenniel
        column = property_column(self.layout).column(align=True)
        column.prop(settings, 'volume_step_rate')
        column.prop(settings, 'volume_preview_step_rate')


class TENNIEL_RENDER_PT_motion_blur(RenderPanel, Panel):
    bl_label = "Motion Blur"
    bl_options = {'DEFAULT_CLOSED'}

    def draw_header(self, context):
        self.layout.prop(context.scene.render, 'use_motion_blur', text="")

    def draw(self, context):
        column = property_column(self.layout)
        column.active = context.scene.render.use_motion_blur
        column.prop(context.scene.tenniel, 'motion_blur_position')
        column.prop(context.scene.render, 'motion_blur_shutter')


class TENNIEL_RENDER_PT_film(RenderPanel, Panel):
    bl_label = "Film"
    bl_options = {'DEFAULT_CLOSED'}

    def draw(self, context):
        settings = context.scene.tenniel
        column = property_column(self.layout)
        column.prop(settings, 'film_exposure')
        column.prop(context.scene.render, 'film_transparent', text="Transparent Background")
        column.prop(settings, 'pixel_filter_type', text="Pixel Filter")
        width = column.column()
        width.active = settings.pixel_filter_type != 'BOX'
        width.prop(settings, 'filter_width')


class TENNIEL_RENDER_PT_performance(RenderPanel, Panel):
    bl_label = "Performance"
    bl_options = {'DEFAULT_CLOSED'}

    def draw(self, context):
        render = context.scene.render
        column = property_column(self.layout)
        column.prop(render, 'threads_mode')
        threads = column.column()
        threads.enabled = render.threads_mode == 'FIXED'
        threads.prop(render, 'threads')
        core = native.loaded()
        if core is not None:
            self.layout.label(
                text=f"Core {core.version} for x86-64-{core.isa}, Embree {core.embree_version}",
                icon='INFO')


class TENNIEL_RENDER_PT_simplify(RenderPanel, Panel):
    """Blender's own would stand above Sampling, since it was registered first."""
    bl_label = "Simplify"
    bl_options = {'DEFAULT_CLOSED'}

    def draw_header(self, context):
        self.layout.prop(context.scene.render, 'use_simplify', text="")

    def draw(self, context):
        render = context.scene.render
        column = property_column(self.layout)
        column.active = render.use_simplify
        subdivision = column.column(align=True)
        subdivision.prop(render, 'simplify_subdivision', text="Subdivision: Viewport")
        subdivision.prop(render, 'simplify_subdivision_render', text="Render")
        particles = column.column(align=True)
        particles.prop(render, 'simplify_child_particles', text="Child Particles: Viewport")
        particles.prop(render, 'simplify_child_particles_render', text="Render")


class TENNIEL_RENDER_PT_report(RenderPanel, Panel):
    bl_label = "Render Report"

    @classmethod
    def poll(cls, context):
        name = context.scene.name
        return super().poll(context) and bool(reports.rows(name) or reports.coverage(name))

    def draw(self, context):
        rows = reports.rows(context.scene.name)
        coverage = reports.coverage(context.scene.name)
        if coverage:
            self.layout.label(text=coverage.text(),
                              icon='INFO' if coverage.reported else 'CHECKMARK')
        width = context.region.width if context.region else 300
        for report in rows[:_MAX_ROWS_SHOWN]:
            _draw_report(self.layout, report, width)
        if len(rows) > _MAX_ROWS_SHOWN:
            self.layout.label(text=f"and {len(rows) - _MAX_ROWS_SHOWN} more")
        marks = self.layout.row(align=True)
        marks.operator('tenniel.mark_nodes', icon='COLOR')
        marks.operator('tenniel.clear_node_marks')
        self.layout.operator('tenniel.clear_reports', text="Clear", icon='X')


def _draw_report(layout, report, width):
    # Room for the box and the button.
    width -= 40
    row = layout.box().row()
    lines = row.column(align=True)
    text = report.text if report.count == 1 else f"{report.text} ({report.count} times)"
    draw_wrapped(lines, text, width, _SEVERITY_ICONS[report.severity])
    if report.where():
        draw_wrapped(lines, report.where(), width, 'BLANK1')
    if report.object:
        button = row.operator(
            'tenniel.select_report_object', text="", icon='RESTRICT_SELECT_OFF', emboss=False)
        button.object_name = report.object


_CLASSES = (
    TENNIEL_RENDER_PT_sampling,
    TENNIEL_RENDER_PT_sampling_inactive,
    TENNIEL_RENDER_PT_light_paths,
    TENNIEL_RENDER_PT_light_paths_max_bounces,
    TENNIEL_RENDER_PT_light_paths_clamping,
    TENNIEL_RENDER_PT_light_paths_caustics,
    TENNIEL_RENDER_PT_volumes,
    TENNIEL_RENDER_PT_motion_blur,
    TENNIEL_RENDER_PT_film,
    TENNIEL_RENDER_PT_performance,
    TENNIEL_RENDER_PT_simplify,
    TENNIEL_RENDER_PT_report,
)


def register():
    register_classes(_CLASSES)


def unregister():
    unregister_classes(_CLASSES)
