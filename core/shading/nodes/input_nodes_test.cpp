// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <memory>
#include <variant>

#include "image/texture.h"
#include "shading/node_type.h"
#include "shading/nodes/attribute_names.h"
#include "shading/shader_ir.h"

namespace tenniel {
namespace {

// One registered node with every output in its own register, run on a context of the test's own.
class NodeRun {
 public:
  explicit NodeRun(const char* idname) : type_(*node_registry().find(idname)), data_(type_) {
    RegisterIndex next = 0;
    for (const OutputInfo& output : type_.outputs) {
      targets_.push_back(next);
      set_target(data_.get(), output, next);
      next += register_count(output.type);
    }
    context.reserve(static_cast<size_t>(next));
  }
  template <class T>
  T& setting(const char* name) {
    return *reinterpret_cast<T*>(static_cast<char*>(data_.get()) + type_.setting(name)->offset);
  }
  void choose(const char* name, const char* choice) {
    const SettingInfo& info = *type_.setting(name);
    for (size_t i = 0; i < info.choices.size(); ++i)
      if (info.choices[i] == choice) return info.set_choice(data_.get(), i);
    FAIL() << name << " has no choice " << choice;
  }
  void input(const char* identifier, Constant value) {
    set_constant(data_.get(), *type_.input(identifier), value);
  }
  Vec3 vector(const char* identifier) {
    const RegisterIndex at = target_of(identifier);
    return {context.read_register(at), context.read_register(at + 1),
            context.read_register(at + 2)};
  }
  float number(const char* identifier) { return context.read_register(target_of(identifier)); }
  void run() { type_.eval(data_.get(), context); }

  ShadingContext context;

 private:
  RegisterIndex target_of(const char* identifier) {
    for (size_t i = 0; i < type_.outputs.size(); ++i)
      if (type_.outputs[i].identifier == identifier) return targets_[i];
    ADD_FAILURE() << "no output " << identifier;
    return 0;
  }

  const NodeType& type_;
  NodeData data_;
  std::vector<RegisterIndex> targets_;
};

// A triangle in the plane z = 1 of an object that is twice as large and stands at (10, 0, 0).
struct Scene {
  Mesh mesh;
  Instance instance;

