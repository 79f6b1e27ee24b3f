// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "image/voxel_grid.h"
#include "shading/nodes/test_surface.h"
#include "shading/test_graph.h"

namespace tenniel {
namespace {

MediumProperties volume_of(const std::string& text) {
  const TestMaterial test(text);
  EXPECT_TRUE(test.reports.empty());
  EXPECT_TRUE(test.material.is_volume_constant);
  return test.material.constant_volume;
}

void expect_near(Spectrum a, Spectrum b) {
  EXPECT_NEAR(a.r, b.r, 1e-5f);
  EXPECT_NEAR(a.g, b.g, 1e-5f);
  EXPECT_NEAR(a.b, b.b, 1e-5f);
}

constexpr const char* k_output = "out: ShaderNodeOutputMaterial Volume<v.Volume\n";

TEST(VolumeNodes, AbsorptionTakesWhatTheColorLacks) {
  const MediumProperties m = volume_of(
      std::string(k_output) + "v: ShaderNodeVolumeAbsorption Color=0.2,0.5,1.5,1 Density=2\n");
  expect_near(m.sigma_a, {1.6f, 1.0f, 0.0f});
  EXPECT_TRUE(is_black(m.sigma_s));
  EXPECT_TRUE(m.phase.empty());
}

TEST(VolumeNodes, ScatterHasNoAbsorption) {
  const MediumProperties m =
      volume_of(std::string(k_output) +
                "v: ShaderNodeVolumeScatter Color=0.2,0.5,0.9,1 Density=2 Anisotropy=0.5\n");
  expect_near(m.sigma_s, {0.4f, 1.0f, 1.8f});
  EXPECT_TRUE(is_black(m.sigma_a));
  const Vec3 z{0.0f, 0.0f, 1.0f};
  expect_near(m.phase.eval(z, z).value, m.sigma_s * henyey_greenstein(z, z, 0.5f));
}

TEST(VolumeNodes, PrincipledAbsorbsByTheRootOfItsAbsorptionColor) {
  const MediumProperties m =
      volume_of(std::string(k_output) +
                "v: ShaderNodeVolumePrincipled Color=0.5,0.5,0.5,1 Density=2 "
                "Absorption~Color=0.25,0.49,0.81,1 Emission~Strength=3 "
                "Emission~Color=1,0.5,0,1\n");
  expect_near(m.sigma_s, Spectrum(1.0f));
  expect_near(m.sigma_a, {0.5f, 0.3f, 0.1f});
  expect_near(m.emission, {3.0f, 1.5f, 0.0f});
}

TEST(VolumeNodes, MixAndAddWeighDensities) {
  const MediumProperties m = volume_of(
      "out: ShaderNodeOutputMaterial Volume<add.Shader\n"
      "add: ShaderNodeAddShader Shader<mix.Shader Shader_001<e.Emission\n"
      "mix: ShaderNodeMixShader Fac=0.25 Shader<a.Volume Shader_001<s.Volume\n"
      "a: ShaderNodeVolumeAbsorption Color=0,0,0,1 Density=4\n"
      "s: ShaderNodeVolumeScatter Color=1,1,1,1 Density=8\n"
      "e: ShaderNodeEmission Color=1,1,1,1 Strength=0.5\n");
  expect_near(m.sigma_a, Spectrum(3.0f));
  expect_near(m.sigma_s, Spectrum(2.0f));
  expect_near(m.emission, Spectrum(0.5f));
}

TEST(VolumeNodes, OneNodeMayServeBothSockets) {
  const TestMaterial test(
      "out: ShaderNodeOutputMaterial Surface<e.Emission Volume<e.Emission\n"
      "e: ShaderNodeEmission Color=1,1,1,1 Strength=2\n");
  expect_near(test.material.constant_emission, Spectrum(2.0f));
  expect_near(test.material.constant_volume.emission, Spectrum(2.0f));
  EXPECT_TRUE(test.material.has_surface);
}

TEST(VolumeNodes, ShadersOfTheWrongSocketAddNothing) {
  const TestMaterial surface(
      "out: ShaderNodeOutputMaterial Surface<v.Volume\n"
      "v: ShaderNodeVolumeScatter\n");
  EXPECT_FALSE(surface.material.scatters);
  EXPECT_FALSE(surface.material.has_volume);
  const TestMaterial volume(
      "out: ShaderNodeOutputMaterial Volume<d.BSDF\n"
      "d: ShaderNodeBsdfDiffuse\n");
  EXPECT_FALSE(volume.material.has_volume);
  EXPECT_FALSE(volume.material.has_surface);
}

TEST(VolumeNodes, NothingAndNonsenseAreNoVolume) {
  for (const char* density : {"0", "-1"}) {
    const TestMaterial test(std::string(k_output) +
                            "v: ShaderNodeVolumeScatter Density=" + density + "\n");
    EXPECT_FALSE(test.material.has_volume) << density;
    EXPECT_FALSE(test.material.has_surface);
  }
}

TEST(VolumeNodes, DensityMayVaryOverSpace) {
  const TestMaterial test(
      "out: ShaderNodeOutputMaterial Volume<v.Volume\n"
      "v: ShaderNodeVolumeScatter Color=1,1,1,1 Density<x.Value\n"
      "x: ShaderNodeVectorMath @operation=LENGTH Vector<g.Position\n"
      "g: ShaderNodeNewGeometry\n");
  EXPECT_TRUE(test.material.has_volume);
  EXPECT_FALSE(test.material.is_volume_constant);
  ShadingContext context;
  context.reserve(test.material.volume.register_count());
  context.surface.position = {0.0f, 3.0f, 4.0f};
  expect_near(test.material.evaluate_volume(context).sigma_s, Spectrum(5.0f));
}

// An instance that fills [-1, 1]^3 with one voxel.
class Voxel {
 public:
  Voxel(const std::vector<float>& value, AttributeIds& ids, const char* name)
      : grid_(value, {1, 1, 1}, static_cast<int>(value.size())) {
    const Transform from_object{
        {0.5f, 0.0f, 0.0f}, {0.0f, 0.5f, 0.0f}, {0.0f, 0.0f, 0.5f}, {0.5f, 0.5f, 0.5f}};
    instance_.grids.push_back({ids.intern(name), &grid_, from_object, from_object});
  }
  MediumProperties at(Vec3 position, const Material& material) const {
    ShadingContext context;
    context.reserve(material.volume.register_count());
    context.surface.instance = &instance_;
    context.surface.position = position;
    return material.evaluate_volume(context);
  }
  const VoxelGrid& grid() const { return grid_; }

