// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace tenniel {

struct Vec2 {
  float x = 0.0f, y = 0.0f;
};

// A point, direction or normal; the name of the variable says which, and in which space.
struct Vec3 {
  float x = 0.0f, y = 0.0f, z = 0.0f;

  constexpr float operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr float& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) {
  return {a.x + b.x, a.y + b.y};
}
constexpr Vec2 operator-(Vec2 a, Vec2 b) {
  return {a.x - b.x, a.y - b.y};
}
constexpr Vec2 operator*(Vec2 a, float s) {
  return {a.x * s, a.y * s};
}
constexpr Vec2 operator*(float s, Vec2 a) {
  return a * s;
}
constexpr bool operator==(Vec2 a, Vec2 b) {
  return a.x == b.x && a.y == b.y;
}

constexpr Vec3 operator+(Vec3 a, Vec3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3 operator-(Vec3 a, Vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3 operator-(Vec3 a) {
  return {-a.x, -a.y, -a.z};
}
constexpr Vec3 operator*(Vec3 a, Vec3 b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
constexpr Vec3 operator*(Vec3 a, float s) {
  return {a.x * s, a.y * s, a.z * s};
}
constexpr Vec3 operator*(float s, Vec3 a) {
  return a * s;
}
constexpr Vec3 operator/(Vec3 a, float s) {
  return a * (1.0f / s);
}
constexpr Vec3& operator+=(Vec3& a, Vec3 b) {
  return a = a + b;
}
constexpr Vec3& operator-=(Vec3& a, Vec3 b) {
  return a = a - b;
}
constexpr Vec3& operator*=(Vec3& a, float s) {
  return a = a * s;
}
constexpr bool operator==(Vec3 a, Vec3 b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

constexpr float dot(Vec2 a, Vec2 b) {
  return a.x * b.x + a.y * b.y;
}
constexpr float dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline float abs_dot(Vec3 a, Vec3 b) {
  return std::abs(dot(a, b));
}

constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline float length(Vec2 a) {
  return std::sqrt(dot(a, a));
}
inline float length(Vec3 a) {
  return std::sqrt(dot(a, a));
}
constexpr float length_squared(Vec3 a) {
  return dot(a, a);
}
inline float distance(Vec3 a, Vec3 b) {
  return length(a - b);
}
inline Vec3 normalize(Vec3 a) {
  return a / length(a);
}

// `fallback` where `a` has no direction (zero, NaN or infinite length).
inline Vec3 normalize_or(Vec3 a, Vec3 fallback) {
  const float len = length(a);
  return len > 0.0f && std::isfinite(len) ? a / len : fallback;
}

inline bool is_finite(Vec2 a) {
  return std::isfinite(a.x) && std::isfinite(a.y);
}
constexpr bool is_finite(Vec3 a) {
  const auto magnitude = [](float x) { return std::bit_cast<uint32_t>(x) & 0x7fffffffu; };
  return std::max(magnitude(a.x), std::max(magnitude(a.y), magnitude(a.z))) < 0x7f800000u;
}

constexpr Vec3 reflect(Vec3 wo, Vec3 normal) {
  return 2.0f * dot(wo, normal) * normal - wo;
}

// `n` turned to the hemisphere of `reference`.
constexpr Vec3 face_forward(Vec3 n, Vec3 reference) {
  return dot(n, reference) < 0.0f ? -n : n;
}

}  // namespace tenniel
