// SPDX-License-Identifier: Apache-2.0
#include "geometry/accel.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace tenniel {

namespace {

// Embree's own bound of coordinates is 1.844e18; Debian's build asserts it for rays.
constexpr float k_largest = 1e18f;

constexpr size_t k_max_time_steps = 129;  // Embree's limit

// No ray kind of any world has this bit: every geometry does, for queries of one instance.
constexpr uint32_t k_any_kind = 1u << 31;

struct Release {
  void operator()(RTCDevice p) const { rtcReleaseDevice(p); }
  void operator()(RTCScene p) const { rtcReleaseScene(p); }
  void operator()(RTCGeometry p) const { rtcReleaseGeometry(p); }
};
using Device = std::unique_ptr<RTCDeviceTy, Release>;
using RtcScene = std::unique_ptr<RTCSceneTy, Release>;
using Geometry = std::unique_ptr<RTCGeometryTy, Release>;

bool is_usable(const Ray& ray) {
  const Vec3 o = ray.origin, d = ray.direction;
  // One sum: anything NaN or infinite makes it fail.
  const float sum = std::abs(o.x) + std::abs(o.y) + std::abs(o.z) + std::abs(d.x) + std::abs(d.y) +
                    std::abs(d.z) + std::abs(ray.t_min) + ray.behind;
  return sum < k_largest && ray.t_max == ray.t_max;
}

bool is_usable(const Instance& instance) {
  const float determinant = instance.object_to_world.determinant();
  return instance.motion.size() <= k_max_time_steps && is_finite(instance.object_to_world) &&
         is_finite(instance.world_to_object) &&
         std::abs(determinant) > std::numeric_limits<float>::min();
}

RTCRay to_embree(const Ray& ray, uint32_t mask, float behind = 0.0f) {
  RTCRay r;
  r.org_x = ray.origin.x - behind * ray.direction.x;
  r.org_y = ray.origin.y - behind * ray.direction.y;
  r.org_z = ray.origin.z - behind * ray.direction.z;
  r.tnear = ray.t_min + behind;
  r.dir_x = ray.direction.x;
  r.dir_y = ray.direction.y;
  r.dir_z = ray.direction.z;
  r.time = ray.time;
  r.tfar = ray.t_max + behind;
  r.mask = mask;
  r.id = 0;
  r.flags = 0;
  return r;
}

RTCRayHit unanswered(const Ray& ray, uint32_t mask, float behind = 0.0f) {
  RTCRayHit query;
  query.ray = to_embree(ray, mask, behind);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

uint32_t instance_of(const RTCHit& hit) {
  return hit.instID[0] != RTC_INVALID_GEOMETRY_ID ? hit.instID[0] : hit.geomID;
}

std::optional<Hit> answer(const RTCRayHit& query) {
  const RTCHit& hit = query.hit;
  if (hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Hit{query.ray.tfar, hit.u, hit.v, hit.primID, instance_of(hit)};
}

constexpr uint32_t k_any_instance = RTC_INVALID_GEOMETRY_ID;

// What a filter knows of its query.
struct FilterContext {
  RTCIntersectContext embree;          // first: the filter casts back
  uint32_t instance = k_any_instance;  // the only one that counts
  std::span<Hit> hits{};
  size_t count = 0;
  FaceId left{};  // does not count
  Accel::Blocker* blocker = nullptr;
};

FilterContext& context_of(const RTCFilterFunctionNArguments* args) {
  // NOLINTNEXTLINE: Embree hands the context back by its first member.
  return *reinterpret_cast<FilterContext*>(args->context);
}

void keep_one_instance(const RTCFilterFunctionNArguments* args) {
  const auto* hit = reinterpret_cast<const RTCHit*>(args->hit);
  if (instance_of(*hit) != context_of(args).instance) args->valid[0] = 0;
}

void skip_face(const RTCFilterFunctionNArguments* args) {
  const auto* hit = reinterpret_cast<const RTCHit*>(args->hit);
  const FaceId left = context_of(args).left;
  if (hit->primID == left.face && instance_of(*hit) == left.instance) args->valid[0] = 0;
}

// Notes each hit and takes none, so that the ray goes on to its end.
void collect(const RTCFilterFunctionNArguments* args) {
  FilterContext& context = context_of(args);
  const auto* hit = reinterpret_cast<const RTCHit*>(args->hit);
  const auto* ray = reinterpret_cast<const RTCRay*>(args->ray);
  args->valid[0] = 0;
  const uint32_t instance = instance_of(*hit);
  if (context.instance != k_any_instance && instance != context.instance) return;
  const auto known = context.hits.first(context.count);
  const bool is_known = std::any_of(known.begin(), known.end(), [&](const Hit& h) {
    return h.face == hit->primID && h.instance == instance;
  });
  if (is_known || context.count == context.hits.size()) return;
  context.hits[context.count++] = {ray->tfar, hit->u, hit->v, hit->primID, instance};
}

void ask_blocker(const RTCFilterFunctionNArguments* args) {
  const auto* hit = reinterpret_cast<const RTCHit*>(args->hit);
  const auto* ray = reinterpret_cast<const RTCRay*>(args->ray);
  const Hit met{ray->tfar, hit->u, hit->v, hit->primID, instance_of(*hit)};
  if (!context_of(args).blocker->blocks(met)) args->valid[0] = 0;
}

// A tube is seen from outside alone: what has gone in comes out unhindered, as in Cycles.
void skip_inside(const RTCFilterFunctionNArguments* args) {
  const auto* hit = reinterpret_cast<const RTCHit*>(args->hit);
  const auto* ray = reinterpret_cast<const RTCRay*>(args->ray);
  if (ray->dir_x * hit->Ng_x + ray->dir_y * hit->Ng_y + ray->dir_z * hit->Ng_z > 0.0f)
    args->valid[0] = 0;
}

RTCGeometryType geometry_type(Shape shape) {
  return shape == Shape::ribbons ? RTC_GEOMETRY_TYPE_FLAT_CATMULL_ROM_CURVE
         : shape == Shape::tubes ? RTC_GEOMETRY_TYPE_ROUND_CATMULL_ROM_CURVE
                                 : RTC_GEOMETRY_TYPE_SPHERE_POINT;
}

}  // namespace

// Every instance is attached under its own index: as a geometry of the top level (world-space mesh)
// or as an instance of its mesh's scene.
struct Accel::State {
  std::atomic<size_t> memory{0};
  mutable std::atomic<uint64_t> rejected{0};
  std::string error;  // Embree's first complaint
  const std::atomic<bool>* cancelled = nullptr;
  bool has_hairs = false;
  Device device;
  RtcScene top;
  std::vector<RtcScene> mesh_scenes;       // per mesh; null: world-space, empty or unused
  std::vector<RtcScene> alone_scenes;      // world-space meshes that are searched alone
  std::vector<RTCScene> instance_scenes;   // per instance; null: in the top level only, or skipped
  std::vector<Transform> world_to_object;  // per instance
  std::vector<uint8_t> is_attached;        // per instance
  std::vector<uint8_t> is_instanced;       // per instance: its mesh is not in world space

  void open_device();
  RtcScene new_scene() const;
  Geometry new_mesh_geometry(const Mesh& mesh);
  Geometry new_strand_geometry(const Mesh& mesh);
  RTCScene mesh_scene(const Mesh& mesh, uint32_t index);
  void attach(const Instance& instance, uint32_t index, const Mesh& mesh);
  RTCScene alone(RTCGeometry geometry);
  // The smallest scene that holds `instance`, and the ray in its space; null: never hit.
  RTCScene scene_of(uint32_t instance, const Transform* world_to_object, Ray& ray) const;
  bool commit(RTCScene scene);  // false: cancelled
  std::optional<Hit> intersect_among_hairs(const Ray& ray, uint32_t mask, FaceId left) const;
  // Whether Embree may see `ray`; counts those that it must not.
  bool accepts(const Ray& ray) const {
    if (is_usable(ray)) return true;
    rejected.fetch_add(1, std::memory_order_relaxed);
    return false;
  }
  void check() const {
    if (!error.empty()) throw std::runtime_error("Embree: " + error);
  }
};

void Accel::State::open_device() {
  // Never "threads=": it would cap TBB for the whole process, Blender included. The build runs on
  // the threads of the arena that calls it.
  device.reset(rtcNewDevice("verbose=0"));
  if (!device) throw std::runtime_error("Embree: no device");
  if (rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED) == 0)
    throw std::runtime_error("Embree: built without ray masks");
  rtcSetDeviceErrorFunction(
      device.get(),
      [](void* self, RTCError code, const char* text) {
        auto& state = *static_cast<State*>(self);
        if (code == RTC_ERROR_CANCELLED || !state.error.empty()) return;
        state.error = text != nullptr && *text != 0 ? text : "error " + std::to_string(code);
      },
      this);
  rtcSetDeviceMemoryMonitorFunction(
      device.get(),
      [](void* self, ssize_t bytes, bool) {
        static_cast<State*>(self)->memory.fetch_add(static_cast<size_t>(bytes),
                                                    std::memory_order_relaxed);
        return true;
      },
      this);
}

RtcScene Accel::State::new_scene() const {
  RtcScene scene(rtcNewScene(device.get()));
  check();
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_MEDIUM);
  return scene;
}

