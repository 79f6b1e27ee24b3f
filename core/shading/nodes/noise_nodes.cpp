// SPDX-License-Identifier: Apache-2.0
#include "math/numeric.h"
#include "shading/node_type.h"
#include "shading/nodes/coordinates.h"
#include "shading/nodes/noise.h"
#include "shading/nodes/patterns.h"
#include "shading/nodes/voronoi.h"

namespace tenniel {

namespace {

enum class Dimensions : uint8_t { one, two, three, four };

// The textures that exist in 1 (w alone), 2 (x, y), 3 (x, y, z) and 4 dimensions.
struct DimensionalNode {
  Input<Vec3> vector;
  Input<float> w;
  Input<float> scale{5.0f};
  std::vector<float> texture_mapping;
  Dimensions dimensions = Dimensions::three;

  // Calls `f` with the scaled coordinate in as many dimensions as the node has.
  template <class Function>
  void with_coordinate(const ShadingContext& context, Function f) const {
    const float s = context.get(scale);
    if (dimensions == Dimensions::one) return f(NoisePoint<1>{context.get(w) * s});
    const Vec3 p = apply_texture_mapping(texture_mapping, context.get(vector)) * s;
    if (dimensions == Dimensions::two) return f(NoisePoint<2>{p.x, p.y});
    if (dimensions == Dimensions::three) return f(NoisePoint<3>{p.x, p.y, p.z});
    f(NoisePoint<4>{p.x, p.y, p.z, context.get(w) * s});
  }
};

template <class Node>
NodeTypeBuilder<Node> add_dimensional(NodeRegistry& registry, const char* idname,
                                      const char* setting) {
  auto builder = registry.add<Node>(idname);
  builder.input("Vector", static_cast<Input<Vec3> Node::*>(&Node::vector))
      .implicit(ImplicitInput::generated)
      .input("W", static_cast<Input<float> Node::*>(&Node::w))
      .input("Scale", static_cast<Input<float> Node::*>(&Node::scale))
      .setting("texture_mapping", static_cast<std::vector<float> Node::*>(&Node::texture_mapping))
      .choice(setting, static_cast<Dimensions Node::*>(&Node::dimensions),
              {{"1D", Dimensions::one},
               {"2D", Dimensions::two},
               {"3D", Dimensions::three},
               {"4D", Dimensions::four}});
  return builder;
}

struct NoiseNode : DimensionalNode {
  Input<float> detail{2.0f}, roughness{0.5f}, distortion{0.0f};
  Output<float> factor;
  Output<Spectrum> color;

  void eval(ShadingContext& context) const {
    with_coordinate(context, [&](const auto& p) {
      const auto rgb = noise_texture(p, context.get(detail), context.get(roughness),
                                     context.get(distortion), color.used());
      context.set(factor, rgb[0]);
      context.set(color, {rgb[0], rgb[1], rgb[2]});
    });
  }
};

struct MusgraveNode : DimensionalNode {
  Input<float> detail{2.0f}, dimension{2.0f}, lacunarity{2.0f}, offset{0.0f}, gain{1.0f};
  Output<float> factor;
  MusgraveType type = MusgraveType::fbm;

  void eval(ShadingContext& context) const {
    const MusgraveParameters m = {type,
                                  context.get(detail),
                                  context.get(dimension),
                                  context.get(lacunarity),
                                  context.get(offset),
                                  context.get(gain)};
    with_coordinate(context, [&](const auto& p) { context.set(factor, musgrave(p, m)); });
  }
};

struct VoronoiNode : DimensionalNode {
  Input<float> smoothness{1.0f}, exponent{0.5f}, randomness{1.0f};
  Output<float> distance, w_out, radius;
  Output<Spectrum> color;
  Output<Vec3> position;
  VoronoiMetric metric = VoronoiMetric::euclidean;
  VoronoiFeature feature = VoronoiFeature::f1;

