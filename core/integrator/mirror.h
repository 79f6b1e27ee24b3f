// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bsdf/lobe_class.h"
#include "geometry/instance.h"
#include "integrator/path_state.h"

// The looking glass: which world a path is in after each event at a surface.
namespace tenniel {

// Lobes whose event carries a path through the glass. Reflections of any roughness enter by
// default; diffuse lobes never do.
inline LobeSet entering_lobes(const LookingGlass& glass, const PathState& state) {
  if (glass.dream == 0) return LobeSet::none();
  if (glass.first_seen_only && !state.is_specular_so_far) return LobeSet::none();
  const LobeSet reflection = LobeSet::of(LobeClass::glossy);
  const LobeSet transmission = LobeSet::of(LobeClass::transmission).with(LobeClass::transparent);
  switch (glass.entry) {
    case MirrorEntry::reflection:
      return reflection;
    case MirrorEntry::transmission:
      return transmission;
    case MirrorEntry::both:
      return reflection | transmission;
  }
  return LobeSet::none();
}

// The world behind the glass for a path that enters from `world`.
inline WorldIndex world_after_entering(const LookingGlass& glass, WorldIndex world) {
  if (glass.reentry == MirrorReentry::toggle && world == glass.dream) return 0;
  return glass.dream;
}

// The lobes of one surface, parted by the world that a path is in after each.
struct WorldGroup {
  LobeSet lobes;
  WorldIndex world = 0;
  bool enters = false;  // goes through the glass
};
struct WorldGroups {
  WorldGroup keeping, entering;
  const WorldGroup& of(LobeClass lobe) const {
    return entering.lobes.has(lobe) ? entering : keeping;
  }
};

inline WorldGroups world_groups(const LookingGlass& glass, const PathState& state) {
  const WorldIndex here = state.info.world;
  const LobeSet entering = entering_lobes(glass, state);
  const LobeSet keeping{static_cast<uint8_t>(LobeSet::all().bits & ~entering.bits)};
  return {{keeping, here, false}, {entering, world_after_entering(glass, here), true}};
}

}  // namespace tenniel
