// SPDX-License-Identifier: Apache-2.0
// What a sample of a closed room costs, on one thread: `./tenniel bench paths`. Prints figures,
// judges none. The checksum tells whether a change of the code has changed the picture.
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "film/film.h"
#include "math/hash.h"
#include "render/render_loop.h"
#include "scene/compile_scene.h"
#include "testing/scene_builder.h"

namespace tenniel {
namespace {

using namespace testing;

constexpr float k_room = 3.0f;  // half of its width

NodeGraph paint(float r, float g, float b) {
  return single("ShaderNodeBsdfDiffuse", {{"Color", {r, g, b, 1.0f}}});
}

// A sphere with dents, so that paths are as scattered as among an artist's models.
MeshDesc dented_sphere() {
  MeshDesc mesh = sphere(128, 256);
  std::vector<float>& p = *mesh.positions;
  for (size_t i = 0; i < p.size(); i += 3) {
    const float dent = 1.0f + 0.12f * std::sin(9.0f * p[i]) * std::sin(11.0f * p[i + 1]) *
                                  std::cos(7.0f * p[i + 2]);
    for (size_t k = 0; k < 3; ++k)
      p[i + k] *= dent;
  }
  mesh.vertex_normals = nullptr;
  return mesh;
}

void add_walls(SceneBuilder& b) {
  const float s = k_room;
  const NodeGraph white = paint(0.76f, 0.74f, 0.70f);
  b.object(square(), paint(0.42f, 0.36f, 0.30f), at(0.0f, 0.0f, 0.0f, s));
  b.object(square(), white, {s, 0, 0, 0, 0, -s, 0, 0, 0, 0, -s, s});
  b.object(square(), white, {s, 0, 0, 0, 0, 0, -s, s, 0, s, 0, 0});
  b.object(square(), white, {s, 0, 0, 0, 0, 0, s, -s, 0, s, 0, 0});
  b.object(square(), paint(0.60f, 0.16f, 0.10f), {0, 0, s, -s, 0, s, 0, 0, s, 0, 0, 0});
  b.object(square(), paint(0.12f, 0.26f, 0.55f), {0, 0, s, s, 0, s, 0, 0, s, 0, 0, 0});
}

// Nine meshes of 65 000 triangles each, none shared, and one area lamp.
SceneDescription room(int samples) {
  SceneBuilder b;
  add_walls(b);
  for (int i = 0; i < 9; ++i) {
    const int row_index = i / 3;
    const auto row = static_cast<float>(row_index), column = static_cast<float>(i % 3);
    const float hue = 0.1f * static_cast<float>(i);
    b.object(dented_sphere(), paint(0.7f - 0.5f * hue, 0.4f, 0.3f + 0.4f * hue),
             at(1.45f * (column - 1.0f), 1.3f * row - 0.6f, 0.5f + 0.36f * row, 0.42f));
  }
  LightDesc& lamp = b.lamp("AREA", 140.0f, {1, 0, 0, 0.4f, 0, 1, 0, 0.2f, 0, 0, 1, 2.98f});
  lamp.shape = "RECTANGLE";
  lamp.size_x = 1.6f;
  lamp.size_y = 1.0f;
  b.scene.camera.camera_to_world = turned(70.0f, 0.0f, -2.9f, 1.85f);
  b.scene.camera.lens = 22.0f;
  b.scene.settings = RenderSettings();
  b.scene.settings.width = 480;
  b.scene.settings.height = 270;
  b.scene.settings.samples = samples;
  b.scene.settings.clamp_indirect = b.scene.settings.blur_glossy = 0.0f;
  return std::move(b.scene);
}

uint32_t checksum(const std::vector<float>& values) {
  uint32_t sum = 0;
  for (const float v : values)
    sum = hash_uint(sum, float_bits(v));
  return sum;
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Measurement {
  double microseconds = 0.0;  // a sample
  std::vector<float> picture;
};

Measurement measure(const Scene& scene, const RenderSettings& settings) {
  Film film(settings.width, settings.height, 0);
  RenderCounters counters;
  const double start = cpu_seconds();
  render_passes(scene, settings, film, counters, [](size_t) {});
  Measurement m;
  m.microseconds = 1e6 * (cpu_seconds() - start) / settings.samples /
                   (static_cast<double>(settings.width) * settings.height);
  m.picture.resize(static_cast<size_t>(settings.width * settings.height) * 4);
  film.read(k_passes[0], {0, 0, settings.width, settings.height}, 1.0f, m.picture.data());
  return m;
}

// Mean square of the difference of two pictures over their squared mean, halved.
double relative_variance(const std::vector<float>& a, const std::vector<float>& b) {
  double difference = 0.0, sum = 0.0;
  for (size_t i = 0; i < a.size(); ++i) {
    if (i % 4 == 3) continue;
    difference += std::pow(static_cast<double>(a[i] - b[i]), 2.0);
    sum += static_cast<double>(a[i] + b[i]);
  }
  const double count = 0.75 * static_cast<double>(a.size()), mean = sum / (2.0 * count);
  return difference / (2.0 * count * mean * mean);
}

void run(int samples) {
  SceneDescription description = room(samples);
  RenderSettings settings = description.settings;
  Diagnostics diagnostics;
  const auto scene = compile_scene(std::move(description), diagnostics, {});
  Measurement first = measure(*scene, settings);
  settings.seed = 1;
  const Measurement second = measure(*scene, settings);
  std::printf("%.3f us a sample, relative variance %.3e, checksum %08x\n",
              std::min(first.microseconds, second.microseconds),
              relative_variance(first.picture, second.picture), checksum(first.picture));
}

}  // namespace
}  // namespace tenniel

int main(int count, char** arguments) {
  const int samples = count > 1 ? std::max(std::atoi(arguments[1]), 1) : 16;
  tbb::task_arena(1).execute([&] { tenniel::run(samples); });
}