Geometry Accel::State::new_mesh_geometry(const Mesh& mesh) {
  if (mesh.shape != Shape::faces) return new_strand_geometry(mesh);
  const bool quads = mesh.corners_per_face == 4;
  Geometry geometry(
      rtcNewGeometry(device.get(), quads ? RTC_GEOMETRY_TYPE_QUAD : RTC_GEOMETRY_TYPE_TRIANGLE));
  check();
  RTCGeometry g = geometry.get();
  const auto& positions = mesh.positions;
  if (positions.capacity() > positions.size()) {
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(), 0,
                               sizeof(Vec3), positions.size());
  } else {
    // Embree loads 16 bytes a vertex; without room behind the last one it takes a copy.
    void* copy = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                         sizeof(Vec3), positions.size());
    check();
    std::copy(positions.begin(), positions.end(), static_cast<Vec3*>(copy));
  }
  rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0,
                             quads ? RTC_FORMAT_UINT4 : RTC_FORMAT_UINT3, mesh.face_vertices.data(),
                             0, sizeof(uint32_t) * (quads ? 4 : 3), mesh.face_count());
  rtcSetGeometryMask(g, ~0u);
  return geometry;
}

Geometry Accel::State::new_strand_geometry(const Mesh& mesh) {
  static_assert(sizeof(StrandKey) == 4 * sizeof(float));
  const Strands& strands = mesh.strands;
  Geometry geometry(rtcNewGeometry(device.get(), geometry_type(mesh.shape)));
  check();
  RTCGeometry g = geometry.get();
  rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, strands.keys.data(),
                             0, sizeof(StrandKey), strands.keys.size());
  if (mesh.shape != Shape::spheres)
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT,
                               strands.segments.data(), 0, sizeof(uint32_t),
                               strands.segments.size());
  has_hairs |= mesh.shape != Shape::spheres;
  if (mesh.shape == Shape::ribbons)
    rtcSetGeometryTessellationRate(g, static_cast<float>(strands.ribbon_pieces));
  if (mesh.shape == Shape::tubes) {
    rtcSetGeometryIntersectFilterFunction(g, skip_inside);
    rtcSetGeometryOccludedFilterFunction(g, skip_inside);
  }
  rtcSetGeometryMask(g, ~0u);
  return geometry;
}

