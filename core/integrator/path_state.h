// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "integrator/medium_stack.h"
#include "lights/light_types.h"
#include "math/ray.h"
#include "math/spectrum.h"
#include "shading/shading_context.h"

namespace tenniel {

// Everything a path carries from one vertex to the next. `info.world` is the world of the current
// segment, a function of the path's own past alone.
struct PathState {
  Ray ray;
  RayCone cone;
  Spectrum throughput{1.0f};
  PathInfo info;
  MediumStack media;
  float skipped_before = 0.0f;  // metres of those media behind the ray's origin
  // The last vertex that scattered, for the weight of light met by chance. `pdf` 0: no light sample
  // could have made this segment (camera ray, or a delta lobe).
  ShadingPoint origin;
  float pdf = 0.0f;
  bool origin_saw_many_lights = false;  // its light sample was one of LightSampler::candidates
  FaceId left;                          // the face that the ray has just passed through
  // Added to the length of the segment to give that of the ray: it runs on through transparent
  // surfaces, and a camera's starts at the clip plane.
  float length_before = 0.0f;
  // Least density of any bounce so far, for filter glossy.
  float min_pdf = std::numeric_limits<float>::max();
  bool sees_background = true;     // nothing but transparent surfaces so far
  bool is_specular_so_far = true;  // only deltas and transparent surfaces so far
  bool has_entered = false;        // has gone through a looking glass
  bool is_recorded = false;        // the film has noted a surface: its depth and normal
  // A bounce limit is reached: only what passes through goes on.
  bool ends_after_transparent = false;
  uint32_t vertices = 0;  // surfaces met, transparent ones included

  // Begins a segment after a bounce or in a medium.
  void begin_segment(Vec3 start, Vec3 direction) {
    ray.origin = start;
    ray.direction = direction;
    ray.t_min = ray.behind = length_before = 0.0f;
    ray.t_max = k_infinity;
    left = {};
  }
};

}  // namespace tenniel
