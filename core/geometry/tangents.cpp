// SPDX-License-Identifier: Apache-2.0
// Tangents after Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited", section 4.4 and his
// reference program: corners that agree in position, normal and UV are welded, triangles around a
// welded vertex form groups of one UV orientation, and a group shares one angle-weighted tangent.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <cstddef>

#include "geometry/mesh.h"
#include "math/hash.h"
#include "math/numeric.h"

namespace tenniel {

namespace {

constexpr uint32_t k_nobody = ~0u;

struct Corner {
  Vec3 position, normal;
  Vec2 uv;
  uint32_t welded = 0;           // same for corners that agree
  uint32_t output = 0;           // Blender's corner
  uint32_t next = k_nobody;      // the neighbour's corner at this vertex, over the edge that leaves
  uint32_t previous = k_nobody;  // over the edge that arrives
  bool is_grouped = false;
};

enum class Orientation : uint8_t { any, positive, negative };

struct Triangle {
  Vec3 tangent;                                // along +u, unit
  Orientation orientation = Orientation::any;  // any: without area in UV
  bool is_degenerate = false;
};

bool same_bits(Vec3 a, Vec3 b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

class TangentBuilder {
 public:
  TangentBuilder(const Mesh& mesh, const Attribute& uv, const Cancellation& cancellation)
      : mesh_(mesh), uv_(uv), cancellation_(cancellation) {
    gather();
    weld();
    for (size_t t = 0; t < triangles_.size(); ++t)
      find_direction(t);
    connect();
  }

  void run(std::vector<float>& tangents, std::vector<float>& signs) {
    tangents_.assign(signs.size(), Vec3());
    orientations_.assign(signs.size(), 0.0f);
    for (uint32_t c = 0; c < corners_.size(); ++c) {
      cancellation_.check();
      const Triangle& t = triangles_[c / 3];
      if (!t.is_degenerate && t.orientation != Orientation::any && !corners_[c].is_grouped)
        grow_group(c);
    }
    lend_to_degenerate();
    for (size_t i = 0; i < signs.size(); ++i) {
      const Vec3 tangent = normalize_or(tangents_[i], {});
      tangents[3 * i] = tangent.x;
      tangents[3 * i + 1] = tangent.y;
      tangents[3 * i + 2] = tangent.z;
      signs[i] = orientations_[i] < 0.0f ? -1.0f : 1.0f;
    }
  }

 private:
  static size_t side(size_t corner, size_t step) {
    return corner - corner % 3 + (corner + step) % 3;
  }

  Vec2 uv_at(uint32_t vertex, uint32_t corner) const {
    const size_t i = uv_.domain == AttributeDomain::vertex ? vertex : corner;
    const float* data = &uv_.data[i * uv_.channels];
    return {data[0], data[1]};
  }

  // One normal for all of a flat quad, else its halves would not weld.
  Vec3 flat_normal(uint32_t face) const {
    const auto stride = static_cast<size_t>(mesh_.corners_per_face);
    const uint32_t* v = &mesh_.face_vertices[face * stride];
    const auto& p = mesh_.positions;
    const bool is_quad = stride == 4 && v[2] != v[3];
    const Vec3 normal = is_quad ? cross(p[v[2]] - p[v[0]], p[v[3]] - p[v[1]])
                                : cross(p[v[1]] - p[v[0]], p[v[2]] - p[v[0]]);
    return normalize_or(normal, {});
  }

  void gather() {
    const size_t stride = static_cast<size_t>(mesh_.corners_per_face);
    for (uint32_t face = 0; face < mesh_.face_count(); ++face) {
      cancellation_.check();
      const uint32_t* v = &mesh_.face_vertices[face * stride];
      const size_t halves = stride == 4 && v[2] != v[3] ? 2 : 1;
      const bool is_smooth = mesh_.is_smooth(face);
      const Vec3 flat = is_smooth ? Vec3() : flat_normal(face);
      for (size_t half = 0; half < halves; ++half) {
        const FaceTriangle triangle = face_triangle(mesh_, face, half == 1);
        for (size_t i = 0; i < 3; ++i) {
          const uint32_t vertex = triangle.vertices[i], corner = triangle.corners[i];
          Corner c;
          c.position = mesh_.positions[vertex];
          c.uv = uv_at(vertex, corner);
          c.output = corner;
          c.normal = flat;
          if (is_smooth && !mesh_.corner_normals.empty())
            c.normal = mesh_.corner_normals[corner];
          else if (is_smooth && !mesh_.vertex_normals.empty())
            c.normal = mesh_.vertex_normals[vertex];
          corners_.push_back(c);
        }
      }
    }
    triangles_.resize(corners_.size() / 3);
  }

  void weld() {
    const size_t size = std::bit_ceil(corners_.size() * 2 + 1);
    std::vector<uint32_t> table(size, k_nobody);
    for (uint32_t i = 0; i < corners_.size(); ++i) {
      cancellation_.check();
      Corner& c = corners_[i];
      uint32_t hash = 0;
      for (const float f : {c.position.x, c.position.y, c.position.z, c.normal.x, c.normal.y,
                            c.normal.z, c.uv.x, c.uv.y})
        hash = mix_bits(hash + float_bits(f + 0.0f));  // + 0: -0 and 0 are one
      size_t slot = hash & (size - 1);
      while (table[slot] != k_nobody && !agree(corners_[table[slot]], c))
        slot = (slot + 1) & (size - 1);
      if (table[slot] == k_nobody) table[slot] = i;
      c.welded = table[slot];
    }
  }

  static bool agree(const Corner& a, const Corner& b) {
    return same_bits(a.position, b.position) && same_bits(a.normal, b.normal) && a.uv == b.uv;
  }

  void find_direction(size_t t) {
    const Corner *a = &corners_[3 * t], *b = a + 1, *c = a + 2;
    Triangle& triangle = triangles_[t];
    triangle.is_degenerate = same_bits(a->position, b->position) ||
                             same_bits(a->position, c->position) ||
                             same_bits(b->position, c->position);
    const Vec2 uv_1 = b->uv - a->uv, uv_2 = c->uv - a->uv;
    const float area = uv_1.x * uv_2.y - uv_1.y * uv_2.x;
    if (!(std::abs(area) > 0.0f) || !std::isfinite(area)) return;
    const Vec3 along_u =
        (b->position - a->position) * uv_2.y - (c->position - a->position) * uv_1.y;
    const Vec3 unit = normalize_or(along_u, {});
    triangle.orientation = area > 0.0f ? Orientation::positive : Orientation::negative;
    triangle.tangent = area > 0.0f ? unit : -unit;
  }

  // An edge by its welded ends, lower first, and the corner that it leaves in its triangle.
  struct Edge {
    uint32_t low, high, corner;
    auto operator<=>(const Edge&) const = default;
  };

  // Pairs each edge with one that runs against it; where more than two meet, first come first
  // served in the order of the triangles.
  void connect() {
    std::vector<Edge> edges;
    edges.reserve(corners_.size());
    for (uint32_t c = 0; c < corners_.size(); ++c) {
      if (triangles_[c / 3].is_degenerate) continue;
      const uint32_t from = corners_[c].welded, to = corners_[side(c, 1)].welded;
      edges.push_back({std::min(from, to), std::max(from, to), c});
    }
    std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) {
      cancellation_.check();
      return a < b;
    });
    for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
      cancellation_.check();
      std::vector<uint32_t>& rising = waiting_[0];
      std::vector<uint32_t>& falling = waiting_[1];
      rising.clear();
      falling.clear();
      for (; end < edges.size() && edges[end].low == edges[begin].low &&
             edges[end].high == edges[begin].high;
           ++end) {
        const uint32_t corner = edges[end].corner;
        (corners_[corner].welded == edges[end].low ? rising : falling).push_back(corner);
      }
      for (size_t i = 0; i < std::min(rising.size(), falling.size()); ++i)
        join(rising[i], falling[i]);
    }
  }

