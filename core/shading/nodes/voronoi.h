// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "math/spectrum.h"
#include "shading/nodes/noise.h"

// Worley's cellular noise with one random point a cell (Worley 1996), as Blender 3.4 has it.
namespace tenniel {

enum class VoronoiMetric : uint8_t { euclidean, manhattan, chebychev, minkowski };
enum class VoronoiFeature : uint8_t { f1, f2, smooth_f1, distance_to_edge, n_sphere_radius };

struct VoronoiParameters {
  VoronoiMetric metric = VoronoiMetric::euclidean;
  float exponent = 0.5f;    // of Minkowski's metric
  float randomness = 1.0f;  // 0 = points on a grid; clamped to [0, 1]
  float smoothness = 1.0f;  // of smooth F1; clamped to [0, 1]
  bool with_color = true;
};

template <size_t n>
struct VoronoiResult {
  float distance = 0.0f;
  Spectrum color;            // if it was asked for
  NoisePoint<n> position{};  // of the point, in the space of the coordinate asked for
};

// `feature` is f1, f2 or smooth_f1.
template <size_t n>
VoronoiResult<n> voronoi(VoronoiFeature feature, const NoisePoint<n>& p,
                         const VoronoiParameters& parameters);
// Distance to the nearest border between two cells.
template <size_t n>
float voronoi_edge_distance(const NoisePoint<n>& p, const VoronoiParameters& parameters);
// Half the distance from the nearest point to the point nearest to that.
template <size_t n>
float voronoi_sphere_radius(const NoisePoint<n>& p, const VoronoiParameters& parameters);

}  // namespace tenniel