RTCScene Accel::State::mesh_scene(const Mesh& mesh, uint32_t index) {
  if (!mesh_scenes[index]) {
    RtcScene scene = new_scene();
    const Geometry geometry = new_mesh_geometry(mesh);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene.get(), geometry.get());
    if (!commit(scene.get())) return nullptr;
    mesh_scenes[index] = std::move(scene);
  }
  return mesh_scenes[index].get();
}

// A second tree over a geometry of the top level: few objects need one.
RTCScene Accel::State::alone(RTCGeometry geometry) {
  RtcScene scene = new_scene();
  rtcAttachGeometry(scene.get(), geometry);
  if (!commit(scene.get())) return nullptr;
  return alone_scenes.emplace_back(std::move(scene)).get();
}

void Accel::State::attach(const Instance& instance, uint32_t index, const Mesh& mesh) {
  if (mesh.is_empty() || !is_usable(instance)) return;
  Geometry geometry;
  if (mesh.is_world_space) {
    geometry = new_mesh_geometry(mesh);
  } else {
    const RTCScene inner = mesh_scene(mesh, instance.mesh);
    if (inner == nullptr) return;
    geometry.reset(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    check();
    rtcSetGeometryInstancedScene(geometry.get(), inner);
    const auto& motion = instance.motion;
    const size_t steps = std::max<size_t>(motion.size(), 1);
    rtcSetGeometryTimeStepCount(geometry.get(), static_cast<unsigned>(steps));
    for (unsigned i = 0; i < steps; ++i)
      rtcSetGeometryTransform(geometry.get(), i, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                              motion.empty() ? &instance.object_to_world : &motion[i]);
    instance_scenes[index] = inner;
    world_to_object[index] = instance.world_to_object;
    is_instanced[index] = 1;
  }
  rtcSetGeometryMask(geometry.get(), instance.visibility.bits | k_any_kind);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(top.get(), geometry.get(), index);
  if (mesh.is_world_space && instance.is_searched_alone)
    instance_scenes[index] = alone(geometry.get());
  is_attached[index] = 1;
  check();
}

bool Accel::State::commit(RTCScene scene) {
  rtcSetSceneProgressMonitorFunction(
      scene,
      [](void* flag, double) { return !static_cast<const std::atomic<bool>*>(flag)->load(); },
      const_cast<std::atomic<bool>*>(cancelled));
  rtcCommitScene(scene);
  rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);  // the flag need not live on
  if (cancelled->load()) return false;
  check();
  return true;
}

