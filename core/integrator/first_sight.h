// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "integrator/path_integrator.h"
#include "integrator/path_state.h"

namespace tenniel {

// What the film notes of the surfaces that the camera sees by itself or through transparent ones.
// `context`: the surface that the path is at, evaluated.
struct FirstSight {
  const Scene& scene;
  const RenderSettings& settings;
  PathState& state;
  ShadingContext& context;
  SampleResult& result;

  // As Blender: every surface up to the first that is more than half opaque adds its own.
  void write_aovs() const {
    if (context.aovs && !state.is_recorded && state.sees_background) run_aovs();
  }
  // What is held out leaves a hole in the film. True when nothing is left of the path.
  bool apply_holdout() const { return state.sees_background && hold_out(); }
  // Depth and normal of the first surface that counts.
  void record() const {
    if (!state.is_recorded) record_surface();
  }

 private:
  void run_aovs() const;
  bool hold_out() const;
  void record_surface() const;
};

}  // namespace tenniel
