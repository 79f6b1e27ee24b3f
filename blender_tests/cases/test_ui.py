# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators and panels, driven as the window would, and what enabling changes in Blender."""
import importlib
import types
import unittest

import bpy
import nodeitems_utils
from bl_ui import space_node  # noqa: F401  (makes the copies of panels for the node editor)
from support import scene_factory
from tenniel import mirror_tags, reports
from tenniel.ui import base, compat

PANEL_MODULES = ('render', 'scene', 'view_layer', 'world', 'object', 'material', 'light', 'camera')
ICONS = set(bpy.types.UILayout.bl_rna.functions['label'].parameters['icon'].enum_items.keys())


def mesh_object(name):
    obj = bpy.data.objects.new(name, bpy.data.meshes.new(name))
    bpy.context.scene.collection.objects.link(obj)
    return obj


def lamp_object(name, kind='POINT'):
    obj = bpy.data.objects.new(name, bpy.data.lights.new(name, kind))
    bpy.context.scene.collection.objects.link(obj)
    return obj


def select(*objects):
    bpy.context.view_layer.update()
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj in objects)


class SelectionOperatorTest(unittest.TestCase):

    def setUp(self):
        scene_factory.empty_scene()
        self.objects = [mesh_object(name) for name in "abc"]
        select(*self.objects[:2])

    def sides(self):
        return [bpy.data.objects[name].tenniel.side for name in "abc"]

    def test_whole_selection_and_nothing_else(self):
        bpy.ops.tenniel.send_behind_mirror()
        self.assertEqual(self.sides(), ['BEHIND', 'BEHIND', 'BOTH'])
        bpy.ops.tenniel.keep_on_this_side()
        self.assertEqual(self.sides(), ['THIS_SIDE', 'THIS_SIDE', 'BOTH'])
        bpy.ops.tenniel.make_looking_glass(dream=3)
        self.assertEqual([obj.tenniel.looking_glass for obj in self.objects], [True, True, False])
        self.assertEqual([obj.tenniel.dream for obj in self.objects], [3, 3, 1])

    def test_undo_and_redo(self):
        bpy.ops.ed.undo_push(message="before")
        bpy.ops.tenniel.send_behind_mirror('EXEC_DEFAULT', True)
        self.assertEqual(self.sides(), ['BEHIND', 'BEHIND', 'BOTH'])
        bpy.ops.ed.undo()
        self.assertEqual(self.sides(), ['BOTH', 'BOTH', 'BOTH'])
        bpy.ops.ed.redo()
        self.assertEqual(self.sides(), ['BEHIND', 'BEHIND', 'BOTH'])

    def test_every_operator_of_the_scene_is_undoable(self):
        operators = [getattr(bpy.types, name) for name in dir(bpy.types)
                     if name.startswith('TENNIEL_OT_')]
        self.assertGreaterEqual(len(operators), 10)
        for operator in operators:
            if operator.__name__ != 'TENNIEL_OT_clear_reports':
                self.assertLessEqual({'REGISTER', 'UNDO'}, operator.bl_options, operator)

    def test_clear_removes_custom_properties_too(self):
        first = self.objects[0]
        first['looking_glass'], first['behind_mirror'], first['other'] = 1, 1, 1
        first.tenniel.dreams = {'2'}
        first.tenniel.behind_material = bpy.data.materials.new("m")
        bpy.ops.tenniel.clear_mirror_tags()
        self.assertEqual(mirror_tags.effective_tags(first), mirror_tags.MirrorTags())
        self.assertEqual(first.tenniel.dreams, set())
        self.assertEqual(set(first.keys()) - {'tenniel'}, {'other'})

    def test_this_side_overrules_the_custom_property(self):
        self.objects[0]['behind_mirror'] = True
        bpy.ops.tenniel.keep_on_this_side()
        self.assertEqual(mirror_tags.effective_tags(self.objects[0]).side, 'THIS_SIDE')

    def test_lamps_have_a_side_but_are_no_mirrors(self):
        lamp = lamp_object("lamp")
        select(lamp, self.objects[0])
        bpy.ops.tenniel.send_behind_mirror()
        bpy.ops.tenniel.make_looking_glass()
        self.assertEqual(lamp.tenniel.side, 'BEHIND')
        self.assertFalse(lamp.tenniel.looking_glass)
        self.assertTrue(self.objects[0].tenniel.looking_glass)

    def test_nothing_selected(self):
        select()
        for name in ('make_looking_glass', 'send_behind_mirror', 'keep_on_this_side',
                     'clear_mirror_tags'):
            with self.assertRaisesRegex(RuntimeError, "No object is selected"):
                getattr(bpy.ops.tenniel, name)()

    def test_select_by_side(self):
        self.objects[0].tenniel.side = 'BEHIND'
        self.objects[1]['looking_glass'] = True
        self.objects[1]['behind_mirror'] = True
        self.objects[2].tenniel.side = 'THIS_SIDE'
        for kind, names in (('BEHIND', "ab"), ('THIS_SIDE', "c"), ('LOOKING_GLASS', "b"),
                            ('BOTH', "")):
            with self.subTest(kind):
                bpy.ops.tenniel.select_by_mirror_side(kind=kind)
                self.assertEqual("".join(obj.name for obj in bpy.context.selected_objects), names)
        bpy.ops.tenniel.select_by_mirror_side(kind='THIS_SIDE')
        bpy.ops.tenniel.select_by_mirror_side(kind='LOOKING_GLASS', extend=True)
        self.assertEqual({obj.name for obj in bpy.context.selected_objects}, {'b', 'c'})


