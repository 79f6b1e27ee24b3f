// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/voronoi.h"

#include <algorithm>
#include <cmath>

#include "math/numeric.h"
#include "shading/nodes/cell_hash.h"

namespace tenniel {

namespace {

// No point of a window is this far away.
constexpr float k_far = 8.0f;

template <size_t n>
NoisePoint<n> sum(NoisePoint<n> a, const NoisePoint<n>& b) {
  for (size_t i = 0; i < n; ++i)
    a[i] += b[i];
  return a;
}

template <size_t n>
NoisePoint<n> difference(NoisePoint<n> a, const NoisePoint<n>& b) {
  for (size_t i = 0; i < n; ++i)
    a[i] -= b[i];
  return a;
}

template <size_t n>
float inner_product(const NoisePoint<n>& a, const NoisePoint<n>& b) {
  float total = 0.0f;
  for (size_t i = 0; i < n; ++i)
    total += a[i] * b[i];
  return total;
}

template <size_t n>
float euclidean(const NoisePoint<n>& a, const NoisePoint<n>& b) {
  const NoisePoint<n> d = difference(a, b);
  return std::sqrt(inner_product(d, d));
}

template <size_t n>
float measure(const NoisePoint<n>& a, const NoisePoint<n>& b, const VoronoiParameters& v) {
  const NoisePoint<n> d = difference(a, b);
  if constexpr (n == 1) return std::abs(d[0]);
  float total = 0.0f;
  switch (v.metric) {
    case VoronoiMetric::euclidean:
      return std::sqrt(inner_product(d, d));
    case VoronoiMetric::manhattan:
      for (const float x : d)
        total += std::abs(x);
      return total;
    case VoronoiMetric::chebychev:
      for (const float x : d)
        total = std::max(total, std::abs(x));
      return total;
    case VoronoiMetric::minkowski:
      for (const float x : d)
        total += std::pow(std::abs(x), v.exponent);
      return std::pow(total, 1.0f / v.exponent);
  }
  return total;
}

// Calls `visit` for every cell offset in [-radius, radius]^n, the first axis fastest.
template <size_t n, class Visit>
void for_each_offset(int radius, Visit visit) {
  NoisePoint<n> offset;
  offset.fill(static_cast<float>(-radius));
  for (;;) {
    visit(offset);
    size_t axis = 0;
    while (axis < n && offset[axis] == static_cast<float>(radius))
      offset[axis++] = static_cast<float>(-radius);
    if (axis == n) return;
    offset[axis] += 1.0f;
  }
}

// The cell that a coordinate lies in, where in it, and the random points around.
template <size_t n>
struct Cells {
  NoisePoint<n> cell, local;
  float randomness;

