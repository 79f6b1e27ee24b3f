// SPDX-License-Identifier: Apache-2.0
#include "geometry/pointiness.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "math/numeric.h"

namespace tenniel {

namespace {

constexpr float k_epsilon = std::numeric_limits<float>::epsilon();

// For each vertex the one that stands for all in its place. Vertices in one place have one sum of
// coordinates, so that they are neighbours when sorted by it.
std::vector<uint32_t> welded(const std::vector<Vec3>& positions, const Cancellation& cancellation) {
  const auto sum = [&](uint32_t v) { return positions[v].x + positions[v].y + positions[v].z; };
  std::vector<uint32_t> order(positions.size()), place(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    cancellation.check();
    return sum(a) != sum(b) ? sum(a) < sum(b) : a > b;
  });
  // From the end, so that chains of copies are already resolved.
  for (size_t i = order.size(); i-- > 0;) {
    cancellation.check();
    const uint32_t v = order[i];
    place[v] = v;
    for (size_t j = i + 1; j < order.size(); ++j) {
      const uint32_t other = order[j];
      if (sum(other) - sum(v) > 3.0f * k_epsilon) break;
      if (length_squared(positions[other] - positions[v]) < k_epsilon) {
        place[v] = place[other];
        break;
      }
    }
  }
  return place;
}

using Edge = std::pair<uint32_t, uint32_t>;

std::vector<Edge> distinct_edges(const std::vector<uint32_t>& edges,
                                 const std::vector<uint32_t>& place,
                                 const Cancellation& cancellation) {
  std::vector<Edge> result;
  for (size_t e = 0; e + 1 < edges.size(); e += 2) {
    if (edges[e] >= place.size() || edges[e + 1] >= place.size()) continue;
    const uint32_t a = place[edges[e]], b = place[edges[e + 1]];
    result.emplace_back(std::min(a, b), std::max(a, b));
  }
  std::sort(result.begin(), result.end(), [&](const Edge& a, const Edge& b) {
    cancellation.check();
    return a < b;
  });
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace

std::vector<float> pointiness(const std::vector<Vec3>& positions, const std::vector<Vec3>& normals,
                              const std::vector<uint32_t>& edges,
                              const Cancellation& cancellation) {
  const size_t count = positions.size();
  const std::vector<uint32_t> place = welded(positions, cancellation);
  const std::vector<Edge> pairs = distinct_edges(edges, place, cancellation);
  std::vector<Vec3> normal(count), along(count);
  std::vector<float> neighbours(count, 0.0f), raw(count, 0.0f), result(count, 0.0f);
  for (size_t v = 0; v < count; ++v)
    normal[place[v]] += normals[v];
  for (const auto& [a, b] : pairs) {
    const Vec3 edge = normalize_or(positions[b] - positions[a], {});
    along[a] += edge;
    along[b] -= edge;
    neighbours[a] += 1.0f;
    neighbours[b] += 1.0f;
  }
  for (size_t v = 0; v < count; ++v)
    if (neighbours[v] > 0.0f)
      raw[v] = safe_acos(dot(normalize_or(normal[v], {}), along[v] / neighbours[v])) * k_inv_pi;
  result = raw;
  for (const auto& [a, b] : pairs) {
    result[a] += raw[b];
    result[b] += raw[a];
  }
  for (size_t v = 0; v < count; ++v)
    result[v] /= neighbours[v] + 1.0f;
  for (size_t v = 0; v < count; ++v)
    result[v] = result[place[v]];
  return result;
}

}  // namespace tenniel
