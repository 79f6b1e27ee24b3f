// SPDX-License-Identifier: Apache-2.0
#include "integrator/segment_media.h"

#include <algorithm>

#include "math/hash.h"

namespace tenniel {

namespace {

// How a segment is cut, and where in each step its media are asked for.
struct Cut {
  size_t count = 1;
  float step = 0.0f;  // metres; the last one runs to the end
  float end = 0.0f;
  uint32_t seed = 0;

  float start_of(size_t i) const { return i > 0 ? static_cast<float>(i) * step : 0.0f; }
  float end_of(size_t i) const { return i + 1 < count ? start_of(i + 1) : end; }
  // Somewhere in step `i`: each has a point of its own, so that their errors cancel.
  float point_in(size_t i) const {
    if (!(step < k_infinity)) return 0.0f;
    const float u = uint_to_unit(mix_bits(seed + static_cast<uint32_t>(i) * 0x9e3779b9u));
    return start_of(i) + u * step;
  }
};

Cut cut_segment(const Scene& scene, const MediumStack& media, const Ray& ray, float length,
                WorldIndex world) {
  Cut cut;
  cut.end = length;
  cut.step = medium_step(scene, media, world);
  if (!(cut.step < k_infinity)) return cut;
  const float count = std::ceil(length / cut.step);
  cut.count = count < static_cast<float>(k_max_medium_steps)
                  ? std::max<size_t>(1, static_cast<size_t>(count))
                  : k_max_medium_steps;
  if (length < k_infinity) cut.step = length / static_cast<float>(cut.count);
  // A number that each segment has of its own, and every run the same.
  const Vec3 p = ray.origin, d = ray.direction;
  cut.seed = hash_uint(float_bits(p.x), float_bits(p.y), float_bits(p.z)) ^
             hash_uint(float_bits(d.x), float_bits(d.y), float_bits(d.z));
  return cut;
}

// What the media are in step `i` of a segment that `ray` joins `skipped` metres after its start.
MediumProperties media_of_step(const Scene& scene, const MediumStack& media, const Ray& ray,
                               float skipped, const Cut& cut, size_t i, const PathInfo& path,
                               ShadingContext& scratch) {
  const Vec3 point = ray.at(std::max(cut.point_in(i) - skipped, 0.0f));
  return media_at(scene, media, point, ray.direction, path, scratch);
}

}  // namespace

SegmentMedia::SegmentMedia(std::vector<MediumStep>& steps, const Scene& scene,
                           const MediumStack& media, const Ray& ray, float skipped, float length,
                           Spectrum throughput, bool scatters, const PathInfo& path,
                           ShadingContext& scratch)
    : steps_(steps), length_(length) {
  const Cut cut = cut_segment(scene, media, ray, length, path.world);
  step_length_ = cut.step;
  steps.clear();
  float scattered = 0.0f;
  for (size_t i = 0; i < cut.count; ++i) {
    const float start = cut.start_of(i);
    const MediumProperties medium =
        media_of_step(scene, media, ray, skipped, cut, i, path, scratch);
    const Spectrum arriving = throughput * transmittance_;
    const FreeFlight flight(medium.sigma_t(), scatters ? medium.sigma_s : Spectrum(), arriving,
                            cut.end_of(i) - start);
    scattered += flight.scattered();
    steps.push_back({medium, flight, transmittance_, start, scattered});
    transmittance_ *= flight.transmittance();
    // What is this dark holds nothing more to see.
    if (!(max_component(transmittance_) > 1e-12f)) break;
  }
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
  if (steps_.size() == 1) return steps_.front();
  size_t i = std::min(static_cast<size_t>(std::max(t / step_length_, 0.0f)), steps_.size() - 1);
  if (i > 0 && t < steps_[i].start) --i;
  return steps_[i];
}

Spectrum segment_transmittance(const Scene& scene, const MediumStack& media, const Ray& ray,
                               float skipped, float length, const PathInfo& path,
                               ShadingContext& scratch) {
  if (media.empty() && !scene.worlds[path.world].material.has_volume) return Spectrum(1.0f);
  const Cut cut = cut_segment(scene, media, ray, length, path.world);
  Spectrum through(1.0f);
  for (size_t i = 0; i < cut.count && max_component(through) > 0.0f; ++i) {
    const MediumProperties medium =
        media_of_step(scene, media, ray, skipped, cut, i, path, scratch);
    through *= beer_lambert(medium.sigma_t(), cut.end_of(i) - cut.start_of(i));
  }
  return through;
}

}  // namespace tenniel
