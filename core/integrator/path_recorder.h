// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "integrator/radiance_cache.h"

namespace tenniel {

// Follows one training path and makes records of its first diffuse bounces.
class PathRecorder {
 public:
  void begin() { count_ = 0; }

  // `record` without its radiance; `throughput` after the bounce, `gathered` by the path before it.
  // False once there is no more room.
  bool diffuse_bounce(const RadianceRecord& record, Spectrum throughput, Spectrum gathered) {
    if (count_ == k_max_bounces) return false;
    bounces_[count_++] = {record, throughput, gathered};
    return true;
  }
  // Nothing but the World came after the last record.
  void leave_scene() { bounces_[count_ - 1].record.has_left_scene = true; }

  // Hands out the records, once the path has ended with `total`.
  template <class Use>
  void finish(Spectrum total, const Use& use) {
    const auto over = [](float a, float b) { return b > 0.0f ? a / b : 0.0f; };
    for (Bounce& bounce : std::span(bounces_).first(count_)) {
      const Spectrum gained = total - bounce.gathered, throughput = bounce.throughput;
      bounce.record.radiance = {over(gained.r, throughput.r), over(gained.g, throughput.g),
                                over(gained.b, throughput.b)};
      if (is_finite(bounce.record.radiance)) use(bounce.record);
    }
  }

 private:
  struct Bounce {
    RadianceRecord record;
    Spectrum throughput, gathered;
  };
  static constexpr size_t k_max_bounces = 8;

  std::array<Bounce, k_max_bounces> bounces_;
  size_t count_ = 0;
};

}  // namespace tenniel
