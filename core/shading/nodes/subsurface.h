// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shading/shading_context.h"

namespace tenniel {

// What Subsurface Scattering and Principled BSDF ask for in common.
struct SubsurfaceRequest {
  SubsurfaceMethod method = SubsurfaceMethod::random_walk;
  Spectrum color;
  Vec3 radius;  // metres
  float ior = 1.4f, anisotropy = 0.0f;
  Vec3 normal;
};

// Adds the lobe; a diffuse one in the channels whose radius is too small to be seen.
void add_subsurface(ShadingContext& context, const SubsurfaceRequest& request, Spectrum weight);
// With the Fresnel terms and the retro-reflection of Principled BSDF.
void add_subsurface(ShadingContext& context, const SubsurfaceRequest& request, Spectrum weight,
                    float roughness);

}  // namespace tenniel
