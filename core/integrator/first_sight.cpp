// SPDX-License-Identifier: Apache-2.0
#include "integrator/first_sight.h"

namespace tenniel {

void FirstSight::run_aovs() const {
  context.query = k_query_aov;
  scene.material_at(context.surface, state.info.world).aovs.run(context);
}

bool FirstSight::hold_out() const {
  const SurfaceInteraction& at = context.surface;
  const bool is_object = at.instance->is_holdout;
  const float holdout = is_object ? 1.0f - mean(context.transparency) : context.holdout;
  if (!(holdout > 0.0f)) return false;
  result.transparency += mean(state.throughput) * holdout;
  if (!is_object) return holdout >= 1.0f;
  context.emission = Spectrum();
  context.bsdf.begin(at.geometric_normal, at.shading_normal, at.wo);
  context.bsdf.add(Transparent(), context.transparency, at.geometric_normal);
  context.bsdf.finish();
  return false;
}

void FirstSight::record_surface() const {
  const float alpha = saturate(1.0f - mean(context.transparency));
  if (alpha < settings.pass_alpha_threshold) return;
  state.is_recorded = true;
  result.depth = scene.camera.depth(context.surface.position);
  result.normal = state.ends_after_transparent || context.bsdf.empty()
                      ? context.surface.shading_normal
                      : context.bsdf.average_normal();
}

}  // namespace tenniel
