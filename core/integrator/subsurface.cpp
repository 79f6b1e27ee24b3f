// SPDX-License-Identifier: Apache-2.0
#include "integrator/subsurface.h"

#include <algorithm>

namespace tenniel {

size_t ObjectBelow::intersect_all(const Ray& ray, std::span<Hit> hits) const {
  const size_t count = scene_.accel->intersect_all_of_instance(ray, instance_, to_object_, hits);
  std::sort(hits.begin(), hits.begin() + static_cast<std::ptrdiff_t>(count),
            [](const Hit& a, const Hit& b) { return a.t != b.t ? a.t < b.t : a.face < b.face; });
  return count;
}

std::optional<SubsurfaceExit> find_exit(const Scene& scene, const Subsurface& lobe,
                                        const SubsurfaceEntry& entry) {
  const ObjectBelow object(scene, entry.at);
  return lobe.method == SubsurfaceMethod::christensen_burley ? probe_nearby(object, lobe, entry)
                                                             : walk_below(object, lobe, entry);
}

void shade_exit(const Scene& scene, const Subsurface& lobe, const PathInfo& path,
                ShadingContext& context) {
  const SurfaceInteraction& at = context.surface;
  const Material& material = scene.material_at(at, path.world);
  Vec3 normal = at.shading_normal;
  if (material.bends_subsurface) {
    begin_surface(scene, material, path, k_query_scatter, context);
    material.surface.run(context);
    normal = context.bsdf.subsurface_normal();
  }
  // Whence the light came does not matter: seen along its normal, no lobe needs to be raised.
  context.bsdf.begin(at.geometric_normal, at.shading_normal, normal);
  if (lobe.has_fresnel)
    context.bsdf.add(PrincipledDiffuse{0.0f, PrincipledDiffuseTerms::lambert_exit}, Spectrum(1.0f),
                     normal);
  else
    context.bsdf.add(Diffuse{}, Spectrum(1.0f), normal);
  context.bsdf.finish();
}

}  // namespace tenniel