class OtherOperatorTest(unittest.TestCase):

    def setUp(self):
        self.scene = scene_factory.empty_scene()

    def test_copy_cycles_settings(self):
        cycles = self.scene.cycles
        cycles.samples, cycles.seed, cycles.max_bounces = 77, 5, 3
        cycles.sample_clamp_indirect, cycles.pixel_filter_type = 2.5, 'GAUSSIAN'
        bpy.ops.tenniel.copy_cycles_settings()
        settings = self.scene.tenniel
        self.assertEqual((settings.samples, settings.seed, settings.max_bounces), (77, 5, 3))
        self.assertEqual(settings.sample_clamp_indirect, 2.5)
        self.assertEqual(settings.pixel_filter_type, 'GAUSSIAN')

    def test_fifth_dream_is_refused(self):
        for _ in range(mirror_tags.MAX_DREAMS):
            bpy.ops.tenniel.dream_add()
        names = [dream.name for dream in self.scene.tenniel.dreams]
        self.assertEqual(names, ["Dream 1", "Dream 2", "Dream 3", "Dream 4"])
        with self.assertRaisesRegex(RuntimeError, "at most 4 dreams"):
            bpy.ops.tenniel.dream_add()
        self.assertEqual(len(self.scene.tenniel.dreams), 4)

    def test_removing_a_dream_keeps_what_others_mean(self):
        for _ in range(3):
            bpy.ops.tenniel.dream_add()
        objects = [mesh_object(name) for name in "abc"]
        for obj, number in zip(objects, (1, 2, 3)):
            obj.tenniel.dream = number
            obj.tenniel.dreams = {str(number), '3'}
        objects[1].tenniel.dreams = {'2'}
        self.scene.tenniel.active_dream_index = 1
        bpy.ops.tenniel.dream_remove()
        self.assertEqual([dream.name for dream in self.scene.tenniel.dreams],
                         ["Dream 1", "Dream 3"])
        self.assertEqual([obj.tenniel.dream for obj in objects], [1, 1, 2])
        self.assertEqual([obj.tenniel.dreams for obj in objects], [{'1', '2'}, {'1'}, {'2'}])

    def test_report_buttons(self):
        obj, other = mesh_object("bad mesh"), mesh_object("other")
        select(other)
        bpy.ops.tenniel.select_report_object(object_name="bad mesh")
        self.assertEqual(bpy.context.selected_objects, [obj])
        self.assertEqual(bpy.context.view_layer.objects.active, obj)
        self.assertEqual(bpy.ops.tenniel.select_report_object(object_name="gone"), {'CANCELLED'})
        reports.add('ERROR', "x", scene=self.scene.name)
        bpy.ops.tenniel.clear_reports()
        self.assertEqual(reports.rows(self.scene.name), [])


