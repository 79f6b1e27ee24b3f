# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings: their names and defaults, the tags that follow from them, and the render report."""
import threading
import types
import unittest

import bpy
from support import scene_factory
from tenniel import mirror_tags, reports

SCENE_DEFAULTS = {
    'samples': 128,
    'preview_samples': 32,
    'seed': 0,
    'use_animated_seed': False,
    'time_limit': 0.0,
    'use_adaptive_sampling': False,
    'adaptive_threshold': 0.01,
    'use_denoising': False,
    'max_bounces': 12,
    'diffuse_bounces': 4,
    'glossy_bounces': 4,
    'transmission_bounces': 12,
    'volume_bounces': 0,
    'transparent_max_bounces': 8,
    'min_light_bounces': 0,
    'sample_clamp_direct': 0.0,
    'sample_clamp_indirect': 10.0,
    'blur_glossy': 1.0,
    'caustics_reflective': True,
    'caustics_refractive': True,
    'volume_step_rate': 1.0,
    'volume_preview_step_rate': 1.0,
    'film_exposure': 1.0,
    'pixel_filter_type': 'BLACKMAN_HARRIS',
    'filter_width': 1.5,
    'motion_blur_position': 'CENTER',
    'active_dream_index': 0,
    'mirror_view': 'AS_RENDERED',
}

OBJECT_DEFAULTS = {
    'use_motion_blur': True,
    'motion_steps': 1,
    'looking_glass': False,
    'dream': 1,
    'entry': 'REFLECTION',
    'reenter': 'STAY',
    'first_seen_only': False,
    'side': 'BOTH',
    'dreams': set(),
    'behind_material': None,
}


def own_names(group):
    return set(group.bl_rna.properties.keys()) - {'rna_type', 'name'}


class DefaultsTest(unittest.TestCase):

    def setUp(self):
        self.scene = scene_factory.empty_scene()

    def assert_defaults(self, group, defaults):
        for name, expected in defaults.items():
            with self.subTest(name):
                value = getattr(group, name)
                if isinstance(expected, float):
                    self.assertAlmostEqual(value, expected, places=6)
                else:
                    self.assertEqual(value, expected)

    def test_scene(self):
        self.assert_defaults(self.scene.tenniel, SCENE_DEFAULTS)
        self.assertEqual(own_names(self.scene.tenniel), set(SCENE_DEFAULTS) | {'dreams'})
        self.assertEqual(len(self.scene.tenniel.dreams), 0)

    def test_object(self):
        settings = bpy.data.objects.new("empty", None).tenniel
        self.assert_defaults(settings, OBJECT_DEFAULTS)
        self.assertEqual(own_names(settings), set(OBJECT_DEFAULTS))

    def test_material(self):
        settings = bpy.data.materials.new("plain").tenniel
        self.assertEqual(own_names(settings), {'behind_material'})
        self.assertIsNone(settings.behind_material)

    def test_every_setting_explains_itself(self):
        material = bpy.data.materials.new("plain")
        for group in (self.scene.tenniel, bpy.data.objects.new("empty", None).tenniel,
                      material.tenniel):
            for name in own_names(group) - {'active_dream_index'}:
                with self.subTest(f"{group.bl_rna.identifier}.{name}"):
                    self.assertTrue(group.bl_rna.properties[name].description)

    def test_inactive_settings_say_so(self):
        properties = self.scene.tenniel.bl_rna.properties
        for name in ('use_adaptive_sampling', 'adaptive_threshold', 'use_denoising'):
            self.assertIn("Not active", properties[name].description)

    def test_names_are_those_of_cycles(self):
        cycles = self.scene.cycles.bl_rna.properties
        own = {'dreams', 'active_dream_index', 'mirror_view'}
        for name in own_names(self.scene.tenniel) - own:
            with self.subTest(name):
                self.assertIn(name, cycles)
                self.assertEqual(cycles[name].type, self.scene.tenniel.bl_rna.properties[name].type)

    def test_filter_types_are_those_of_cycles(self):
        def items(group):
            return set(group.bl_rna.properties['pixel_filter_type'].enum_items.keys())
        self.assertEqual(items(self.scene.tenniel), items(self.scene.cycles))


