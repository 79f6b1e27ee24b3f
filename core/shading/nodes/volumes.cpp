// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/volumes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "image/voxel_grid.h"
#include "math/numeric.h"
#include "shading/nodes/attributes.h"
#include "shading/nodes/blackbody.h"
#include "shading/nodes/coordinates.h"
#include "shading/nodes/register.h"

namespace tenniel {
namespace {

constexpr float k_cutoff = 1e-5f;

bool may_be_dense(const Input<float>& density) {
  return density.linked() || density.value > 0.0f;
}

float usable_density(const ShadingContext& context, const Input<float>& density) {
  return std::max(context.get(density), 0.0f);
}

float rest(float x) {
  return std::max(1.0f - x, 0.0f);
}
// What white is more than `color`.
Spectrum complement(Spectrum color) {
  return {rest(color.r), rest(color.g), rest(color.b)};
}
Spectrum root(Spectrum color) {
  return {safe_sqrt(color.r), safe_sqrt(color.g), safe_sqrt(color.b)};
}

// What the grid of that name holds, if the slot names one and the object has it.
std::optional<std::array<float, 4>> voxel(const ShadingContext& context,
                                          const AttributeSlot& slot) {
  if (slot.name.empty()) return std::nullopt;
  return grid_attribute(context, slot.id);
}

// What a simulation stored in each voxel; nothing where there is none.
struct VolumeInfoNode {
  Output<Spectrum> color;
  Output<float> density, flame, temperature;
  AttributeSlot color_grid{"color"}, density_grid{"density"}, flame_grid{"flame"},
      temperature_grid{"temperature"};

  void eval(ShadingContext& context) const {
    if (color.used()) {
      const auto v = voxel(context, color_grid).value_or(VoxelGrid::Rgba{});
      context.set(color, {v[0], v[1], v[2]});
    }
    read(context, density, density_grid);
    read(context, flame, flame_grid);
    read(context, temperature, temperature_grid);
  }

  static void read(ShadingContext& context, const Output<float>& output,
                   const AttributeSlot& slot) {
    if (output.used()) context.set(output, voxel(context, slot).value_or(VoxelGrid::Rgba{})[0]);
  }
};

}  // namespace

void VolumeAbsorptionNode::eval(ShadingContext& context) const {
  const float d = usable_density(context, density) * context.get(weight);
  context.medium.add_absorption(complement(context.get(color)) * d);
}

uint8_t VolumeAbsorptionNode::closure_parts() const {
  return may_be_dense(density) ? k_query_volume : 0;
}

void VolumeScatterNode::eval(ShadingContext& context) const {
  const float d = usable_density(context, density) * context.get(weight);
  context.medium.add_scattering(context.get(color) * d, context.get(anisotropy));
}

uint8_t VolumeScatterNode::closure_parts() const {
  return may_be_dense(density) ? k_query_volume : 0;
}

void PrincipledVolumeNode::eval(ShadingContext& context) const {
  float d = usable_density(context, density);
  if (const auto v = voxel(context, density_attribute)) d = std::max(d * (*v)[0], 0.0f);
  d *= context.get(weight);
  if (d > k_cutoff) {
    Spectrum scattered = context.get(color);
    if (const auto v = voxel(context, color_attribute))
      scattered *= Spectrum((*v)[0], (*v)[1], (*v)[2]);
    const Spectrum absorbed =
        complement(scattered) * complement(root(context.get(absorption_color)));
    context.medium.add_scattering(scattered * d, context.get(anisotropy));
    context.medium.add_absorption(absorbed * d);
  }
  context.add_emission(glow(context));
}

Spectrum PrincipledVolumeNode::glow(const ShadingContext& context) const {
  Spectrum sum;
  const float strength = context.get(emission_strength);
  if (strength > k_cutoff) sum += context.get(emission_color) * strength;
  const float blackbody = context.get(blackbody_intensity);
  if (!(blackbody > k_cutoff)) return sum;
  // Stefan and Boltzmann's law, in a unit that suits flames.
  constexpr float k_sigma = 5.670373e-8f * 1e-6f * k_inv_pi;
  float kelvin = std::max(context.get(temperature), 0.0f);
  if (const auto v = voxel(context, temperature_attribute)) kelvin *= std::max((*v)[0], 0.0f);
  const float intensity = k_sigma * lerp(1.0f, sqr(sqr(kelvin)), blackbody);
  if (intensity > k_cutoff)
    sum += raw_blackbody_color(kelvin) * context.get(blackbody_tint) * intensity;
  // As in Cycles, what a dull red lacks of blue is taken from the emission beside it, but here no
  // light is less than none.
  return positive(sum);
}

uint8_t PrincipledVolumeNode::closure_parts() const {
  const auto may_be_positive = [](const Input<float>& x) { return x.linked() || x.value > 0.0f; };
  const bool glows = may_be_positive(emission_strength) || may_be_positive(blackbody_intensity);
  return static_cast<uint8_t>((may_be_dense(density) ? k_query_volume : 0) |
                              (glows ? k_query_emission : 0));
}

bool PrincipledVolumeNode::varies() const {
  return !density_attribute.name.empty() || !color_attribute.name.empty() ||
         !temperature_attribute.name.empty();
}

std::optional<GridMedium> PrincipledVolumeNode::grid_medium() const {
  const bool needs_temperature = blackbody_intensity.linked() || blackbody_intensity.value > 0.0f;
  if (density_attribute.name.empty() || !color_attribute.name.empty() || needs_temperature)
    return {};
  PrincipledVolumeNode uniform = *this;
  uniform.density_attribute = {};
  ShadingContext context;
  context.begin(k_query_volume | k_query_emission);
  uniform.eval(context);
  return GridMedium{density_attribute.id, context.medium, context.emission};
}

namespace {

enum class DensitySpace : uint8_t { object, world };

// Points as Blender has spread them over a grid.
struct PointDensityNode {
  Input<Vec3> vector;
  Output<Spectrum> color;
  Output<float> density;
  GridSlot grid;
  std::vector<float> to_grid;  // 12 floats: from world space to the grid's
  DensitySpace space = DensitySpace::object;
  GridFilter filter = GridFilter::linear;

