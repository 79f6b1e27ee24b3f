// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "integrator/subsurface.h"
#include "math/frame.h"
#include "media/dwivedi.h"
#include "media/free_flight.h"
#include "media/phase_function.h"
#include "media/subsurface_medium.h"
#include "sampling/warp.h"

namespace tenniel {

namespace {

// Blender's limit: a ball ten mean free paths thick, or dull colors, lose nothing by it, but a
// white half-space 8 % of its light.
constexpr int k_max_flights = 256;
// The first flights decide most and have stratified numbers, with dimensions apart from those of
// surfaces and media. Measured on a ball: 0.6 of the variance that plain ones give.
constexpr uint32_t k_first_dimension = 1u << 17;
constexpr int k_stratified_flights = 12;
// From the flight after this many on the medium is isotropic.
constexpr int k_anisotropic_flights = 10;
// Guided flights where scattering is isotropic so: after that change, and before.
constexpr float k_late_guided_share = 0.75f, k_most_guided_share = 0.5f;
constexpr float k_negligible_throughput = 1e-6f;
// The rounding of the entry counts along the first flight, but no farther at a grazing one.
constexpr float k_least_cosine = 0.1f;
// Mean free paths within which the far side of a thin object is looked for.
constexpr float k_far_side_reach = 10.0f;

// Exponents of color: 0 / 0 is a channel that carries nothing.
Spectrum divided(Spectrum a, Spectrum b) {
  return {safe_divide(a.r, b.r), safe_divide(a.g, b.g), safe_divide(a.b, b.b)};
}

float total(Spectrum s) {
  return s.r + s.g + s.b;
}

// Density of flying `t` metres, or at least so far where a surface ends the flight.
Spectrum flight_density(Spectrum sigma_t, float t, bool is_ended) {
  const Spectrum through = beer_lambert(sigma_t, t);
  return is_ended ? through : sigma_t * through;
}

// One of the three channels in proportion to the light it carries that will scatter.
struct ChannelChoice {
  Spectrum probability{1.0f / 3.0f};

  explicit ChannelChoice(Spectrum carried) {
    const float sum = total(carried);
    if (sum > 0.0f) probability = carried * (1.0f / sum);
  }
  float pick(Spectrum of, float u) const {
    if (u < probability.r) return of.r;
    return u < probability.r + probability.g || !(probability.b > 0.0f) ? of.g : of.b;
  }
};

// A path below the surface of one object until it meets that surface again. Flights are drawn in
// nine ways, each with its density in the weight (balance heuristic): for the three channels, by
// the phase function or guided towards the surface or towards the far side of a thin object.
class Walk {
 public:
  Walk(const ObjectBelow& object, const Subsurface& lobe, const SubsurfaceEntry& entry)
      : object_(object),
        entry_(entry),
        medium_(lobe.color, lobe.radius, lobe.anisotropy),
        guide_(max_component(medium_.single_albedo)),
        throughput_(divided(entry.throughput, lobe.color) * medium_.scale),
        random_(hash_uint(float_bits(entry.u.x), float_bits(entry.u.y), float_bits(entry.choice))) {
    guided_share_ = std::min(k_most_guided_share, 1.0f - std::pow(lobe.anisotropy, 0.125f));
  }

  std::optional<SubsurfaceExit> run();

 private:
  // How the direction of a flight was found; factors are of the density that the phase function
  // gives to it.
  struct Guidance {
    float forward = 0.0f, backward = 0.0f;  // factors
    float forward_stretch = 1.0f, backward_stretch = 1.0f;
    float backward_share = 0.0f;
    float used_stretch = 1.0f;
  };

  bool start();
  void take_numbers(int flight);
  std::optional<Hit> first_flight(float t);
  Guidance turn();
  Spectrum density(const Guidance& guidance, float t, bool is_ended) const;
  float share_to_far_side() const;

