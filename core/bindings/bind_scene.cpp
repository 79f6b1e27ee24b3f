// SPDX-License-Identifier: Apache-2.0
#include <limits>
#include <utility>
#include <vector>

#include "bindings/bind.h"
#include "bindings/check_sizes.h"
#include "bindings/fields.h"
#include "scene/description.h"

namespace tenniel {

namespace {

constexpr int k_last_dream = 4;

void bind_mesh(py::module_& module) {
  Fields<AttributeDesc>(module, "AttributeDesc", "Values of an attribute: (elements, channels).")
      .field("name", &AttributeDesc::name)
      .choice("domain", {"POINT", "EDGE", "CORNER", "FACE"}, &AttributeDesc::domain)
      .ranged("channels", 1, 4, &AttributeDesc::channels)
      .field("data", &AttributeDesc::data);
  Fields<MeshDesc>(module, "MeshDesc", "A mesh in object space, with Blender's triangulation.")
      .field("name", &MeshDesc::name)
      .field("positions", &MeshDesc::positions)
      .field("corner_vertices", &MeshDesc::corner_vertices)
      .field("polygon_starts", &MeshDesc::polygon_starts)
      .field("polygon_sizes", &MeshDesc::polygon_sizes)
      .field("triangle_corners", &MeshDesc::triangle_corners)
      .optional("material_indices", &MeshDesc::material_indices)
      .optional("smooth_flags", &MeshDesc::smooth_flags)
      .optional("vertex_normals", &MeshDesc::vertex_normals)
      .optional("corner_normals", &MeshDesc::corner_normals)
      .optional("edge_vertices", &MeshDesc::edge_vertices)
      .field("attributes", &MeshDesc::attributes)
      .field("texture_space_location", &MeshDesc::texture_space_location)
      .field("texture_space_size", &MeshDesc::texture_space_size)
      .choice("shape", {"FACES", "RIBBONS", "TUBES", "SPHERES"}, &MeshDesc::shape)
      .optional("radii", &MeshDesc::radii)
      .field("root_radius", &MeshDesc::root_radius)
      .field("tip_radius", &MeshDesc::tip_radius)
      .field("radius_shape", &MeshDesc::radius_shape)
      .field("closes_tip", &MeshDesc::closes_tip)
      .optional("strand_sizes", &MeshDesc::strand_sizes)
      .field("to_object", &MeshDesc::to_object)
      .ranged("ribbon_pieces", 1, 16, &MeshDesc::ribbon_pieces)
      .ranged("first_strand", 0, std::numeric_limits<int>::max(), &MeshDesc::first_strand);
}

void bind_instance(py::module_& module) {
  constexpr auto glass = &InstanceDesc::looking_glass;
  Fields<InstanceDesc>(module, "InstanceDesc", "A mesh at a place, with its materials.")
      .field("name", &InstanceDesc::name)
      .field("mesh", &InstanceDesc::mesh)
      .field("object_to_world", &InstanceDesc::object_to_world)
      .field("motion", &InstanceDesc::motion)
      .field("worlds", &InstanceDesc::visibility, &VisibilityDesc::worlds)
      .field("ray_kinds", &InstanceDesc::visibility, &VisibilityDesc::ray_kinds)
      .ranged("dream", 0, k_last_dream, glass, &LookingGlassDesc::dream)
      .choice("entry", {"REFLECTION", "TRANSMISSION", "BOTH"}, glass, &LookingGlassDesc::entry)
      .choice("reentry", {"STAY", "TOGGLE"}, glass, &LookingGlassDesc::reentry)
      .field("first_seen_only", glass, &LookingGlassDesc::first_seen_only)
      .field("materials", &InstanceDesc::materials)
      .field("behind_materials", &InstanceDesc::behind_materials)
      .field("color", &InstanceDesc::color)
      .field("pass_index", &InstanceDesc::pass_index)
      .field("random", &InstanceDesc::random)
      .field("is_holdout", &InstanceDesc::is_holdout)
      .field("terminator_cutoff", &InstanceDesc::terminator_cutoff)
      .field("generated", &InstanceDesc::generated)
      .field("instancer_uv", &InstanceDesc::instancer_uv)
      .field("attributes", &InstanceDesc::attributes)
      .field("grids", &InstanceDesc::grids)
      .field("has_scaled_density", &InstanceDesc::has_scaled_density);
}

void bind_material(py::module_& module) {
  Fields<MaterialDesc>(module, "MaterialDesc", "A surface shader and its settings.")
      .field("name", &MaterialDesc::name)
      .part("graph", &MaterialDesc::graph)
      .field("pass_index", &MaterialDesc::pass_index)
      .choice("displacement_method", {"BUMP", "DISPLACEMENT", "BOTH"},
              &MaterialDesc::displacement_method)
      .field("use_transparent_shadow", &MaterialDesc::use_transparent_shadow)
      .field("sample_as_light", &MaterialDesc::sample_as_light)
      .choice("volume_interpolation", {"LINEAR", "CUBIC"}, &MaterialDesc::volume_interpolation)
      .field("volume_step_rate", &MaterialDesc::volume_step_rate);
}

void bind_light(py::module_& module) {
  Fields<LightDesc>(module, "LightDesc", "A lamp; energy in W, of a sun in W/m^2.")
      .field("name", &LightDesc::name)
      .choice("type", {"POINT", "SPOT", "AREA", "SUN"}, &LightDesc::type)
      .field("object_to_world", &LightDesc::object_to_world)
      .field("color", &LightDesc::color)
      .field("energy", &LightDesc::energy)
      .field("radius", &LightDesc::radius)
      .field("spot_size", &LightDesc::spot_size)
      .field("spot_blend", &LightDesc::spot_blend)
      .choice("shape", {"SQUARE", "RECTANGLE", "DISK", "ELLIPSE"}, &LightDesc::shape)
      .field("size_x", &LightDesc::size_x)
      .field("size_y", &LightDesc::size_y)
      .field("spread", &LightDesc::spread)
      .field("angle", &LightDesc::angle)
      .part("graph", &LightDesc::graph)
      .field("worlds", &LightDesc::visibility, &VisibilityDesc::worlds)
      .field("ray_kinds", &LightDesc::visibility, &VisibilityDesc::ray_kinds)
      .field("casts_shadow", &LightDesc::casts_shadow)
      .field("use_mis", &LightDesc::use_mis)
      .field("max_bounces", &LightDesc::max_bounces)
      .field("random", &LightDesc::random);
}

void bind_world(py::module_& module) {
  Fields<WorldDesc>(module, "WorldDesc", "What surrounds the scene; without a graph: `color`.")
      .field("name", &WorldDesc::name)
      .part("graph", &WorldDesc::graph)
      .field("color", &WorldDesc::color)
      .field("ray_kinds", &WorldDesc::visibility, &VisibilityDesc::ray_kinds)
      .choice("sampling", {"NONE", "AUTOMATIC", "MANUAL"}, &WorldDesc::sampling)
      .field("map_resolution", &WorldDesc::map_resolution)
      .field("volume_step_size", &WorldDesc::volume_step_size)
      .field("max_bounces", &WorldDesc::max_bounces);
}

void bind_image(py::module_& module) {
  Fields<ImageTileDesc>(module, "ImageTileDesc",
                        "A file or pixels (height, width, 4), bottom row first.")
      .field("number", &ImageTileDesc::number)
      .field("path", &ImageTileDesc::path)
      .optional("pixels", &ImageTileDesc::pixels)
      .field("width", &ImageTileDesc::width)
      .field("height", &ImageTileDesc::height);
  Fields<ImageDesc>(module, "ImageDesc", "An image; without tiles it is missing: magenta.")
      .field("name", &ImageDesc::name)
      .field("tiles", &ImageDesc::tiles)
      .field("colorspace", &ImageDesc::colorspace)
      .choice("alpha_mode", {"STRAIGHT", "PREMUL", "CHANNEL_PACKED", "NONE"},
              &ImageDesc::alpha_mode)
      .field("is_data", &ImageDesc::is_data)
      .field("is_float", &ImageDesc::is_float);
}

void bind_grid(py::module_& module) {
  constexpr int k_longest = 1 << 15;
  Fields<GridDesc>(module, "GridDesc",
                   "Values in the unit cube: (depth, height, width, channels); or an OpenVDB file.")
      .field("name", &GridDesc::name)
      .field("path", &GridDesc::path)
      .ranged("width", 1, k_longest, &GridDesc::width)
      .ranged("height", 1, k_longest, &GridDesc::height)
      .ranged("depth", 1, k_longest, &GridDesc::depth)
      .ranged("channels", 1, 4, &GridDesc::channels)
      .optional("values", &GridDesc::values);
}

void bind_aov(py::module_& module) {
  Fields<AovDesc>(module, "AovDesc", "A pass that AOV Output nodes of this name write.")
      .field("name", &AovDesc::name)
      .field("is_color", &AovDesc::is_color);
}

void bind_camera(py::module_& module) {
  Fields<CameraDesc>(module, "CameraDesc", "Blender's camera; lens and sensor in mm.")
      .choice("type", {"PERSP", "ORTHO", "PANO"}, &CameraDesc::type)
      .field("camera_to_world", &CameraDesc::camera_to_world)
      .field("motion", &CameraDesc::motion)
      .field("lens", &CameraDesc::lens)
      .field("sensor_width", &CameraDesc::sensor_width)
      .field("sensor_height", &CameraDesc::sensor_height)
      .choice("sensor_fit", {"AUTO", "HORIZONTAL", "VERTICAL"}, &CameraDesc::sensor_fit)
      .field("shift_x", &CameraDesc::shift_x)
      .field("shift_y", &CameraDesc::shift_y)
      .field("ortho_scale", &CameraDesc::ortho_scale)
      .field("clip_start", &CameraDesc::clip_start)
      .field("clip_end", &CameraDesc::clip_end)
      .field("aperture_radius", &CameraDesc::aperture_radius)
      .field("focus_distance", &CameraDesc::focus_distance)
      .field("aperture_blades", &CameraDesc::aperture_blades)
      .field("aperture_rotation", &CameraDesc::aperture_rotation)
      .field("aperture_ratio", &CameraDesc::aperture_ratio)
      .field("longitude_min", &CameraDesc::longitude_min)
      .field("longitude_max", &CameraDesc::longitude_max)
      .field("latitude_min", &CameraDesc::latitude_min)
      .field("latitude_max", &CameraDesc::latitude_max)
      .field("pixel_aspect_x", &CameraDesc::pixel_aspect_x)
      .field("pixel_aspect_y", &CameraDesc::pixel_aspect_y);
}

void bind_settings(py::module_& module) {
  Fields<RenderSettings>(module, "RenderSettings", "What is rendered, how long and how exactly.")
      .field("width", &RenderSettings::width)
      .field("height", &RenderSettings::height)
      .field("border_x", &RenderSettings::border_x)
      .field("border_y", &RenderSettings::border_y)
      .field("border_width", &RenderSettings::border_width)
      .field("border_height", &RenderSettings::border_height)
      .field("samples", &RenderSettings::samples)
      .field("sample_offset", &RenderSettings::sample_offset)
      .field("seed", &RenderSettings::seed)
      .field("threads", &RenderSettings::threads)
      .field("time_limit", &RenderSettings::time_limit)
      .field("max_bounces", &RenderSettings::max_bounces)
      .field("diffuse_bounces", &RenderSettings::diffuse_bounces)
      .field("glossy_bounces", &RenderSettings::glossy_bounces)
      .field("transmission_bounces", &RenderSettings::transmission_bounces)
      .field("volume_bounces", &RenderSettings::volume_bounces)
      .field("transparent_max_bounces", &RenderSettings::transparent_max_bounces)
      .field("min_light_bounces", &RenderSettings::min_light_bounces)
      .field("use_radiance_cache", &RenderSettings::use_radiance_cache)
      .field("clamp_direct", &RenderSettings::clamp_direct)
      .field("clamp_indirect", &RenderSettings::clamp_indirect)
      .field("blur_glossy", &RenderSettings::blur_glossy)
      .field("caustics_reflective", &RenderSettings::caustics_reflective)
      .field("caustics_refractive", &RenderSettings::caustics_refractive)
      .field("film_transparent", &RenderSettings::film_transparent)
      .field("film_exposure", &RenderSettings::film_exposure)
      .field("pass_alpha_threshold", &RenderSettings::pass_alpha_threshold)
      .choice("pixel_filter", {"BOX", "GAUSSIAN", "BLACKMAN_HARRIS"}, &RenderSettings::pixel_filter)
      .field("filter_width", &RenderSettings::filter_width)
      .field("occlusion_distance", &RenderSettings::occlusion_distance)
      .field("volume_step_rate", &RenderSettings::volume_step_rate)
      .field("texture_limit", &RenderSettings::texture_limit)
      .ranged("start_world", 0, k_last_dream, &RenderSettings::start_world);
}

// Adds a copy; its index.
template <class T>
auto adder(std::vector<T> SceneDescription::*list) {
  return [list](SceneDescription& scene, const T& item) {
    if constexpr (requires { check_sizes(item); }) check_sizes(item);
    (scene.*list).push_back(item);
    return (scene.*list).size() - 1;
  };
}

void bind_description(py::module_& module) {
  Fields<SceneDescription>(module, "SceneDescription", "A whole scene; `add_*` return indices.")
      .part("camera", &SceneDescription::camera)
      .part("settings", &SceneDescription::settings)
      .bound()
      .def("add_mesh", adder(&SceneDescription::meshes), py::arg("mesh"))
      .def("add_instance", adder(&SceneDescription::instances), py::arg("instance"))
      .def("add_material", adder(&SceneDescription::materials), py::arg("material"))
      .def("add_light", adder(&SceneDescription::lights), py::arg("light"))
      .def("add_world", adder(&SceneDescription::worlds), py::arg("world"),
           "The first is the scene's World; the next four are those of dreams 1..4.")
      .def("add_image", adder(&SceneDescription::images), py::arg("image"))
      .def("add_grid", adder(&SceneDescription::grids), py::arg("grid"))
      .def("add_aov", adder(&SceneDescription::aovs), py::arg("aov"));
}

}  // namespace

void bind_scene(py::module_& module) {
  bind_mesh(module);
  bind_instance(module);
  bind_material(module);
  bind_light(module);
  bind_world(module);
  bind_image(module);
  bind_grid(module);
  bind_aov(module);
  bind_camera(module);
  bind_settings(module);
  bind_description(module);
}

}  // namespace tenniel
