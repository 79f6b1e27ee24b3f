// SPDX-License-Identifier: Apache-2.0
#include "scene/displace.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace tenniel {
namespace {

// One corner of a face, as Embree counts them.
struct FaceCorner {
  static constexpr uint32_t k_none = ~0u;
  uint32_t face = k_none;
  uint8_t corner = 0;
};

const Material& material_of(const Scene& scene, const Instance& user, const Mesh& mesh,
                            uint32_t face) {
  return scene.materials[user.material(mesh.material_slot(face), 0)];
}

bool is_displaced(const Scene& scene, const Instance& user) {
  for (const uint32_t m : user.materials)
    if (scene.materials[m].displaces) return true;
  return false;
}

// Instances of one mesh share what became of it.
bool all_have_the_materials_of(const Instance& user, const std::vector<Instance>& instances) {
  return std::all_of(instances.begin(), instances.end(), [&user](const Instance& other) {
    return other.mesh != user.mesh || other.materials == user.materials;
  });
}

// For each vertex the first corner that a displacing material moves.
std::vector<FaceCorner> corners_to_move(const Scene& scene, const Instance& user,
                                        const Mesh& mesh) {
  std::vector<FaceCorner> first(mesh.positions.size());
  const size_t stride = mesh.stride();
  for (uint32_t face = 0; face < mesh.face_count(); ++face) {
    if (!material_of(scene, user, mesh, face).displaces) continue;
    const uint32_t* ids = &mesh.face_vertices[face * stride];
    for (size_t corner = 0; corner < stride; ++corner) {
      // The third corner of a triangle among quads is that of its empty half.
      if (corner == 2 && stride == 4 && ids[2] == ids[3]) continue;
      FaceCorner& of_vertex = first[ids[corner]];
      if (of_vertex.face == FaceCorner::k_none) of_vertex = {face, static_cast<uint8_t>(corner)};
    }
  }
  return first;
}

// The corner seen from straight above its front.
SurfaceInteraction interaction_at(const Instance& user, const Mesh& mesh, FaceCorner at) {
  constexpr float k_u[] = {0.0f, 1.0f, 1.0f, 0.0f}, k_v3[] = {0.0f, 0.0f, 1.0f};
  constexpr float k_v4[] = {0.0f, 0.0f, 1.0f, 1.0f};
  Hit hit;
  hit.face = at.face;
  const bool is_quad = mesh.corners_per_face == 4;
  hit.u = is_quad || at.corner < 2 ? k_u[at.corner] : 0.0f;
  hit.v = is_quad ? k_v4[at.corner] : k_v3[at.corner];
  Ray ray{{}, {0.0f, 0.0f, -1.0f}};
  ray.time = 0.5f;  // the middle of the shutter
  const SurfaceInteraction seen = make_interaction(ray, hit, user, mesh, 0.0f);
  ray.direction = seen.is_back_facing ? seen.geometric_normal : -seen.geometric_normal;
  return make_interaction(ray, hit, user, mesh, 0.0f);
}

Vec3 offset_at(const Scene& scene, const Material& material, const SurfaceInteraction& at,
               ShadingContext& context) {
  context.surface = at;
  context.camera = &scene.camera_info;
  context.material_pass_index = material.pass_index;
  context.begin(k_query_displacement);
  if (material.displacement.program) material.displacement.program->run(context);
  return at.instance->world_to_object.vector(context.get(material.displacement.result));
}

// New positions; returns how many vertices had none that distances can be taken of.
uint32_t move_vertices(const Scene& scene, const Instance& user, const Mesh& mesh,
                       std::vector<Vec3>& positions, const Cancellation& cancellation) {
  const std::vector<FaceCorner> corners = corners_to_move(scene, user, mesh);
  std::atomic<uint32_t> broken{0};
  tbb::parallel_for(
      tbb::blocked_range<size_t>(0, corners.size(), 256), [&](const tbb::blocked_range<size_t>& r) {
        ShadingContext context;
        context.reserve(scene.register_count);
        for (size_t i = r.begin(); i < r.end(); ++i) {
          cancellation.check();
          if (corners[i].face == FaceCorner::k_none) continue;
          const Material& material = material_of(scene, user, mesh, corners[i].face);
          const Vec3 moved =
              positions[i] +
              offset_at(scene, material, interaction_at(user, mesh, corners[i]), context);
          if (std::isfinite(length_squared(moved)))
            positions[i] = moved;
          else
            ++broken;
        }
      });
  return broken;
}

// Which of the normals that are to be made each corner of a face reads: one a vertex, or where the
// mesh has normals by corner one for all that were equal.
class SharedNormals {
 public:
  SharedNormals(const Mesh& mesh, const Cancellation& cancellation) : mesh_(mesh) {
    if (mesh.corner_normals.empty()) return;
    of_corner_.assign(mesh.corner_normals.size(), 0);
    std::map<std::tuple<uint32_t, float, float, float>, uint32_t> ids;
    for (size_t i = 0; i < mesh.face_vertices.size(); ++i) {
      cancellation.check();
      const uint32_t corner = mesh.face_corners[i];
      const Vec3 n = mesh.corner_normals[corner];
      const auto next = static_cast<uint32_t>(ids.size());
      of_corner_[corner] =
          ids.try_emplace({mesh.face_vertices[i], n.x, n.y, n.z}, next).first->second;
    }
    count_ = ids.size();
  }
  size_t count() const { return of_corner_.empty() ? mesh_.vertex_normals.size() : count_; }
  uint32_t id(uint32_t vertex, uint32_t corner) const {
    return of_corner_.empty() ? vertex : of_corner_[corner];
  }