  const ObjectBelow& object_;
  const SubsurfaceEntry& entry_;
  SubsurfaceMedium medium_;
  Dwivedi guide_;
  Spectrum throughput_;
  LocalRandom random_;
  VertexNumbers u_{};  // of this flight
  Ray ray_;
  float guided_share_;
  float far_side_ = 0.0f;  // metres below the entry; 0: none nearby
};

// Into the object by the cosine around the lobe's normal.
bool Walk::start() {
  const Vec3 direction =
      Frame::from_normal(-entry_.normal).to_world(warp_cosine_hemisphere(entry_.u));
  const float cosine = -dot(direction, entry_.at.geometric_normal);
  if (!(cosine > 0.0f)) return false;
  // From the surface itself, which is not met again: an offset would be a part of the flight, and
  // mean free paths may be as short.
  ray_.origin = entry_.at.position;
  ray_.t_min = distance(offset_ray_origin(entry_.at, direction), ray_.origin) /
               std::max(cosine, k_least_cosine);
  ray_.direction = direction;
  ray_.time = entry_.at.time;
  return max_component(throughput_) > 0.0f;
}

void Walk::take_numbers(int flight) {
  constexpr uint32_t k_requests = VertexNumbers::k_requests;
  if (flight < k_stratified_flights) {
    const uint32_t index = entry_.vertex * k_stratified_flights + static_cast<uint32_t>(flight);
    u_ = entry_.sampler.vertex_numbers(k_first_dimension + index * k_requests);
    return;
  }
  u_.light = random_.get_1d();
  u_.on_light.x = random_.get_1d();
  u_.flight = random_.get_1d();
  u_.wi = random_.get_2d();
  u_.roulette = random_.get_1d();
}

// Looks farther than it flies, for the far side.
std::optional<Hit> Walk::first_flight(float t) {
  const Spectrum& sigma = medium_.sigma_t;
  const float thinnest = std::min({sigma.r, sigma.g, sigma.b});
  ray_.t_max = std::max(t, k_far_side_reach / thinnest);
  const auto hit = object_.intersect(ray_);
  if (!hit) return {};
  far_side_ = std::max(dot(ray_.at(hit->t) - entry_.at.position, -entry_.normal), 0.0f);
  return hit->t < t ? hit : std::nullopt;
}

// The nearer the walk is to the far side, the more it is led there.
float Walk::share_to_far_side() const {
  if (!(far_side_ > 0.0f)) return 0.0f;
  const float depth =
      std::clamp(dot(ray_.origin - entry_.at.position, -entry_.normal), 0.0f, far_side_);
  const Spectrum& sigma = medium_.sigma_t;
  const float thinnest = std::min({sigma.r, sigma.g, sigma.b});
  return 1.0f / (1.0f + std::exp((far_side_ - 2.0f * depth) * thinnest / guide_.length()));
}

Walk::Guidance Walk::turn() {
  Guidance g;
  g.backward_share = share_to_far_side();
  const bool is_guided = u_.roulette < guided_share_;
  const bool is_backward = u_.on_light.x < g.backward_share;
  const Vec2 u = u_.wi;
  const Vec3 before = ray_.direction;
  float cosine;  // with the normal
  if (is_guided) {
    cosine = guide_.sample(u.x) * (is_backward ? -1.0f : 1.0f);
    const float sine = safe_sqrt(1.0f - sqr(cosine)), phi = k_two_pi * u.y;
    ray_.direction = Frame::from_normal(entry_.normal)
                         .to_world({sine * std::cos(phi), sine * std::sin(phi), cosine});
  } else {
    ray_.direction = sample_henyey_greenstein(before, medium_.anisotropy, u);
    cosine = std::clamp(dot(ray_.direction, entry_.normal), -1.0f, 1.0f);
  }
  const float phase = henyey_greenstein(before, ray_.direction, medium_.anisotropy);
  g.forward = guide_.pdf(cosine) / phase;
  g.backward = guide_.pdf(-cosine) / phase;
  g.forward_stretch = guide_.stretching(cosine);
  g.backward_stretch = guide_.stretching(-cosine);
  if (is_guided) g.used_stretch = is_backward ? g.backward_stretch : g.forward_stretch;
  return g;
}

// Of the flight in each channel, relative to that of the direction by the phase function.
Spectrum Walk::density(const Guidance& g, float t, bool is_ended) const {
  const Spectrum sigma = medium_.sigma_t;
  Spectrum guided = flight_density(sigma * g.forward_stretch, t, is_ended) * g.forward;
  if (g.backward_share > 0.0f)
    guided = lerp(guided, flight_density(sigma * g.backward_stretch, t, is_ended) * g.backward,
                  g.backward_share);
  return lerp(flight_density(sigma, t, is_ended), guided, guided_share_);
}

std::optional<SubsurfaceExit> Walk::run() {
  if (!start()) return {};
  for (int flight = 0; flight < k_max_flights; ++flight) {
    if (flight == k_anisotropic_flights) {
      medium_ = medium_.similar();
      guided_share_ = k_late_guided_share;
    }
    const ChannelChoice channel(throughput_ * medium_.single_albedo);
    take_numbers(flight);
    const float sigma = channel.pick(medium_.sigma_t, u_.light);
    const bool is_first = flight == 0;
    const Guidance guidance = is_first ? Guidance{} : turn();
    float t = -std::log1p(-u_.flight) / (sigma * guidance.used_stretch);
    std::optional<Hit> hit;
    if (is_first) {
      hit = first_flight(t);
    } else {
      ray_.t_max = t;
      hit = object_.intersect(ray_);
    }
    if (hit) t = hit->t;
    if (!(t < k_farthest_below)) return {};

    const Spectrum pdf = is_first ? flight_density(medium_.sigma_t, t, hit.has_value())
                                  : density(guidance, t, hit.has_value());
    const Spectrum through = beer_lambert(medium_.sigma_t, t);
    const float chosen = total(channel.probability * pdf);
    if (!(chosen > 0.0f)) return {};
    throughput_ *= (hit ? through : medium_.sigma_s() * through) * (1.0f / chosen);
    if (hit) {
      // As if it came from outside, twice as far as it flew.
      const Ray from_outside{ray_.at(2.0f * t), -ray_.direction, 0.0f, k_infinity, ray_.time};
      return SubsurfaceExit{from_outside, *hit, throughput_};
    }
    if (!(max_component(throughput_) > k_negligible_throughput)) return {};
    ray_.origin = ray_.at(t);
    ray_.t_min = 0.0f;
  }
  return {};
}

}  // namespace

std::optional<SubsurfaceExit> walk_below(const ObjectBelow& object, const Subsurface& lobe,
                                         const SubsurfaceEntry& entry) {
  return Walk(object, lobe, entry).run();
}

}  // namespace tenniel
