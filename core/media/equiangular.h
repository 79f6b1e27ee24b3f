// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "math/numeric.h"
#include "math/ray.h"

namespace tenniel {

// Distances along [0, length) of a ray with a density in proportion to the inverse squared distance
// to `center` (Kulla & Fajardo 2012): what a small lamp there asks for.
class Equiangular {
 public:
  Equiangular(const Ray& ray, float length, Vec3 center) : length_(length) {
    const Vec3 to_center = center - ray.origin;
    nearest_ = dot(to_center, ray.direction);
    // A ray through the very center would never leave it.
    const float least = 1e-4f * tenniel::length(to_center) + 1e-12f;
    height_ = std::max(tenniel::length(to_center - ray.direction * nearest_), least);
    begin_ = std::atan2(-nearest_, height_);
    // As the angle of one sum: the difference of two angles has no digits left far away.
    angle_ = length < k_infinity
                 ? std::atan2(length * height_, sqr(height_) - nearest_ * (length - nearest_))
                 : 0.5f * k_pi - begin_;
  }

  float sample(float u) const {
    const float t = nearest_ + height_ * std::tan(begin_ + u * angle_);
    return std::clamp(t, 0.0f, std::min(length_, k_farthest));
  }
  float pdf(float t) const { return height_ / (angle_ * (sqr(height_) + sqr(t - nearest_))); }
  bool is_usable() const { return angle_ > 0.0f && std::isfinite(angle_); }

 private:
  static constexpr float k_farthest = 1e15f;
  float length_;
  float nearest_;  // distance along the ray to its point nearest to the center
  float height_;   // of the center above the ray
  float begin_;    // angle at the center from that point to the ray's origin
  float angle_;    // at the center between the ends of the ray
};

}  // namespace tenniel
