// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace tenniel {

// What kind of event a lobe makes; decides the RayKind and the bounce counter of what follows.
// Diffuse and glossy reflect; transmission goes through (rough, sharp or diffuse); transparent
// passes straight on as if nothing were there.
enum class LobeClass : uint8_t { diffuse = 1, glossy = 2, transmission = 4, transparent = 8 };

struct LobeSet {
  uint8_t bits = 0;

  static constexpr LobeSet none() { return {0}; }
  static constexpr LobeSet all() { return {15}; }
  static constexpr LobeSet of(LobeClass c) { return {static_cast<uint8_t>(c)}; }
  constexpr bool has(LobeClass c) const { return (bits & static_cast<uint8_t>(c)) != 0; }
  constexpr LobeSet with(LobeClass c) const {
    return {static_cast<uint8_t>(bits | static_cast<uint8_t>(c))};
  }
  constexpr LobeSet without(LobeClass c) const {
    return {static_cast<uint8_t>(bits & ~static_cast<uint8_t>(c))};
  }
  constexpr bool empty() const { return bits == 0; }
};
constexpr LobeSet operator&(LobeSet a, LobeSet b) {
  return {static_cast<uint8_t>(a.bits & b.bits)};
}
constexpr LobeSet operator|(LobeSet a, LobeSet b) {
  return {static_cast<uint8_t>(a.bits | b.bits)};
}

}  // namespace tenniel
