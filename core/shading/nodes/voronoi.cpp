// SPDX-License-Identifier: Apache-2.0
#include "shading/nodes/voronoi.h"

#include <algorithm>
#include <cmath>

#include "math/lanes.h"
#include "math/numeric.h"
#include "shading/nodes/cell_hash.h"

namespace tenniel {

namespace {

// No point of a window is this far away.
constexpr float k_far = 8.0f;

// The cells around one, the first axis fastest, as offsets of whole vectors: what is too much
// repeats the last cell.
template <size_t n, int radius>
struct Window {
  static constexpr size_t k_side = 2 * radius + 1;
  static constexpr size_t k_cells = [] {
    size_t cells = 1;
    for (size_t axis = 0; axis < n; ++axis)
      cells *= k_side;
    return cells;
  }();
  static constexpr size_t k_padded = (k_cells + k_lanes - 1) / k_lanes * k_lanes;
  using Axis = std::array<float, k_padded>;

  static constexpr std::array<Axis, n> k_offsets = [] {
    std::array<Axis, n> offsets{};
    for (size_t i = 0; i < k_padded; ++i) {
      size_t rest = std::min(i, k_cells - 1);
      for (size_t axis = 0; axis < n; ++axis, rest /= k_side)
        offsets[axis][i] = static_cast<float>(rest % k_side) - static_cast<float>(radius);
    }
    return offsets;
  }();
  static NoisePoint<n> offset(size_t i) {
    NoisePoint<n> at;
    for (size_t axis = 0; axis < n; ++axis)
      at[axis] = k_offsets[axis][i];
    return at;
  }
};

// `x` is a point or the lanes of eight.
template <class Float, size_t n>
Float length_squared(const std::array<Float, n>& x) {
  Float total{};
  for (size_t i = 0; i < n; ++i)
    total += x[i] * x[i];
  return total;
}

FloatLanes root(FloatLanes x) {
  return each_lane(x, [](float lane) { return std::sqrt(lane); });
}
FloatLanes absolute(FloatLanes x) {
  return x < 0.0f ? -x : x;
}

template <size_t n>
FloatLanes measure(const std::array<FloatLanes, n>& d, const VoronoiParameters& v) {
  if constexpr (n == 1) return absolute(d[0]);
  FloatLanes total{};
  switch (v.metric) {
    case VoronoiMetric::euclidean:
      return root(length_squared(d));
    case VoronoiMetric::manhattan:
      for (const FloatLanes& x : d)
        total += absolute(x);
      return total;
    case VoronoiMetric::chebychev:
      for (const FloatLanes& x : d)
        total = absolute(x) > total ? absolute(x) : total;
      return total;
    case VoronoiMetric::minkowski:
      for (const FloatLanes& x : d)
        total += each_lane(absolute(x), [&](float lane) { return std::pow(lane, v.exponent); });
      return each_lane(total, [&](float lane) { return std::pow(lane, 1.0f / v.exponent); });
  }
  return total;
}

// The cell that a coordinate lies in and where in it.
template <size_t n>
struct Place {
  NoisePoint<n> cell, local;

  explicit Place(const NoisePoint<n>& p) {
    for (size_t i = 0; i < n; ++i) {
      cell[i] = std::floor(p[i]);
      local[i] = p[i] - cell[i];
    }
  }
  Spectrum color(const NoisePoint<n>& offset) const { return random_color_of(plus(cell, offset)); }
};

// The random points of a window about the cell at `centre` of a place, relative to its own cell.
template <size_t n, int radius>
class Points {
 public:
  using Cells = Window<n, radius>;
  static constexpr size_t k_vectors = Cells::k_padded / k_lanes;

  Points(const Place<n>& place, const VoronoiParameters& v, const NoisePoint<n>& centre = {}) {
    const float randomness = saturate(v.randomness);
    for (size_t vector = 0; vector < k_vectors; ++vector) {
      std::array<FloatLanes, n> offset, cell;
      for (size_t axis = 0; axis < n; ++axis) {
        offset[axis] = load_lanes(&Cells::k_offsets[axis][vector * k_lanes]) + centre[axis];
        cell[axis] = offset[axis] + place.cell[axis];
      }
      const std::array<FloatLanes, n> random = random_point_of(cell);
      for (size_t axis = 0; axis < n; ++axis)
        store_lanes(offset[axis] + random[axis] * randomness, &axes_[axis][vector * k_lanes]);
    }
  }
  // From `origin` to eight of the points.
  std::array<FloatLanes, n> from(const NoisePoint<n>& origin, size_t vector) const {
    std::array<FloatLanes, n> to;
    for (size_t axis = 0; axis < n; ++axis)
      to[axis] = load_lanes(&axes_[axis][vector * k_lanes]) - origin[axis];
    return to;
  }
  NoisePoint<n> operator[](size_t i) const {
    NoisePoint<n> point;
    for (size_t axis = 0; axis < n; ++axis)
      point[axis] = axes_[axis][i];
    return point;
  }