  void eval(ShadingContext& context) const {
    const VoronoiParameters v = {metric, context.get(exponent), context.get(randomness),
                                 context.get(smoothness), color.used()};
    with_coordinate(context, [&](const auto& p) {
      if (feature == VoronoiFeature::distance_to_edge)
        context.set(distance, voronoi_edge_distance(p, v));
      else if (feature == VoronoiFeature::n_sphere_radius)
        context.set(radius, voronoi_sphere_radius(p, v));
      else
        set_point(context, voronoi(feature, p, v));
    });
  }

  template <size_t n>
  void set_point(ShadingContext& context, const VoronoiResult<n>& result) const {
    const float s = context.get(scale);
    std::array<float, 4> at{};
    for (size_t i = 0; i < n; ++i)
      at[n == 1 ? 3 : i] = safe_divide(result.position[i], s);
    context.set(distance, result.distance);
    context.set(color, result.color);
    context.set(position, {at[0], at[1], at[2]});
    context.set(w_out, at[3]);
  }
};

void register_musgrave(NodeRegistry& registry) {
  add_dimensional<MusgraveNode>(registry, "ShaderNodeTexMusgrave", "musgrave_dimensions")
      .input("Detail", &MusgraveNode::detail)
      .input("Dimension", &MusgraveNode::dimension)
      .input("Lacunarity", &MusgraveNode::lacunarity)
      .input("Offset", &MusgraveNode::offset)
      .input("Gain", &MusgraveNode::gain)
      .output("Fac", &MusgraveNode::factor)
      .choice("musgrave_type", &MusgraveNode::type,
              {{"MULTIFRACTAL", MusgraveType::multifractal},
               {"RIDGED_MULTIFRACTAL", MusgraveType::ridged_multifractal},
               {"HYBRID_MULTIFRACTAL", MusgraveType::hybrid_multifractal},
               {"FBM", MusgraveType::fbm},
               {"HETERO_TERRAIN", MusgraveType::hetero_terrain}});
}

void register_voronoi(NodeRegistry& registry) {
  add_dimensional<VoronoiNode>(registry, "ShaderNodeTexVoronoi", "voronoi_dimensions")
      .input("Smoothness", &VoronoiNode::smoothness)
      .input("Exponent", &VoronoiNode::exponent)
      .input("Randomness", &VoronoiNode::randomness)
      .output("Distance", &VoronoiNode::distance)
      .output("Color", &VoronoiNode::color)
      .output("Position", &VoronoiNode::position)
      .output("W", &VoronoiNode::w_out)
      .output("Radius", &VoronoiNode::radius)
      .choice("distance", &VoronoiNode::metric,
              {{"EUCLIDEAN", VoronoiMetric::euclidean},
               {"MANHATTAN", VoronoiMetric::manhattan},
               {"CHEBYCHEV", VoronoiMetric::chebychev},
               {"MINKOWSKI", VoronoiMetric::minkowski}})
      .choice("feature", &VoronoiNode::feature,
              {{"F1", VoronoiFeature::f1},
               {"F2", VoronoiFeature::f2},
               {"SMOOTH_F1", VoronoiFeature::smooth_f1},
               {"DISTANCE_TO_EDGE", VoronoiFeature::distance_to_edge},
               {"N_SPHERE_RADIUS", VoronoiFeature::n_sphere_radius}});
}

}  // namespace

void register_noise_nodes(NodeRegistry& registry) {
  add_dimensional<NoiseNode>(registry, "ShaderNodeTexNoise", "noise_dimensions")
      .input("Detail", &NoiseNode::detail)
      .input("Roughness", &NoiseNode::roughness)
      .input("Distortion", &NoiseNode::distortion)
      .output("Fac", &NoiseNode::factor)
      .output("Color", &NoiseNode::color);
  register_musgrave(registry);
  register_voronoi(registry);
}

}  // namespace tenniel
