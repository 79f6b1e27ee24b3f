// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <utility>

#include "math/transform.h"
#include "shading/node_type.h"
#include "shading/nodes/coordinates.h"
#include "shading/nodes/register.h"
#include "shading/nodes/sky_analytic.h"
#include "shading/nodes/sky_nishita.h"

namespace tenniel {

namespace {

enum class SkyType : uint8_t { preetham, hosek_wilkie, nishita };

struct SkyTextureNode : NishitaParameters {
  Input<Vec3> vector;
  Output<Spectrum> color;
  SkyType type = SkyType::nishita;
  std::vector<float> texture_mapping;
  std::vector<float> sun_direction;  // of the analytic skies
  float turbidity = 2.2f, ground_albedo = 0.3f;
  // Which of them is set depends on the type.
  PreethamSky preetham_sky;
  HosekWilkieSky hosek_wilkie_sky;
  std::shared_ptr<const NishitaSky> nishita_sky;

  void prepare() {
    const bool has_direction = sun_direction.size() == 3;
    const Vec3 to_sun = normalize_or(
        has_direction ? Vec3{sun_direction[0], sun_direction[1], sun_direction[2]} : Vec3{},
        {0.0f, 0.0f, 1.0f});
    if (type == SkyType::preetham)
      preetham_sky = PreethamSky(to_sun, turbidity);
    else if (type == SkyType::hosek_wilkie)
      hosek_wilkie_sky = HosekWilkieSky(to_sun, turbidity, ground_albedo);
    else
      nishita_sky = NishitaSky::make(*this);
  }

  void eval(ShadingContext& context) const {
    const Vec3 direction = apply_texture_mapping(texture_mapping, context.get(vector));
    context.set(color, type == SkyType::preetham       ? preetham_sky.radiance(direction)
                       : type == SkyType::hosek_wilkie ? hosek_wilkie_sky.radiance(direction)
                                                       : nishita_sky->radiance(direction));
  }

  // Through the inverse of the node's own mapping, which a sun outside of the map survives little
  // deformed.
  std::optional<SunDisk> sun_disk() const {
    if (type != SkyType::nishita) return {};
    auto sun = nishita_sky->sun();
    if (sun && texture_mapping.size() >= 12) {
      std::array<float, 12> rows;
      std::copy_n(texture_mapping.begin(), 12, rows.begin());
      sun->direction =
          normalize_or(Transform::from_rows(rows).inverse().vector(sun->direction), sun->direction);
    }
    return sun;
  }
};

}  // namespace

void register_sky_nodes(NodeRegistry& registry) {
  registry.add<SkyTextureNode>("ShaderNodeTexSky")
      .input("Vector", &SkyTextureNode::vector)
      .implicit(ImplicitInput::generated)
      .output("Color", &SkyTextureNode::color)
      .choice("sky_type", &SkyTextureNode::type,
              {{"PREETHAM", SkyType::preetham},
               {"HOSEK_WILKIE", SkyType::hosek_wilkie},
               {"NISHITA", SkyType::nishita}})
      .setting("texture_mapping", &SkyTextureNode::texture_mapping)
      .setting("sun_direction", &SkyTextureNode::sun_direction)
      .setting("turbidity", &SkyTextureNode::turbidity)
      .setting("ground_albedo", &SkyTextureNode::ground_albedo)
      .setting("sun_disc", static_cast<bool SkyTextureNode::*>(&SkyTextureNode::sun_disc))
      .setting("sun_size", static_cast<float SkyTextureNode::*>(&SkyTextureNode::sun_size))
      .setting("sun_intensity",
               static_cast<float SkyTextureNode::*>(&SkyTextureNode::sun_intensity))
      .setting("sun_elevation",
               static_cast<float SkyTextureNode::*>(&SkyTextureNode::sun_elevation))
      .setting("sun_rotation", static_cast<float SkyTextureNode::*>(&SkyTextureNode::sun_rotation))
      .setting("altitude", static_cast<float SkyTextureNode::*>(&SkyTextureNode::altitude))
      .setting("air_density", static_cast<float SkyTextureNode::*>(&SkyTextureNode::air_density))
      .setting("dust_density", static_cast<float SkyTextureNode::*>(&SkyTextureNode::dust_density))
      .setting("ozone_density",
               static_cast<float SkyTextureNode::*>(&SkyTextureNode::ozone_density));
}

}  // namespace tenniel
