// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <type_traits>

#include "math/spectrum.h"
#include "math/vec.h"

namespace tenniel {

// Registers are floats; a vector or colour takes three in a row.
using RegisterIndex = int32_t;
constexpr RegisterIndex k_no_register = -1;

enum class SocketType : uint8_t { number, vector, color, closure };

// An input of a node: a constant, or the register that the node before it wrote.
template <class T>
struct Input {
  T value{};
  RegisterIndex source = k_no_register;
  bool linked() const { return source != k_no_register; }
};

// An output; `target` stays empty when nobody reads it, so that costly outputs can be skipped.
template <class T>
struct Output {
  RegisterIndex target = k_no_register;
  bool used() const { return target != k_no_register; }
};

template <class T>
constexpr SocketType socket_type() {
  static_assert(std::is_same_v<T, float> || std::is_same_v<T, Vec3> || std::is_same_v<T, Spectrum>);
  if constexpr (std::is_same_v<T, float>)
    return SocketType::number;
  else if constexpr (std::is_same_v<T, Vec3>)
    return SocketType::vector;
  else
    return SocketType::color;
}

constexpr int register_count(SocketType type) {
  return type == SocketType::number ? 1 : type == SocketType::closure ? 0 : 3;
}

}  // namespace tenniel
