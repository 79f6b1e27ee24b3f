// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "integrator/segment_media.h"
#include "scene/description.h"

namespace tenniel {

// Where a ray starts: in which media, and how many metres of them lie behind its origin.
struct SegmentStart {
  MediumStack media;
  float skipped = 0.0f;
};

// That of a ray which leaves the surface at `at` toward `direction` in `world`; the path came there
// through the media `before` of `world_before`.
SegmentStart segment_from(const Scene& scene, const SurfaceInteraction& at, Vec3 direction,
                          const MediumStack& before, WorldIndex world_before, WorldIndex world);

// Share of the light that comes along `ray` from `ray.t_max` through all media and transparent
// surfaces on the way. Boundaries without a surface do not count as one.
Spectrum media_transmittance(const Scene& scene, const RenderSettings& settings, const Ray& ray,
                             const SegmentStart& start, const PathInfo& path,
                             ShadingContext& scratch);

}  // namespace tenniel
