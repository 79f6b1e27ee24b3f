// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "sampling/sampler.h"

namespace tenniel {

// The numbers that a path draws at its vertices.
class PathNumbers {
 public:
  // Those of a vertex. What it asks the sampler for besides comes after them.
  VertexNumbers take(Sampler& sampler, uint32_t vertex) {
    const uint32_t pair = vertex / 2;
    if (pair != pair_at_hand_) {
      const uint32_t first = k_camera_dimensions + 2 * pair * k_dimensions_per_vertex;
      pair_ = sampler.numbers_of_two_vertices(first, k_dimensions_per_vertex);
      pair_at_hand_ = pair;
    }
    sampler.set_dimension(k_camera_dimensions + vertex * k_dimensions_per_vertex +
                          VertexNumbers::k_requests);
    return pair_[vertex % 2];
  }
  // The sampler stands at another sample now.
  void forget() { pair_at_hand_ = k_none; }

 private:
  // Requests to the sampler per path vertex: those of VertexNumbers, on a looking glass a second
  // light sample, and for each the choice among candidates of many lights.
  static constexpr uint32_t k_dimensions_per_vertex = VertexNumbers::k_requests + 4;
  static constexpr uint32_t k_camera_dimensions = 8;
  static constexpr uint32_t k_none = ~0u;

  std::array<VertexNumbers, 2> pair_{};  // of an even vertex and the next
  uint32_t pair_at_hand_ = k_none;
};

}  // namespace tenniel