class CheckedLayout:
    """Stands for UILayout where there is no window: refuses what Blender would complain about."""

    def __init__(self, calls):
        self.__dict__['calls'] = calls

    def __setattr__(self, name, value):
        if name not in bpy.types.UILayout.bl_rna.properties:
            raise AttributeError(f"UILayout has no '{name}'")

    def __getattr__(self, name):
        function = bpy.types.UILayout.bl_rna.functions.get(name)
        if function is None:
            raise AttributeError(f"UILayout has no '{name}'")

        def call(*args, **kwargs):
            self.check(name, function, args, kwargs)
            self.calls.append((name, args, kwargs))
            if name == 'operator':
                return types.SimpleNamespace()
            return CheckedLayout(self.calls)
        return call

    @staticmethod
    def check(name, function, args, kwargs):
        unknown = set(kwargs) - set(function.parameters.keys())
        if unknown:
            raise TypeError(f"{name} has no arguments {unknown}")
        if kwargs.get('icon', 'NONE') not in ICONS:
            raise ValueError(f"no icon {kwargs['icon']}")
        if name == 'prop' and args[1] not in args[0].bl_rna.properties:
            raise AttributeError(f"{args[0].bl_rna.identifier} has no '{args[1]}'")
        if name in {'operator', 'operator_menu_enum'}:
            group, function_name = args[0].split('.')
            getattr(getattr(bpy.ops, group), function_name).get_rna_type()
        if name == 'menu' and not hasattr(bpy.types, args[0]):
            raise KeyError(f"no menu {args[0]}")


def panels():
    found = []
    for name in PANEL_MODULES:
        module = importlib.import_module(f'tenniel.ui.{name}')
        found += [cls for cls in module._CLASSES if issubclass(cls, bpy.types.Panel)]
    return found


