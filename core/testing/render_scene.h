// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <stdexcept>
#include <vector>

#include "math/spectrum.h"
#include "render/session.h"

namespace tenniel::testing {

struct Picture {
  int width = 0, height = 0;
  std::vector<float> rgba;  // bottom row first

  Spectrum pixel(int x, int y) const {
    const float* p = &rgba[static_cast<size_t>(y * width + x) * 4];
    return {p[0], p[1], p[2]};
  }
  float alpha(int x, int y) const { return rgba[static_cast<size_t>(y * width + x) * 4 + 3]; }
};

// Mean over the picture and the standard error of that mean, from the scatter of the pixels: right
// where every pixel expects the same value.
struct Mean {
  double value = 0.0, error = 0.0;
};
inline Mean mean_of(const Picture& picture) {
  double sum = 0.0, squares = 0.0;
  const auto n = static_cast<double>(picture.width * picture.height);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const double v = mean(picture.pixel(x, y));
      sum += v;
      squares += v * v;
    }
  }
  const double m = sum / n;
  return {m, std::sqrt(std::max(squares / n - m * m, 0.0) / (n - 1.0))};
}

inline std::vector<float> render_pass(SceneDescription scene, const std::string& name) {
  RenderSession session(std::move(scene));
  session.start();
  while (!session.wait(10.0)) {
  }
  if (!session.error().empty()) throw std::runtime_error(session.error());
  const TileRect all{0, 0, session.width(), session.height()};
  std::vector<float> values(session.pass_size(name, all));
  session.read_pass(name, all, values.data(), values.size());
  return values;
}

inline Picture render(SceneDescription scene) {
  const int width = scene.settings.width, height = scene.settings.height;
  return {width, height, render_pass(std::move(scene), "Combined")};
}

}  // namespace tenniel::testing