 private:
  VoxelGrid grid_;
  Instance instance_;
};

TEST(VolumeNodes, PrincipledIsScaledByItsGrid) {
  TestMaterial test(
      "out: ShaderNodeOutputMaterial Volume<v.Volume\n"
      "v: ShaderNodeVolumePrincipled Color=1,1,1,1 Density=2 @density_attribute=density\n");
  EXPECT_FALSE(test.material.is_volume_constant);
  const Voxel voxel({0.25f}, test.attributes, "density");
  expect_near(voxel.at({0.5f, 0.5f, -0.5f}, test.material).sigma_s, Spectrum(0.5f));
  expect_near(voxel.at({0.5f, 0.5f, 1.5f}, test.material).sigma_s, Spectrum(0.0f));
  const Voxel other({0.25f}, test.attributes, "flame");
  expect_near(other.at({}, test.material).sigma_s, Spectrum(2.0f));
}

TEST(VolumeNodes, SmokeIsKnownWithoutItsShader) {
  const std::string smoke =
      "out: ShaderNodeOutputMaterial Volume<v.Volume\n"
      "v: ShaderNodeVolumePrincipled Color=0.8,0.5,0.2,1 Density=3 Emission~Strength=0.5 "
      "@density_attribute=density @temperature_attribute=temperature";
  TestMaterial test(smoke + "\n");
  const auto& known = test.material.grid_medium;
  ASSERT_TRUE(known);
  const Voxel voxel({0.25f}, test.attributes, "density");
  const MediumProperties seen = voxel.at({}, test.material);
  expect_near(known->medium.sigma_s * 0.25f, seen.sigma_s);
  expect_near(known->medium.sigma_a * 0.25f, seen.sigma_a);
  expect_near(known->emission, seen.emission);
  for (const char* more : {" @color_attribute=color", " Blackbody~Intensity=1"})
    EXPECT_FALSE(TestMaterial(smoke + more + "\n").material.grid_medium) << more;
}

TEST(VolumeNodes, InfoDividesColorByItsAlpha) {
  TestMaterial test(
      "out: ShaderNodeOutputMaterial Volume<e.Emission\n"
      "e: ShaderNodeEmission Color<i.Color Strength=1\n"
      "i: ShaderNodeVolumeInfo\n");
  const Voxel voxel({0.1f, 0.2f, 0.4f, 0.5f}, test.attributes, "color");
  expect_near(voxel.at({}, test.material).emission, {0.2f, 0.4f, 0.8f});
}

}  // namespace
}  // namespace tenniel
