// SPDX-License-Identifier: Apache-2.0
#include "bindings/convert.h"

#include <algorithm>

namespace tenniel {

namespace {

std::string full_name(FieldName field) {
  return field.owner.empty() ? std::string(field.name)
                             : std::string(field.owner) + "." + std::string(field.name);
}

std::string type_name(py::handle value) {
  return value.is_none() ? "None" : bound_name(py::type::handle_of(value));
}

[[noreturn]] void throw_python(PyObject* type, const std::string& text) {
  PyErr_SetObject(type, text_to_python(text).ptr());
  throw py::error_already_set();
}

// Keeps what Python raised (a KeyboardInterrupt, a broken __getitem__) unless the type was wrong.
[[noreturn]] void throw_converted(FieldName field, std::string_view expected, py::handle value) {
  if (!PyErr_ExceptionMatches(PyExc_TypeError)) throw py::error_already_set();
  PyErr_Clear();
  throw_type_error(field, expected, value);
}

}  // namespace

void throw_type_error(FieldName field, std::string_view expected, py::handle value) {
  throw_python(PyExc_TypeError, full_name(field) + " must be " + std::string(expected) + ", not " +
                                    type_name(value));
}

void throw_value_error(FieldName field, const std::string& problem) {
  throw_python(PyExc_ValueError, full_name(field) + " " + problem);
}

std::string bound_name(py::handle type) {
  return text_from_python(type.attr("__name__"), {"type", "__name__"});
}

std::string text_from_python(py::handle value, FieldName field) {
  if (!PyUnicode_Check(value.ptr())) throw_type_error(field, "text", value);
  const auto bytes = py::reinterpret_steal<py::bytes>(
      PyUnicode_AsEncodedString(value.ptr(), "utf-8", "surrogateescape"));
  if (!bytes) throw py::error_already_set();
  return std::string(bytes);
}

py::str text_to_python(std::string_view text) {
  PyObject* decoded =
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "surrogateescape");
  if (!decoded) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(decoded);
}

bool flag_from_python(py::handle value, FieldName field) {
  if (!PyBool_Check(value.ptr())) throw_type_error(field, "a bool", value);
  return value.ptr() == Py_True;
}

int64_t integer_from_python(py::handle value, FieldName field, int64_t low, int64_t high) {
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!index) throw_converted(field, "an integer", value);
  int overflow = 0;
  const int64_t result = PyLong_AsLongLongAndOverflow(index.ptr(), &overflow);
  if (overflow != 0 || result < low || result > high)
    throw_value_error(field, "must be from " + std::to_string(low) + " to " + std::to_string(high) +
                                 ", not " + py::str(index).cast<std::string>());
  return result;
}

std::string choice_from_python(py::handle value, FieldName field,
                               const std::vector<std::string>& allowed) {
  std::string result = text_from_python(value, field);
  if (std::find(allowed.begin(), allowed.end(), result) != allowed.end()) return result;
  std::string names;
  for (const std::string& name : allowed)
    names += (names.empty() ? "" : ", ") + name;
  throw_value_error(field, "must be one of " + names + ", not '" + result + "'");
}

float number_from_python(py::handle value, FieldName field) {
  const double result = PyFloat_AsDouble(value.ptr());
  if (result == -1.0 && PyErr_Occurred()) throw_converted(field, "a number", value);
  return static_cast<float>(result);
}

bool is_sequence(py::handle value) {
  return PySequence_Check(value.ptr()) && !PyUnicode_Check(value.ptr()) &&
         !PyBytes_Check(value.ptr());
}

py::object items_from_python(py::handle value, FieldName field, std::string_view expected) {
  if (!is_sequence(value)) throw_type_error(field, expected, value);
  PyObject* items = PySequence_Fast(value.ptr(), "");
  if (!items) throw_converted(field, expected, value);
  return py::reinterpret_steal<py::object>(items);
}

std::vector<float> floats_from_python(py::handle value, FieldName field) {
  // Tables of ramps and curves come as buffers.
  if (py::isinstance<std::vector<float>>(value)) return value.cast<const std::vector<float>&>();
  const py::object items = items_from_python(value, field, "a sequence of numbers");
  std::vector<float> result;
  result.reserve(py::len(items));
  for (const py::handle item : items)
    result.push_back(number_from_python(item, field));
  return result;
}

void floats_from_python(py::handle value, FieldName field, std::span<float> target) {
  const py::object items = items_from_python(value, field, "a sequence of numbers");
  if (py::len(items) != target.size())
    throw_value_error(field, "needs " + std::to_string(target.size()) + " numbers, not " +
                                 std::to_string(py::len(items)));
  for (size_t i = 0; i < target.size(); ++i)
    target[i] = number_from_python(items[py::int_(i)], field);
}

py::tuple floats_to_python(std::span<const float> values) {
  py::tuple result(values.size());
  for (size_t i = 0; i < values.size(); ++i)
    result[i] = values[i];
  return result;
}

}  // namespace tenniel