class MirrorTagsTest(unittest.TestCase):

    def setUp(self):
        scene_factory.empty_scene()
        self.object = bpy.data.objects.new("thing", None)

    def test_untagged(self):
        tags = mirror_tags.effective_tags(self.object)
        self.assertEqual(tags, mirror_tags.MirrorTags())
        self.assertFalse(mirror_tags.is_tagged(tags))
        self.assertEqual(mirror_tags.worlds(tags), {0, 1, 2, 3, 4})

    def test_panel_tags_arrive(self):
        material = bpy.data.materials.new("behind")
        settings = self.object.tenniel
        settings.looking_glass, settings.dream = True, 3
        settings.entry, settings.reenter, settings.first_seen_only = 'BOTH', 'TOGGLE', True
        settings.side, settings.dreams = 'BEHIND', {'2', '4'}
        settings.behind_material = material
        self.assertEqual(
            mirror_tags.effective_tags(self.object),
            mirror_tags.MirrorTags(True, 3, 'BOTH', 'TOGGLE', True, 'BEHIND',
                                   frozenset({2, 4}), material, frozenset()))

    def test_worlds(self):
        settings = self.object.tenniel
        for side, dreams, worlds in (('BEHIND', set(), {1, 2, 3, 4}), ('BEHIND', {'2'}, {2}),
                                     ('THIS_SIDE', {'2'}, {0}), ('BOTH', {'2'}, {0, 1, 2, 3, 4})):
            with self.subTest(side=side, dreams=dreams):
                settings.side, settings.dreams = side, dreams
                self.assertEqual(
                    mirror_tags.worlds(mirror_tags.effective_tags(self.object)), worlds)

    def test_custom_properties(self):
        for value, is_true in ((True, True), (1, True), (2.5, True), ("yes", True),
                               ([0.0, 1.0], True), (False, False), (0, False), (0.0, False),
                               ("", False), ([0.0, 0.0], False)):
            with self.subTest(value=value):
                self.object['looking_glass'] = value
                self.object['behind_mirror'] = value
                tags = mirror_tags.effective_tags(self.object)
                self.assertEqual(tags.looking_glass, is_true)
                self.assertEqual(tags.side, 'BEHIND' if is_true else 'BOTH')
                self.assertEqual(
                    tags.from_custom_property,
                    {'looking_glass', 'behind_mirror'} if is_true else frozenset())

    def test_custom_property_yields_to_the_panel(self):
        self.object['behind_mirror'] = True
        self.object.tenniel.side = 'THIS_SIDE'
        tags = mirror_tags.effective_tags(self.object)
        self.assertEqual(tags.side, 'THIS_SIDE')
        self.assertEqual(tags.from_custom_property, frozenset())

    def test_instancer_takes_its_side(self):
        own = mirror_tags.MirrorTags(looking_glass=True, side='THIS_SIDE')
        behind = mirror_tags.MirrorTags(side='BEHIND', dreams=frozenset({3}))
        taken = mirror_tags.with_instancer(own, behind)
        self.assertEqual((taken.side, taken.dreams, taken.looking_glass), ('BEHIND', {3}, True))
        self.assertIs(mirror_tags.with_instancer(own, mirror_tags.MirrorTags()), own)

    def test_without_the_property_group(self):
        class Bare(dict):
            """An object as it is where the add-on's settings are not registered."""
        self.assertEqual(mirror_tags.effective_tags(Bare()), mirror_tags.MirrorTags())
        self.assertEqual(mirror_tags.effective_tags(Bare(behind_mirror=1)).side, 'BEHIND')

    def test_evaluated_object(self):
        bpy.context.scene.collection.objects.link(self.object)
        self.object.tenniel.side = 'BEHIND'
        self.object['looking_glass'] = 1
        depsgraph = bpy.context.evaluated_depsgraph_get()
        tags = mirror_tags.effective_tags(self.object.evaluated_get(depsgraph))
        self.assertEqual((tags.side, tags.looking_glass), ('BEHIND', True))


class ReportsTest(unittest.TestCase):

    def setUp(self):
        reports.clear()
        self.addCleanup(reports.clear)

    def test_equal_problems_are_counted(self):
        reports.begin("s")
        for _ in range(3):
            reports.add('WARNING', "no image", material="Oak", node="Image")
        reports.add('WARNING', "no image", material="Oak", node="Other")
        rows = reports.rows("s")
        self.assertEqual([row.count for row in rows], [3, 1])
        self.assertEqual(rows[0].where(), "Material 'Oak', node 'Image'")

    def test_errors_come_first(self):
        reports.begin("s")
        for severity in ('INFO', 'WARNING', 'ERROR', 'WARNING'):
            reports.add(severity, f"{severity} text")
        self.assertEqual([row.severity for row in reports.rows()], ['ERROR', 'WARNING', 'INFO'])
        with self.assertRaises(ValueError):
            reports.add('FATAL', "unknown severity")

    def test_scenes_are_apart(self):
        reports.begin("one")
        reports.add('INFO', "a")
        reports.begin("two")
        reports.add('INFO', "b")
        reports.add('INFO', "c", scene="one")
        self.assertEqual([row.text for row in reports.rows("one")], ["a", "c"])
        self.assertEqual([row.text for row in reports.rows()], ["b"])
        reports.clear("one")
        self.assertEqual(reports.rows("one"), [])
        reports.begin("two")
        self.assertEqual(reports.rows("two"), [])

    def test_coverage(self):
        """Of nodes in use; a node counts once, and 100 % is said of all only."""
        reports.begin("s")
        self.assertIsNone(reports.coverage("s"))
        reports.count_nodes("Oak", 1999)
        reports.count_nodes("Oak", 1999)
        reports.count_nodes("Sky", 1)
        self.assertEqual(reports.coverage("s").text(), "All 2000 shader nodes are covered")
        reports.add('INFO', "a remark", material="Oak", node="Noise")
        reports.add('WARNING', "unknown", material="Sky", node="Script")
        reports.add('ERROR', "and broken", material="Sky", node="Script")
        reports.add('WARNING', "of the object", material="Sky")
        self.assertEqual(reports.coverage("s"), (2000, 1))
        self.assertEqual(reports.coverage("s").text(), "99.9 % of 2000 shader nodes are covered")
        reports.begin("s")
        self.assertIsNone(reports.coverage("s"))

    def test_number_of_rows_is_bounded(self):
        reports.begin("s")
        for number in range(reports.MAX_ROWS + 7):
            reports.add('ERROR', f"problem {number}")
        rows = reports.rows("s")
        self.assertEqual(len(rows), reports.MAX_ROWS + 1)
        self.assertEqual(rows[-1].count, 7)

    def test_threads(self):
        reports.begin("s")

        def work():
            for number in range(1000):
                reports.add('WARNING', f"problem {number % 10}")
        threads = [threading.Thread(target=work) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual([row.count for row in reports.rows("s")], [800] * 10)

    def test_rows_hold_no_blender_data(self):
        reports.begin("s")
        reports.add('INFO', types.SimpleNamespace(x=1), object="o")
        self.assertTrue(all(isinstance(value, (str, int)) for value in reports.rows("s")[0]))
