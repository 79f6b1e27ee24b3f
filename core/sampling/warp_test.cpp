// SPDX-License-Identifier: Apache-2.0
#include "sampling/warp.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "math/frame.h"
#include "sampling/mis.h"
#include "sampling/sampler.h"

namespace tenniel {
namespace {

constexpr int k_samples = 200000;

// Chi-squared of `counts` against equal shares, in standard deviations of the statistic.
double chi2_excess(const std::vector<int>& counts) {
  double total = 0.0, chi2 = 0.0;
  for (const int c : counts)
    total += c;
  const double expected = total / static_cast<double>(counts.size());
  for (const int c : counts)
    chi2 += (c - expected) * (c - expected) / expected;
  const double freedom = static_cast<double>(counts.size()) - 1.0;
  return (chi2 - freedom) / std::sqrt(2.0 * freedom);
}

// Histogram of `cell(sample)` over independent uniform points; every cell has the same chance.
double equal_cells(size_t cell_count, const std::function<size_t(Vec2)>& cell) {
  LocalRandom random(1);
  std::vector<int> counts(cell_count);
  for (int i = 0; i < k_samples; ++i) {
    const size_t c = cell(random.get_2d());
    EXPECT_LT(c, cell_count);
    ++counts[std::min(c, cell_count - 1)];
  }
  return chi2_excess(counts);
}

size_t cell_of(float x, float y, size_t n) {
  const auto index = [n](float v) {
    return static_cast<size_t>(std::clamp(v, 0.0f, k_one_minus_epsilon) * static_cast<float>(n));
  };
  return index(y) * n + index(x);
}

float turn(float y, float x) {
  const float phi = std::atan2(y, x) / k_two_pi;
  return phi < 0.0f ? phi + 1.0f : phi;
}

constexpr double k_limit = 4.5;  // standard deviations

TEST(WarpStatistics, ConcentricDiskIsUniform) {
  EXPECT_LT(equal_cells(256,
                        [](Vec2 u) {
                          const Vec2 p = warp_concentric_disk(u);
                          return cell_of(dot(p, p), turn(p.y, p.x), 16);
                        }),
            k_limit);
}

TEST(WarpStatistics, CosineHemisphereFollowsItsPdf) {
  // pdf = cos / pi makes sin^2 and phi uniform.
  EXPECT_LT(equal_cells(256,
                        [](Vec2 u) {
                          const Vec3 w = warp_cosine_hemisphere(u);
                          return cell_of(w.x * w.x + w.y * w.y, turn(w.y, w.x), 16);
                        }),
            k_limit);
}

TEST(WarpStatistics, CapsAreUniform) {
  for (const float height : {2.0f, 1.0f, 0.3f, 1e-5f}) {
    EXPECT_LT(equal_cells(256,
                          [height](Vec2 u) {
                            const Vec3 w = warp_uniform_cone(u, height);
                            EXPECT_NEAR(length(w), 1.0f, 1e-6f);
                            // 1 - cos from the sine where the cone is narrow: z alone has no digits
                            // left.
                            const float sin2 = w.x * w.x + w.y * w.y;
                            const float risen = height > 0.1f ? 1.0f - w.z : sin2 / (1.0f + w.z);
                            return cell_of(risen / height, turn(w.y, w.x), 16);
                          }),
              k_limit)
        << height;
  }
}

TEST(WarpStatistics, TriangleIsUniform) {
  // The folding (b0, b1) -> uniform square: s = (1 - b2)^2, t = b1 / (b0 + b1).
  EXPECT_LT(equal_cells(256,
                        [](Vec2 u) {
                          const auto b = warp_triangle(u);
                          EXPECT_TRUE(b[0] >= 0.0f && b[1] >= 0.0f && b[2] >= 0.0f);
                          EXPECT_NEAR(b[0] + b[1] + b[2], 1.0f, 1e-6f);
                          const float rest = b[0] + b[1];
                          return cell_of(rest * rest, b[1] / std::max(rest, 1e-20f), 16);
                        }),
            k_limit);
}

// Cells of the square against the density at their middle, which is the mean of a bilinear
// function.
TEST(WarpStatistics, BilinearSquareFollowsItsPdf) {
  for (const std::array<float, 4>& corners :
       {std::array{1.0f, 1.0f, 1.0f, 1.0f}, std::array{0.0f, 1.0f, 2.0f, 5.0f},
        std::array{3.0f, 0.0f, 0.0f, 0.1f}}) {
    const BilinearSquare square(corners);
    LocalRandom random(7);
    constexpr size_t k_side = 8;
    std::array<int, k_side * k_side> counts{};
    for (int i = 0; i < k_samples; ++i) {
      const Vec2 at = square.sample(random.get_2d());
      ASSERT_TRUE(at.x >= 0.0f && at.x <= 1.0f && at.y >= 0.0f && at.y <= 1.0f);
      ++counts[cell_of(at.x, at.y, k_side)];
    }
    double chi2 = 0.0;
    for (size_t i = 0; i < counts.size(); ++i) {
      const size_t column = i % k_side, row = i / k_side;
      const Vec2 middle{(static_cast<float>(column) + 0.5f) / k_side,
                        (static_cast<float>(row) + 0.5f) / k_side};
      const double expected = square.pdf(middle) * k_samples / counts.size();
      chi2 += (counts[i] - expected) * (counts[i] - expected) / expected;
    }
    const double freedom = counts.size() - 1.0;
    EXPECT_LT((chi2 - freedom) / std::sqrt(2.0 * freedom), k_limit);
  }
}

TEST(WarpStatistics, PolygonIsUniform) {
  constexpr int k_sides = 5;
  constexpr float k_rotation = 0.4f;
  // Wedge and, within it, the triangle's own square.
  EXPECT_LT(equal_cells(k_sides * 64,
                        [](Vec2 u) {
                          const Vec2 p = warp_regular_polygon(u, k_sides, k_rotation);
                          const float step = k_two_pi / k_sides;
                          float angle = std::atan2(p.y, p.x) - k_rotation;
                          if (angle < 0.0f) angle += k_two_pi;
                          const int wedge = std::min(static_cast<int>(angle / step), k_sides - 1);
                          const float within = angle - static_cast<float>(wedge) * step;
                          const float rho = length(p);
                          const float b1 = rho * std::sin(within) / std::sin(step);
                          const float b0 = rho * std::sin(step - within) / std::sin(step);
                          return static_cast<size_t>(wedge) * 64 +
                                 cell_of((b0 + b1) * (b0 + b1), b1 / std::max(b0 + b1, 1e-20f), 8);
                        }),
            k_limit);
}

// Mean of 1/pdf-weighted solid angle over an equal-area grid of the rectangle: what the samples'
// density in a cell should be is its solid angle, integrated here by subdivision.
double cell_solid_angle(Vec3 from, Vec3 corner, Vec3 ex, Vec3 ey) {
  constexpr int k_steps = 24;
  const Vec3 normal = cross(ex, ey);
  double sum = 0.0;
  for (int j = 0; j < k_steps; ++j) {
    for (int i = 0; i < k_steps; ++i) {
      const Vec3 p = corner + ex * ((static_cast<float>(i) + 0.5f) / k_steps) +
                     ey * ((static_cast<float>(j) + 0.5f) / k_steps);
      const Vec3 d = p - from;
      const float d2 = dot(d, d);
      sum += static_cast<double>(std::abs(dot(d, normal))) / (d2 * std::sqrt(d2));
    }
  }
  return sum / (k_steps * k_steps);
}

TEST(WarpStatistics, SphericalRectangleIsUniformInSolidAngle) {
  struct Case {
    Vec3 corner, ex, ey;
  };
  const Case cases[] = {
      {{-1.0f, -1.0f, 0.5f}, {2.0f, 0.0f, 0.0f}, {0.0f, 2.0f, 0.0f}},   // close
      {{-1.0f, -1.0f, -0.5f}, {2.0f, 0.0f, 0.0f}, {0.0f, 2.0f, 0.0f}},  // from the other side
      {{1.0f, 2.0f, 0.7f}, {0.0f, 0.0f, 3.0f}, {0.5f, 0.0f, 0.0f}},     // off to a corner
      {{-0.5f, -0.2f, 15.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 0.4f, 0.0f}},  // far
      {{10.0f, 0.5f, 5.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 0.4f, 0.0f}},    // far and oblique
  };
  for (const Case& c : cases) {
    const Vec3 from{0.1f, 0.2f, 0.05f};
    const SphericalRectangle rectangle(from, c.corner, normalize(c.ex), normalize(c.ey),
                                       length(c.ex), length(c.ey));
    constexpr int k_cells = 6;
    std::vector<double> expected, counts(k_cells * k_cells);
    double total = 0.0;
    for (int j = 0; j < k_cells; ++j) {
      for (int i = 0; i < k_cells; ++i) {
        const Vec3 corner = c.corner + c.ex * (static_cast<float>(i) / k_cells) +
                            c.ey * (static_cast<float>(j) / k_cells);
        expected.push_back(cell_solid_angle(from, corner, c.ex / k_cells, c.ey / k_cells));
        total += expected.back();
      }
    }
    EXPECT_NEAR(rectangle.solid_angle() / total, 1.0, 2e-3);
    EXPECT_FLOAT_EQ(rectangle.pdf() * rectangle.solid_angle(), 1.0f);

    LocalRandom random(4);
    for (int n = 0; n < k_samples; ++n) {
      const Vec3 d = rectangle.sample(random.get_2d()) - c.corner;
      const float x = dot(d, c.ex) / length_squared(c.ex), y = dot(d, c.ey) / length_squared(c.ey);
      ASSERT_TRUE(x > -1e-3f && x < 1.001f && y > -1e-3f && y < 1.001f) << x << " " << y;
      counts[cell_of(x, y, k_cells)] += 1.0;
    }
    double chi2 = 0.0;
    for (size_t i = 0; i < counts.size(); ++i) {
      const double mean = expected[i] / total * k_samples;
      chi2 += (counts[i] - mean) * (counts[i] - mean) / mean;
    }
    EXPECT_LT((chi2 - 35.0) / std::sqrt(70.0), k_limit) << c.corner.x;
  }
}

TEST(Warp, SphericalRectangleSeenEdgeOnIsEmpty) {
  const SphericalRectangle flat({0.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 0.0f}, {1.0f, 0.0f, 0.0f},
                                {0.0f, 1.0f, 0.0f}, 1.0f, 1.0f);
  EXPECT_EQ(flat.solid_angle(), 0.0f);
}

TEST(Warp, EndsOfTheSquareStayFinite) {
  const SphericalRectangle rectangle({0.0f, 0.0f, 0.0f}, {-1.0f, -1.0f, 1.0f}, {1.0f, 0.0f, 0.0f},
                                     {0.0f, 1.0f, 0.0f}, 2.0f, 2.0f);
  for (const float x : {0.0f, 0.5f, k_one_minus_epsilon}) {
    for (const float y : {0.0f, 0.5f, k_one_minus_epsilon}) {
      const Vec2 u{x, y};
      EXPECT_LE(length(warp_concentric_disk(u)), 1.000001f);
      EXPECT_LE(length(warp_regular_polygon(u, 6, 0.0f)), 1.000001f);
      EXPECT_NEAR(length(warp_cosine_hemisphere(u)), 1.0f, 1e-6f);
      EXPECT_NEAR(length(warp_uniform_sphere(u)), 1.0f, 1e-6f);
      EXPECT_GE(warp_uniform_hemisphere(u).z, 0.0f);
      EXPECT_TRUE(is_finite(rectangle.sample(u)));
    }
  }
}

// The densities are those of the domain: one over its measure.
TEST(Warp, PdfsIntegrateToOne) {
  EXPECT_FLOAT_EQ(concentric_disk_pdf() * k_pi, 1.0f);
  EXPECT_FLOAT_EQ(uniform_sphere_pdf() * 4.0f * k_pi, 1.0f);
  EXPECT_FLOAT_EQ(uniform_hemisphere_pdf() * k_two_pi, 1.0f);
  EXPECT_FLOAT_EQ(uniform_cone_pdf(1.0f), uniform_hemisphere_pdf());
  EXPECT_FLOAT_EQ(regular_polygon_pdf(4) * 2.0f, 1.0f);  // a square of diagonal 2
  EXPECT_FLOAT_EQ(triangle_pdf(0.25f), 4.0f);
  double sum = 0.0;
  constexpr int k_steps = 1000;
  for (int i = 0; i < k_steps; ++i)
    sum += cosine_hemisphere_pdf((static_cast<float>(i) + 0.5f) / k_steps) * k_two_pi / k_steps;
  EXPECT_NEAR(sum, 1.0, 1e-5);
  EXPECT_EQ(cosine_hemisphere_pdf(-0.5f), 0.0f);
}

TEST(PowerHeuristic, PartitionsUnityAndSurvivesExtremes) {
  EXPECT_FLOAT_EQ(power_heuristic(3.0f, 0.7f) + power_heuristic(0.7f, 3.0f), 1.0f);
  EXPECT_FLOAT_EQ(power_heuristic(2.0f, 1.0f), 0.8f);
  EXPECT_FLOAT_EQ(power_heuristic(1e30f, 1e30f), 0.5f);
  EXPECT_EQ(power_heuristic(1e-30f, 1e30f), 0.0f);
  EXPECT_EQ(power_heuristic(1.0f, 0.0f), 1.0f);
  EXPECT_EQ(power_heuristic(0.0f, 0.0f), 0.0f);
}

}  // namespace
}  // namespace tenniel
