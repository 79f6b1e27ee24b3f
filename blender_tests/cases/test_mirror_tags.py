# SPDX-License-Identifier: GPL-3.0-or-later
"""Magic mirror tags on instances, materials and dreams; tags that change nothing; mistakes."""
import bpy

from support import compare, scene_factory
from support.mirror import MIRROR_Y, MirrorCase, coated
from support.render import TESTED_ENGINE, render, render_seeds
from support.tile_grid import emission_of
from tenniel import reports


class InstanceTest(MirrorCase):
    """Proof 9 for instances of several origins, materials, dreams and nodes."""

    RADIANCE = (1.0, 2.0, 4.0)

    def build(self, add, reflectance=1.0):
        add()
        self.looking_glass(scene_factory.mirror((reflectance,) * 3))
        scene_factory.camera(self.scene, (0.0, -3.0, 1.2), (0, MIRROR_Y, 1.2), lens=40.0)
        return render(TESTED_ENGINE, 16, 0, (33, 33))

    def ball(self, collection=None, side="BOTH"):
        """Emissive sphere on the line from the camera to the middle of the mirror."""
        obj = scene_factory.sphere(self.scene, 0.4, scene_factory.emission(self.RADIANCE),
                                   name="Ball")
        obj.tenniel.side = side
        if collection:
            self.scene.collection.objects.unlink(obj)
            collection.objects.link(obj)
        return obj

    def collection_instance(self, instancer_side, ball_side):
        collection = bpy.data.collections.new("Balls")
        self.ball(collection, ball_side)
        empty = scene_factory.link(self.scene, None, "Instancer", (0.0, -0.5, 1.2))
        empty.instance_type = "COLLECTION"
        empty.instance_collection = collection
        empty.tenniel.side = instancer_side

    def vertex_instance(self, instancer_side, ball_side):
        parent = scene_factory.link(self.scene, scene_factory.mesh("Dots", [(0, -0.5, 1.2)], []),
                                    "Instancer")
        parent.instance_type = "VERTS"
        parent.tenniel.side = instancer_side
        self.ball(side=ball_side).parent = parent

    def test_side_of_instancer_and_object(self):
        """Directly the ball hides the middle of the mirror; behind, it is seen by reflection."""
        direct, none = self.RADIANCE, (0.0, 0.0, 0.0)
        cases = {("BEHIND", "BOTH"): "behind", ("BOTH", "BEHIND"): "behind",
                 ("THIS_SIDE", "BOTH"): "this", ("BOTH", "THIS_SIDE"): "this",
                 ("THIS_SIDE", "BEHIND"): "this", ("BEHIND", "THIS_SIDE"): "behind"}
        for add in (self.collection_instance, self.vertex_instance, self.particle_instance,
                    self.geometry_nodes_instance):
            for (instancer, ball), seen in cases.items():
                with self.subTest(f"{add.__name__}: instancer {instancer}, object {ball}"):
                    self.setUp()
                    picture = self.build(lambda a=add, i=instancer, b=ball: a(i, b), 0.5)
                    expected = [0.5 * r for r in direct] if seen == "behind" else direct
                    self.assert_pixel(picture, 16, 16, expected)
                    # Beside the ball but inside the mirror: nothing shines in either world.
                    self.assert_pixel(picture, 2, 16, none)

    def particle_instance(self, instancer_side, ball_side):
        parent = scene_factory.plane(self.scene, 0.01, scene_factory.diffuse((0, 0, 0)),
                                     name="Instancer", location=(0.0, -0.5, 1.2))
        parent.tenniel.side = instancer_side
        parent.show_instancer_for_render = False
        settings = parent.modifiers.new("Particles", 'PARTICLE_SYSTEM').particle_system.settings
        settings.count, settings.frame_start, settings.frame_end = 1, 0.0, 0.0
        settings.physics_type, settings.particle_size = 'NO', 1.0
        settings.emit_from, settings.use_emit_random = 'VERT', False
        ball = self.ball(side=ball_side)
        # What is instanced is not to be seen itself.
        ball.location = (0.0, 100.0, 0.0)
        settings.render_type, settings.instance_object = 'OBJECT', ball
        self.scene.frame_set(1)

    def geometry_nodes_instance(self, instancer_side, ball_side):
        ball = self.ball(side=ball_side)
        ball.location = (0.0, 100.0, 0.0)
        parent = scene_factory.link(self.scene, scene_factory.mesh("Dot", [(0, -0.5, 1.2)], []),
                                    "Instancer")
        parent.tenniel.side = instancer_side
        tree = bpy.data.node_groups.new("Instances", 'GeometryNodeTree')
        tree.inputs.new('NodeSocketGeometry', "Geometry")
        tree.outputs.new('NodeSocketGeometry', "Geometry")
        nodes = scene_factory.Nodes(tree)
        on_points = nodes.add("GeometryNodeInstanceOnPoints", None, {
            "Points": nodes.add("NodeGroupInput"),
            "Instance": nodes.add("GeometryNodeObjectInfo", None, {
                "Object": ball, "As Instance": True}).outputs["Geometry"]})
        nodes.add("NodeGroupOutput", None, {0: on_points})
        parent.modifiers.new("Instances", 'NODES').node_group = tree

    def test_behind_material(self):
        other = (4.0, 0.5, 0.25)
        for where in ("object", "material"):
            with self.subTest(where):
                self.setUp()

                def add():
                    obj = self.ball()
                    obj.location = (0.6, -0.5, 1.2)
                    look = scene_factory.emission(other)
                    owner = obj if where == "object" else obj.data.materials[0]
                    owner.tenniel.behind_material = look
                picture = self.build(add)
                colors = {tuple(round(v, 3) for v in picture.pixel(x, 16)[:3]) for x in range(33)}
                self.assertIn(self.RADIANCE, colors, "seen directly")
                self.assertIn(other, colors, "seen in the mirror")

    def test_attribute_node(self):
        def add():
            material = emission_of("world", lambda n: n.add("ShaderNodeCombineXYZ", None, {
                0: 1.0, 1: n.add("ShaderNodeAttribute", {
                    "attribute_name": "behind_mirror"}).outputs["Fac"]}))
            obj = self.ball()
            obj.data.materials[0] = material
            obj.location = (0.6, -0.5, 1.2)
        picture = self.build(add)
        colors = {tuple(round(v, 3) for v in picture.pixel(x, 16)[:3]) for x in range(33)}
        self.assertIn((1.0, 0.0, 0.0), colors)
        self.assertIn((1.0, 1.0, 0.0), colors)

    def test_two_dreams_with_their_own_worlds(self):
        """Two mirrors side by side show two skies; directly there is a third."""
        skies = ((0.25, 0.5, 1.0), (1.0, 0.5, 0.25))
        for index, sky in enumerate(skies):
            dream = self.scene.tenniel.dreams.add()
            dream.name = f"Dream {index + 1}"
            own = self.scene.world
            scene_factory.set_world(self.scene, sky)
            dream.world, self.scene.world = self.scene.world, own
        scene_factory.set_world(self.scene, (0.125, 0.125, 0.125))
        for index, x in enumerate((-1.0, 1.0)):
            obj = scene_factory.plane(self.scene, 1.8, scene_factory.mirror((1, 1, 1)),
                                      location=(x, MIRROR_Y, 1.2), rotation=(90, 0, 0))
            obj.tenniel.looking_glass = True
            obj.tenniel.dream = index + 1
        scene_factory.camera(self.scene, (0.0, -4.0, 1.2), (0, MIRROR_Y, 1.2), lens=40.0)
        picture = render(TESTED_ENGINE, 4, 0, (48, 36))
        self.assert_pixel(picture, 16, 18, skies[0])
        self.assert_pixel(picture, 32, 18, skies[1])
        self.assert_pixel(picture, 24, 1, (0.125, 0.125, 0.125))

    def test_object_in_one_dream_only(self):
        settings = scene_factory.link(self.scene, None, "Probe").tenniel
        items = [i.identifier for i in settings.bl_rna.properties["dreams"].enum_items]
        for wanted, expected in ((0, (0.0, 0.0, 0.0)), (1, self.RADIANCE)):
            with self.subTest(items[wanted]):
                self.setUp()
                for name in ("First", "Second"):
                    self.scene.tenniel.dreams.add().name = name
                obj = self.ball(side="BEHIND")
                obj.location = (0.0, -0.5, 1.2)
                obj.tenniel.dreams = {items[wanted]}
                glass = self.looking_glass(scene_factory.mirror((1, 1, 1)))
                glass.tenniel.dream = 2
                scene_factory.camera(self.scene, (0.0, -3.0, 1.2), (0, MIRROR_Y, 1.2), lens=40.0)
                self.assert_pixel(render(TESTED_ENGINE, 4, 0, (33, 33)), 16, 16, expected)

    def test_portal(self):
        """Entry by transmission: the other world is seen through the surface."""
        obj = self.ball(side="BEHIND")
        obj.location = (0.0, MIRROR_Y + 2.0, 1.2)
        for entry, expected in (("TRANSMISSION", self.RADIANCE), ("BOTH", self.RADIANCE),
                                ("REFLECTION", (0.0, 0.0, 0.0))):
            glass = self.looking_glass(scene_factory.simple_material(
                "ShaderNodeBsdfTransparent", Color=(1, 1, 1)), entry=entry)
            scene_factory.camera(self.scene, (0.0, -3.0, 1.2), (0, MIRROR_Y, 1.2), lens=40.0)
            with self.subTest(entry):
                self.assert_pixel(render(TESTED_ENGINE, 4, 0, (33, 33)), 16, 16, expected)
            bpy.data.objects.remove(glass)

    def test_first_seen_only(self):
        """The floor is not lit from behind when only the directly seen mirror is magic."""
        def floor_light(first_seen_only):
            self.setUp()
            scene_factory.plane(self.scene, 6.0, scene_factory.diffuse((1, 1, 1)), "Floor")
            obj = scene_factory.plane(self.scene, 2.0, scene_factory.emission((1, 1, 1), 5.0),
                                      location=(0, -1.0, 3.0))
            obj.tenniel.side = "BEHIND"
            self.looking_glass(scene_factory.mirror((1, 1, 1)), first_seen_only=first_seen_only)
            scene_factory.top_camera(self.scene, 1.0, (0, 0.5), 8.0)
            return render(TESTED_ENGINE, 256, 0, (8, 8)).mean()[0]
        self.assertGreater(floor_light(False), 0.01)
        self.assertEqual(floor_light(True), 0.0)


