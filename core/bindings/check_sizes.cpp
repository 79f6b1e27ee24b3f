// SPDX-License-Identifier: Apache-2.0
#include "bindings/check_sizes.h"

#include "bindings/convert.h"

namespace tenniel {

namespace {

template <class T>
size_t size_of_required(const Buffer<T>& buffer, FieldName field, size_t multiple = 1) {
  if (!buffer) throw_value_error(field, "is missing");
  if (buffer->size() % multiple != 0)
    throw_value_error(field, "needs a multiple of " + std::to_string(multiple) + " values, not " +
                                 std::to_string(buffer->size()));
  return buffer->size();
}

template <class T>
void check_size(const Buffer<T>& buffer, size_t expected, FieldName field) {
  if (buffer && buffer->size() != expected)
    throw_value_error(field, "needs " + std::to_string(expected) + " values, not " +
                                 std::to_string(buffer->size()));
}

void check_attributes(const MeshDesc& mesh, size_t points, size_t edges, size_t corners,
                      size_t faces) {
  for (const AttributeDesc& attribute : mesh.attributes) {
    const std::string name = "data ('" + attribute.name + "')";
    const FieldName data{"AttributeDesc", name};
    size_of_required(attribute.data, data);
    const size_t elements = attribute.domain == "POINT"    ? points
                            : attribute.domain == "EDGE"   ? edges
                            : attribute.domain == "CORNER" ? corners
                                                           : faces;
    if (attribute.domain.empty()) throw_value_error({"AttributeDesc", "domain"}, "is missing");
    check_size(attribute.data, elements * static_cast<size_t>(attribute.channels), data);
  }
}

void check_strands(const MeshDesc& mesh) {
  const auto field = [](const char* name) { return FieldName{"MeshDesc", name}; };
  const size_t keys = size_of_required(mesh.positions, field("positions"), 3) / 3;
  const bool has_hairs = mesh.shape != "SPHERES";
  if (!has_hairs) size_of_required(mesh.radii, field("radii"));
  check_size(mesh.radii, keys, field("radii"));
  const size_t strands =
      has_hairs ? size_of_required(mesh.strand_sizes, field("strand_sizes")) : keys;
  check_attributes(mesh, keys, 0, 0, strands);
}

}  // namespace

void check_sizes(const MeshDesc& mesh) {
  if (mesh.shape != "FACES") return check_strands(mesh);
  const auto field = [](const char* name) { return FieldName{"MeshDesc", name}; };
  const size_t vertices = size_of_required(mesh.positions, field("positions"), 3) / 3;
  const size_t corners = size_of_required(mesh.corner_vertices, field("corner_vertices"));
  const size_t polygons = size_of_required(mesh.polygon_starts, field("polygon_starts"));
  size_of_required(mesh.polygon_sizes, field("polygon_sizes"));
  size_of_required(mesh.triangle_corners, field("triangle_corners"), 3);
  check_size(mesh.polygon_sizes, polygons, field("polygon_sizes"));
  check_size(mesh.material_indices, polygons, field("material_indices"));
  check_size(mesh.smooth_flags, polygons, field("smooth_flags"));
  check_size(mesh.vertex_normals, vertices * 3, field("vertex_normals"));
  check_size(mesh.corner_normals, corners * 3, field("corner_normals"));
  const size_t edges =
      mesh.edge_vertices ? size_of_required(mesh.edge_vertices, field("edge_vertices"), 2) / 2 : 0;
  check_attributes(mesh, vertices, edges, corners, polygons);
}

void check_sizes(const ImageDesc& image) {
  for (const ImageTileDesc& tile : image.tiles)
    if (tile.pixels) check_pixels(tile.pixels, tile.width, tile.height, "ImageTileDesc");
}

void check_sizes(const GridDesc& grid) {
  if (!grid.path.empty()) return;
  const FieldName values{"GridDesc", "values"};
  size_of_required(grid.values, values);
  check_size(grid.values,
             static_cast<size_t>(grid.width) * static_cast<size_t>(grid.height) *
                 static_cast<size_t>(grid.depth) * static_cast<size_t>(grid.channels),
             values);
}

void check_pixels(const Buffer<float>& pixels, int width, int height, const char* owner) {
  if (width < 1) throw_value_error({owner, "width"}, "must be positive");
  if (height < 1) throw_value_error({owner, "height"}, "must be positive");
  check_size(pixels, size_t{4} * static_cast<size_t>(width) * static_cast<size_t>(height),
             {owner, "pixels"});
}

}  // namespace tenniel
