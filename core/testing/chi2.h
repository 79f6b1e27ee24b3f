// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "math/frame.h"
#include "math/numeric.h"
#include "math/vec.h"
#include "sampling/sampler.h"
#include "testing/quadrature.h"
#include "testing/statistics.h"

// Whether samples follow the density that is claimed for them: a chi-squared goodness-of-fit test
// with the density integrated over each bin, and the mass of rejected samples counted too.
namespace tenniel::testing {

// A domain maps its points to the unit square and back; `measure(x, y)` is its length, area or
// solid angle per area of the square there.

// Directions, by (cos theta, phi) around z.
struct SphereDomain {
  using Point = Vec3;
  static constexpr double k_total = 4.0 * 3.14159265358979323846;
  static double measure(double, double) { return k_total; }
  static Vec2 to_square(Vec3 w) {
    const float phi = std::atan2(w.y, w.x);
    return {0.5f * (w.z + 1.0f), (phi < 0.0f ? phi + k_two_pi : phi) / k_two_pi};
  }
  static Vec3 from_square(double x, double y) {
    const double z = 2.0 * x - 1.0, phi = 2.0 * 3.14159265358979323846 * y;
    const double r = 2.0 * std::sqrt(std::max(0.0, x * (1.0 - x)));
    return {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
            static_cast<float>(z)};
  }
};

// Directions with bins that shrink towards a peak (z of `frame`), for narrow lobes: x is the fourth
// root of (1 - cos theta) / 2, so that half of the bins lie within 41 degrees and a tenth within 1.
struct PeakDomain {
  using Point = Vec3;
  Frame frame;
  static double measure(double x, double) { return SphereDomain::k_total * 4.0 * x * x * x; }
  Vec2 to_square(Vec3 w) const {
    const Vec3 local = frame.to_local(w);
    // Near the peak 1 - cos has no digits left, the sine has.
    const float t = local.z > 0.0f ? (sqr(local.x) + sqr(local.y)) / (2.0f * (1.0f + local.z))
                                   : 0.5f * (1.0f - local.z);
    return {std::sqrt(std::sqrt(t)), SphereDomain::to_square(local).y};
  }
  Vec3 from_square(double x, double y) const {
    const double t = x * x * x * x, phi = 2.0 * 3.14159265358979323846 * y;
    const double r = 2.0 * std::sqrt(std::max(0.0, t * (1.0 - t)));
    return frame.to_world({static_cast<float>(r * std::cos(phi)),
                           static_cast<float>(r * std::sin(phi)),
                           static_cast<float>(1.0 - 2.0 * t)});
  }
};

// A rectangle of the plane; the unit square as it stands.
struct PlaneDomain {
  using Point = Vec2;
  Vec2 low{0.0f, 0.0f}, high{1.0f, 1.0f};
  double measure(double, double) const {
    return static_cast<double>(high.x - low.x) * static_cast<double>(high.y - low.y);
  }
  Vec2 to_square(Vec2 p) const {
    return {(p.x - low.x) / (high.x - low.x), (p.y - low.y) / (high.y - low.y)};
  }
  Vec2 from_square(double x, double y) const {
    return {static_cast<float>(low.x + (high.x - low.x) * x),
            static_cast<float>(low.y + (high.y - low.y) * y)};
  }
};

// A stretch of the real line; bins_y should be 1.
struct LineDomain {
  using Point = float;
  float low = 0.0f, high = 1.0f;
  double measure(double, double) const { return static_cast<double>(high - low); }
  Vec2 to_square(float x) const { return {(x - low) / (high - low), 0.5f}; }
  float from_square(double x, double) const { return static_cast<float>(low + (high - low) * x); }
};

struct Chi2Options {
  int bins_x = 51, bins_y = 102;  // odd in cos theta: the equator is no edge
  int samples = 200000;
  uint32_t seed = 1;
  int max_depth = 12;  // of splitting a bin to integrate the density
};

struct Chi2Result {
  double p_value = 1.0;
  double statistic = 0.0;
  int degrees_of_freedom = 0;
  double mass = 0.0;          // integral of the density
  double sampled_mass = 0.0;  // fraction of samples that were drawn and lie in the domain
  double mass_z = 0.0;        // deviation of the two in standard deviations
  double stray = 0.0;         // fraction of samples in bins without density