class NothingTaggedTest(MirrorCase):
    """Proof 10: without a difference between the worlds, not a bit changes."""

    def ordinary(self, roughness=0.0):
        glass = self.room(scene_factory.mirror((0.9, 0.9, 0.9), roughness))
        for name in ("BEHIND", "THIS_SIDE"):
            self.scene.objects[name].tenniel.side = "BOTH"
        return glass

    def test_tags_that_mean_nothing(self):
        glass = self.ordinary(0.2)
        glass.tenniel.looking_glass = False
        plain = render(TESTED_ENGINE, 16, 3, self.RESOLUTION)
        glass["looking_glass"] = False
        self.scene.objects["Floor"]["behind_mirror"] = 0
        self.scene.tenniel.dreams.add().name = "unused"
        self.assert_bitwise_equal(render(TESTED_ENGINE, 16, 3, self.RESOLUTION), plain,
                                  "false tags")

    def pictures_with_and_without_tag(self, roughness):
        glass = self.ordinary(roughness)
        magic = render(TESTED_ENGINE, 16, 3, self.RESOLUTION)
        glass.tenniel.looking_glass = False
        return magic, render(TESTED_ENGINE, 16, 3, self.RESOLUTION)

    def test_sharp_looking_glass_into_an_equal_world(self):
        magic, plain = self.pictures_with_and_without_tag(0.0)
        self.assert_bitwise_equal(magic, plain, "equal worlds")

    def test_rough_looking_glass_into_an_equal_world(self):
        magic, plain = self.pictures_with_and_without_tag(0.2)
        self.assert_bitwise_equal(magic, plain, "equal worlds")

    def test_mixed_lobes_into_an_equal_world(self):
        """With lobes that enter and lobes that stay the estimator differs, the mean does not."""
        self.ordinary()
        self.scene.objects["Looking Glass"].data.materials[0] = scene_factory.node_material(
            "coat", coated)
        settings = {"samples": 256, "resolution": self.RESOLUTION}
        magic = render_seeds(TESTED_ENGINE, 3, **settings)
        self.scene.objects["Looking Glass"].tenniel.looking_glass = False
        plain = render_seeds(TESTED_ENGINE, 3, 77, **settings)
        self.assert_pictures_agree(magic, plain, "mixed lobes", 6, 0.01, 1e-4, max_noise=0.03)


