// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/visibility.h"
#include "math/spectrum.h"
#include "math/vec.h"

namespace tenniel {

// What one training path found after one of its diffuse bounces.
struct RadianceRecord {
  Vec3 position;
  Vec3 normal;  // of the side the path came from
  WorldIndex world = 0;
  // All that the path gathered after its bounce over its throughput there, and the density of a
  // cosine over that of the direction.
  Spectrum radiance;
  float weight = 1.0f;
  bool has_left_scene = false;  // met the World, and nothing else
};

// A coarse guess of the light in the scene: cells of space by side and world. The roulette's
// control variate (PathTracer::survives_bounce): a wrong guess costs noise, never a wrong mean, so
// the cells may be large and cut across walls.
class RadianceCache {
 public:
  struct Guess {
    Spectrum from_surfaces;   // what a diffuse bounce brings if it meets one, without the albedo
    bool sees_world = false;  // the World is a share of the light that counts
  };

  // The order of the records counts for the last bits.
  explicit RadianceCache(const std::vector<RadianceRecord>& records);

  // Null where too few training paths have been. `normal` on the side of the path.
  const Guess* find(Vec3 position, Vec3 normal, WorldIndex world) const;

 private:
  using Key = uint64_t;  // 0: none
  struct Slot {
    Key key = 0;
    Guess guess;
  };
  Key key_of(Vec3 position, Vec3 normal, WorldIndex world) const;
  size_t slot_of(Key key) const;

  Vec3 origin_;
  float cells_per_metre_ = 1.0f;
  std::vector<Slot> slots_;  // open addressing; a power of two, never full
};

}  // namespace tenniel
