// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bsdf/subsurface.h"
#include "integrator/worker.h"
#include "scene/scene.h"

namespace tenniel {

// Metres. What has gone so far below a surface does not come back, and leaves the range of rays.
constexpr float k_farthest_below = 1e9f;

// Where light goes below the surface of an object. One object alone counts, whatever sees it.
struct SubsurfaceEntry {
  const SurfaceInteraction& at;
  Vec3 normal;          // of the lobe, on the side of at.wo
  Spectrum throughput;  // of the path, the lobe's weight included
  Vec2 u;               // stratified numbers for what comes first
  float choice = 0.0f;  // one more
  Sampler& sampler;     // for what comes next
  uint32_t vertex = 0;  // of the path: which of the sampler's dimensions are free
};

// Where it leaves. `ray` comes from outside, so that what it meets has its front outside.
struct SubsurfaceExit {
  Ray ray;
  Hit hit;
  Spectrum throughput;
};

// What one object answers to rays below its surface at the time of the path.
class ObjectBelow {
 public:
  ObjectBelow(const Scene& scene, const SurfaceInteraction& at)
      : scene_(scene), instance_(scene.index_of(*at.instance)), to_object_(at.world_to_object()) {}

  std::optional<Hit> intersect(const Ray& ray) const {
    return scene_.accel->intersect_instance(ray, instance_, &to_object_);
  }
  // All hits from near to far, at most hits.size(); how many.
  size_t intersect_all(const Ray& ray, std::span<Hit> hits) const;
  SurfaceInteraction interaction(const Ray& ray, const Hit& hit) const {
    return scene_.interaction(ray, hit, 0.0f);
  }

 private:
  const Scene& scene_;
  uint32_t instance_;
  Transform to_object_;
};

// A random walk through the medium that the lobe stands for (subsurface_walk.cpp), and a probe of
// the surface nearby for a profile (subsurface_disk.cpp). Empty: the light is lost.
std::optional<SubsurfaceExit> walk_below(const ObjectBelow& object, const Subsurface& lobe,
                                         const SubsurfaceEntry& entry);
std::optional<SubsurfaceExit> probe_nearby(const ObjectBelow& object, const Subsurface& lobe,
                                           const SubsurfaceEntry& entry);

std::optional<SubsurfaceExit> find_exit(const Scene& scene, const Subsurface& lobe,
                                        const SubsurfaceEntry& entry);

// Makes `context`, whose surface is the exit, what light that leaves there scatters by: a diffuse
// lobe, around the normal that the shader gives its subsurface there.
void shade_exit(const Scene& scene, const Subsurface& lobe, const PathInfo& path,
                ShadingContext& context);

}  // namespace tenniel