class MistakeTest(MirrorCase):
    """Section 4 of the definition: errors lose nothing."""

    def test_looking_glass_without_faces(self):
        self.room()
        obj = scene_factory.link(self.scene, scene_factory.mesh("Nothing", [], []))
        obj.tenniel.looking_glass = True
        render(TESTED_ENGINE, 1, 0, (8, 8))

    def test_dream_that_is_not_there(self):
        self.room().tenniel.dream = 4
        render(TESTED_ENGINE, 1, 0, (8, 8))

    def test_behind_object_without_looking_glass(self):
        self.room().tenniel.looking_glass = False
        render(TESTED_ENGINE, 1, 0, (8, 8))

    def test_looking_glass_that_cannot_be_entered(self):
        """Said of a matte one, not of one that reflects or of a portal that lets light through."""
        def matte():
            return scene_factory.diffuse((0.5, 0.5, 0.5))

        def clear():
            return scene_factory.simple_material("ShaderNodeBsdfTransparent", Color=(1, 1, 1))

        def mirror():
            return scene_factory.mirror((1, 1, 1))
        for make, entry, word in ((matte, 'REFLECTION', "reflects"),
                                  (clear, 'REFLECTION', "reflects"),
                                  (matte, 'TRANSMISSION', "lets light through"),
                                  (lambda: None, 'BOTH', "reflects or lets light through"),
                                  (clear, 'TRANSMISSION', None), (clear, 'BOTH', None),
                                  (mirror, 'REFLECTION', None)):
            with self.subTest(f"{make.__name__}, {entry}"):
                self.setUp()
                glass = self.room()
                glass.data.materials[0] = make()
                glass.tenniel.entry = entry
                render(TESTED_ENGINE, 1, 0, (8, 8))
                found = [f"{row.object}: {row.text}" for row in reports.rows(self.scene.name)
                         if "it shows no dream" in row.text]
                expected = f"Looking Glass: No material of this looking glass {word}: "
                self.assertEqual(found, [expected + "it shows no dream"] if word else [])


