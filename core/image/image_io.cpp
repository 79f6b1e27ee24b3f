// SPDX-License-Identifier: Apache-2.0
#include "image/image_io.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <string_view>
#include <system_error>
#include <utility>

#include "image/colorspace.h"
#include "image/pixel_format.h"

namespace tenniel {

namespace {

using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

// Deflate packs at best 1030:1 and every other codec of the list less; a header that claims more
// than this is a lie. Small images are let through whatever their size: they can do no harm.
constexpr size_t k_max_compression = 1100;
constexpr size_t k_harmless_bytes = size_t{16} << 20;

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

// OpenImageIO's name of the format by signature, empty if it is not on our list. Only these readers
// ever see a file: the less common ones have a worse record with malformed input.
std::string detect_format(const std::string& path) {
  std::array<char, 16> head{};
  std::ifstream(path, std::ios::binary).read(head.data(), head.size());
  const std::string_view bytes(head.data(), head.size());
  const auto starts = [&](std::string_view signature) { return bytes.starts_with(signature); };
  using namespace std::string_view_literals;
  if (starts("\x89PNG"sv)) return "png";
  if (starts("\xff\xd8\xff"sv)) return "jpeg";
  if (starts("\x76\x2f\x31\x01"sv)) return "openexr";
  if (starts("#?"sv)) return "hdr";
  if (starts("II*\0"sv) || starts("MM\0*"sv) || starts("II+\0"sv) || starts("MM\0+"sv))
    return "tiff";
  if (starts("RIFF"sv) && bytes.substr(8, 4) == "WEBP"sv) return "webp";
  if (starts("\0\0\0\x0cjP  "sv) || starts("\xff\x4f\xff\x51"sv)) return "jpeg2000";
  if (extension_of(path) == ".tga") return "targa";
  if (starts("BM"sv)) return "bmp";
  return {};
}

// Empty if the promise of the header can be believed.
std::string check_claim(const ImageSpec& spec, size_t file_bytes) {
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) return "has no pixels";
  if (spec.width > k_max_image_side || spec.height > k_max_image_side || spec.depth > 1)
    return "is too large";
  const size_t bytes = spec.image_bytes(true);
  if (bytes > k_max_image_bytes) return "is too large";
  if (bytes > k_harmless_bytes && bytes / k_max_compression > file_bytes)
    return "claims more pixels than a file of its size can hold";
  return {};
}

TypeDesc allocate_pixels(Image& image, const ImageSpec& spec) {
  const size_t count = static_cast<size_t>(image.width) * static_cast<size_t>(image.height) *
                       static_cast<size_t>(image.channels);
  switch (spec.format.basetype) {
    case TypeDesc::UINT8:
    case TypeDesc::INT8:
      image.pixels.emplace<std::vector<uint8_t>>(count);
      return TypeDesc::UINT8;
    case TypeDesc::HALF:
      image.pixels.emplace<std::vector<uint16_t>>(count);
      image.is_half = true;
      return TypeDesc::HALF;
    case TypeDesc::UINT16:
    case TypeDesc::INT16:
      image.pixels.emplace<std::vector<uint16_t>>(count);
      return TypeDesc::UINT16;
    default:
      image.pixels.emplace<std::vector<float>>(count);
      return TypeDesc::FLOAT;
  }
}

// Throws what OpenImageIO and the allocator throw.
ImageLoadResult read_file(const std::string& path, const ImageLoadOptions& options) {
  const auto failure = [&](const std::string& reason) {
    return ImageLoadResult{nullptr, "Image '" + path + "' " + reason + "."};
  };
  std::error_code file_error;
  const auto file_bytes = std::filesystem::file_size(path, file_error);
  if (file_error) return failure("cannot be read: " + file_error.message());
  const std::string format = detect_format(path);
  if (format.empty()) return failure("is of no supported format");

  const auto input = ImageInput::create(format);
  if (!input) return failure("needs a reader for " + format + " that OpenImageIO lacks");
  ImageSpec spec, config;
  // Straight pixels as they are in the file: associating is ours, after any colour conversion.
  config.attribute("oiio:UnassociatedAlpha", 1);
  if (!input->open(path, spec, config)) return failure("cannot be read: " + input->geterror());
  if (const std::string problem = check_claim(spec, file_bytes); !problem.empty())
    return failure(problem);

  Image image;
  image.width = spec.width;
  image.height = spec.height;
  image.channels = std::min(spec.nchannels, 4);
  const TypeDesc type = allocate_pixels(image, spec);
  const auto row_bytes = static_cast<OIIO::stride_t>(
      static_cast<size_t>(image.width) * static_cast<size_t>(image.channels) * type.size());
  const bool complete = std::visit(
      [&](auto& pixels) {
        auto* last_row = reinterpret_cast<char*>(pixels.data()) + row_bytes * (image.height - 1);
        return input->read_image(0, 0, 0, image.channels, type, last_row, OIIO::AutoStride,
                                 -row_bytes);
      },
      image.pixels);
  if (!complete) return failure("is damaged: " + input->geterror());
  const bool is_associated = spec.get_int_attribute("oiio:UnassociatedAlpha", 0) == 0;
  return {std::make_shared<const Image>(prepare_image(std::move(image), is_associated, options)),
          {}};
}

std::vector<float> to_png_pixels(const float* rgba, size_t pixel_count) {
  std::vector<float> encoded(rgba, rgba + pixel_count * 4);
  for (size_t i = 0; i < encoded.size(); i += 4) {
    const float alpha = encoded[i + 3];
    for (size_t c = i; c < i + 3; ++c)
      encoded[c] = linear_to_srgb(alpha > 0.0f ? encoded[c] / alpha : encoded[c]);
  }
  return encoded;
}

// Returns an error or an empty string; throws what OpenImageIO and the allocator throw.
std::string write_file(const std::string& path, const std::string& temporary, const float* rgba,
                       int width, int height) {
  const std::string extension = extension_of(path);
  const bool is_png = extension == ".png";
  if (!is_png && extension != ".exr") return "the name must end in .exr or .png";
  const auto output = ImageOutput::create(is_png ? "png" : "openexr");
  if (!output) return "OpenImageIO lacks a writer for " + extension;
  ImageSpec spec(width, height, 4, is_png ? TypeDesc::UINT8 : TypeDesc::FLOAT);
  if (is_png) {
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("oiio:ColorSpace", "sRGB");
  } else {
    spec.attribute("compression", "zip");
  }
  std::vector<float> encoded;
  if (is_png) {
    encoded = to_png_pixels(rgba, static_cast<size_t>(width) * static_cast<size_t>(height));
    rgba = encoded.data();
  }
  if (!output->open(temporary, spec)) return output->geterror();
  const OIIO::stride_t row = static_cast<OIIO::stride_t>(width) * 4 * OIIO::stride_t{sizeof(float)};
  const char* last_row = reinterpret_cast<const char*>(rgba) + row * (height - 1);
  if (!output->write_image(TypeDesc::FLOAT, last_row, OIIO::AutoStride, -row) || !output->close())
    return output->geterror();
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  return error ? error.message() : std::string();
}

}  // namespace