  Scene() {
    mesh.positions = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    mesh.corners_per_face = 3;
    mesh.face_vertices = {0, 1, 2};
    mesh.face_corners = {0, 1, 2};
    instance.object_to_world = {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {10, 0, 0}};
    instance.world_to_object = instance.object_to_world.inverse();
    instance.texture_space_location = {0.5f, 0.5f, 1.0f};
    instance.texture_space_size = {0.5f, 0.5f, 1.0f};
    instance.color = {0.1f, 0.2f, 0.3f};
    instance.pass_index = 7.0f;
    instance.random = 0.625f;
  }
  void add(int id, Attribute attribute) {
    mesh.slot_of_attribute.resize(static_cast<size_t>(id) + 1, -1);
    mesh.slot_of_attribute[static_cast<size_t>(id)] = static_cast<int16_t>(mesh.attributes.size());
    mesh.attributes.push_back(std::move(attribute));
  }
  SurfaceInteraction at(float u, float v) const {
    SurfaceInteraction s;
    s.instance = &instance;
    s.mesh = &mesh;
    s.vertices = {0, 1, 2};
    s.weights = {1.0f - u - v, u, v};
    s.u = u;
    s.v = v;
    for (size_t i = 0; i < 3; ++i)
      s.corner_points[i] = instance.object_to_world.point(mesh.positions[i]);
    s.position =
        s.corner_points[0] * s.weights[0] + s.corner_points[1] * u + s.corner_points[2] * v;
    s.geometric_normal = s.shading_normal = {0, 0, 1};
    s.wo = normalize(Vec3{1, 0, 1});
    s.t = 3.0f;
    return s;
  }
};

void expect_near(Vec3 a, Vec3 b) {
  EXPECT_NEAR(a.x, b.x, 2e-6f);
  EXPECT_NEAR(a.y, b.y, 2e-6f);
  EXPECT_NEAR(a.z, b.z, 2e-6f);
}

TEST(GeometryNode, TellsThePoint) {
  const Scene scene;
  NodeRun node("ShaderNodeNewGeometry");
  node.context.surface = scene.at(0.25f, 0.5f);
  node.run();
  expect_near(node.vector("Position"), {10.5f, 1.0f, 2.0f});
  expect_near(node.vector("Parametric"), {0.25f, 0.25f, 0.0f});
  expect_near(node.vector("Incoming"), normalize(Vec3{1, 0, 1}));
  EXPECT_EQ(node.number("Backfacing"), 0.0f);
  // Generated there is (0.25, 0.5, 0.5): around the middle the tangent points to -y.
  expect_near(node.vector("Tangent"), {0.0f, -1.0f, 0.0f});
}

TEST(TextureCoordinateNode, AnswersInEachSpace) {
  Scene scene;
  scene.add(0, {k_active_uv, AttributeDomain::corner, 2, {0, 0, 1, 0, 0, 1}});
  NodeRun node("ShaderNodeTexCoord");
  node.setting<AttributeSlot>("active_uv").id = 0;
  CameraInfo camera;
  camera.world_to_camera.translation = {-10.0f, 0.0f, -5.0f};  // stands at (10, 0, 5), looks down
  node.context.camera = &camera;
  node.context.surface = scene.at(0.25f, 0.5f);
  node.run();
  expect_near(node.vector("Generated"), {0.25f, 0.5f, 0.5f});
  expect_near(node.vector("UV"), {0.25f, 0.5f, 0.0f});
  expect_near(node.vector("Object"), {0.25f, 0.5f, 1.0f});
  expect_near(node.vector("Normal"), {0, 0, 1});
  expect_near(node.vector("Camera"), {0.5f, 1.0f, 3.0f});
  expect_near(node.vector("Reflection"), normalize(Vec3{-1, 0, 1}));
}

TEST(TextureCoordinateNode, UndeformedPositionsWinOverTheShadedOne) {
  Scene scene;
  scene.add(0, {k_undeformed, AttributeDomain::vertex, 3, {1, 1, 2, 1, 1, 2, 1, 1, 2}});
  NodeRun node("ShaderNodeTexCoord");
  node.setting<AttributeSlot>("undeformed").id = 0;
  node.context.surface = scene.at(0.25f, 0.5f);
  node.run();
  expect_near(node.vector("Generated"), {1.0f, 1.0f, 1.0f});
}

TEST(TextureCoordinateNode, WorldsAnswerWithTheDirection) {
  NodeRun node("ShaderNodeTexCoord");
  node.context.domain = ShaderDomain::world;
  node.context.surface.position = {0.0f, 0.6f, 0.8f};
  node.context.surface.wo = {0.0f, -0.6f, -0.8f};
  node.run();
  expect_near(node.vector("Generated"), {0.0f, 0.6f, 0.8f});
  expect_near(node.vector("Object"), {0.0f, 0.6f, 0.8f});
  expect_near(node.vector("Normal"), {0.0f, -0.6f, -0.8f});
  expect_near(node.vector("UV"), {});
}

TEST(AttributeNode, SpreadsNumbersAndDefaultsToBlack) {
  Scene scene;
  scene.add(2, {"heat", AttributeDomain::vertex, 1, {0.0f, 1.0f, 0.5f}});
  NodeRun node("ShaderNodeAttribute");
  node.context.surface = scene.at(0.25f, 0.5f);
  node.setting<AttributeSlot>("attribute_name") = {"heat", 2};
  node.run();
  expect_near(node.vector("Color"), {0.5f, 0.5f, 0.5f});
  EXPECT_FLOAT_EQ(node.number("Fac"), 0.5f);
  EXPECT_FLOAT_EQ(node.number("Alpha"), 1.0f);
  node.setting<AttributeSlot>("attribute_name") = {"absent", 1};
  node.run();
  expect_near(node.vector("Vector"), {});
}

TEST(AttributeNode, FactorOfTwoNumbersIsTheFirst) {
  Scene scene;
  scene.add(0, {"map", AttributeDomain::corner, 2, {0, 0, 1, 0, 0, 1}});
  NodeRun node("ShaderNodeAttribute");
  node.context.surface = scene.at(0.25f, 0.5f);
  node.setting<AttributeSlot>("attribute_name") = {"map", 0};
  node.run();
  EXPECT_FLOAT_EQ(node.number("Fac"), 0.25f);
}

TEST(AttributeNode, ReadsObjectsAndTheMirror) {
  Scene scene;
  scene.instance.object_attributes = {{4, {0.1f, 0.2f, 0.6f, 0.5f}}};
  NodeRun node("ShaderNodeAttribute");
  node.context.surface = scene.at(0.25f, 0.25f);
  node.choose("attribute_type", "OBJECT");
  node.setting<AttributeSlot>("attribute_name") = {"tint", 4};
  node.run();
  expect_near(node.vector("Vector"), {0.1f, 0.2f, 0.6f});
  EXPECT_FLOAT_EQ(node.number("Fac"), 0.3f);
  EXPECT_FLOAT_EQ(node.number("Alpha"), 0.5f);
  node.setting<AttributeSlot>("attribute_name") = {"absent", 5};
  node.run();
  EXPECT_EQ(node.number("Alpha"), 0.0f);

  node.context.path.world = 3;
  node.setting<AttributeSlot>("attribute_name").name = k_dream;
  node.run();
  EXPECT_EQ(node.number("Fac"), 3.0f);
  node.setting<AttributeSlot>("attribute_name").name = k_behind_mirror;
  node.run();
  EXPECT_EQ(node.number("Fac"), 1.0f);
  node.context.path.world = 0;
  node.context.surface = {};  // as in a World
  node.run();
  EXPECT_EQ(node.number("Fac"), 0.0f);
}

TEST(ColorAttributeNode, IsTransparentBlackWhereMissing) {
  Scene scene;
  scene.add(0, {"paint", AttributeDomain::face, 4, {0.1f, 0.2f, 0.3f, 0.4f}});
  NodeRun node("ShaderNodeVertexColor");
  node.context.surface = scene.at(0.2f, 0.2f);
  EXPECT_EQ(node.setting<AttributeSlot>("layer_name").name, k_active_color);
  node.run();
  EXPECT_EQ(node.number("Alpha"), 0.0f);
  node.setting<AttributeSlot>("layer_name").id = 0;
  node.run();
  expect_near(node.vector("Color"), {0.1f, 0.2f, 0.3f});
  EXPECT_FLOAT_EQ(node.number("Alpha"), 0.4f);
}

TEST(ObjectInfoNode, CopiesTheInstance) {
  const Scene scene;
  NodeRun node("ShaderNodeObjectInfo");
  node.context.surface = scene.at(0.2f, 0.2f);
  node.context.material_pass_index = 2.0f;
  node.run();
  expect_near(node.vector("Location"), {10, 0, 0});
  expect_near(node.vector("Color"), {0.1f, 0.2f, 0.3f});
  EXPECT_EQ(node.number("Object Index"), 7.0f);
  EXPECT_EQ(node.number("Material Index"), 2.0f);
  EXPECT_EQ(node.number("Random"), 0.625f);
}

TEST(LightPathNode, ShadowRaysAreNothingElseAndOneBounceOn) {
  NodeRun node("ShaderNodeLightPath");
  PathInfo& path = node.context.path;
  path.kind = RayKind::shadow;
  path.is_reflection = path.is_singular = true;
  path.ray_depth = 2;
  path.transparent_depth = 4;
  node.run();
  EXPECT_EQ(node.number("Is Shadow Ray"), 1.0f);
  EXPECT_EQ(node.number("Is Camera Ray"), 0.0f);
  EXPECT_EQ(node.number("Is Reflection Ray"), 0.0f);
  EXPECT_EQ(node.number("Is Singular Ray"), 0.0f);
  EXPECT_EQ(node.number("Ray Depth"), 3.0f);
  EXPECT_EQ(node.number("Transparent Depth"), 4.0f);
  path.kind = RayKind::transmission;
  node.run();
  EXPECT_EQ(node.number("Is Transmission Ray"), 1.0f);
  EXPECT_EQ(node.number("Is Glossy Ray"), 1.0f);
  EXPECT_EQ(node.number("Is Diffuse Ray"), 0.0f);
  EXPECT_EQ(node.number("Ray Depth"), 2.0f);
}

TEST(LightPathNode, SampledLightIsMetByNoRay) {
  NodeRun node("ShaderNodeLightPath");
  PathInfo& path = node.context.path;
  path.is_light_sample = path.is_reflection = path.is_singular = true;
  path.ray_depth = 1;
  for (const RayKind kind : {RayKind::camera, RayKind::diffuse, RayKind::glossy,
                             RayKind::transmission, RayKind::shadow}) {
    path.kind = kind;
    node.run();
    for (const char* name : {"Is Camera Ray", "Is Shadow Ray", "Is Diffuse Ray", "Is Glossy Ray",
                             "Is Transmission Ray", "Is Reflection Ray", "Is Singular Ray"})
      EXPECT_EQ(node.number(name), 0.0f) << name;
  }
}

TEST(FresnelNode, InvertsTheIndexFromInside) {
  const Scene scene;
  NodeRun node("ShaderNodeFresnel");
  node.context.surface = scene.at(0.2f, 0.2f);
  node.context.surface.wo = node.context.closure_normal = {0, 0, 1};
  node.input("IOR", {1.5f, 0, 0});
  node.run();
  EXPECT_NEAR(node.number("Fac"), 0.04f, 1e-6f);
  node.context.surface.is_back_facing = true;
  node.context.surface.wo = normalize(Vec3{1, 0, 1});
  node.run();
  EXPECT_EQ(node.number("Fac"), 1.0f);  // beyond the critical angle of 41.8 degrees
}

TEST(CameraDataNode, LooksForwardAlongPositiveZ) {
  NodeRun node("ShaderNodeCameraData");
  CameraInfo camera;
  node.context.camera = &camera;
  node.context.surface.position = {3.0f, 0.0f, -4.0f};
  node.run();
  EXPECT_FLOAT_EQ(node.number("View Z Depth"), 4.0f);
  EXPECT_FLOAT_EQ(node.number("View Distance"), 5.0f);
  expect_near(node.vector("View Vector"), {0.6f, 0.0f, 0.8f});
}

TEST(VectorTransformNode, ThereAndBack) {
  const Scene scene;
  NodeRun node("ShaderNodeVectorTransform");
  node.context.surface = scene.at(0.2f, 0.2f);
  node.choose("vector_type", "POINT");
  node.input("Vector", {12.0f, 4.0f, 6.0f});
  node.run();
  expect_near(node.vector("Vector"), {1.0f, 2.0f, 3.0f});
  node.choose("convert_from", "OBJECT");
  node.choose("convert_to", "WORLD");
  node.input("Vector", {1.0f, 2.0f, 3.0f});
  node.run();
  expect_near(node.vector("Vector"), {12.0f, 4.0f, 6.0f});
}

TEST(ImageTextureNode, MissingImageIsMagenta) {
  NodeRun node("ShaderNodeTexImage");
  node.run();
  expect_near(node.vector("Color"), {1, 0, 1});
  EXPECT_EQ(node.number("Alpha"), 1.0f);
}

TEST(ImageTextureNode, BoxShowsTheFaceThatLooksAtYou) {
  auto image = std::make_shared<Image>();
  image->width = image->height = 2;
  image->channels = 1;
  image->pixels = std::vector<float>{0.1f, 0.2f, 0.3f, 0.4f};
  const Texture texture(image, Interpolation::closest, Extension::repeat);
  const Scene scene;
  NodeRun node("ShaderNodeTexImage");
  node.setting<ImageSlot>("image").texture = &texture;
  node.choose("projection", "BOX");
  node.context.surface = scene.at(0.2f, 0.2f);  // normal +z: reads (1 - y, x)
  node.input("Vector", {0.75f, 0.75f, 0.0f});
  node.run();
  EXPECT_FLOAT_EQ(node.vector("Color").x, 0.3f);
}

TEST(EnvironmentTextureNode, ReadsTheDirection) {
  auto image = std::make_shared<Image>();
  image->width = 4;
  image->height = 1;
  image->channels = 1;
  image->pixels = std::vector<float>{0.1f, 0.2f, 0.3f, 0.4f};
  const Texture texture(image, Interpolation::closest, Extension::repeat);
  NodeRun node("ShaderNodeTexEnvironment");
  node.setting<ImageSlot>("image").texture = &texture;
  node.input("Vector", {-1.0f, 1.0f, 0.0f});  // u = 0.5 - 135/360
  node.run();
  EXPECT_FLOAT_EQ(node.vector("Color").x, 0.1f);
}

TEST(ColorRampNode, ConstantDoesNotInterpolate) {
  NodeRun node("ShaderNodeValToRGB");
  node.setting<std::vector<float>>("color_ramp") = {0, 0, 0, 1, 1, 1, 1, 0};
  node.input("Fac", {0.75f, 0, 0});
  node.run();
  EXPECT_FLOAT_EQ(node.vector("Color").y, 0.75f);
  EXPECT_FLOAT_EQ(node.number("Alpha"), 0.25f);
  node.choose("interpolation", "CONSTANT");
  node.run();
  EXPECT_FLOAT_EQ(node.vector("Color").y, 0.0f);
}

TEST(MixNode, ChoosesItsOutputByType) {
  NodeRun node("ShaderNodeMix");
  node.choose("data_type", "RGBA");
  node.choose("blend_type", "ADD");
  node.setting<bool>("clamp_result") = true;
  node.input("Factor_Float", {3.0f, 0, 0});
  node.input("A_Color", {0.25f, 0.5f, 0.75f});
  node.input("B_Color", {0.5f, 0.25f, 0.5f});
  node.run();
  expect_near(node.vector("Result_Color"), {0.75f, 0.75f, 1.0f});
  node.choose("data_type", "VECTOR");
  node.choose("factor_mode", "NON_UNIFORM");
  node.input("Factor_Vector", {0.0f, 0.5f, 2.0f});
  node.input("B_Vector", {1, 1, 1});
  node.run();
  expect_near(node.vector("Result_Vector"), {0.0f, 0.5f, 1.0f});
}

TEST(MapRangeNode, EmptySourceAndClamp) {
  NodeRun node("ShaderNodeMapRange");
  node.input("Value", {3.0f, 0, 0});
  node.input("To Max", {10.0f, 0, 0});
  node.run();
  EXPECT_FLOAT_EQ(node.number("Result"), 10.0f);
  node.setting<bool>("clamp") = false;
  node.run();
  EXPECT_FLOAT_EQ(node.number("Result"), 30.0f);
  node.input("From Min", {1.0f, 0, 0});
  node.run();
  EXPECT_FLOAT_EQ(node.number("Result"), 0.0f);
}

TEST(Registry, NamesAreUniqueInEachNode) {
  for (const auto& type : node_registry().all()) {
    for (size_t i = 0; i < type->inputs.size(); ++i)
      EXPECT_EQ(type->input(type->inputs[i].identifier), &type->inputs[i]) << type->idname;
    for (size_t i = 0; i < type->outputs.size(); ++i)
      EXPECT_EQ(type->output(type->outputs[i].identifier), &type->outputs[i]) << type->idname;
    EXPECT_EQ(node_registry().find(type->idname), type.get());
  }
}

}  // namespace
}  // namespace tenniel