class PassTest(MirrorCase):

    def test_passes(self):
        """Mirror World and its coverage as the camera sees the glass, Dream as the difference."""
        self.room(scene_factory.mirror((0.9, 0.9, 0.9)))
        samples = 8  # each with a camera ray of its own, whatever it meets
        covered = self.coverage(samples=samples)
        layer = bpy.context.view_layer
        layer.tenniel.use_pass_mirror_world = layer.tenniel.use_pass_dream = True
        channels = render(TESTED_ENGINE, samples, 5, self.RESOLUTION, True,
                          diffuse_bounces=0).layers
        names = {name: [channels[f"{layer.name}.{name}.{c}"] for c in letters]
                 for name, letters in (("Mirror World", "X"), ("Mirror Coverage", "X"),
                                       ("Dream", "RGB"), ("Combined", "RGB"))}
        for i, expected in enumerate(covered):
            coverage = names["Mirror Coverage"][0][i]
            self.assertAlmostEqual(coverage, expected, delta=1e-5)
            self.assertEqual(names["Mirror World"][0][i], float(expected > 0.0))
            for dream, combined in zip(names["Dream"], names["Combined"]):
                if expected in (0.0, 1.0):
                    self.assertAlmostEqual(dream[i], expected * combined[i], delta=1e-5)
        self.assertGreater(max(names["Dream"][0]), 0.05)

    def test_off_unless_asked_for(self):
        self.room()
        names = render(TESTED_ENGINE, 1, 0, (8, 8), True).layers
        self.assertFalse([name for name in names if "Mirror" in name or "Dream" in name])
