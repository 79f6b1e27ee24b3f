// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/cancellation.h"
#include "scene/diagnostics.h"
#include "scene/scene.h"

namespace tenniel {

// Moves the vertices of `mesh` (object space still) as the materials of `user` displace them, those
// of this side. Each vertex moves once, as the first face that has it says. Where the method is not
// BOTH the smooth normals follow. What is not finite stays where it is, with a report.
void displace(const Scene& scene, const Instance& user, Mesh& mesh, Diagnostics& diagnostics,
              const Cancellation& cancellation = {});

}  // namespace tenniel
