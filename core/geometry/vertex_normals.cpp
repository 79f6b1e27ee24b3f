// SPDX-License-Identifier: Apache-2.0
#include "geometry/vertex_normals.h"

#include <span>

#include "math/numeric.h"

namespace tenniel {

namespace {

// Far above what the order of a sum can do, far below what an eye can see.
constexpr float k_same_normal = 1e-5f;

Vec3 position_of(const PolygonSoup& soup, uint32_t vertex) {
  const float* p = soup.positions + 3 * static_cast<size_t>(vertex);
  return {p[0], p[1], p[2]};
}

// The corners of a polygon, or none where one of them is out of range.
std::span<const uint32_t> corners_of(const PolygonSoup& soup, size_t polygon) {
  const int64_t start = soup.polygon_starts[polygon], size = soup.polygon_sizes[polygon];
  if (start < 0 || size < 3 || start + size > static_cast<int64_t>(soup.corner_count)) return {};
  const std::span corners(soup.corner_vertices + start, static_cast<size_t>(size));
  for (const uint32_t vertex : corners)
    if (vertex >= soup.vertex_count) return {};
  return corners;
}

// Newell's, about the first corner so that a mesh far from the origin keeps its precision.
Vec3 polygon_normal(const PolygonSoup& soup, std::span<const uint32_t> corners) {
  const Vec3 first = position_of(soup, corners[0]);
  Vec3 sum, last = position_of(soup, corners[1]) - first;
  for (const uint32_t vertex : corners.subspan(2)) {
    const Vec3 next = position_of(soup, vertex) - first;
    sum += cross(last, next);
    last = next;
  }
  return normalize_or(sum, {0.0f, 0.0f, 1.0f});
}

void add_polygon(const PolygonSoup& soup, std::span<const uint32_t> corners,
                 std::vector<Vec3>& sums) {
  const Vec3 normal = polygon_normal(soup, corners);
  const size_t size = corners.size();
  Vec3 here = position_of(soup, corners[size - 1]);
  const Vec3 closing = normalize_or(here - position_of(soup, corners[size - 2]), {});
  Vec3 arriving = closing;
  for (size_t i = 0; i < size; ++i) {
    const Vec3 next = position_of(soup, corners[i]);
    const Vec3 leaving = i + 1 < size ? normalize_or(next - here, {}) : closing;
    const Vec3 weighted = normal * safe_acos(-dot(arriving, leaving));
    if (is_finite(weighted)) sums[corners[(i + size - 1) % size]] += weighted;
    here = next;
    arriving = leaving;
  }
}

}  // namespace

std::vector<Vec3> vertex_normals(const PolygonSoup& soup, const Cancellation& cancellation) {
  std::vector<Vec3> normals(soup.vertex_count);
  for (size_t polygon = 0; polygon < soup.polygon_count; ++polygon) {
    cancellation.check();
    if (const auto corners = corners_of(soup, polygon); !corners.empty())
      add_polygon(soup, corners, normals);
  }
  for (uint32_t vertex = 0; vertex < normals.size(); ++vertex)
    normals[vertex] = normalize_or(normals[vertex], normalize_or(position_of(soup, vertex), {}));
  return normals;
}

void settle_corner_normals(const PolygonSoup& soup, const std::vector<Vec3>& of_vertices,
                           std::vector<Vec3>& of_corners) {
  for (size_t corner = 0; corner < of_corners.size(); ++corner) {
    const uint32_t vertex = soup.corner_vertices[corner];
    if (vertex >= of_vertices.size()) continue;
    const Vec3 normal = of_vertices[vertex];
    if (length_squared(of_corners[corner] - normal) < k_same_normal * k_same_normal)
      of_corners[corner] = normal;
  }
}

}  // namespace tenniel