  void eval(ShadingContext& context) const {
    const Vec3 p = vector.linked() ? context.get(vector) : context.surface.position;
    const VoxelGrid::Rgba v =
        grid.grid ? grid.grid->lookup(place(context, p), filter) : VoxelGrid::Rgba{};
    context.set(color, {v[0], v[1], v[2]});
    context.set(density, v[3]);
  }

  // Object space is that of the shaded object: in volumes its texture space.
  Vec3 place(const ShadingContext& context, Vec3 p) const {
    const SurfaceInteraction& at = context.surface;
    if (space == DensitySpace::world) return apply_texture_mapping(to_grid, p);
    if (!at.instance) return p;
    p = at.world_to_object().point(p);
    return at.mesh ? p : texture_space_coordinate(*at.instance, p);
  }
};

}  // namespace

void register_volume_nodes(NodeRegistry& registry) {
  registry.add<VolumeAbsorptionNode>("ShaderNodeVolumeAbsorption")
      .input("Color", &VolumeAbsorptionNode::color)
      .input("Density", &VolumeAbsorptionNode::density)
      .closure_output("Volume")
      .closure();
  registry.add<VolumeScatterNode>("ShaderNodeVolumeScatter")
      .input("Color", &VolumeScatterNode::color)
      .input("Density", &VolumeScatterNode::density)
      .input("Anisotropy", &VolumeScatterNode::anisotropy)
      .closure_output("Volume")
      .closure();
  registry.add<PrincipledVolumeNode>("ShaderNodeVolumePrincipled")
      .input("Color", &PrincipledVolumeNode::color)
      .input("Density", &PrincipledVolumeNode::density)
      .input("Anisotropy", &PrincipledVolumeNode::anisotropy)
      .input("Absorption Color", &PrincipledVolumeNode::absorption_color)
      .input("Emission Strength", &PrincipledVolumeNode::emission_strength)
      .input("Emission Color", &PrincipledVolumeNode::emission_color)
      .input("Blackbody Intensity", &PrincipledVolumeNode::blackbody_intensity)
      .input("Blackbody Tint", &PrincipledVolumeNode::blackbody_tint)
      .input("Temperature", &PrincipledVolumeNode::temperature)
      .setting("density_attribute", &PrincipledVolumeNode::density_attribute)
      .setting("color_attribute", &PrincipledVolumeNode::color_attribute)
      .setting("temperature_attribute", &PrincipledVolumeNode::temperature_attribute)
      .closure_output("Volume")
      .closure();
  registry.add<VolumeInfoNode>("ShaderNodeVolumeInfo")
      .output("Color", &VolumeInfoNode::color)
      .output("Density", &VolumeInfoNode::density)
      .output("Flame", &VolumeInfoNode::flame)
      .output("Temperature", &VolumeInfoNode::temperature)
      .setting("color_grid", &VolumeInfoNode::color_grid)
      .setting("density_grid", &VolumeInfoNode::density_grid)
      .setting("flame_grid", &VolumeInfoNode::flame_grid)
      .setting("temperature_grid", &VolumeInfoNode::temperature_grid)
      .varying();
  registry.add<PointDensityNode>("ShaderNodeTexPointDensity")
      .input("Vector", &PointDensityNode::vector)
      .output("Color", &PointDensityNode::color)
      .output("Density", &PointDensityNode::density)
      .setting("grid", &PointDensityNode::grid)
      .setting("to_grid", &PointDensityNode::to_grid)
      .choice("space", &PointDensityNode::space,
              {{"OBJECT", DensitySpace::object}, {"WORLD", DensitySpace::world}})
      .choice("interpolation", &PointDensityNode::filter,
              {{"Linear", GridFilter::linear},
               {"Closest", GridFilter::closest},
               {"Cubic", GridFilter::cubic}})
      .varying();
}

}  // namespace tenniel
