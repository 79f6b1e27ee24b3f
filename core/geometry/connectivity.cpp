// SPDX-License-Identifier: Apache-2.0
#include "geometry/connectivity.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tenniel {

namespace {

class DisjointSets {
 public:
  explicit DisjointSets(size_t size) : parents_(size), ranks_(size, 0) {
    std::iota(parents_.begin(), parents_.end(), 0u);
  }

  uint32_t find(uint32_t x) {
    uint32_t root = x;
    while (parents_[root] != root)
      root = parents_[root];
    while (parents_[x] != root)
      x = std::exchange(parents_[x], root);
    return root;
  }

  void join(uint32_t a, uint32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return;
    if (ranks_[a] < ranks_[b]) std::swap(a, b);
    parents_[b] = a;
    if (ranks_[a] == ranks_[b]) ++ranks_[a];
  }

 private:
  std::vector<uint32_t> parents_;
  std::vector<uint8_t> ranks_;  // at most log2 of the size
};

}  // namespace

std::vector<uint32_t> connected_parts(size_t vertex_count, const std::vector<uint32_t>& edges) {
  DisjointSets sets(vertex_count);
  for (size_t e = 0; e + 1 < edges.size(); e += 2)
    if (edges[e] < vertex_count && edges[e + 1] < vertex_count) sets.join(edges[e], edges[e + 1]);
  std::vector<uint32_t> parts(vertex_count);
  for (uint32_t v = 0; v < vertex_count; ++v)
    parts[v] = sets.find(v);
  return parts;
}

std::vector<float> edges_to_vertices(size_t vertex_count, const std::vector<uint32_t>& edges,
                                     const std::vector<float>& values, size_t channels) {
  std::vector<float> sums(vertex_count * channels, 0.0f);
  std::vector<uint32_t> counts(vertex_count, 0);
  const size_t edge_count = std::min(edges.size() / 2, values.size() / channels);
  for (size_t e = 0; e < edge_count; ++e) {
    for (const uint32_t v : {edges[2 * e], edges[2 * e + 1]}) {
      if (v >= vertex_count) continue;
      ++counts[v];
      for (size_t c = 0; c < channels; ++c)
        sums[v * channels + c] += values[e * channels + c];
    }
  }
  for (size_t v = 0; v < vertex_count; ++v)
    for (size_t c = 0; c < channels && counts[v] > 0; ++c)
      sums[v * channels + c] /= static_cast<float>(counts[v]);
  return sums;
}

}  // namespace tenniel
