// SPDX-License-Identifier: Apache-2.0
#include "integrator/environment_samples.h"

#include <algorithm>

#include "math/numeric.h"
#include "sampling/sampler.h"
#include "shading/shading_context.h"

namespace tenniel {

namespace {

const EnvironmentLight* presampled_light(const Scene& scene, const World& world) {
  if (world.light < 0 || world.radiance_knows_path) return nullptr;
  return scene.lights[static_cast<size_t>(world.light)].as<EnvironmentLight>();
}

// In [0, 1) for all that rounding may do.
float place(size_t cell, float within) {
  constexpr auto side = static_cast<float>(EnvironmentSamples::k_side);
  return std::min((static_cast<float>(cell) + within) / side, k_one_minus_epsilon);
}

}  // namespace

EnvironmentSample sample_environment(const Scene& scene, const EnvironmentLight& light,
                                     const PathInfo& path, Vec2 u, ShadingContext& scratch) {
  const auto drawn = light.sample(u);
  if (!drawn) return {};
  return {drawn->wi, drawn->pdf,
          background_radiance(scene, scene.worlds[path.world], drawn->wi, path, scratch)};
}

EnvironmentSamples::EnvironmentSamples(const Scene& scene, uint32_t seed, uint32_t first_sample,
                                       const RowLoop& rows) {
  for (WorldIndex w = 0; w < k_world_count; ++w) {
    const EnvironmentLight* light = presampled_light(scene, scene.worlds[w]);
    if (!light) continue;
    for (WorldIndex other = 0; other < w && !tables_[w]; ++other) {
      const EnvironmentLight* earlier = presampled_light(scene, scene.worlds[other]);
      if (earlier && light->shares_map_with(*earlier)) tables_[w] = tables_[other];
    }
    if (tables_[w]) continue;
    const auto table = std::make_shared<Table>(k_count);
    PathInfo path;
    path.world = w;
    path.is_light_sample = true;
    rows(static_cast<int>(k_side), [&](int y) {
      ShadingContext context;
      context.reserve(scene.register_count);
      context.rays = &scene;
      Sampler sampler(seed);
      for (size_t x = 0; x < k_side; ++x) {
        // Pixels that no picture has.
        sampler.start_sample(-2 - static_cast<int>(x), -2 - y, first_sample);
        const Vec2 within = sampler.get_2d();
        const Vec2 u{place(x, within.x), place(static_cast<size_t>(y), within.y)};
        (*table)[static_cast<size_t>(y) * k_side + x] =
            sample_environment(scene, *light, path, u, context);
      }
    });
    tables_[w] = table;
  }
}

}  // namespace tenniel
