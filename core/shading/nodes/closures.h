// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shading/node_type.h"

// The plain shaders, with the meaning they have in Blender 3.4. Roughness is squared to alpha.
namespace tenniel {

enum class GlossyDistribution : uint8_t { sharp, beckmann, ggx, ashikhmin_shirley, multi_ggx };
// A number that varies from sample to sample, for lobes that walk at random.
uint32_t walk_seed(const SurfaceInteraction& surface);

struct DiffuseNode {
  Input<float> weight;
  Input<Spectrum> color{Spectrum(0.8f)};
  Input<float> roughness{0.0f};
  Input<Vec3> normal;
  void eval(ShadingContext& context) const;
  uint8_t closure_parts() const { return k_query_scatter; }
};

struct GlossyNode {
  Input<float> weight;
  Input<Spectrum> color{Spectrum(0.8f)};
  Input<float> roughness{0.5f};
  Input<Vec3> normal;
  GlossyDistribution distribution = GlossyDistribution::ggx;
  void eval(ShadingContext& context) const;
  uint8_t closure_parts() const { return k_query_scatter; }
};

// A metal by its complex index eta + i k per channel, relative to air: the exact reflectance of
// each facet. No node of Blender's; the exporter puts it where it finds the add-on's Metal group.
struct ConductorNode {
  Input<float> weight;
  Input<Vec3> eta{{1.0f, 1.0f, 1.0f}}, k;
  Input<float> roughness{0.0f};
  Input<Vec3> normal;
  GlossyDistribution distribution = GlossyDistribution::ggx;
  void eval(ShadingContext& context) const;
  uint8_t closure_parts() const { return k_query_scatter; }
};

struct AnisotropicNode {
  Input<float> weight;
  Input<Spectrum> color{Spectrum(0.8f)};
  Input<float> roughness{0.5f}, anisotropy{0.5f}, rotation{0.0f};
  Input<Vec3> normal, tangent;
  GlossyDistribution distribution = GlossyDistribution::ggx;
  void eval(ShadingContext& context) const;
  uint8_t closure_parts() const { return k_query_scatter; }
};

struct GlassNode {
  Input<float> weight;
  Input<Spectrum> color{Spectrum(1.0f)};
  Input<float> roughness{0.0f}, ior{1.45f};
  Input<Vec3> normal;
  GlossyDistribution distribution = GlossyDistribution::beckmann;
  void eval(ShadingContext& context) const;
  uint8_t closure_parts() const { return k_query_scatter; }
};

struct RefractionNode {
  Input<float> weight;
  Input<Spectrum> color{Spectrum(1.0f)};
  Input<float> roughness{0.0f}, ior{1.45f};
  Input<Vec3> normal;
  GlossyDistribution distribution = GlossyDistribution::beckmann;
  void eval(ShadingContext& context) const;
  uint8_t closure_parts() const { return k_query_scatter; }
};

struct TranslucentNode {
  Input<float> weight;
  Input<Spectrum> color{Spectrum(0.8f)};
  Input<Vec3> normal;
  void eval(ShadingContext& context) const;
  uint8_t closure_parts() const { return k_query_scatter; }
};

struct VelvetNode {
  Input<float> weight;
  Input<Spectrum> color{Spectrum(0.8f)};
  Input<float> sigma{1.0f};
  Input<Vec3> normal;
  void eval(ShadingContext& context) const;
  uint8_t closure_parts() const { return k_query_scatter; }
};

// Adds to ShadingContext::transparency, not to the Bsdf: shadow rays and paths treat it alike.
struct TransparentNode {
  Input<float> weight;
  Input<Spectrum> color{Spectrum(1.0f)};
  void eval(ShadingContext& context) const;
  uint8_t closure_parts() const;
};

// Emission and Background differ in their defaults only.
struct EmissionNode {
  Input<float> weight;
  Input<Spectrum> color{Spectrum(1.0f)};
  Input<float> strength{1.0f};
  void eval(ShadingContext& context) const;
  uint8_t closure_parts() const;
  const char* note() const;
};

struct BackgroundNode {
  Input<float> weight;
  Input<Spectrum> color{Spectrum(0.8f)};
  Input<float> strength{1.0f};
  void eval(ShadingContext& context) const;
  uint8_t closure_parts() const;
  const char* note() const;
};

struct HoldoutNode {
  Input<float> weight;
  void eval(ShadingContext& context) const;
  uint8_t closure_parts() const { return k_query_scatter; }
};

// Index of the far side over that of wo's side; `ior` describes the object.
float relative_ior(const SurfaceInteraction& surface, float ior);

}  // namespace tenniel