  // The edges that leave corners `a` and `b` are one edge seen from both sides.
  void join(uint32_t a, uint32_t b) {
    const auto a_end = static_cast<uint32_t>(side(a, 1)), b_end = static_cast<uint32_t>(side(b, 1));
    corners_[a].next = b_end;
    corners_[b_end].previous = a;
    corners_[b].next = a_end;
    corners_[a_end].previous = b;
  }

  // All corners around one vertex that edges join to `seed` without a change of orientation.
  void grow_group(uint32_t seed) {
    const Orientation orientation = triangles_[seed / 3].orientation;
    group_.assign(1, seed);
    corners_[seed].is_grouped = true;
    Vec3 sum;
    for (size_t i = 0; i < group_.size(); ++i) {
      const uint32_t c = group_[i];
      sum += weighted_tangent(c);
      for (const uint32_t neighbour : {corners_[c].next, corners_[c].previous}) {
        if (neighbour == k_nobody || corners_[neighbour].is_grouped) continue;
        Triangle& triangle = triangles_[neighbour / 3];
        if (triangle.orientation == Orientation::any) triangle.orientation = orientation;
        if (triangle.orientation != orientation) continue;
        corners_[neighbour].is_grouped = true;
        group_.push_back(neighbour);
      }
    }
    const Vec3 tangent = normalize_or(sum, {});
    const float sign = orientation == Orientation::positive ? 1.0f : -1.0f;
    for (const uint32_t c : group_) {
      // Triangles of one polygon share a corner; the wider angle counts for more.
      const float angle = std::max(angle_at(c), 1e-6f);
      tangents_[corners_[c].output] += tangent * angle;
      orientations_[corners_[c].output] += sign * angle;
    }
  }

