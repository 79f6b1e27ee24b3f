// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "bsdf/lobe.h"

// Every alternative of `Lobe` at the corners of its parameters: what all tests of lobes run over.
namespace tenniel {

struct LobeCase {
  std::string name;  // letters, digits and underscores
  Lobe lobe;
  float narrowest = 1.0f;  // about the smallest angle over which its value changes
};

inline void PrintTo(const LobeCase& c, std::ostream* out) {
  *out << c.name;
}

inline Fresnel gold() {  // complex index per channel (reference: equal-energy RGB of luxpop's data)
  return Fresnel::conductor({0.14304f, 0.37531f, 1.44205f}, {3.983f, 2.38556f, 1.60336f});
}

inline std::vector<LobeCase> diffuse_cases() {
  std::vector<LobeCase> cases{{"Diffuse", Diffuse{}},
                              {"PrincipledSheen", PrincipledSheen{}},
                              {"Translucent", Translucent{}}};
  for (const float sigma : {0.0f, 0.4f, 1.0f})
    cases.push_back(
        {"OrenNayar_" + std::to_string(static_cast<int>(sigma * 100)), OrenNayar{sigma}});
  for (const float sigma : {0.01f, 0.1f, 0.3f, 1.0f})
    cases.push_back({"Velvet_" + std::to_string(static_cast<int>(sigma * 100)), Velvet{sigma}});
  for (const float r : {0.0f, 0.5f, 1.0f})
    cases.push_back(
        {"PrincipledDiffuse_" + std::to_string(static_cast<int>(r * 100)), PrincipledDiffuse{r}});
  cases.push_back({"PrincipledLambert", PrincipledDiffuse{0.5f, PrincipledDiffuseTerms::lambert}});
  cases.push_back(
      {"PrincipledExit", PrincipledDiffuse{0.5f, PrincipledDiffuseTerms::lambert_exit}});
  cases.push_back(
      {"PrincipledRetro", PrincipledDiffuse{0.8f, PrincipledDiffuseTerms::retro_reflection}});
  return cases;
}

inline std::vector<LobeCase> microfacet_cases() {
  struct Alpha {
    const char* name;
    float x, y;
  };
  constexpr Alpha k_alphas[] = {
      {"0004", 4e-4f, 4e-4f}, {"001", 0.01f, 0.01f},   {"01", 0.1f, 0.1f},    {"05", 0.5f, 0.5f},
      {"1", 1.0f, 1.0f},      {"005x06", 0.05f, 0.6f}, {"1x002", 1.0f, 0.02f}};
  struct Eta {
    const char* name;
    float value;
  };
  constexpr Eta k_etas[] = {
      {"145", 1.45f}, {"inv145", 1.0f / 1.45f}, {"1001", 1.001f}, {"05", 0.5f}, {"3", 3.0f}};
  std::vector<LobeCase> cases;
  for (const auto distribution : {MicrofacetDistribution::ggx, MicrofacetDistribution::beckmann}) {
    const std::string kind = distribution == MicrofacetDistribution::ggx ? "Ggx" : "Beckmann";
    for (const Alpha& a : k_alphas) {
      const Microsurface surface{distribution, a.x, a.y};
      const float least = std::min(a.x, a.y);
      cases.push_back({kind + "Reflection_" + a.name, MicrofacetReflection{surface, {}}, least});
      for (const Eta& e : k_etas) {
        const MicrofacetRefraction lobe{surface, e.value};
        cases.push_back({kind + "Refraction_" + a.name + "_eta_" + e.name, lobe,
                         least * (1.0f - std::min(e.value, 1.0f / e.value))});
      }
    }
    cases.push_back(
        {kind + "Gold", MicrofacetReflection{{distribution, 0.2f, 0.3f}, gold()}, 0.2f});
    cases.push_back({kind + "Principled",
                     MicrofacetReflection{{distribution, 0.25f, 0.25f},
                                          Fresnel::principled({0.04f, 0.2f, 0.9f}, 1.45f)},
                     0.25f});
  }
  for (const float alpha : {4e-4f, 0.01f, 0.1f, 0.5f, 0.9999f, 1.0f})
    cases.push_back(
        {"Clearcoat_" + std::to_string(static_cast<int>(alpha * 10000)), Clearcoat{alpha}, alpha});
  return cases;
}

// Hairs, by what the artist sets: thin and thick, dark and clear, met in the middle and at the rim.
inline std::vector<LobeCase> fiber_cases() {
  struct Setting {
    const char* name;
    float along, around, coat, tilt, eta, offset;
    Spectrum absorption;
  };
  const Setting settings[] = {
      {"default", 0.3f, 0.3f, 0.0f, 0.0349f, 1.55f, 0.3f, {0.2f, 0.5f, 1.4f}},
      {"clear", 0.5f, 0.6f, 0.0f, 0.0f, 1.55f, -0.7f, {}},
      {"rim", 0.3f, 0.4f, 0.0f, -0.1f, 1.4f, 0.99f, {0.1f, 0.1f, 0.1f}},
      {"rough", 1.0f, 1.0f, 0.5f, 0.05f, 1.8f, 0.0f, {1.0f, 0.1f, 0.0f}},
      {"coated", 0.6f, 0.3f, 0.6f, 0.03f, 1.55f, -0.2f, {5.0f, 10.0f, 20.0f}}};
  std::vector<LobeCase> cases;
  for (const Setting& s : settings) {
    for (const bool is_primary : {true, false}) {
      HairFiber fiber = HairFiber::from_roughness(s.along, s.around, s.coat);
      fiber.tilt = s.tilt;
      fiber.eta = s.eta;
      fiber.offset = s.offset;
      fiber.absorption = s.absorption;
      fiber.is_primary = is_primary;
      cases.push_back({std::string(is_primary ? "FiberPrimary_" : "FiberInside_") + s.name, fiber,
                       (is_primary ? 0.5f : 0.1f) * s.along * (1.0f - s.coat)});
    }
  }
  return cases;
}

// Shapes without a microsurface behind them.
inline std::vector<LobeCase> artistic_cases() {
  std::vector<LobeCase> cases;
  for (const auto& [size, smooth] :
       {std::pair{0.5f, 0.0f}, {0.2f, 0.3f}, {0.8f, 0.6f}, {0.9f, 0.0f}, {0.0f, 0.5f}}) {
    const auto percent = [](float x) { return std::to_string(static_cast<int>(x * 100)); };
    const std::string name = percent(size) + "_" + percent(smooth);
    const float edge = smooth > 0.0f ? 1.0f : 0.01f;  // a hard one has no width
    cases.push_back({"DiffuseToon_" + name, DiffuseToon{{size, smooth}}, edge});
    cases.push_back({"GlossyToon_" + name, GlossyToon{{size, smooth}}, edge});
  }
  for (const bool passes : {false, true}) {
    const std::string kind = passes ? "HairTransmission_" : "HairReflection_";
    cases.push_back({kind + "default", HairLobe{0.1f, 1.0f, 0.0f, 0.0f, passes}, 0.1f});
    cases.push_back({kind + "offset", HairLobe{0.3f, 0.4f, 0.2f, 0.0f, passes}, 0.3f});
    cases.push_back({kind + "tilted", HairLobe{1.0f, 0.2f, -0.3f, 0.4f, passes}, 0.2f});
  }
  for (const auto& [x, y] : {std::pair{0.1f, 0.1f}, {0.5f, 0.5f}, {1.0f, 1.0f}, {0.1f, 0.6f}})
    cases.push_back({"AshikhminShirley_" + std::to_string(static_cast<int>(x * 100)) + "_" +
                         std::to_string(static_cast<int>(y * 100)),
                     AshikhminShirley{x, y}, std::min(x, y)});
  return cases;
}

inline std::vector<LobeCase> delta_cases() {
  return {{"Transparent", Transparent{}},
          {"Mirror", SpecularReflection{}},
          {"GoldMirror", SpecularReflection{gold()}},
          {"SharpRefraction_145", SpecularRefraction{1.45f}},
          {"SharpRefraction_inv145", SpecularRefraction{1.0f / 1.45f}},
          {"SmoothGgx", MicrofacetReflection{{MicrofacetDistribution::ggx, 0.0f, 0.0f}, gold()}},
          {"SmoothBeckmannRefraction",
           MicrofacetRefraction{{MicrofacetDistribution::beckmann, 1e-4f, 1e-4f}, 1.45f}},
          {"SmoothClearcoat", Clearcoat{0.0f}},
          {"SmoothAshikhminShirley", AshikhminShirley{1e-4f, 1e-4f}},
          {"IndexMatched", MicrofacetRefraction{{MicrofacetDistribution::ggx, 0.5f, 0.5f}, 1.0f}}};
}

// The lobes with a density.
inline std::vector<LobeCase> smooth_cases() {
  std::vector<LobeCase> cases = diffuse_cases();
  for (LobeCase& c : artistic_cases())
    cases.push_back(c);
  for (LobeCase& c : fiber_cases())
    cases.push_back(c);
  for (LobeCase& c : microfacet_cases())
    if (!visit_lobe([](const auto& l) { return l.is_delta(); }, c.lobe)) cases.push_back(c);
  return cases;
}

// Those whose samples follow it.
inline std::vector<LobeCase> exact_cases() {
  std::vector<LobeCase> cases = smooth_cases();
  std::erase_if(cases, [](const LobeCase& c) { return std::holds_alternative<Clearcoat>(c.lobe); });
  return cases;
}

inline std::vector<LobeCase> all_cases() {
  std::vector<LobeCase> cases = diffuse_cases();
  for (const auto& more : {artistic_cases(), fiber_cases(), microfacet_cases(), delta_cases()})
    cases.insert(cases.end(), more.begin(), more.end());
  return cases;
}

inline LobeEval eval(const Lobe& lobe, Vec3 wo, Vec3 wi) {
  return visit_lobe([&](const auto& l) { return l.eval(wo, wi); }, lobe);
}
// On a surface whose normal is not bent, which hides what leaves below the lobe's horizon.
inline std::optional<LobeSample> sample(const Lobe& lobe, Vec3 wo, Vec2 u) {
  auto s = visit_lobe([&](const auto& l) { return l.sample(wo, u); }, lobe);
  const bool may_leave_below =
      std::holds_alternative<MicrofacetReflection>(lobe) || std::holds_alternative<Clearcoat>(lobe);
  if (s && may_leave_below && !(s->wi.z > 0.0f)) s.reset();
  return s;
}

inline Vec3 direction(float theta_degrees, float phi_degrees) {
  const float theta = theta_degrees * (k_pi / 180.0f), phi = phi_degrees * (k_pi / 180.0f);
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

constexpr float k_angles[] = {0.0f, 5.0f, 30.0f, 45.0f, 60.0f, 75.0f, 85.0f, 89.0f};

}  // namespace tenniel