 private:
  std::array<typename Cells::Axis, n> axes_;
};

// What `f` makes of the way to each point; `k_far` in place of those that repeat another.
template <size_t n, int radius, class Function>
auto distances(const Points<n, radius>& points, const NoisePoint<n>& origin, Function f) {
  using Cells = Window<n, radius>;
  typename Cells::Axis all;
  for (size_t vector = 0; vector < Points<n, radius>::k_vectors; ++vector)
    store_lanes(f(points.from(origin, vector)), &all[vector * k_lanes]);
  for (size_t i = Cells::k_cells; i < Cells::k_padded; ++i)
    all[i] = k_far;
  return all;
}

// The first where several are as small. There always is one: what repeats a cell is `k_far`.
template <class Distances>
size_t index_of_smallest(const Distances& distances) {
  FloatLanes least = FloatLanes{} + k_far;
  for (size_t i = 0; i < distances.size(); i += k_lanes) {
    const FloatLanes next = load_lanes(&distances[i]);
    least = next < least ? next : least;
  }
  const float value = smallest(least);
  size_t index = 0;
  while (distances[index] != value)
    ++index;
  return index;
}

template <size_t n>
VoronoiResult<n> smooth_f1(const Place<n>& place, const VoronoiParameters& v, float k) {
  const Points<n, 2> points(place, v);
  const auto to_points =
      distances(points, place.local, [&](const auto& d) { return measure(d, v); });
  VoronoiResult<n> result;
  result.distance = k_far;
  for (size_t i = 0; i < Window<n, 2>::k_cells; ++i) {
    const float d = to_points[i];
    const float h = smoothstep(saturate(0.5f + 0.5f * (result.distance - d) / k));
    if (h == 0.0f) continue;
    const float bulge = k * h * (1.0f - h);
    result.distance = lerp(result.distance, d, h) - bulge;
    const float correction = bulge / (1.0f + 3.0f * k);
    if (v.with_color)
      result.color =
          lerp(result.color, place.color(Window<n, 2>::offset(i)), h) - Spectrum(correction);
    const NoisePoint<n> point = points[i];
    for (size_t axis = 0; axis < n; ++axis)
      result.position[axis] = lerp(result.position[axis], point[axis], h) - correction;
  }
  result.position = plus(result.position, place.cell);
  return result;
}

template <size_t n>
VoronoiResult<n> nearest(const Place<n>& place, const VoronoiParameters& v, bool second) {
  const Points<n, 1> points(place, v);
  auto to_points = distances(points, place.local, [&](const auto& to_point) {
    const FloatLanes d = measure(to_point, v);
    return d < k_far ? d : FloatLanes{} + k_far;
  });
  size_t chosen = index_of_smallest(to_points);
  if (second) {
    to_points[chosen] = k_far;
    chosen = index_of_smallest(to_points);
  }
  VoronoiResult<n> result;
  result.distance = to_points[chosen];
  // As in Blender: nowhere is the corner of the own cell.
  const bool is_far = result.distance == k_far;
  if (v.with_color)
    result.color = place.color(is_far ? NoisePoint<n>{} : Window<n, 1>::offset(chosen));
  result.position = is_far ? place.cell : plus(points[chosen], place.cell);
  return result;
}

}  // namespace

template <size_t n>
VoronoiResult<n> voronoi(VoronoiFeature feature, const NoisePoint<n>& p,
                         const VoronoiParameters& v) {
  const Place<n> place(p);
  const float k = std::clamp(v.smoothness * 0.5f, 0.0f, 0.5f);
  if (feature == VoronoiFeature::smooth_f1 && k > 0.0f) return smooth_f1(place, v, k);
  return nearest(place, v, feature == VoronoiFeature::f2);
}

template <size_t n>
float voronoi_edge_distance(const NoisePoint<n>& p, const VoronoiParameters& v) {
  const Place<n> place(p);
  const Points<n, 1> points(place, v);
  if constexpr (n == 1) {
    const float left = (points[1][0] + points[0][0]) * 0.5f;
    const float right = (points[1][0] + points[2][0]) * 0.5f;
    return std::min(std::abs(left - place.local[0]), std::abs(right - place.local[0]));
  }
  const size_t closest = index_of_smallest(
      distances(points, place.local, [](const auto& d) { return length_squared(d); }));
  NoisePoint<n> to_closest = points[closest];
  for (size_t i = 0; i < n; ++i)
    to_closest[i] -= place.local[i];
  const auto edges = distances(points, place.local, [&](const auto& to_point) {
    std::array<FloatLanes, n> across;
    FloatLanes along{};
    for (size_t i = 0; i < n; ++i) {
      across[i] = to_point[i] - to_closest[i];
      along += (to_point[i] + to_closest[i]) * across[i];
    }
    const FloatLanes length2 = length_squared(across);
    return length2 <= 1e-4f ? FloatLanes{} + k_far : 0.5f * along / root(length2);
  });
  return edges[index_of_smallest(edges)];
}

template <size_t n>
float voronoi_sphere_radius(const NoisePoint<n>& p, const VoronoiParameters& v) {
  const Place<n> place(p);
  const auto length = [](const auto& d) { return root(length_squared(d)); };
  const Points<n, 1> points(place, v);
  const size_t closest = index_of_smallest(distances(points, place.local, length));
  const Points<n, 1> around(place, v, Window<n, 1>::offset(closest));
  auto gaps = distances(around, points[closest], length);
  gaps[Window<n, 1>::k_cells / 2] = k_far;  // to itself
  return gaps[index_of_smallest(gaps)] * 0.5f;
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