ImageLoadResult load_image(const std::string& path, const ImageLoadOptions& options) {
  try {
    return read_file(path, options);
  } catch (const std::bad_alloc&) {
    return {nullptr, "Image '" + path + "' does not fit into memory."};
  } catch (const std::exception& problem) {
    return {nullptr, "Image '" + path + "' cannot be read: " + problem.what() + "."};
  } catch (...) {
    return {nullptr, "Image '" + path + "' cannot be read."};
  }
}

ImageLoadResult image_from_pixels(const float* rgba, int width, int height, bool is_float,
                                  bool alpha_associated, const ImageLoadOptions& options) {
  if (!rgba || width < 1 || height < 1) return {nullptr, "The image has no pixels."};
  if (width > k_max_image_side || height > k_max_image_side)
    return {nullptr, "The image is too large."};
  try {
    const size_t count = static_cast<size_t>(width) * static_cast<size_t>(height) * 4;
    Image image;
    image.width = width;
    image.height = height;
    image.channels = 4;
    ImageLoadOptions used = options;
    // Cycles multiplies bytes by alpha whatever their alpha mode says.
    const bool is_associated = is_float && alpha_associated;
    if (is_float) {
      if (count * sizeof(float) > k_max_image_bytes) return {nullptr, "The image is too large."};
      image.pixels.emplace<std::vector<float>>(rgba, rgba + count);
      const ColorSpace* space = find_colorspace(used.colorspace);
      if (!space || !space->is_data) used.colorspace = "Linear";
    } else {
      auto& bytes = image.pixels.emplace<std::vector<uint8_t>>(count);
      std::transform(rgba, rgba + count, bytes.begin(), ByteFormat::store);
    }
    return {std::make_shared<const Image>(prepare_image(std::move(image), is_associated, used)),
            {}};
  } catch (const std::bad_alloc&) {
    return {nullptr, "The image does not fit into memory."};
  }
}

bool colorspace_is_supported(const std::string& name) {
  return find_colorspace(name) != nullptr;
}

std::string write_image(const std::string& path, const float* rgba, int width, int height) {
  const std::string temporary = path + ".part";
  std::string reason;
  try {
    if (!rgba || width < 1 || height < 1)
      reason = "there are no pixels";
    else
      reason = write_file(path, temporary, rgba, width, height);
  } catch (const std::exception& problem) {
    reason = problem.what();
  }
  if (reason.empty()) return {};
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  return "Cannot write '" + path + "': " + reason + ".";
}

std::string oiio_version() {
  const int version = OIIO::openimageio_version();  // major * 10000 + minor * 100 + patch
  return std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
         std::to_string(version % 100);
}

}  // namespace tenniel
