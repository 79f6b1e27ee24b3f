// SPDX-License-Identifier: Apache-2.0
#include "integrator/path_tracer.h"

#include <new>

#include "integrator/direct_light.h"
#include "integrator/first_sight.h"
#include "integrator/limits.h"
#include "integrator/media_transmittance.h"
#include "integrator/subsurface.h"

namespace tenniel {

namespace {

// Cycles' least share of a lobe where the camera sees it first.
constexpr float k_least_share_at_first = 0.125f;
// A path that only passes through surfaces ends here whatever the settings say.
constexpr uint32_t k_max_vertices = 1024;

}  // namespace

bool PathTracer::start(Vec2 raster) {
  worker_.sampler.set_dimension(PathIntegrator::k_caller_dimensions);
  const Vec2 lens_u = worker_.sampler.get_2d();
  const float time = scene_.has_motion ? worker_.sampler.get_1d() : 0.0f;
  const auto camera_ray = scene_.camera.sample_ray(raster, lens_u, time);
  if (!camera_ray) return false;
  state_.ray = camera_ray->ray;
  state_.cone = camera_ray->cone;
  state_.length_before = -camera_ray->ray.t_min;
  state_.info.world = static_cast<WorldIndex>(settings_.start_world);
  if (scene_.has_media) start_in_media();
  return true;
}

void PathTracer::follow() {
  while (is_under_way_ && meet_surface())
    leave_surface();
}

void PathTracer::follow_alone() {
  leave_surface();
  follow();
}

bool PathTracer::reach_fork() {
  while (is_under_way_ && meet_surface()) {
    const ShadingContext& met = worker_.surface;
    if (!is_boundary(met.surface) && !met.bsdf.is_certain()) return result_.has_forked = true;
    leave_surface();
  }
  return false;
}

bool PathTracer::leave_fork() {
  stream_.forget();
  numbers_ = stream_.take(worker_.sampler, state_.vertices);
  const uint32_t left = state_.vertices;
  leave_surface();
  // Below a surface and out again is a vertex more.
  return state_.vertices == left + 1;
}

void PathTracer::return_to_fork() {
  evaluate(arrive(hit_));
}

void PathTracer::leave_surface() {
  is_under_way_ = scatter();
  ++state_.vertices;
}

// Goes on to the next surface and shades it. False if the path ends before.
bool PathTracer::meet_surface() {
  for (; state_.vertices < k_max_vertices; ++state_.vertices) {
    const uint32_t mask = ray_mask(state_.info.world, state_.info.kind);
    const auto hit = scene_.accel->intersect(state_.ray, mask, state_.left);
    if (!hit && !scene_.has_media) {
      leave_scene();
      return false;
    }
    if (roulette_.probability < 1.0f) settle_roulette(true);
    roulette_ = {};
    add_lamps(hit ? hit->t : k_infinity);
    if (scene_.has_media) {
      const MediumEvent event = walk_media(hit ? hit->t : k_infinity);
      if (event == MediumEvent::ended) return false;
      if (event == MediumEvent::scattered) continue;
    }
    if (!hit) {
      add_background();
      return false;
    }
    hit_ = *hit;
    return shade();
  }
  return false;
}

// False if nothing is left of the path.
bool PathTracer::shade() {
  // The numbers are made while the face comes from memory.
  scene_.prefetch(hit_);
  numbers_ = stream_.take(worker_.sampler, state_.vertices);
  const SurfaceInteraction& at = arrive(hit_);
  if (is_boundary(at)) return true;
  evaluate(at);
  const FirstSight sight{scene_, settings_, state_, worker_.surface, result_};
  sight.write_aovs();
  if (sight.apply_holdout()) return false;
  add_emission(at);
  sight.record();
  return true;
}

// Of a medium, with no surface to see.
bool PathTracer::is_boundary(const SurfaceInteraction& at) const {
  return scene_.has_media && !scene_.material_at(at, state_.info.world).has_surface;
}

// Light from lamps, and on in a new direction. False if the path ends.
bool PathTracer::scatter() {
  const SurfaceInteraction& at = worker_.surface.surface;
  const WorldGroups groups = world_groups(at.instance->looking_glass, state_);
  if (is_boundary(at)) return pass_on(at, groups.of(LobeClass::transparent));
  const Bsdf& bsdf = worker_.surface.bsdf;
  const ShadingPoint point{at.position, at.shading_normal,
                           !bsdf.smooth_lobes().has(LobeClass::transmission)};
  add_direct_light(groups, point);
  return bounce(at, groups, point);
}

void PathTracer::add(Spectrum radiance, int bounces, bool is_through_glass) {
  add_to_pixel(clamped(state_.throughput * radiance, bounces, settings_), is_through_glass);
}

void PathTracer::add_to_pixel(Spectrum seen, bool is_through_glass) {
  result_.radiance += seen;
  if (is_through_glass) result_.dream_radiance += seen;
}

// Makes the interaction in its place: std::construct_at would take a copy of it, which waits for
// every number to reach memory.
const SurfaceInteraction& PathTracer::arrive(const Hit& hit) {
  SurfaceInteraction* at = &worker_.surface.surface;
  ::new (at) SurfaceInteraction(scene_.interaction(state_.ray, hit, state_.cone.radius_at(hit.t)));
  at->t += state_.length_before;
  return *at;
}

// Light met by chance counts as the bounce before it did.
void PathTracer::add_lamps(float t_max) {
  if (scene_.hittable_lamps.empty()) return;
  const Spectrum radiance = lamps_met(scene_, state_, t_max, worker_);
  if (!is_black(radiance)) add(radiance, state_.info.ray_depth - 1, state_.has_entered);
}

void PathTracer::add_background() {
  if (state_.sees_background && settings_.film_transparent) {
    result_.transparency += mean(state_.throughput);
    return;
  }
  const World& world = scene_.worlds[state_.info.world];
  if (!world.material.emits || !world.visibility.seen_by(state_.info.world, state_.info.kind))
    return;
  const Spectrum radiance =
      background_radiance(scene_, world, state_.ray.direction, state_.info, worker_.light);
  add(radiance * background_weight(scene_, state_), state_.info.ray_depth - 1, state_.has_entered);
}

// The media of the first segment begin where the camera sees from.
void PathTracer::start_in_media() {
  Ray& ray = state_.ray;
  ray.origin = ray.at(ray.t_min);
  ray.t_max -= ray.t_min;
  ray.t_min = state_.length_before = 0.0f;
  state_.media = media_around(scene_, ray.origin, state_.info.world);
}

// Takes the path through what fills the segment before it, part by part.
MediumEvent PathTracer::walk_media(float length) {
  if (state_.media.empty() && !scene_.worlds[state_.info.world].material.has_volume)
    return MediumEvent::passed;
  const float skipped = state_.skipped_before;
  for (uint32_t part = 0;; ++part) {
    const VolumeWalk walk(scene_, settings_, state_, length, part, worker_);
    const MediumEvent event = walk.is_vacuum() ? MediumEvent::passed : walk_part(walk);
    if (event != MediumEvent::passed) return event;
    if (!walk.is_cut()) break;
    // The ray stays where it is, and with it what lies at its end.
    state_.skipped_before = -walk.covered();
  }
  state_.skipped_before = skipped;
  return MediumEvent::passed;
}

MediumEvent PathTracer::walk_part(const VolumeWalk& walk) {
  add(walk.emission(), state_.info.ray_depth - 1, state_.has_entered);
  add(walk.lamp_light(state_, worker_), state_.info.ray_depth, state_.has_entered);
  const MediumEvent event = walk.advance(state_, worker_);
  if (event != MediumEvent::scattered) return event;
  const bool goes_on = survives(worker_.sampler.get_1d()) &&
                       (!state_.ends_after_transparent || may_still_meet_light());
  return goes_on ? event : MediumEvent::ended;
}

void PathTracer::evaluate(const SurfaceInteraction& at) {
  const Material& material = scene_.material_at(at, state_.info.world);
  ShadingContext& context = worker_.surface;
  const uint8_t query =
      state_.ends_after_transparent ? k_query_emission | k_query_transparency : k_query_surface;
  begin_surface(scene_, material, state_.info, query, context);
  material.surface.run(context);
  if (state_.ends_after_transparent) return;

  Bsdf& bsdf = context.bsdf;
  if (!is_black(context.transparency))
    bsdf.add(Transparent(), context.transparency, at.geometric_normal);
  if (state_.info.kind == RayKind::diffuse)
    bsdf.drop_caustics(!settings_.caustics_reflective, !settings_.caustics_refractive);
  const bool is_first = state_.info.ray_depth + state_.info.transparent_depth == 0;
  bsdf.finish(is_first ? k_least_share_at_first : 0.0f);
  const float alpha = filter_glossy_alpha(state_.min_pdf, settings_);
  if (alpha > 0.0f) bsdf.widen(alpha);
}

void PathTracer::add_emission(const SurfaceInteraction& at) {
  const Spectrum emission = worker_.surface.emission;
  if (is_black(emission)) return;
  add(emission * surface_emission_weight(scene_, state_, at), state_.info.ray_depth - 1,
      state_.has_entered);
}

// Decided before the ray is traced: a path that ends costs no ray more.
bool PathTracer::survives(float u) {
  const float probability = survival_probability(state_, settings_);
  if (probability >= 1.0f) return true;
  if (u >= probability) return false;
  state_.throughput *= 1.0f / probability;
  return true;
}

// The same after a bounce. Where the World shines the game is for what surfaces bring: the World is
// met by chance, in part or at all, and a path that ended before it would leave that to luck twice.
bool PathTracer::survives_bounce(const SurfaceInteraction& at, const BsdfSample& sample) {
  roulette_ = {};
  roulette_.probability = survival_probability(state_, settings_);
  guess_bounce(at, sample);
  const bool goes_on = numbers_.roulette < roulette_.probability;
  if (!may_reach_world()) {
    settle_roulette(goes_on);
    return goes_on;
  }
  if (goes_on) return true;
  if (scene_.accel->occluded(state_.ray, ray_mask(state_.info.world, state_.info.kind)))
    settle_roulette(false);
  else
    leave_scene();
  return false;
}

void PathTracer::guess_bounce(const SurfaceInteraction& at, const BsdfSample& sample) {
  const float cosine = dot(at.geometric_normal, sample.wi);
  if (state_.ends_after_transparent || !sample.is_diffuse || !(cosine > 0.0f)) return;
  const WorldIndex world = state_.info.world;
  if (worker_.recorder) {
    const float weight = std::min(cosine * k_inv_pi / sample.pdf, 4.0f);
    roulette_.is_recorded = worker_.recorder->diffuse_bounce(
        {at.position, at.geometric_normal, world, {}, weight}, state_.throughput, result_.radiance);
  }
  if (cache_ && roulette_.probability < 1.0f)
    roulette_.guess = cache_->find(at.position, at.geometric_normal, world);
}

bool PathTracer::may_reach_world() const {
  const World& world = scene_.worlds[state_.info.world];
  if (roulette_.guess && !roulette_.guess->sees_world) return false;
  return world.material.emits && !scene_.has_media &&
         world.visibility.seen_by(state_.info.world, state_.info.kind);
}

// A path expected to bring C goes on with probability p and brings C + (X - C) / p; otherwise it
// brings C. The mean is that of X whatever C is, and the noise of the roulette is that of X - C
// alone.
void PathTracer::settle_roulette(bool goes_on) {
  const float scale = goes_on ? 1.0f / roulette_.probability : 0.0f;
  if (roulette_.guess)
    add_to_pixel(state_.throughput * roulette_.guess->from_surfaces * (1.0f - scale),
                 state_.has_entered);
  state_.throughput *= scale;
  roulette_ = {};
}

// No surface ahead, so there was no game.
void PathTracer::leave_scene() {
  if (roulette_.is_recorded) worker_.recorder->leave_scene();
  roulette_ = {};
  add_lamps(k_infinity);
  add_background();
}

void PathTracer::add_direct_light(const WorldGroups& groups, const ShadingPoint& point) {
  if (state_.ends_after_transparent || sees_emission_only(state_, settings_)) return;
  const LobeSet smooth = worker_.surface.bsdf.smooth_lobes();
  const auto add_group = [&](const WorldGroup& group, const LightNumbers& u) {
    const Spectrum radiance = direct_light(scene_, settings_, state_, group, point, u, worker_);
    if (!is_black(radiance))
      add(radiance, state_.info.ray_depth, state_.has_entered || group.enters);
  };
  const bool keeps = !(smooth & groups.keeping.lobes).empty();
  const LightNumbers of_vertex{numbers_.light, numbers_.on_light};
  if (keeps) add_group(groups.keeping, of_vertex);
  if ((smooth & groups.entering.lobes).empty()) return;
  // A glass whose lobes all enter is an ordinary mirror, number for number.
  if (!keeps) return add_group(groups.entering, of_vertex);
  // One sample each: choosing one group by albedo saves 5 % of the rays of a room of such mirrors
  // and costs 22 % more variance.
  const float choice = worker_.sampler.get_1d();
  add_group(groups.entering, {choice, worker_.sampler.get_2d()});
}

// Into the world that the lobes of `group` lead to, and into the media there.
void PathTracer::enter(const WorldGroup& group, const SurfaceInteraction& at, Vec3 direction) {
  if (scene_.has_media) {
    const SegmentStart start =
        segment_from(scene_, at, direction, state_.media, state_.info.world, group.world);
    state_.media = start.media;
    state_.skipped_before = start.skipped;
  }
  state_.info.world = group.world;
  if (!group.enters) return;
  if (!state_.has_entered && state_.is_specular_so_far) result_.dream = group.world;
  state_.has_entered = true;
}

// Continues behind the surface as if it were not there.
bool PathTracer::pass_through(const SurfaceInteraction& at, Spectrum weight,
                              const WorldGroup& group) {
  state_.throughput *= weight;
  ++state_.info.transparent_depth;
  return pass_on(at, group);
}

// The same for a boundary between media alone, which counts as nothing.
bool PathTracer::pass_on(const SurfaceInteraction& at, const WorldGroup& group) {
  enter(group, at, state_.ray.direction);
  state_.cone.radius = at.footprint;
  state_.ray.behind += at.t - state_.length_before;
  state_.left = {at.face, scene_.index_of(*at.instance)};
  state_.ray.origin = offset_ray_origin(at, state_.ray.direction);
  state_.ray.t_min = 0.0f;
  state_.ray.t_max -= at.t - state_.length_before;
  state_.length_before = at.t;
  return state_.ray.t_max > 0.0f;
}

bool PathTracer::bounce(const SurfaceInteraction& at, const WorldGroups& groups,
                        const ShadingPoint& point) {
  if (sees_emission_only(state_, settings_)) return false;
  const ShadingContext& context = worker_.surface;
  if (state_.ends_after_transparent) {
    const WorldGroup& group = groups.of(LobeClass::transparent);
    return !is_black(context.transparency) && pass_through(at, context.transparency, group);
  }
  auto sample = context.bsdf.sample(numbers_.wi);
  if (!sample) return false;
  if (sample->subsurface) return scatter_below(at, *sample);
  const WorldGroup& group = groups.of(sample->lobe_class);
  if (sample->lobe_class == LobeClass::transparent) return pass_through(at, sample->weight, group);

  // Where lobes lead to different worlds a direction is worth what its own group makes of it.
  const LobeSet lobes = context.bsdf.lobes();
  const bool is_mixed =
      !(lobes & groups.entering.lobes).empty() && !(lobes & groups.keeping.lobes).empty();
  if (is_mixed && !sample->is_delta) {
    const BsdfEval own = context.bsdf.eval(sample->wi, group.lobes, group.lobes);
    if (!(own.pdf > 0.0f)) return false;
    sample->weight = own.value / own.pdf;
    sample->pdf = own.pdf;
  }
  state_.throughput *= sample->weight;
  if (!(max_component(state_.throughput) > 0.0f)) return false;
  enter(group, at, sample->wi);
  state_.origin_saw_many_lights = state_.is_specular_so_far;
  count_bounce(state_, *sample, settings_);
  state_.pdf = sample->is_delta ? 0.0f : sample->pdf;
  if (!sample->is_delta) state_.min_pdf = std::min(state_.min_pdf, sample->pdf);
  state_.origin = point;
  // As wide as at first sight: a bump's heights apart by what a rough bounce spreads would be flat.
  state_.cone.radius = at.footprint;
  state_.begin_segment(offset_ray_origin(at, sample->wi), sample->wi);
  return (!state_.ends_after_transparent || may_still_meet_light()) && survives_bounce(at, *sample);
}

// Below the surface of the object and out again, as one vertex more that counts as no bounce: its
// diffuse lobe is what the light at the exit meets.
bool PathTracer::scatter_below(const SurfaceInteraction& at, const BsdfSample& sample) {
  const Subsurface lobe = *sample.subsurface;
  const float footprint = at.footprint;
  const SubsurfaceEntry entry{at,
                              sample.wi,
                              state_.throughput * sample.weight,
                              sample.u_below,
                              numbers_.roulette,
                              worker_.sampler,
                              state_.vertices};
  const auto exit = find_exit(scene_, lobe, entry);
  if (!exit || !is_finite(exit->throughput)) return false;
  state_.throughput = exit->throughput;
  SurfaceInteraction& out = worker_.surface.surface;  // was `at`
  out = scene_.interaction(exit->ray, exit->hit, footprint);
  if (!scene_.filled_instances.empty())
    state_.media = media_around(scene_, offset_ray_origin(out, out.wo), state_.info.world);
  shade_exit(scene_, lobe, state_.info, worker_.surface);
  ++state_.vertices;
  numbers_ = stream_.take(worker_.sampler, state_.vertices);
  const WorldGroups groups = world_groups(out.instance->looking_glass, state_);
  const ShadingPoint point{out.position, out.shading_normal, true};
  add_direct_light(groups, point);
  return bounce(out, groups, point);
}

// The last segment of a path can only pick up light: where none lies ahead it need not be traced.
bool PathTracer::may_still_meet_light() {
  if (scene_.has_emissive_surfaces || scene_.has_emissive_media) return true;
  if (scene_.worlds[state_.info.world].material.emits) return true;
  return !scene_.hittable_lamps.empty() &&
         !is_black(lamps_met(scene_, state_, k_infinity, worker_));
}

}  // namespace tenniel