  // Empty if the samples follow the density, else a sentence. `significance` after `sidak`.
  std::string failure(double significance) const {
    if (!(mass <= 1.001)) return "the density integrates to " + std::to_string(mass);
    if (!(std::abs(mass_z) <= 4.0))
      return "density holds mass " + std::to_string(mass) + ", samples " +
             std::to_string(sampled_mass);
    if (!(stray <= 1e-5)) return std::to_string(stray) + " of the samples have no density";
    if (!(p_value >= significance))
      return "chi2 " + std::to_string(statistic) + " with " + std::to_string(degrees_of_freedom) +
             " degrees of freedom, p = " + std::to_string(p_value);
    return {};
  }
};

namespace detail {

// Integral over a rectangle that is split at least until no part holds many samples: they show
// where a narrow peak is that the quadrature alone would step over. It is as accurate as the count
// needs.
template <class Function>
double integrate_guided(const Function& f, const Rectangle& r, std::span<Vec2> samples,
                        const Chi2Options& options, int depth) {
  const auto count = static_cast<double>(samples.size());
  if (count <= std::max(16.0, options.samples * 1e-3) || depth >= options.max_depth) {
    const double tolerance = (0.02 * std::sqrt(count) + 0.002) / options.samples;
    const double mass = integrate_adaptive(f, r, tolerance, options.max_depth - depth);
    if (mass > 0.0 || samples.empty() || depth >= options.max_depth) return mass;
  }
  const double x = 0.5 * (r.x0 + r.x1), y = 0.5 * (r.y0 + r.y1);
  const auto left = [x](Vec2 s) { return s.x < x; };
  const auto below = [y](Vec2 s) { return s.y < y; };
  const auto middle = std::partition(samples.begin(), samples.end(), below);
  const auto low = std::partition(samples.begin(), middle, left);
  const auto high = std::partition(middle, samples.end(), left);
  const std::array<std::span<Vec2>, 4> parts{std::span(samples.begin(), low),
                                             std::span(low, middle), std::span(middle, high),
                                             std::span(high, samples.end())};
  const auto quarters = r.quarters();
  double sum = 0.0;
  for (size_t i = 0; i < 4; ++i)
    sum += integrate_guided(f, quarters[i], parts[i], options, depth + 1);
  return sum;
}

struct Cell {
  double expected, observed;
};

// Sums (observed - expected)^2 / expected, cells that expect fewer than 5 pooled together.
inline void accumulate_statistic(std::vector<Cell> cells, Chi2Result& result) {
  std::sort(cells.begin(), cells.end(),
            [](const Cell& a, const Cell& b) { return a.expected < b.expected; });
  Cell pool{0.0, 0.0};
  int used = 0;
  const auto add = [&](const Cell& c) {
    result.statistic += (c.observed - c.expected) * (c.observed - c.expected) / c.expected;
    ++used;
  };
  for (const Cell& cell : cells) {
    if (cell.expected >= 5.0 && (pool.expected == 0.0 || pool.expected >= 5.0)) {
      if (pool.expected > 0.0) add(pool);
      pool = {0.0, 0.0};
      add(cell);
    } else {
      pool.expected += cell.expected;
      pool.observed += cell.observed;
    }
  }
  if (pool.expected > 0.0) add(pool);
  result.degrees_of_freedom = used - 1;
  if (used > 1) result.p_value = chi2_p(result.statistic, used - 1);
}

}  // namespace detail

// `sample`: Vec2 in [0,1)^2 (or (float u, Vec2) for one number more) -> optional<Point>, empty
// where none can be drawn. `pdf`: Point -> density over the domain, which may integrate to less
// than 1.
template <class Domain, class Sample, class Pdf>
Chi2Result chi2_test(const Domain& domain, const Sample& sample, const Pdf& pdf,
                     const Chi2Options& options = {}) {
  using Point = typename Domain::Point;
  const auto bins_x = static_cast<size_t>(options.bins_x);
  const auto bins_y = static_cast<size_t>(options.bins_y);
  std::vector<std::vector<Vec2>> binned(bins_x * bins_y);
  LocalRandom random(options.seed);
  int drawn = 0;
  for (int i = 0; i < options.samples; ++i) {
    std::optional<Point> point;
    if constexpr (std::is_invocable_v<Sample, float, Vec2>) {
      const float u = random.get_1d();
      point = sample(u, random.get_2d());
    } else {
      point = sample(random.get_2d());
    }
    if (!point) continue;
    const Vec2 p = domain.to_square(*point);
    if (!(p.x >= 0.0f && p.x <= 1.0f && p.y >= 0.0f && p.y <= 1.0f)) continue;
    const auto column = static_cast<size_t>(p.x * static_cast<float>(bins_x));
    const auto row = static_cast<size_t>(p.y * static_cast<float>(bins_y));
    binned[std::min(row, bins_y - 1) * bins_x + std::min(column, bins_x - 1)].push_back(p);
    ++drawn;
  }

  const auto density = [&](double x, double y) {
    return static_cast<double>(pdf(domain.from_square(x, y))) * domain.measure(x, y);
  };
  const auto n = static_cast<double>(options.samples);
  Chi2Result result;
  std::vector<detail::Cell> cells;
  for (size_t row = 0; row < bins_y; ++row) {
    for (size_t column = 0; column < bins_x; ++column) {
      const Rectangle r{static_cast<double>(column) / options.bins_x,
                        static_cast<double>(column + 1) / options.bins_x,
                        static_cast<double>(row) / options.bins_y,
                        static_cast<double>(row + 1) / options.bins_y};
      std::vector<Vec2>& bin = binned[row * bins_x + column];
      const double mass = detail::integrate_guided(density, r, bin, options, 0);
      const auto observed = static_cast<double>(bin.size());
      if (!(mass > 0.0)) result.stray += observed / n;
      result.mass += mass;
      cells.push_back({mass * n, observed});
    }
  }
  result.sampled_mass = drawn / n;
  const double rejected = std::clamp(1.0 - result.mass, 0.0, 1.0);
  // The last term is what the quadrature may be off by.
  result.mass_z =
      (result.sampled_mass - result.mass) / (std::sqrt(result.mass * rejected / n) + 1e-4);
  cells.push_back({rejected * n, n - drawn});
  detail::accumulate_statistic(std::move(cells), result);
  return result;
}

}  // namespace tenniel::testing
