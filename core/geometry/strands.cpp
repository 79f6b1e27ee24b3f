// SPDX-License-Identifier: Apache-2.0
#include "geometry/strands.h"

#include <algorithm>
#include <cmath>

#include "geometry/interaction.h"
#include "math/numeric.h"

namespace tenniel {

namespace {

// Embree ignores what reaches farther.
constexpr float k_farthest = 1e18f;

// Transforms that stretch by less than this are taken for uniform.
constexpr float k_stretch_tolerance = 1e-4f;

bool is_usable(const StrandKey& key) {
  const Vec3 p = key.position;
  return std::abs(p.x) < k_farthest && std::abs(p.y) < k_farthest && std::abs(p.z) < k_farthest &&
         key.radius >= 0.0f && key.radius < k_farthest;
}

Vec3 point_of(const StrandSoup& soup, size_t i) {
  const float* p = soup.positions + 3 * i;
  return soup.to_object.point({p[0], p[1], p[2]});
}

StrandKey key_of(const StrandSoup& soup, size_t i) {
  return {point_of(soup, i), soup.radii[i]};
}

void add_spheres(const StrandSoup& soup, Mesh& mesh) {
  auto& keys = mesh.strands.keys;
  for (size_t i = 0; i < soup.key_count; ++i) {
    const StrandKey key = key_of(soup, i);
    // The place is kept for the sake of the attributes; a negative radius is never hit.
    const bool usable = is_usable(key);
    keys.push_back(usable ? key : StrandKey{{}, -1.0f});
    if (!usable) ++mesh.dropped_faces;
  }
}

// Two more keys than came in for each hair, so that key `k` of hair `s` is number k + 2 s + 1.
void add_hairs(const StrandSoup& soup, Mesh& mesh) {
  Strands& strands = mesh.strands;
  strands.keys.reserve(soup.key_count + 2 * soup.strand_count);
  size_t key = 0;
  for (size_t hair = 0; hair < soup.strand_count; ++hair) {
    const auto wanted = static_cast<size_t>(std::max(soup.sizes[hair], 0));
    const size_t size = std::min(wanted, soup.key_count - key);
    const size_t first = strands.keys.size();
    strands.keys.push_back(size > 0 ? key_of(soup, key) : StrandKey{});
    for (size_t i = 0; i < size; ++i)
      strands.keys.push_back(key_of(soup, key + i));
    strands.keys.push_back(strands.keys.back());
    for (size_t i = 0; i + 1 < size; ++i) {
      const auto four = strands.keys.begin() + static_cast<std::ptrdiff_t>(first + i);
      if (!std::all_of(four, four + 4, is_usable)) {
        ++mesh.dropped_faces;
        continue;
      }
      strands.segments.push_back(static_cast<uint32_t>(first + i));
      mesh.face_polygons.push_back(static_cast<uint32_t>(hair));
    }
    key += size;
  }
}

// A Catmull-Rom segment at `u`: where it is, and how that and the radius change.
struct CurvePoint {
  Vec3 position, derivative;
};
CurvePoint evaluate(const StrandKey* k, float u) {
  const Vec3 a = k[0].position, b = k[1].position, c = k[2].position, d = k[3].position;
  const Vec3 linear = (c - a) * 0.5f;
  const Vec3 square = a - b * 2.5f + c * 2.0f - d * 0.5f;
  const Vec3 cube = (d - a) * 0.5f + (b - c) * 1.5f;
  return {b + (linear + (square + cube * u) * u) * u,
          linear + (square * 2.0f + cube * (3.0f * u)) * u};
}

const StrandKey* segment_keys(const SurfaceInteraction& at) {
  const Strands& strands = at.mesh->strands;
  return &strands.keys[strands.segments[at.face]];
}

// Attributes of a hair lie on the keys as they came in. The third place belongs to `v`, which runs
// across: with the first key there it changes nothing.
void place_attributes(SurfaceInteraction& at) {
  const uint32_t hair = at.mesh->face_polygons[at.face];
  const uint32_t key = at.mesh->strands.segments[at.face] - 2 * hair;
  at.vertices = {key, key + 1, key};
  at.weights = {1.0f - at.u - at.v, at.u, at.v};
}

// Unit, object space: of a cylinder of the ribbon's width. `along` and `to_viewer` need not be
// unit.
Vec3 ribbon_normal(Vec3 along, Vec3 to_viewer, float v) {
  const Vec3 across = normalize_or(cross(along, to_viewer), {});
  const Vec3 up = normalize_or(cross(across, along), to_viewer);
  return across * v + up * safe_sqrt(1.0f - sqr(v));
}

void set_directions(SurfaceInteraction& at, Vec3 normal, Vec3 along) {
  at.is_back_facing = dot(normal, at.wo) < 0.0f;
  at.shading_normal = at.is_back_facing ? -normal : normal;
  at.geometric_normal = at.mesh->shape == Shape::ribbons ? at.wo : at.shading_normal;
  at.corner_points = {at.position, at.position + along,
                      at.position + cross(along, at.geometric_normal)};
}

void place_on_hair(const Ray& ray, const Hit& hit, SurfaceInteraction& at) {
  place_attributes(at);
  const CurvePoint curve = evaluate(segment_keys(at), at.u);
  at.position = ray.at(hit.t);
  const bool is_local = !at.mesh->is_world_space;
  const Transform to_object = is_local ? at.world_to_object() : Transform();
  const Vec3 p = to_object.point(at.position), wo = to_object.vector(at.wo);
  Vec3 normal = at.mesh->shape == Shape::ribbons ? ribbon_normal(curve.derivative, wo, at.v)
                                                 : normalize_or(p - curve.position, wo);
  Vec3 along = curve.derivative;
  if (is_local) {
    normal = to_object.transposed_vector(normal);
    along = at.object_to_world().vector(along);
  }
  set_directions(at, normalize_or(normal, at.wo), along);
}

void place_on_sphere(const Ray& ray, const Hit& hit, SurfaceInteraction& at) {
  at.u = at.v = 0.0f;
  at.vertices = {hit.face, hit.face, hit.face};
  at.weights = {1.0f, 0.0f, 0.0f};
  const StrandKey& sphere = at.mesh->strands.keys[hit.face];
  at.position = ray.at(hit.t);
  const bool is_local = !at.mesh->is_world_space;
  const Transform to_object = is_local ? at.world_to_object() : Transform();
  Vec3 normal =
      normalize_or(to_object.point(at.position) - sphere.position, to_object.vector(at.wo));
  // From the centre: more exact than the end of a long ray.
  at.position = sphere.position + normal * sphere.radius;
  if (is_local) {
    at.position = at.object_to_world().point(at.position);
    normal = to_object.transposed_vector(normal);
  }
  set_directions(at, normalize_or(normal, at.wo), {});
}

}  // namespace

Mesh build_strands(const StrandSoup& soup) {
  Mesh mesh;
  mesh.name = soup.name;
  mesh.shape = soup.shape;
  mesh.strands.ribbon_pieces = std::clamp(soup.ribbon_pieces, 1, 16);
  if (soup.shape == Shape::spheres)
    add_spheres(soup, mesh);
  else
    add_hairs(soup, mesh);
  return mesh;
}

StrandLengths measure_strands(const StrandSoup& soup) {
  StrandLengths result;
  result.intercepts.reserve(soup.key_count);
  result.lengths.reserve(soup.strand_count);
  size_t key = 0;
  for (size_t hair = 0; hair < soup.strand_count; ++hair) {
    const auto wanted = static_cast<size_t>(std::max(soup.sizes[hair], 0));
    const size_t size = std::min(wanted, soup.key_count - key);
    float sum = 0.0f;
    for (size_t i = 0; i < size; ++i) {
      if (i > 0) sum += length(point_of(soup, key + i) - point_of(soup, key + i - 1));
      result.intercepts.push_back(sum);
    }
    for (size_t i = 0; i < size; ++i)
      result.intercepts[key + i] = safe_divide(result.intercepts[key + i], sum);
    result.lengths.push_back(sum);
    key += size;
  }
  return result;
}

std::vector<float> tapered_radii(const StrandSoup& soup, const Taper& taper) {
  std::vector<float> radii = measure_strands(soup).intercepts;
  const float s = taper.shape;
  const float power = s < 0.0f ? 1.0f + s : 1.0f / std::max(1.0f - s, 1e-6f);
  for (float& r : radii)
    r = std::pow(1.0f - saturate(r), power) * (taper.root - taper.tip) + taper.tip;
  size_t end = 0;
  for (size_t hair = 0; hair < soup.strand_count && taper.closes_tip; ++hair) {
    end += static_cast<size_t>(std::max(soup.sizes[hair], 0));
    if (end > 0 && end <= radii.size()) radii[end - 1] = 0.0f;
  }
  radii.resize(soup.key_count);
  return radii;
}

bool keeps_shape(const Transform& m) {
  const float x = length_squared(m.x), y = length_squared(m.y), z = length_squared(m.z);
  const float slack = k_stretch_tolerance * x;
  return std::abs(x - y) <= slack && std::abs(x - z) <= slack && std::abs(dot(m.x, m.y)) <= slack &&
         std::abs(dot(m.x, m.z)) <= slack && std::abs(dot(m.y, m.z)) <= slack;
}

void move_strands_to_world_space(Strands& strands, const Transform& object_to_world) {
  const float scale = std::cbrt(std::abs(object_to_world.determinant()));
  for (StrandKey& key : strands.keys)
    key = {object_to_world.point(key.position), key.radius * scale};
}

void place_on_strand(const Ray& ray, const Hit& hit, SurfaceInteraction& at) {
  at.u = hit.u;
  at.v = at.mesh->shape == Shape::ribbons ? std::clamp(hit.v, -1.0f, 1.0f) : 0.0f;
  if (at.mesh->shape == Shape::spheres)
    place_on_sphere(ray, hit, at);
  else
    place_on_hair(ray, hit, at);
}

bool is_on_hair(const SurfaceInteraction& at) {
  return at.mesh && (at.mesh->shape == Shape::ribbons || at.mesh->shape == Shape::tubes);
}

float strand_thickness(const SurfaceInteraction& at) {
  if (!is_on_hair(at)) return 0.0f;
  const StrandKey* keys = segment_keys(at);
  return 2.0f * lerp(keys[1].radius, keys[2].radius, at.u);
}

Vec3 strand_direction(const SurfaceInteraction& at) {
  return is_on_hair(at) ? at.corner_points[1] - at.corner_points[0] : Vec3{};
}

bool is_on_sphere(const SurfaceInteraction& at) {
  return at.mesh && at.mesh->shape == Shape::spheres;
}

Vec3 sphere_center(const SurfaceInteraction& at) {
  const Vec3 center = at.mesh->strands.keys[at.face].position;
  return at.mesh->is_world_space ? center : at.object_to_world().point(center);
}

float sphere_radius(const SurfaceInteraction& at) {
  return at.mesh->strands.keys[at.face].radius;
}

}  // namespace tenniel
