// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/interaction.h"
#include "media/medium.h"
#include "scene/scene.h"

namespace tenniel {

// The media that the path is in, that of the World not counted: one entry for each material slot of
// each object whose boundary it has crossed. What fills it is asked of the material in the path's
// own world. Overlapping media add up.
class MediumStack {
 public:
  struct Entry {
    uint32_t instance = 0;
    int32_t slot = 0;
    friend bool operator==(Entry, Entry) = default;
  };
  static constexpr size_t k_max_media = 12;  // what is more goes unnoticed

  void enter(Entry entry) {
    if (count_ < k_max_media && !contains(entry)) entries_[count_++] = entry;
  }
  void leave(Entry entry) {
    for (size_t i = 0; i < count_; ++i)
      if (entries_[i] == entry) entries_[i--] = entries_[--count_];
  }
  bool contains(Entry entry) const {
    for (const Entry& e : *this)
      if (e == entry) return true;
    return false;
  }
  bool empty() const { return count_ == 0; }
  const Entry* begin() const { return entries_.data(); }
  const Entry* end() const { return entries_.data() + count_; }

 private:
  std::array<Entry, k_max_media> entries_;
  size_t count_ = 0;
};

// The media of `world` that contain `point`: `known` ones stay where their object exists, others
// are found by a ray to their boundary.
MediumStack media_around(const Scene& scene, Vec3 point, WorldIndex world,
                         const MediumStack& known = {});

// A path goes through the boundary at `at` and starts anew at `origin`: in by the front, out by the
// back of the true surface. Boundaries that coincide with it are crossed along with it, or the path
// would never leave their media.
void cross_boundary(const Scene& scene, const SurfaceInteraction& at, Vec3 origin, WorldIndex world,
                    MediumStack& media);

// Metres of medium between the surface at `at` and `origin`, where a ray toward `direction` starts
// so as not to meet that surface again.
inline float skipped_length(const SurfaceInteraction& at, Vec3 origin, Vec3 direction) {
  const float cosine = std::max(std::abs(dot(at.geometric_normal, direction)), 0.1f);
  return distance(at.position, origin) / cosine;
}

// Adds what light that travels in `direction` meets at `point`.
void add_media_at(const Scene& scene, const MediumStack& media, Vec3 point, Vec3 direction,
                  const PathInfo& path, ShadingContext& scratch, MediumProperties& sum);
// Its extinction alone, per metre.
Spectrum extinction_at(const Scene& scene, const MediumStack& media, Vec3 point, Vec3 direction,
                       const PathInfo& path, ShadingContext& scratch);

// Metres over which the media may be taken as homogeneous; infinite where all of them are.
float medium_step(const Scene& scene, const MediumStack& media, WorldIndex world);

}  // namespace tenniel