class PanelTest(unittest.TestCase):

    def setUp(self):
        self.scene = scene_factory.empty_scene()
        self.scene.render.engine = base.ENGINE
        self.addCleanup(reports.clear)

    def context(self, obj=None, **values):
        data = getattr(obj, 'data', None)
        own = {kind: data if isinstance(data, cls) else None
               for kind, cls in (('light', bpy.types.Light), ('camera', bpy.types.Camera))}
        return types.SimpleNamespace(**{
            'engine': base.ENGINE, 'scene': self.scene, 'object': obj, 'material': None,
            'world': self.scene.world, 'view_layer': self.scene.view_layers[0],
            'region': types.SimpleNamespace(width=300), **own, **values})

    def draw_all(self, context):
        """Names of the panels shown in this context; each has been drawn, header included."""
        shown = {}
        for panel in panels():
            if not panel.poll(context):
                continue
            calls = shown[panel.__name__] = []
            self_like = types.SimpleNamespace(layout=CheckedLayout(calls))
            if hasattr(panel, 'draw_header'):
                panel.draw_header(self_like, context)
            panel.draw(self_like, context)
        return shown

    def test_every_panel_is_drawn_somewhere(self):
        shown = set()
        reports.add('ERROR', "a mesh " * 30, object="Cube", scene=self.scene.name)
        shown |= set(self.draw_all(self.context(mesh_object("mesh"))))
        for kind in ('POINT', 'SUN', 'SPOT', 'AREA'):
            shown |= set(self.draw_all(self.context(lamp_object(kind, kind))))
        camera = bpy.data.cameras.new("camera")
        camera.type = 'PANO'
        shown |= set(self.draw_all(self.context(bpy.data.objects.new("camera", camera))))
        material = bpy.data.materials.new("material")
        for material.use_nodes in (False, True):
            shown |= set(self.draw_all(self.context(material=material)))
        for self.scene.world.use_nodes in (False, True):
            shown |= set(self.draw_all(self.context()))
        self.assertEqual(shown, {panel.__name__ for panel in panels()})

    def test_area_shapes_and_empty_trees(self):
        lamp = lamp_object("lamp", 'AREA')
        for lamp.data.shape in ('SQUARE', 'RECTANGLE', 'DISK', 'ELLIPSE'):
            self.draw_all(self.context(lamp))
        material = bpy.data.materials.new("no output")
        material.use_nodes = True
        material.node_tree.nodes.clear()
        shown = self.draw_all(self.context(material=material))
        self.assertIn('no output node', str(shown['TENNIEL_MATERIAL_PT_surface']))

    def test_other_engines_see_none(self):
        reports.add('ERROR', "x", scene=self.scene.name)
        shown = self.draw_all(self.context(mesh_object("mesh"), engine='CYCLES'))
        self.assertEqual(shown, {})

    def test_nothing_raises_without_cycles(self):
        """As it is where the Cycles add-on is disabled: its settings exist on nothing."""
        class Bare:
            """Passes on to Blender's data, without Cycles' groups."""
            def __init__(self, data):
                self._data = data

            def __getattr__(self, name):
                if name in {'cycles', 'cycles_visibility'}:
                    raise AttributeError(name)
                return getattr(self._data, name)

        lamp = lamp_object("lamp")
        context = self.context(lamp, scene=Bare(self.scene), world=Bare(self.scene.world),
                               light=Bare(lamp.data))
        shown = self.draw_all(context)
        self.assertNotIn('TENNIEL_WORLD_PT_ray_visibility', shown)
        self.assertIn('use_shadow', str(shown['TENNIEL_LIGHT_PT_light']))
        copy = bpy.types.TENNIEL_OT_copy_cycles_settings
        self.assertFalse(copy.poll(context))

    def test_custom_property_in_force_is_shown(self):
        obj = mesh_object("mesh")
        obj['behind_mirror'] = True
        shown = self.draw_all(self.context(obj))['TENNIEL_OBJECT_PT_magic_mirror']
        self.assertIn("'behind_mirror'", str(shown))

    def test_tagged_objects_are_listed(self):
        mesh_object("plain")
        mesh_object("glass").tenniel.looking_glass = True
        mesh_object("vampire").tenniel.side = 'THIS_SIDE'
        calls = self.draw_all(self.context())['TENNIEL_SCENE_PT_tagged_objects']
        buttons = [kwargs['text'] for name, _args, kwargs in calls if name == 'operator']
        self.assertEqual(sorted(buttons), ["glass", "vampire"])

    def test_report_rows(self):
        for _ in range(2):
            reports.add('WARNING', "broken image", object="Cube", scene=self.scene.name)
        calls = self.draw_all(self.context())['TENNIEL_RENDER_PT_report']
        self.assertIn("broken image (2 times)", str(calls))

    def test_coverage_without_problems(self):
        reports.begin(self.scene.name)
        reports.count_nodes("Oak", 7)
        calls = self.draw_all(self.context())['TENNIEL_RENDER_PT_report']
        self.assertIn("All 7 shader nodes are covered", str(calls))


def menu_entries(engine, shader_type):
    """Number of node types the Add menu of the shader editor offers."""
    space = types.SimpleNamespace(type='NODE_EDITOR', tree_type='ShaderNodeTree',
                                  shader_type=shader_type, edit_tree=None)
    context = types.SimpleNamespace(engine=engine, space_data=space, blend_data=bpy.data)
    return {item.nodetype for item in nodeitems_utils.node_items_iter(context)
            if hasattr(item, 'nodetype')}