static_assert(sizeof(Transform) == 12 * sizeof(float), "Embree reads it as 3x4, column by column");

Accel::Accel() : state_(std::make_unique<State>()) {}
Accel::~Accel() = default;

std::shared_ptr<const Accel> Accel::build(std::span<const Mesh> meshes,
                                          std::span<const Instance> instances,
                                          const std::atomic<bool>& cancelled) {
  std::shared_ptr<Accel> accel(new Accel);
  State& state = *accel->state_;
  state.cancelled = &cancelled;
  state.open_device();
  state.mesh_scenes.resize(meshes.size());
  state.instance_scenes.resize(instances.size());
  state.world_to_object.resize(instances.size());
  state.is_attached.resize(instances.size());
  state.is_instanced.resize(instances.size());
  state.top = state.new_scene();
  for (uint32_t i = 0; i < instances.size() && !cancelled.load(); ++i)
    if (instances[i].mesh < meshes.size()) state.attach(instances[i], i, meshes[instances[i].mesh]);
  const bool is_complete = !cancelled.load() && state.commit(state.top.get());
  state.cancelled = nullptr;
  if (!is_complete) return std::shared_ptr<const Accel>(new Accel);
  return accel;
}

std::optional<Hit> Accel::intersect(const Ray& ray, uint32_t mask, FaceId left) const {
  if (!state_->top) return {};
  if (!state_->accepts(ray)) return {};
  if (state_->has_hairs) return state_->intersect_among_hairs(ray, mask, left);
  RTCRayHit query = unanswered(ray, mask);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(state_->top.get(), &context, &query);
  return answer(query);
}

std::optional<Hit> Accel::State::intersect_among_hairs(const Ray& ray, uint32_t mask,
                                                       FaceId left) const {
  RTCRayHit query = unanswered(ray, mask, ray.behind);
  FilterContext context;
  rtcInitIntersectContext(&context.embree);
  if (left.is_known()) {
    context.embree.filter = skip_face;
    context.left = left;
  }
  rtcIntersect1(top.get(), &context.embree, &query);
  query.ray.tfar -= ray.behind;
  return answer(query);
}

size_t Accel::intersect_all(const Ray& ray, uint32_t mask, std::span<Hit> hits) const {
  if (!state_->top) return 0;
  if (!state_->accepts(ray)) return 0;
  RTCRayHit query = unanswered(ray, mask);
  FilterContext context;
  rtcInitIntersectContext(&context.embree);
  context.embree.filter = collect;
  context.hits = hits;
  rtcIntersect1(state_->top.get(), &context.embree, &query);
  return context.count;
}

