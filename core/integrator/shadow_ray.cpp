// SPDX-License-Identifier: Apache-2.0
#include "integrator/shadow_ray.h"

#include <algorithm>
#include <span>
#include <tuple>

namespace tenniel {

namespace {

// Notes the faces that may let a ray pass: one search finds them all, or the first that does not.
class TransparentFaces final : public Accel::Blocker {
 public:
  TransparentFaces(const Scene& scene, WorldIndex world, std::span<Hit> room)
      : scene_(scene), world_(world), hits_(room) {}

  bool blocks(const Hit& hit) override {
    const Material& material = scene_.material_at(hit, world_);
    if (!material.is_transparent || !material.use_transparent_shadow) return true;
    if (is_known(hit)) return false;
    if (count_ == hits_.size()) return true;
    hits_[count_++] = hit;
    return false;
  }

  // In one order always: their product is rounded.
  std::span<const Hit> from_near_to_far() {
    const auto met = hits_.first(count_);
    std::sort(met.begin(), met.end(), [](const Hit& a, const Hit& b) {
      return std::tie(a.t, a.instance, a.face) < std::tie(b.t, b.instance, b.face);
    });
    return met;
  }

 private:
  bool is_known(const Hit& hit) const {
    const auto met = hits_.first(count_);
    return std::any_of(met.begin(), met.end(), [&](const Hit& h) {
      return h.face == hit.face && h.instance == hit.instance;
    });
  }

  const Scene& scene_;
  const WorldIndex world_;
  const std::span<Hit> hits_;
  size_t count_ = 0;
};

}  // namespace

Vec3 origin_on_smooth_surface(const SurfaceInteraction& at, Vec3 wi, float smooth, float flat) {
  const float cutoff = at.instance->terminator_cutoff;
  const float amount = smooth < cutoff ? 2.0f - (flat + smooth) / cutoff : 1.0f - flat / cutoff;
  const Vec3 above = offset_ray_origin(at, flat > 0.0f ? wi : at.geometric_normal);
  return above + to_smooth_surface(at) * saturate(amount);
}

Spectrum surface_transparency(const Scene& scene, const SurfaceInteraction& at,
                              const Material& material, const PathInfo& path,
                              ShadingContext& scratch) {
  scratch.surface = at;
  begin_surface(scene, material, path, k_query_transparency, scratch);
  material.transparency.run(scratch);
  // Blender's hairs cast grey shadows.
  return is_on_hair(at) ? Spectrum(mean(scratch.transparency)) : scratch.transparency;
}

Spectrum transmittance_of_surfaces(const Scene& scene, const RenderSettings& settings,
                                   const Ray& ray, WorldIndex world, const PathInfo& path,
                                   Worker& worker) {
  const uint32_t mask = ray_mask(world, RayKind::shadow);
  const int passes = settings.transparent_max_bounces - path.transparent_depth;
  TransparentFaces faces(
      scene, world, std::span(worker.shadow_hits).first(static_cast<size_t>(std::max(passes, 0))));
  if (scene.accel->occluded(ray, mask, faces)) return {};
  PathInfo info = path;
  info.kind = RayKind::shadow;
  info.world = world;
  ++info.ray_depth;
  Spectrum through(1.0f);
  for (const Hit& hit : faces.from_near_to_far()) {
    const SurfaceInteraction at = scene.interaction(ray, hit, 0.0f);
    through *= surface_transparency(scene, at, scene.material_at(at, world), info, worker.light);
    if (!(max_component(through) > 0.0f)) return {};
    ++info.transparent_depth;
  }
  return through;
}

}  // namespace tenniel