  Cells(const NoisePoint<n>& p, const VoronoiParameters& v) : randomness(saturate(v.randomness)) {
    for (size_t i = 0; i < n; ++i) {
      cell[i] = std::floor(p[i]);
      local[i] = p[i] - cell[i];
    }
  }
  NoisePoint<n> point(const NoisePoint<n>& offset) const {
    NoisePoint<n> at = random_point_of(sum(cell, offset));
    for (size_t i = 0; i < n; ++i)
      at[i] = offset[i] + at[i] * randomness;
    return at;
  }
  Spectrum color(const NoisePoint<n>& offset) const { return random_color_of(sum(cell, offset)); }
};

template <size_t n>
VoronoiResult<n> smooth_f1(const Cells<n>& cells, const VoronoiParameters& v, float k) {
  VoronoiResult<n> result;
  result.distance = k_far;
  for_each_offset<n>(2, [&](const NoisePoint<n>& offset) {
    const NoisePoint<n> point = cells.point(offset);
    const float d = measure(point, cells.local, v);
    const float h = smoothstep(saturate(0.5f + 0.5f * (result.distance - d) / k));
    if (h == 0.0f) return;
    const float bulge = k * h * (1.0f - h);
    result.distance = lerp(result.distance, d, h) - bulge;
    const float correction = bulge / (1.0f + 3.0f * k);
    result.color = lerp(result.color, cells.color(offset), h) - Spectrum(correction);
    for (size_t i = 0; i < n; ++i)
      result.position[i] = lerp(result.position[i], point[i], h) - correction;
  });
  result.position = sum(result.position, cells.cell);
  return result;
}

template <size_t n>
VoronoiResult<n> nearest(const Cells<n>& cells, const VoronoiParameters& v, bool second) {
  struct Candidate {
    float distance = k_far;
    NoisePoint<n> offset{}, point{};
  };
  Candidate first, next;
  for_each_offset<n>(1, [&](const NoisePoint<n>& offset) {
    const NoisePoint<n> point = cells.point(offset);
    const float d = measure(point, cells.local, v);
    if (d < first.distance) {
      next = first;
      first = {d, offset, point};
    } else if (d < next.distance) {
      next = {d, offset, point};
    }
  });
  const Candidate& chosen = second ? next : first;
  return {chosen.distance, cells.color(chosen.offset), sum(chosen.point, cells.cell)};
}

}  // namespace

template <size_t n>
VoronoiResult<n> voronoi(VoronoiFeature feature, const NoisePoint<n>& p,
                         const VoronoiParameters& v) {
  const Cells<n> cells(p, v);
  const float k = std::clamp(v.smoothness * 0.5f, 0.0f, 0.5f);
  if (feature == VoronoiFeature::smooth_f1 && k > 0.0f) return smooth_f1(cells, v, k);
  return nearest(cells, v, feature == VoronoiFeature::f2);
}

template <size_t n>
float voronoi_edge_distance(const NoisePoint<n>& p, const VoronoiParameters& v) {
  const Cells<n> cells(p, v);
  if constexpr (n == 1) {
    const float middle = cells.point({0.0f})[0];
    const float left = (middle + cells.point({-1.0f})[0]) * 0.5f;
    const float right = (middle + cells.point({1.0f})[0]) * 0.5f;
    return std::min(std::abs(left - cells.local[0]), std::abs(right - cells.local[0]));
  }
  NoisePoint<n> to_closest{};
  float closest = k_far;
  for_each_offset<n>(1, [&](const NoisePoint<n>& offset) {
    const NoisePoint<n> to_point = difference(cells.point(offset), cells.local);
    const float d2 = inner_product(to_point, to_point);
    if (d2 < closest) closest = d2, to_closest = to_point;
  });
  float edge = k_far;
  for_each_offset<n>(1, [&](const NoisePoint<n>& offset) {
    const NoisePoint<n> to_point = difference(cells.point(offset), cells.local);
    const NoisePoint<n> across = difference(to_point, to_closest);
    const float length2 = inner_product(across, across);
    if (length2 <= 1e-4f) return;
    const float d = 0.5f * inner_product(sum(to_closest, to_point), across) / std::sqrt(length2);
    edge = std::min(edge, d);
  });
  return edge;
}

template <size_t n>
float voronoi_sphere_radius(const NoisePoint<n>& p, const VoronoiParameters& v) {
  const Cells<n> cells(p, v);
  NoisePoint<n> closest{}, closest_offset{};
  float distance = k_far;
  for_each_offset<n>(1, [&](const NoisePoint<n>& offset) {
    const NoisePoint<n> point = cells.point(offset);
    const float d = euclidean(point, cells.local);
    if (d < distance) distance = d, closest = point, closest_offset = offset;
  });
  float gap = k_far;
  for_each_offset<n>(1, [&](const NoisePoint<n>& step) {
    if (step == NoisePoint<n>{}) return;
    gap = std::min(gap, euclidean(closest, cells.point(sum(step, closest_offset))));
  });
  return gap * 0.5f;
}

#define TENNIEL_VORONOI_OF_DIMENSION(n)                                                    \
  template VoronoiResult<n> voronoi<n>(VoronoiFeature, const NoisePoint<n>&,               \
                                       const VoronoiParameters&);                          \
  template float voronoi_edge_distance<n>(const NoisePoint<n>&, const VoronoiParameters&); \
  template float voronoi_sphere_radius<n>(const NoisePoint<n>&, const VoronoiParameters&);
TENNIEL_VORONOI_OF_DIMENSION(1)
TENNIEL_VORONOI_OF_DIMENSION(2)
TENNIEL_VORONOI_OF_DIMENSION(3)
TENNIEL_VORONOI_OF_DIMENSION(4)
#undef TENNIEL_VORONOI_OF_DIMENSION

}  // namespace tenniel
