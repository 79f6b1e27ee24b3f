// SPDX-License-Identifier: Apache-2.0
#include "integrator/direct_light.h"

#include <algorithm>

#include "integrator/media_transmittance.h"
#include "integrator/shadow_ray.h"
#include "sampling/mis.h"

namespace tenniel {

namespace {

// The lobes that `light` shows itself to in `world`.
LobeSet lobes_that_see(Visibility visibility, WorldIndex world) {
  // Ray kinds and classes of lobes follow each other in one order.
  static_assert(ray_mask(0, RayKind::glossy) == ray_mask(0, RayKind::diffuse) << 1 &&
                ray_mask(0, RayKind::transmission) == ray_mask(0, RayKind::diffuse) << 2);
  static_assert(LobeSet::of(LobeClass::diffuse).bits == 1 &&
                LobeSet::of(LobeClass::glossy).bits == 2 &&
                LobeSet::of(LobeClass::transmission).bits == 4);
  const uint32_t seen = visibility.bits / ray_mask(world, RayKind::diffuse);
  return {static_cast<uint8_t>(seen & 7u)};
}

std::optional<LightSample> sample_mesh_light(const Scene& scene, const MeshLight& light,
                                             const ShadingPoint& point, const PathInfo& path,
                                             Vec2 u, ShadingContext& scratch) {
  const auto drawn = light.sample(point, u);
  if (!drawn) return {};
  const Instance& instance = light.instance();
  const Material& material =
      scene.materials[instance.material(light.mesh().material_slot(drawn->hit.face), path.world)];
  if (!material.emits || !material.sample_as_light) return {};
  Spectrum radiance = material.constant_emission;
  if (!material.is_emission_constant) {
    const Ray ray{point.position, drawn->wi};
    radiance =
        surface_emission(scene, material, scene.interaction(ray, drawn->hit, 0.0f), path, scratch);
  }
  return LightSample{drawn->wi, drawn->distance, radiance, drawn->pdf, false};
}

std::optional<LightSample> sample_environment(const Scene& scene, const EnvironmentLight& light,
                                              const PathInfo& path, Vec2 u,
                                              ShadingContext& scratch) {
  const auto drawn = light.sample(u);
  if (!drawn) return {};
  const Spectrum radiance =
      background_radiance(scene, scene.worlds[path.world], drawn->wi, path, scratch);
  return LightSample{drawn->wi, k_infinity, radiance, drawn->pdf, false};
}

PathInfo path_of_light_sample(PathInfo path, WorldIndex world) {
  path.world = world;
  ++path.ray_depth;
  path.is_light_sample = true;
  return path;
}

// A light whose radiance takes a shader. Out of line: lamps without one need none of its room.
[[gnu::noinline]] std::optional<LightSample> sample_shaded_light(
    const Scene& scene, const Light& light, const ShadingPoint& point, const PathInfo& at,
    WorldIndex world, Vec2 u, ShadingContext& scratch) {
  const PathInfo path = path_of_light_sample(at, world);
  if (const auto* mesh = light.as<MeshLight>())
    return sample_mesh_light(scene, *mesh, point, path, u, scratch);
  if (const auto* environment = light.as<EnvironmentLight>())
    return sample_environment(scene, *environment, path, u, scratch);
  auto sample = sample_lamp(light, point, u);
  if (!sample) return sample;
  const Vec3 position = point.position + sample->wi * std::min(sample->distance, 1e6f);
  sample->radiance *=
      lamp_emission(scene, light, position, sample->wi, sample->distance, path, scratch);
  return sample;
}

// What `sample_light` does, within its caller. Lamps without a tree need not know of the path.
[[gnu::always_inline]] inline std::optional<LightSample> aim_at(
    const Scene& scene, const Light& light, const ShadingPoint& point, const PathInfo& at,
    WorldIndex world, Vec2 u, ShadingContext& scratch) {
  return light.is_lamp() && !light.material
             ? sample_lamp(light, point, u)
             : sample_shaded_light(scene, light, point, at, world, u, scratch);
}

// The same factor as `transmittance`, where there are media as well.
[[gnu::noinline]] Spectrum transmittance_through_media(const Scene& scene,
                                                       const RenderSettings& settings,
                                                       const PathState& state, WorldIndex world,
                                                       const Ray& ray, Worker& worker) {
  const SegmentStart start = segment_from(scene, worker.surface.surface, ray.direction, state.media,
                                          state.info.world, world);
  PathInfo path = state.info;
  path.world = world;
  return media_transmittance(scene, settings, ray, start, path, worker.light);
}

}  // namespace

std::optional<LightSample> sample_light(const Scene& scene, const Light& light,
                                        const ShadingPoint& point, const PathInfo& at,
                                        WorldIndex world, Vec2 u, ShadingContext& scratch) {
  return aim_at(scene, light, point, at, world, u, scratch);
}

Spectrum direct_light(const Scene& scene, const RenderSettings& settings, const PathState& state,
                      const WorldGroup& group, const ShadingPoint& point, const LightNumbers& u,
                      Worker& worker) {
  const auto choice = scene.light_samplers[group.world].choose(point, u.choice);
  if (!choice) return {};
  const Light& light = scene.lights[choice->light];
  if (state.info.ray_depth > light.max_bounces) return {};
  const auto sample = aim_at(scene, light, point, state.info, group.world, u.place, worker.light);
  if (!sample || !(sample->pdf > 0.0f) || !(max_component(sample->radiance) > 0.0f)) return {};

  const Bsdf& bsdf = worker.surface.bsdf;
  const LobeSet seeing = lobes_that_see(light.visibility, group.world) & group.lobes;
  BsdfEval scattered = bsdf.eval(sample->wi, seeing, group.lobes);
  if (worker.surface.surface.instance->terminator_cutoff > 0.0f)
    scattered.value += bsdf.value_beyond_horizon(sample->wi, seeing);
  if (is_black(scattered.value)) return {};

  const float pdf = sample->pdf * choice->probability;
  const bool can_be_met = !sample->is_delta && light.use_mis;
  const float weight = can_be_met ? power_heuristic(pdf, scattered.pdf) : 1.0f;
  Spectrum result = scattered.value * sample->radiance * (weight / pdf);

  const SurfaceInteraction& at = worker.surface.surface;
  if (light.casts_shadow) {
    Ray ray;
    ray.origin = shadow_ray_origin(at, sample->wi);
    ray.direction = sample->wi;
    if (sample->distance < k_infinity) {
      // To the very point that was sampled: seen at a slant, the lamp itself would come between.
      const Vec3 to_light = point.position + sample->wi * sample->distance - ray.origin;
      const float distance = length(to_light);
      ray.direction = to_light / distance;
      // Short of the light, so that an emissive mesh does not shadow itself.
      ray.t_max = distance * (1.0f - 1e-4f);
    }
    ray.time = state.ray.time;
    result *= scene.has_media
                  ? transmittance_through_media(scene, settings, state, group.world, ray, worker)
                  : transmittance(scene, settings, ray, group.world, state.info, worker);
  }
  return result;
}

Spectrum lamp_met(const Scene& scene, const PathState& state, uint32_t index, const LampHit& hit,
                  Worker& worker) {
  const Light& light = scene.lights[index];
  float weight = 1.0f;
  if (state.pdf > 0.0f) {
    // The density is seen from where the path last scattered, also through transparent surfaces.
    const float light_pdf = lamp_pdf(light, state.origin, state.ray.direction) *
                            scene.light_samplers[state.info.world].probability(state.origin, index);
    weight = power_heuristic(state.pdf, light_pdf);
  }
  Spectrum radiance = hit.radiance;
  if (light.material) {
    const Vec3 position = state.ray.at(std::min(hit.t, 1e6f));
    radiance *=
        lamp_emission(scene, light, position, state.ray.direction, hit.t, state.info, worker.light);
  }
  if (scene.has_media)
    radiance *= segment_transmittance(scene, state.media, state.ray, state.skipped_before,
                                      state.skipped_before + hit.t, state.info, worker.light);
  return radiance * weight;
}

float surface_emission_weight(const Scene& scene, const PathState& state,
                              const SurfaceInteraction& at) {
  if (state.pdf <= 0.0f || at.instance->light < 0) return 1.0f;
  const auto light = static_cast<uint32_t>(at.instance->light);
  const auto* mesh = scene.lights[light].as<MeshLight>();
  const float light_pdf = mesh->pdf(at, state.origin.position) *
                          scene.light_samplers[state.info.world].probability(state.origin, light);
  return power_heuristic(state.pdf, light_pdf);
}

float background_weight(const Scene& scene, const PathState& state) {
  const World& world = scene.worlds[state.info.world];
  if (state.pdf <= 0.0f || world.light < 0) return 1.0f;
  const auto light = static_cast<uint32_t>(world.light);
  const auto* environment = scene.lights[light].as<EnvironmentLight>();
  const float light_pdf = environment->pdf(state.ray.direction) *
                          scene.light_samplers[state.info.world].probability(state.origin, light);
  return power_heuristic(state.pdf, light_pdf);
}

}  // namespace tenniel
