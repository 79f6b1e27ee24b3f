// SPDX-License-Identifier: Apache-2.0
#include "shading/shading_context.h"

namespace tenniel {

void ShadingContext::begin(uint8_t wanted_query) {
  query = wanted_query;
  emission = Spectrum();
  transparency = Spectrum();
  holdout = 0.0f;
  if (wanted_query & k_query_volume) medium = MediumProperties();
  bend_shading_normal(surface.shading_normal);
}

void ShadingContext::bend_shading_normal(Vec3 normal) {
  surface.shading_normal = normal;
  closure_normal = normal;
  bsdf.begin(surface.geometric_normal, normal, surface.wo, is_on_hair(surface));
}

}  // namespace tenniel
