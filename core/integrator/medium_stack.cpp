// SPDX-License-Identifier: Apache-2.0
#include "integrator/medium_stack.h"

#include "shading/nodes/attributes.h"

namespace tenniel {

namespace {

// Boundaries of one object that a probe looks at: each slot's first one tells.
constexpr int k_max_probes = 64;
constexpr size_t k_max_coincident = 8;
// Steps where a medium varies, as in Cycles: a part of the object's mean extent.
constexpr float k_object_step = 0.1f;
// Along no axis: it runs along no side of a box and through no pole of a sphere.
constexpr Vec3 k_probe_direction{0.3112f, 0.1779f, 0.9335f};

// Enters the slots of one object that contain `point`: those whose nearest face shows its back.
void probe(const Scene& scene, uint32_t instance, Vec3 point, WorldIndex world,
           MediumStack& media) {
  MediumStack outside;
  Ray ray;
  ray.origin = point;
  ray.direction = normalize(k_probe_direction);
  for (int i = 0; i < k_max_probes; ++i) {
    const auto hit = scene.accel->intersect_instance(ray, instance);
    if (!hit) return;
    const SurfaceInteraction at = scene.interaction(ray, *hit, 0.0f);
    const MediumStack::Entry entry{instance, at.mesh->material_slot(at.face)};
    if (scene.material_at(at, world).has_volume && !media.contains(entry)) {
      if (!at.is_back_facing)
        outside.enter(entry);
      else if (!outside.contains(entry))
        media.enter(entry);
    }
    ray.origin = offset_ray_origin(at, ray.direction);
  }
}

void cross(const Scene& scene, const SurfaceInteraction& at, WorldIndex world, MediumStack& media) {
  const MediumStack::Entry entry{scene.index_of(*at.instance), at.mesh->material_slot(at.face)};
  if (at.is_back_facing)
    media.leave(entry);
  else if (scene.material_at(at, world).has_volume)
    media.enter(entry);
}

// Of a grid at the point; 1 where the instance has none of that kind.
float density_at(const Material& smoke, const Instance* instance, Vec3 point) {
  if (!instance) return 1.0f;
  const auto voxel =
      grid_attribute(*instance, point, 0.0f, smoke.grid_medium->density, smoke.grid_filter);
  return voxel ? std::max((*voxel)[0], 0.0f) : 1.0f;
}

// Calls `use(medium, scale)` for what one object or World makes of the point.
template <class Use>
void visit_medium(const Material& material, const Instance* instance, Vec3 point, Vec3 direction,
                  const PathInfo& path, ShadingContext& scratch, const Use& use) {
  if (!material.has_volume) return;
  const float scale = instance ? instance->density_scale : 1.0f;
  if (material.is_volume_constant) return use(material.constant_volume, scale);
  if (const auto& smoke = material.grid_medium) {
    use(smoke->medium, density_at(material, instance, point) * scale);
    if (is_black(smoke->emission)) return;
    MediumProperties glow;
    glow.add_emission(smoke->emission);
    return use(glow, scale);
  }
  scratch.surface = SurfaceInteraction();
  scratch.surface.instance = instance;
  scratch.surface.position = point;
  scratch.surface.wo = -direction;
  scratch.surface.geometric_normal = scratch.surface.shading_normal = -direction;
  scratch.path = path;
  scratch.domain = ShaderDomain::surface;
  scratch.lamp = nullptr;
  scratch.material_pass_index = material.pass_index;
  scratch.grid_filter = material.grid_filter;
  use(material.evaluate_volume(scratch), scale);
}

template <class Use>
void visit_media(const Scene& scene, const MediumStack& media, Vec3 point, Vec3 direction,
                 const PathInfo& path, ShadingContext& scratch, const Use& use) {
  scratch.camera = &scene.camera_info;
  visit_medium(scene.worlds[path.world].material, nullptr, point, direction, path, scratch, use);
  for (const MediumStack::Entry& entry : media) {
    const Instance& instance = scene.instances[entry.instance];
    const Material& material = scene.materials[instance.material(entry.slot, path.world)];
    visit_medium(material, &instance, point, direction, path, scratch, use);
  }
}

}  // namespace

MediumStack media_around(const Scene& scene, Vec3 point, WorldIndex world,
                         const MediumStack& known) {
  MediumStack media;
  for (const MediumStack::Entry& entry : known)
    if (scene.instances[entry.instance].visibility.exists_in(world)) media.enter(entry);
  for (const FilledInstance& filled : scene.filled_instances)
    if (filled.bounds.contains(point) &&
        scene.instances[filled.instance].visibility.exists_in(world))
      probe(scene, filled.instance, point, world, media);
  return media;
}

void cross_boundary(const Scene& scene, const SurfaceInteraction& at, Vec3 origin, WorldIndex world,
                    MediumStack& media) {
  cross(scene, at, world, media);
  if (scene.filled_instances.size() < 2) return;
  // From as far before the surface as the origin lies behind it.
  Ray ray;
  const Vec3 step = origin - at.position;
  const float size = length(step);
  ray.direction = normalize_or(step, -at.geometric_normal);
  ray.origin = at.position - ray.direction * size;
  ray.t_max = 2.0f * size;
  std::array<Hit, k_max_coincident> hits;
  const size_t count = scene.accel->intersect_all(ray, any_ray_mask(world), hits);
  for (size_t i = 0; i < count; ++i) {
    const SurfaceInteraction other = scene.interaction(ray, hits[i], 0.0f);
    if (other.instance != at.instance) cross(scene, other, world, media);
  }
}

void add_media_at(const Scene& scene, const MediumStack& media, Vec3 point, Vec3 direction,
                  const PathInfo& path, ShadingContext& scratch, MediumProperties& sum) {
  visit_media(scene, media, point, direction, path, scratch,
              [&sum](const MediumProperties& medium, float scale) { sum.add(medium, scale); });
}

Spectrum extinction_at(const Scene& scene, const MediumStack& media, Vec3 point, Vec3 direction,
                       const PathInfo& path, ShadingContext& scratch) {
  Spectrum sum;
  visit_media(
      scene, media, point, direction, path, scratch,
      [&sum](const MediumProperties& medium, float scale) { sum += medium.sigma_t() * scale; });
  return sum;
}

float medium_step(const Scene& scene, const MediumStack& media, WorldIndex world) {
  const auto varies = [](const Material& m) { return m.has_volume && !m.is_volume_constant; };
  const Material& around = scene.worlds[world].material;
  float step = varies(around) ? around.volume_step_rate : k_infinity;
  for (const MediumStack::Entry& entry : media) {
    const Instance& instance = scene.instances[entry.instance];
    const Material& material = scene.materials[instance.material(entry.slot, world)];
    if (!varies(material)) continue;
    const auto filled = std::lower_bound(
        scene.filled_instances.begin(), scene.filled_instances.end(), entry.instance,
        [](const FilledInstance& f, uint32_t index) { return f.instance < index; });
    const Vec3 size = filled->bounds.max - filled->bounds.min;
    const float least = std::min({size.x, size.y, size.z});
    const float across = k_object_step * (size.x + size.y + size.z) / 3.0f;
    // At least four steps through a flat one; none is so flat that its steps have no end.
    const float own = std::min(std::max(std::min(across, 0.25f * least), 0.01f * across),
                               std::max(filled->voxel, 0.01f * across));
    step = std::min(step, own * material.volume_step_rate);
  }
  return step;
}

}  // namespace tenniel
