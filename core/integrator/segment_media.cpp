// SPDX-License-Identifier: Apache-2.0
#include "integrator/segment_media.h"

#include <algorithm>

#include "integrator/empty_space.h"
#include "math/hash.h"

namespace tenniel {

namespace {

// What is this dark holds nothing more to see; Cycles' own limit.
constexpr float k_least_transmittance = 1e-6f;

// Of the light of a path, and of a lamp's: where less is left of it chance says whether the search
// goes on. Measured in a dense cloud: what costs no noise.
constexpr float k_worthwhile_path = 0.1f, k_worthwhile_light = 0.3f;

bool is_worth_a_cut(float scattered, Spectrum passed) {
  const float rest = passed.r + passed.g + passed.b;
  return scattered > 0.0f && rest < k_worthwhile_path * (scattered + rest);
}

// A stretch that is taken as homogeneous, and where in it its media are asked for.
struct Stretch {
  float start = 0.0f, end = 0.0f, point = 0.0f;
  bool is_empty = false;
};

// Cuts a segment that `ray` joins `skipped` metres after its start into stretches, the near ones
// first.
class Cutter {
 public:
  Cutter(const Scene& scene, const MediumStack& media, const Ray& ray, float skipped, float length,
         WorldIndex world)
      : ray_(ray),
        skipped_(skipped),
        end_(length),
        step_(medium_step(scene, media, world)),
        empty_space_(scene, media, ray, skipped, world) {
    if (!(step_ < k_infinity)) return;
    constexpr auto k_most = static_cast<float>(k_max_medium_steps);
    if (length < k_infinity) step_ = length / std::clamp(std::ceil(length / step_), 1.0f, k_most);
    // A number that each segment has of its own, and every run the same.
    const Vec3 p = ray.origin, d = ray.direction;
    seed_ = hash_uint(float_bits(p.x), float_bits(p.y), float_bits(p.z)) ^
            hash_uint(float_bits(d.x), float_bits(d.y), float_bits(d.z), float_bits(skipped));
  }

  bool is_done() const { return !(at_ < end_); }
  // The point of a stretch, in world space.
  Vec3 point_of(const Stretch& stretch) const {
    return ray_.at(std::max(stretch.point - skipped_, 0.0f));
  }
  Stretch next() {
    Stretch stretch;
    stretch.start = at_;
    const float empty_until = empty_space_.until(at_);
    stretch.is_empty = empty_until > at_;
    stretch.end = stretch.is_empty ? std::min(empty_until, end_) : end_of_step();
    // Each has a point of its own, so that their errors cancel.
    const float extent = stretch.end - stretch.start;
    stretch.point = stretch.start + (extent < k_infinity ? chance() * extent : 0.0f);
    at_ = stretch.end;
    ++count_;
    return stretch;
  }
  // A number of this segment, in [0, 1), another at each call.
  float chance() { return uint_to_unit(mix_bits(seed_ + 0x9e3779b9u * chances_++)); }

 private:
  // An infinite segment has its last steps in one.
  float end_of_step() const {
    const bool is_last = !(end_ < k_infinity) && count_ + 1 >= k_max_medium_steps;
    const float end = at_ + step_;
    return is_last || !(end < end_ - 0.01f * step_) ? end_ : end;
  }