class CompatTest(unittest.TestCase):

    def test_add_menu_offers_what_cycles_offers(self):
        for shader_type in ('OBJECT', 'WORLD', 'LINESTYLE'):
            with self.subTest(shader_type):
                cycles = menu_entries('CYCLES', shader_type)
                self.assertEqual(menu_entries(base.ENGINE, shader_type), cycles)
                self.assertLess(menu_entries('OTHER', shader_type), cycles)

    def test_stock_panels(self):
        for name in ('RENDER_PT_color_management', 'RENDER_PT_format', 'RENDER_PT_output',
                     'DATA_PT_camera', 'DATA_PT_lens', 'DATA_PT_camera_dof',
                     'DATA_PT_uv_texture', 'WORLD_PT_context_world', 'VIEWLAYER_PT_layer',
                     'EEVEE_MATERIAL_PT_context_material'):
            self.assertIn(base.ENGINE, getattr(bpy.types, name).COMPAT_ENGINES, name)
        for name in ('DATA_PT_light', 'RENDER_PT_simplify', 'OBJECT_PT_visibility',
                     'EEVEE_MATERIAL_PT_surface'):
            self.assertNotIn(base.ENGINE, getattr(bpy.types, name).COMPAT_ENGINES, name)

    def test_as_many_panels_as_cycles_takes(self):
        ours = set(compat.stock_panels())
        theirs = {panel for panel in bpy.types.Panel.__subclasses__()
                  if {'CYCLES', 'BLENDER_RENDER'} <= getattr(panel, 'COMPAT_ENGINES', set())}
        simplify = {'RENDER_PT_simplify_greasepencil', 'RENDER_PT_simplify_render',
                    'RENDER_PT_simplify_viewport'}
        self.assertEqual({panel.__name__ for panel in theirs - ours}, simplify)

    @staticmethod
    def state():
        """Everything of Blender that enabling changes, except what it adds under its own name."""
        import nodeitems_builtins
        owners = (bpy.types.Scene, bpy.types.Object, bpy.types.Material)
        return (
            {cls.__name__: set(cls.COMPAT_ENGINES) for cls in bpy.types.Panel.__subclasses__()
             if hasattr(cls, 'COMPAT_ENGINES') and not cls.__name__.startswith('TENNIEL_')},
            nodeitems_builtins.cycles_shader_nodes_poll,
            list(bpy.types.VIEW3D_MT_object._dyn_ui_initialize()),
            {owner.__name__: hasattr(owner, 'tenniel') for owner in owners},
            [name for name in dir(bpy.types) if name.upper().startswith('TENNIEL')],
        )

    def test_unregister_restores_everything(self):
        import tenniel
        self.addCleanup(lambda: tenniel._registered or tenniel.register())
        tenniel.unregister()
        panels_off, poll_off, menu_off, groups_off, types_off = off = self.state()
        self.assertFalse(any(base.ENGINE in engines for engines in panels_off.values()))
        self.assertEqual(set(groups_off.values()), {False})
        self.assertEqual(types_off, [])
        self.assertEqual(poll_off.__module__, 'nodeitems_builtins')
        self.assertFalse(hasattr(poll_off, '__wrapped__'))
        tenniel.register()
        on = self.state()[0]
        for _ in range(5):
            tenniel.unregister()
            self.assertEqual(self.state(), off)
            tenniel.register()
            self.assertEqual(self.state()[0], on)
        self.assertEqual(len(self.state()[2]), len(menu_off) + 1)

    def test_foreign_patch_of_the_menu_survives(self):
        import nodeitems_builtins
        ours = nodeitems_builtins.cycles_shader_nodes_poll

        def theirs(context):
            return ours(context)
        nodeitems_builtins.cycles_shader_nodes_poll = theirs
        try:
            compat.unregister()
            self.assertIs(nodeitems_builtins.cycles_shader_nodes_poll, theirs)
        finally:
            nodeitems_builtins.cycles_shader_nodes_poll = ours.__wrapped__
            compat.register()
