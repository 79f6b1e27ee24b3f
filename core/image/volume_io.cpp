// SPDX-License-Identifier: Apache-2.0
#include "image/volume_io.h"

#include <OpenImageIO/imageio.h>

#include <array>
#include <exception>
#include <fstream>
#include <new>
#include <string_view>
#include <vector>

namespace tenniel {

namespace {

using OIIO::ImageInput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

constexpr int k_side = VoxelGrid::k_brick_side;

// Only files that say they are OpenVDB's ever come to its reader.
bool has_signature(const std::string& path) {
  std::array<char, 8> head{};
  std::ifstream(path, std::ios::binary).read(head.data(), head.size());
  return std::string_view(head.data(), head.size()) == std::string_view(" BDV\0\0\0\0", 8);
}

// Number of the grid among those of the file, -1 where there is none.
int find_grid(ImageInput& input, const std::string& name) {
  for (int i = 0;; ++i) {
    const ImageSpec spec = input.spec_dimensions(i);
    if (spec.format == TypeDesc::UNKNOWN) return -1;
    if (input.spec(i).get_string_attribute("openvdb:name") == name) return i;
  }
}

// Empty if the grid is one that can be read.
std::string check_grid(const ImageSpec& spec) {
  if (spec.nchannels != 1 && spec.nchannels != 3) return "is of a kind that is not supported";
  if (spec.tile_width != k_side || spec.tile_height != k_side || spec.tile_depth != k_side)
    return "is of a structure that is not supported";
  size_t bricks = 1;
  for (const int size : {spec.width, spec.height, spec.depth}) {
    if (size < 1) return "is empty";
    bricks *= static_cast<size_t>(size / k_side + 1);
    if (bricks > k_max_grid_bricks) return "is too large";
  }
  return {};
}

// From the voxels' numbers to the space of the file; singular where the grid has none of that kind.
Transform index_to_file(const ImageSpec& spec) {
  std::array<double, 16> m{};
  const TypeDesc matrix(TypeDesc::DOUBLE, TypeDesc::MATRIX44);
  if (!spec.getattribute("openvdb:indextoworld", matrix, m.data())) return {{}, {}, {}, {}};
  const auto row = [&](size_t i) {
    return Vec3{static_cast<float>(m[4 * i]), static_cast<float>(m[4 * i + 1]),
                static_cast<float>(m[4 * i + 2])};
  };
  return {row(0), row(1), row(2), row(3)};
}

Transform unit_to_index(const ImageSpec& spec) {
  const auto size = [](int n) { return static_cast<float>(n); };
  return {{size(spec.width), 0.0f, 0.0f},
          {0.0f, size(spec.height), 0.0f},
          {0.0f, 0.0f, size(spec.depth)},
          {size(spec.x), size(spec.y), size(spec.z)}};
}

// Returns an error or an empty string.
std::string read_bricks(ImageInput& input, int number, const ImageSpec& spec, VoxelGrid& grid,
                        const Cancellation& cancellation) {
  std::vector<float> brick(VoxelGrid::k_brick_voxels * static_cast<size_t>(spec.nchannels));
  for (int z = 0; z < spec.depth; z += k_side)
    for (int y = 0; y < spec.height; y += k_side) {
      cancellation.check();
      if (grid.memory_bytes() > k_max_grid_bytes) return "is too large";
      for (int x = 0; x < spec.width; x += k_side) {
        const int x0 = spec.x + x, y0 = spec.y + y, z0 = spec.z + z;
        if (!input.read_tiles(number, 0, x0, x0 + k_side, y0, y0 + k_side, z0, z0 + k_side, 0,
                              spec.nchannels, TypeDesc::FLOAT, brick.data()))
          return "is damaged: " + input.geterror();
        grid.set_brick({x / k_side, y / k_side, z / k_side}, brick.data());
      }
    }
  return {};
}

// Throws what OpenImageIO and the allocator throw, and Cancelled.
VolumeLoadResult read_grid(const std::string& path, const std::string& name,
                           const Cancellation& cancellation) {
  const auto failure = [&](const std::string& reason) {
    return VolumeLoadResult{nullptr, {}, "Volume '" + path + "' " + reason + "."};
  };
  const auto grid_failure = [&](const std::string& reason) {
    return failure("cannot be used: its grid '" + name + "' " + reason);
  };
  if (!has_signature(path)) return failure("is missing or no OpenVDB file");
  const auto input = ImageInput::create("openvdb");
  if (!input) return failure("needs a reader for OpenVDB that OpenImageIO lacks");
  ImageSpec first;
  if (!input->open(path, first)) return failure("cannot be read: " + input->geterror());
  const int number = find_grid(*input, name);
  if (number < 0) return failure("has no grid '" + name + "' of numbers");
  const ImageSpec spec = input->spec(number);
  if (const std::string problem = check_grid(spec); !problem.empty()) return grid_failure(problem);
  const Transform to_unit = (index_to_file(spec) * unit_to_index(spec)).inverse();
  if (to_unit == Transform{{}, {}, {}, {}} || !is_finite(to_unit))
    return grid_failure("has no place in space that is supported");
  auto grid = std::make_unique<VoxelGrid>(std::array{spec.width, spec.height, spec.depth},
                                          spec.nchannels, GridBorder::empty);
  const std::string problem = read_bricks(*input, number, spec, *grid, cancellation);
  if (!problem.empty()) return grid_failure(problem);
  grid->finish(cancellation);
  return {std::move(grid), to_unit, {}};
}

}  // namespace

VolumeLoadResult load_volume(const std::string& path, const std::string& grid,
                             const Cancellation& cancellation) {
  try {
    return read_grid(path, grid, cancellation);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::bad_alloc&) {
    return {nullptr, {}, "Volume '" + path + "' does not fit into memory."};
  } catch (const std::exception& problem) {
    return {nullptr, {}, "Volume '" + path + "' cannot be read: " + problem.what() + "."};
  } catch (...) {
    return {nullptr, {}, "Volume '" + path + "' cannot be read."};
  }
}

}  // namespace tenniel
