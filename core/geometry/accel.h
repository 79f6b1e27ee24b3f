// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "geometry/interaction.h"

namespace tenniel {

// Ray queries against every instance: the only place that knows Embree. Const and thread-safe once
// built; a ray that is not finite never reaches Embree (Debian's build would abort) and is counted.
class Accel {
 public:
  // Multi-user meshes become true instances, world-space meshes join the top level. `cancelled` is
  // polled during the build; an empty Accel comes back when it was set.
  // Embree reads the meshes' own arrays: they must outlive the Accel (moving a Mesh is fine).
  // Instances that are singular or not finite, or whose mesh has no faces, are never hit.
  // Throws std::runtime_error with Embree's own words when the device or the build fails.
  static std::shared_ptr<const Accel> build(std::span<const Mesh> meshes,
                                            std::span<const Instance> instances,
                                            const std::atomic<bool>& cancelled);
  ~Accel();

  // Closest hit in (ray.t_min, ray.t_max) among what `mask` (see ray_mask) sees. Where there are
  // hairs, the face that the ray has `left` by passing through it is not met again: pieces of a
  // ribbon overlap where it bends.
  std::optional<Hit> intersect(const Ray& ray, uint32_t mask, FaceId left = {}) const;
  bool occluded(const Ray& ray, uint32_t mask) const;
  // Asked of the faces that a ray meets, in no order, until one blocks it. A face may come twice:
  // on the diagonal of a quad, where pieces of a ribbon overlap.
  class Blocker {
   public:
    virtual bool blocks(const Hit& hit) = 0;

   protected:
    ~Blocker() = default;
  };
  bool occluded(const Ray& ray, uint32_t mask, Blocker& blocker) const;
  // All hits, as many as `hits` holds, in no order; how many. A face counts once.
  size_t intersect_all(const Ray& ray, uint32_t mask, std::span<Hit> hits) const;
  // Closest hit with one instance only, whatever its mask. `world_to_object`: where it stands at
  // the ray's time; null: in the middle of the shutter. Fast where Instance::is_searched_alone.
  std::optional<Hit> intersect_instance(const Ray& ray, uint32_t instance,
                                        const Transform* world_to_object = nullptr) const;
  // All hits with it, as intersect_all.
  size_t intersect_all_of_instance(const Ray& ray, uint32_t instance,
                                   const Transform& world_to_object, std::span<Hit> hits) const;

  Bounds3 bounds() const;          // world space, of all instances
  size_t memory_bytes() const;     // what Embree holds
  uint64_t rejected_rays() const;  // not finite
  static std::string embree_version();

 private:
  Accel();
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tenniel