bool Accel::occluded(const Ray& ray, uint32_t mask) const {
  if (!state_->top) return false;
  if (!state_->accepts(ray)) return false;
  RTCRay query = to_embree(ray, mask);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(state_->top.get(), &context, &query);
  return query.tfar < 0.0f;
}

bool Accel::occluded(const Ray& ray, uint32_t mask, Blocker& blocker) const {
  if (!state_->top) return false;
  if (!state_->accepts(ray)) return false;
  RTCRay query = to_embree(ray, mask);
  FilterContext context;
  rtcInitIntersectContext(&context.embree);
  context.embree.filter = ask_blocker;
  context.blocker = &blocker;
  rtcOccluded1(state_->top.get(), &context.embree, &query);
  return query.tfar < 0.0f;
}

RTCScene Accel::State::scene_of(uint32_t instance, const Transform* to_object, Ray& ray) const {
  if (!top || instance >= is_attached.size() || !is_attached[instance]) return nullptr;
  if (is_instanced[instance]) {
    if (to_object == nullptr) to_object = &world_to_object[instance];
    // Not normalised again: `t` stays in metres of the world.
    ray.origin = to_object->point(ray.origin);
    ray.direction = to_object->vector(ray.direction);
  }
  if (!accepts(ray)) return nullptr;
  return instance_scenes[instance] != nullptr ? instance_scenes[instance] : top.get();
}

std::optional<Hit> Accel::intersect_instance(const Ray& ray, uint32_t instance,
                                             const Transform* world_to_object) const {
  Ray local = ray;
  const RTCScene scene = state_->scene_of(instance, world_to_object, local);
  if (scene == nullptr) return {};
  RTCRayHit query = unanswered(local, k_any_kind);
  FilterContext context;
  rtcInitIntersectContext(&context.embree);
  context.instance = instance;
  if (scene == state_->top.get()) context.embree.filter = keep_one_instance;
  rtcIntersect1(scene, &context.embree, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return Hit{query.ray.tfar, query.hit.u, query.hit.v, query.hit.primID, instance};
}

size_t Accel::intersect_all_of_instance(const Ray& ray, uint32_t instance,
                                        const Transform& world_to_object,
                                        std::span<Hit> hits) const {
  Ray local = ray;
  const RTCScene scene = state_->scene_of(instance, &world_to_object, local);
  if (scene == nullptr) return 0;
  RTCRayHit query = unanswered(local, k_any_kind);
  FilterContext context;
  rtcInitIntersectContext(&context.embree);
  context.embree.filter = collect;
  context.hits = hits;
  const bool is_shared = scene == state_->top.get();
  if (is_shared) context.instance = instance;
  rtcIntersect1(scene, &context.embree, &query);
  for (size_t i = 0; i < context.count; ++i)
    hits[i].instance = instance;
  return context.count;
}

Bounds3 Accel::bounds() const {
  Bounds3 box;
  if (!state_->top) return box;
  RTCBounds b;
  rtcGetSceneBounds(state_->top.get(), &b);
  if (!(b.lower_x <= b.upper_x)) return box;
  box.min = {b.lower_x, b.lower_y, b.lower_z};
  box.max = {b.upper_x, b.upper_y, b.upper_z};
  return box;
}

size_t Accel::memory_bytes() const {
  return state_->memory.load(std::memory_order_relaxed);
}
uint64_t Accel::rejected_rays() const {
  return state_->rejected.load(std::memory_order_relaxed);
}

std::string Accel::embree_version() {
  const Device device(rtcNewDevice("verbose=0"));
  if (!device) return "none";
  const auto part = [&device](RTCDeviceProperty p) {
    return std::to_string(rtcGetDeviceProperty(device.get(), p));
  };
  return part(RTC_DEVICE_PROPERTY_VERSION_MAJOR) + "." + part(RTC_DEVICE_PROPERTY_VERSION_MINOR) +
         "." + part(RTC_DEVICE_PROPERTY_VERSION_PATCH);
}

}  // namespace tenniel