  // In the tangent plane of the vertex normal.
  static Vec3 projected(Vec3 v, Vec3 normal) {
    return normalize_or(v - normal * dot(normal, v), {});
  }

  float angle_at(uint32_t c) const {
    const Corner& here = corners_[c];
    const Vec3 to_next = projected(corners_[side(c, 1)].position - here.position, here.normal);
    const Vec3 to_last = projected(corners_[side(c, 2)].position - here.position, here.normal);
    return safe_acos(dot(to_next, to_last));
  }

  Vec3 weighted_tangent(uint32_t c) const {
    return projected(triangles_[c / 3].tangent, corners_[c].normal) * angle_at(c);
  }

  // A triangle with two equal corners takes what a sound one has at the same welded vertex.
  void lend_to_degenerate() {
    std::vector<uint32_t> lender(corners_.size(), k_nobody);
    for (uint32_t c = 0; c < corners_.size(); ++c)
      if (corners_[c].is_grouped) lender[corners_[c].welded] = corners_[c].output;
    for (const Corner& c : corners_) {
      if (c.is_grouped || lender[c.welded] == k_nobody || orientations_[c.output] != 0.0f) continue;
      tangents_[c.output] = tangents_[lender[c.welded]];
      orientations_[c.output] = orientations_[lender[c.welded]];
    }
  }

  const Mesh& mesh_;
  const Attribute& uv_;
  const Cancellation& cancellation_;
  std::vector<Corner> corners_;  // three a triangle
  std::vector<Triangle> triangles_;
  std::vector<uint32_t> group_;
  std::array<std::vector<uint32_t>, 2> waiting_;
  std::vector<Vec3> tangents_;       // per Blender corner, sums
  std::vector<float> orientations_;  // per Blender corner, sums of signed angles
};

}  // namespace

void add_tangents(Mesh& mesh, const Attribute& uv, const std::string& name,
                  const Cancellation& cancellation) {
  uint32_t corner_count = 0;
  for (const uint32_t c : mesh.face_corners)
    corner_count = std::max(corner_count, c + 1);
  Attribute tangent{name, AttributeDomain::corner, 3, {}};
  Attribute sign{name + ".sign", AttributeDomain::corner, 1, {}};
  tangent.data.resize(size_t{corner_count} * 3);
  sign.data.resize(corner_count);
  // `uv` may live in mesh.attributes: the new ones are added when it is read.
  TangentBuilder(mesh, uv, cancellation).run(tangent.data, sign.data);
  mesh.attributes.push_back(std::move(tangent));
  mesh.attributes.push_back(std::move(sign));
}

}  // namespace tenniel
