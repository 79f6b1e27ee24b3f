// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>

#include "integrator/radiance_cache.h"
#include "scene/description.h"
#include "scene/scene.h"

namespace tenniel {

// A first guess of the light, from a few thousand paths through the whole picture whatever its
// border: it depends on scene, seed and size alone, so that neither threads nor crop change a
// pixel. Null where it would not pay (few samples), is not wanted, or `cancelled`.
std::unique_ptr<const RadianceCache> learn_radiance(const Scene& scene,
                                                    const RenderSettings& settings,
                                                    const std::atomic<bool>& cancelled);

}  // namespace tenniel
