// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/visibility.h"
#include "math/spectrum.h"
#include "math/vec.h"

namespace tenniel {

// What one training path found at one of the diffuse surfaces that it met.
struct RadianceRecord {
  Vec3 position;
  Vec3 normal;  // of the side the path came from
  WorldIndex world = 0;
  // All that the path gathered there and after, over throughput and albedo: what a white surface
  // in this place sends back.
  Spectrum radiance;
};

// What the training paths found in the neighbourhood of a vertex.
struct CachedRadiance {
  Spectrum mean;           // of what a white surface sends back; not black
  float deviation = 0.0f;  // standard deviation of one path's, brightest channel
};

// A coarse guess of the light in the scene: cells of space by side and world. The roulette's
// control variate (integrator/roulette.h): a wrong guess costs noise, never a wrong mean, so the
// cells may be large and cut across walls.
class RadianceCache {
 public:
  // `picture_mean`: of the brightest channel over the training paths. The order of the records
  // counts for the last bits.
  RadianceCache(const std::vector<RadianceRecord>& records, float picture_mean);

  // Null where too few training paths have been. `normal` on the side of the path.
  const CachedRadiance* find(Vec3 position, Vec3 normal, WorldIndex world) const;
  float picture_mean() const { return picture_mean_; }

 private:
  using Key = uint64_t;  // 0: none
  struct Slot {
    Key key = 0;
    CachedRadiance value;
  };
  Key key_of(Vec3 position, Vec3 normal, WorldIndex world) const;
  size_t slot_of(Key key) const;

  Vec3 origin_;
  float cells_per_metre_ = 1.0f;
  float picture_mean_ = 0.0f;
  std::vector<Slot> slots_;  // open addressing; a power of two, never full
};

}  // namespace tenniel