  const Ray& ray_;
  const float skipped_;
  const float end_;
  float step_;  // metres
  float at_ = 0.0f;
  uint32_t seed_ = 0, chances_ = 0;
  size_t count_ = 0;
  const EmptySpace empty_space_;
};

}  // namespace

SegmentMedia::SegmentMedia(std::vector<MediumStep>& steps, const Scene& scene,
                           const MediumStack& media, const Ray& ray, float skipped, float length,
                           Spectrum throughput, bool scatters, const PathInfo& path,
                           ShadingContext& scratch)
    : steps_(steps) {
  Cutter cutter(scene, media, ray, skipped, length, path.world);
  steps.clear();
  float scattered = 0.0f;
  bool is_dark = false;
  do {
    const Stretch stretch = cutter.next();
    // Made in its place, which a copy would wait for.
    MediumStep& step = steps.emplace_back();
    if (!stretch.is_empty)
      add_media_at(scene, media, cutter.point_of(stretch), ray.direction, path, scratch,
                   step.medium);
    step.flight = FreeFlight(step.medium.sigma_t(), scatters ? step.medium.sigma_s : Spectrum(),
                             throughput * transmittance_, stretch.end - stretch.start);
    scattered += step.flight.scattered();
    step.before = transmittance_;
    step.start = stretch.start;
    step.until = scattered;
    transmittance_ *= step.flight.transmittance();
    length_ = stretch.end;
    is_dark = !(max_component(transmittance_) > k_least_transmittance);
  } while (!is_dark && !cutter.is_done() && steps.size() < k_max_medium_steps &&
           !is_worth_a_cut(scattered, throughput * transmittance_));
  is_cut_ = !is_dark && !cutter.is_done();
  const Spectrum passed = throughput * transmittance_;
  if (scattered > 0.0f)
    scatter_probability_ = scattered / (scattered + passed.r + passed.g + passed.b);
}

bool SegmentMedia::is_vacuum() const {
  return std::all_of(steps_.begin(), steps_.end(),
                     [](const MediumStep& step) { return step.medium.is_vacuum(); });
}

Spectrum SegmentMedia::emission() const {
  Spectrum sum;
  for (size_t i = 0; i < steps_.size(); ++i) {
    const MediumStep& step = steps_[i];
    if (is_black(step.medium.emission)) continue;
    const float end = i + 1 < steps_.size() ? steps_[i + 1].start : length_;
    sum += step.before * step.medium.emission *
           emission_length(step.medium.sigma_t(), end - step.start);
  }
  return sum;
}

float SegmentMedia::sample(float u) const {
  const float target = u * steps_.back().until;
  const auto step = std::upper_bound(
      steps_.begin(), steps_.end() - 1, target,
      [](float value, const MediumStep& candidate) { return value < candidate.until; });
  // Rounding may lead behind the last step that scatters.
  auto chosen = step;
  while (chosen != steps_.begin() && !(chosen->flight.scattered() > 0.0f))
    --chosen;
  const float own = chosen->flight.scattered();
  const float within = (target - (chosen->until - own)) / own;
  return chosen->start + chosen->flight.sample(std::clamp(within, 0.0f, k_one_minus_epsilon));
}

float SegmentMedia::pdf(float t) const {
  const MediumStep& step = step_at(t);
  const float own = step.flight.scattered();
  return own > 0.0f ? step.flight.pdf(t - step.start) * (own / steps_.back().until) : 0.0f;
}

Spectrum SegmentMedia::transmittance_to(float t) const {
  const MediumStep& step = step_at(t);
  return step.before * beer_lambert(step.medium.sigma_t(), t - step.start);
}

float SegmentMedia::mean_free_path() const {
  for (const MediumStep& step : steps_) {
    const float sigma = mean(step.medium.sigma_t());
    if (sigma > 0.0f) return step.start + 1.0f / sigma;
  }
  return length_;
}

const MediumStep& SegmentMedia::step_at(float t) const {
  const auto after = std::upper_bound(
      steps_.begin() + 1, steps_.end(), t,
      [](float value, const MediumStep& candidate) { return value < candidate.start; });
  return *(after - 1);
}

Spectrum segment_transmittance(const Scene& scene, const MediumStack& media, const Ray& ray,
                               float skipped, float length, const PathInfo& path,
                               ShadingContext& scratch) {
  if (media.empty() && !scene.worlds[path.world].material.has_volume) return Spectrum(1.0f);
  Cutter cutter(scene, media, ray, skipped, length, path.world);
  Spectrum through(1.0f);
  while (!cutter.is_done()) {
    const Stretch stretch = cutter.next();
    if (stretch.is_empty) continue;
    const Spectrum sigma_t =
        extinction_at(scene, media, cutter.point_of(stretch), ray.direction, path, scratch);
    through *= beer_lambert(sigma_t, stretch.end - stretch.start);
    const float rest = max_component(through);
    if (rest >= k_worthwhile_light || cutter.is_done()) continue;
    const float survival = rest * (1.0f / k_worthwhile_light);
    if (!(cutter.chance() < survival)) return {};
    through *= 1.0f / survival;
  }
  return through;
}

}  // namespace tenniel