 private:
  const Mesh& mesh_;
  std::vector<uint32_t> of_corner_;
  size_t count_ = 0;
};

Vec3 triangle_normal(const Mesh& mesh, const FaceTriangle& t) {
  const Vec3 p = mesh.positions[t.vertices[0]];
  return normalize_or(cross(mesh.positions[t.vertices[1]] - p, mesh.positions[t.vertices[2]] - p),
                      {});
}

// As Cycles: the mean of the triangles around, each counted once whatever its size or angle.
void follow_with_normals(const Scene& scene, const Instance& user, Mesh& mesh,
                         const Cancellation& cancellation) {
  auto& normals = mesh.corner_normals.empty() ? mesh.vertex_normals : mesh.corner_normals;
  if (normals.empty()) return;
  const SharedNormals shared(mesh, cancellation);
  std::vector<Vec3> sums(shared.count());
  const auto each_triangle = [&](const auto& visit) {
    for (uint32_t face = 0; face < mesh.face_count(); ++face) {
      cancellation.check();
      const Material& material = material_of(scene, user, mesh, face);
      if (!material.displaces || material.displacement_method == DisplacementMethod::both) continue;
      for (int half = 0; half < mesh.corners_per_face - 2; ++half)
        visit(face_triangle(mesh, face, half == 1));
    }
  };
  each_triangle([&](const FaceTriangle& t) {
    const Vec3 normal = triangle_normal(mesh, t);
    for (size_t i = 0; i < 3; ++i)
      sums[shared.id(t.vertices[i], t.corners[i])] += normal;
  });
  const bool by_corner = !mesh.corner_normals.empty();
  each_triangle([&](const FaceTriangle& t) {
    for (size_t i = 0; i < 3; ++i) {
      Vec3& normal = normals[by_corner ? t.corners[i] : t.vertices[i]];
      normal = normalize_or(sums[shared.id(t.vertices[i], t.corners[i])], normal);
    }
  });
}

}  // namespace

void displace(const Scene& scene, const Instance& user, Mesh& mesh, Diagnostics& diagnostics,
              const Cancellation& cancellation) {
  if (!is_displaced(scene, user)) return;
  std::vector<Vec3> positions = mesh.positions;
  const uint32_t broken = move_vertices(scene, user, mesh, positions, cancellation);
  mesh.undisplaced = std::exchange(mesh.positions, std::move(positions));
  follow_with_normals(scene, user, mesh, cancellation);
  if (!all_have_the_materials_of(user, scene.instances))
    diagnostics.add(
        {"WARNING",
         "Other objects share its mesh with other materials: all are displaced as it is.",
         user.name, "", "", ""});
  if (broken > 0)
    diagnostics.add({"WARNING",
                     "The displacement of " + std::to_string(broken) +
                         " vertices is not a number: they stay where they are.",
                     user.name, "", "", ""});
}

}  // namespace tenniel
