// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "integrator/radiance_cache.h"

namespace tenniel {

// Follows one training path and makes records of the first diffuse surfaces that it meets.
class PathRecorder {
 public:
  void begin() { count_ = 0; }

  // `record` without its radiance; `throughput` times albedo, `gathered` by the path before.
  void diffuse_surface(const RadianceRecord& record, Spectrum throughput, Spectrum gathered) {
    if (count_ < k_max_surfaces) surfaces_[count_++] = {record, throughput, gathered};
  }

  // Hands out the records, once the path has ended with `total`.
  template <class Use>
  void finish(Spectrum total, const Use& use) {
    const auto over = [](float a, float b) { return b > 0.0f ? a / b : 0.0f; };
    for (Surface& surface : std::span(surfaces_).first(count_)) {
      const Spectrum gained = total - surface.gathered, throughput = surface.throughput;
      surface.record.radiance = {over(gained.r, throughput.r), over(gained.g, throughput.g),
                                 over(gained.b, throughput.b)};
      if (is_finite(surface.record.radiance)) use(surface.record);
    }
  }

 private:
  struct Surface {
    RadianceRecord record;
    Spectrum throughput, gathered;
  };
  static constexpr size_t k_max_surfaces = 8;

  std::array<Surface, k_max_surfaces> surfaces_;
  size_t count_ = 0;
};

}  // namespace tenniel
