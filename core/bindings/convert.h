// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "scene/description.h"

// Python values to core values and back. pybind11's own converters are not used for fields: their
// messages do not say which field was wrong, and they refuse mathutils types.
namespace tenniel {

namespace py = pybind11;

// Where a value is going, for messages: "LightDesc.type".
struct FieldName {
  std::string_view owner;
  std::string_view name;
};

// TypeError: "LightDesc.energy must be a number, not str".
[[noreturn]] void throw_type_error(FieldName field, std::string_view expected, py::handle value);
// ValueError: "MeshDesc.positions " + `problem`.
[[noreturn]] void throw_value_error(FieldName field, const std::string& problem);

// Blender's strings may hold bytes that are not UTF-8 (file names); they survive as surrogates.
std::string text_from_python(py::handle value, FieldName field);
py::str text_to_python(std::string_view text);

bool flag_from_python(py::handle value, FieldName field);
// Within [low, high], else ValueError.
int64_t integer_from_python(py::handle value, FieldName field, int64_t low, int64_t high);
// One of `allowed`, else ValueError that lists them.
std::string choice_from_python(py::handle value, FieldName field,
                               const std::vector<std::string>& allowed);
float number_from_python(py::handle value, FieldName field);

std::string bound_name(py::handle type);  // of a Python class

// Any sequence: list, tuple, mathutils types, bpy arrays, buffers. Text is none.
bool is_sequence(py::handle value);
// A list or tuple of the items of `value`.
py::object items_from_python(py::handle value, FieldName field, std::string_view expected);
std::vector<float> floats_from_python(py::handle value, FieldName field);
// As many as `target` holds, else ValueError.
void floats_from_python(py::handle value, FieldName field, std::span<float> target);
py::tuple floats_to_python(std::span<const float> values);

// A class that is bound by itself; the reference lives as long as `value`.
template <class T>
T& bound_from_python(py::handle value, FieldName field) {
  if (!py::isinstance<T>(value)) throw_type_error(field, bound_name(py::type::of<T>()), value);
  return value.cast<T&>();
}

// How one type of field crosses: from_python(value, field) and to_python(value).
template <class T>
struct Convert;

template <>
struct Convert<bool> {
  static bool from_python(py::handle value, FieldName field) {
    return flag_from_python(value, field);
  }
  static py::bool_ to_python(bool value) { return py::bool_(value); }
};

template <class T>
requires(std::is_integral_v<T> && !std::is_same_v<T, bool>) struct Convert<T> {
  static T from_python(py::handle value, FieldName field) {
    return static_cast<T>(integer_from_python(value, field, std::numeric_limits<T>::min(),
                                              std::numeric_limits<T>::max()));
  }
  static py::int_ to_python(T value) { return py::int_(value); }
};

template <>
struct Convert<float> {
  static float from_python(py::handle value, FieldName field) {
    return number_from_python(value, field);
  }
  static py::float_ to_python(float value) { return py::float_(value); }
};

template <>
struct Convert<std::string> {
  static std::string from_python(py::handle value, FieldName field) {
    return text_from_python(value, field);
  }
  static py::str to_python(const std::string& value) { return text_to_python(value); }
};

template <size_t n>
struct Convert<std::array<float, n>> {
  static std::array<float, n> from_python(py::handle value, FieldName field) {
    std::array<float, n> result;
    floats_from_python(value, field, result);
    return result;
  }
  static py::tuple to_python(const std::array<float, n>& value) { return floats_to_python(value); }
};

template <>
struct Convert<std::vector<int>> {
  static std::vector<int> from_python(py::handle value, FieldName field) {
    std::vector<int> result;
    for (const py::handle item : items_from_python(value, field, "a sequence of integers"))
      result.push_back(Convert<int>::from_python(item, field));
    return result;
  }
  static py::list to_python(const std::vector<int>& value) {
    py::list result;
    for (const int item : value)
      result.append(item);
    return result;
  }
};

template <size_t n>
struct Convert<std::vector<std::array<float, n>>> {
  using Item = std::array<float, n>;
  static std::vector<Item> from_python(py::handle value, FieldName field) {
    std::vector<Item> result;
    for (const py::handle item : items_from_python(value, field, "a sequence of sequences"))
      result.push_back(Convert<Item>::from_python(item, field));
    return result;
  }
  static py::list to_python(const std::vector<Item>& value) {
    py::list result;
    for (const Item& item : value)
      result.append(Convert<Item>::to_python(item));
    return result;
  }
};

// Lists of classes that are bound by themselves: copies in both directions.
template <class T>
requires std::is_class_v<T>
struct Convert<std::vector<T>> {
  static std::vector<T> from_python(py::handle value, FieldName field) {
    std::vector<T> result;
    const std::string expected = "a sequence of " + bound_name(py::type::of<T>());
    for (const py::handle item : items_from_python(value, field, expected))
      result.push_back(bound_from_python<T>(item, field));
    return result;
  }
  static py::list to_python(const std::vector<T>& value) {
    py::list result;
    for (const T& item : value)
      result.append(py::cast(item, py::return_value_policy::copy));
    return result;
  }
};

template <size_t n>
struct Convert<std::map<std::string, std::array<float, n>>> {
  using Map = std::map<std::string, std::array<float, n>>;
  static Map from_python(py::handle value, FieldName field) {
    if (!py::isinstance<py::dict>(value)) throw_type_error(field, "a dict", value);
    Map result;
    for (const auto& [key, item] : py::reinterpret_borrow<py::dict>(value))
      floats_from_python(item, field, result[text_from_python(key, field)]);
    return result;
  }
  static py::dict to_python(const Map& value) {
    py::dict result;
    for (const auto& [key, item] : value)
      result[text_to_python(key)] = floats_to_python(item);
    return result;
  }
};

// Buffers are shared, not copied.
template <class T>
struct Convert<Buffer<T>> {
  static Buffer<T> from_python(py::handle value, FieldName field) {
    bound_from_python<std::vector<T>>(value, field);
    return value.cast<Buffer<T>>();
  }
  static py::object to_python(const Buffer<T>& value) { return py::cast(value); }
};

}  // namespace tenniel
