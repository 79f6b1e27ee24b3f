// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "integrator/mirror.h"
#include "integrator/path_integrator.h"
#include "integrator/path_numbers.h"
#include "integrator/path_state.h"
#include "integrator/volume_walk.h"

namespace tenniel {

// The game after the last bounce, until it is settled.
struct Roulette {
  float probability = 1.0f;
  const RadianceCache::Guess* guess = nullptr;
  bool is_recorded = false;
};

// One path under way, or the common beginning of several. A copy is another path from there on.
class PathTracer {
 public:
  PathTracer(const Scene& scene, const RenderSettings& settings, const RadianceCache* cache,
             Worker& worker)
      : scene_(scene), settings_(settings), cache_(cache), worker_(worker) {}

  // Leaves the camera. False where the lens has no image.
  bool start(Vec2 raster);
  // Goes on to the first surface that may send paths different ways and shades it. False if the
  // path has ended before.
  bool reach_fork();
  // Leaves that surface with the numbers of the sample that the worker's sampler stands at. False
  // if the worker does not hold the surface any more.
  bool leave_fork();
  // Makes the worker hold it again, before any path has gone on.
  void return_to_fork();
  // Goes on to the end: after `leave_fork`, or from the fork as the only one.
  void follow();
  void follow_alone();
  const SampleResult& result() const { return result_; }

 private:
  bool meet_surface();
  void leave_surface();
  bool shade();
  bool scatter();
  bool is_boundary(const SurfaceInteraction& at) const;
  const SurfaceInteraction& arrive(const Hit& hit);
  void add(Spectrum radiance, int bounces, bool is_through_glass);
  void add_to_pixel(Spectrum seen, bool is_through_glass);
  void add_lamps(float t_max);
  void add_background();
  void add_emission(const SurfaceInteraction& at);
  void evaluate(const SurfaceInteraction& at);
  bool survives(float u);
  bool survives_bounce(const SurfaceInteraction& at, const BsdfSample& sample);
  void guess_bounce(const SurfaceInteraction& at, const BsdfSample& sample);
  bool may_reach_world() const;
  void settle_roulette(bool goes_on);
  void leave_scene();
  void add_direct_light(const WorldGroups& groups, const ShadingPoint& point);
  bool bounce(const SurfaceInteraction& at, const WorldGroups& groups, const ShadingPoint& point);
  bool scatter_below(const SurfaceInteraction& at, const BsdfSample& sample);
  bool may_still_meet_light();
  bool pass_through(const SurfaceInteraction& at, Spectrum weight, const WorldGroup& group);
  bool pass_on(const SurfaceInteraction& at, const WorldGroup& group);
  void enter(const WorldGroup& group, const SurfaceInteraction& at, Vec3 direction);
  void start_in_media();
  MediumEvent walk_media(float length);
  MediumEvent walk_part(const VolumeWalk& walk);

  const Scene& scene_;
  const RenderSettings& settings_;
  const RadianceCache* cache_;
  Worker& worker_;
  PathState state_;
  Hit hit_;  // of the surface that the path is at
  PathNumbers stream_;
  VertexNumbers numbers_{};  // of the vertex that the path is at
  Roulette roulette_;
  SampleResult result_;
  bool is_under_way_ = true;
};

}  // namespace tenniel
