// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "bindings/bind.h"
#include "bindings/convert.h"

namespace tenniel {

namespace {

template <class T>
size_t checked_index(const std::vector<T>& values, py::ssize_t i) {
  const auto count = static_cast<py::ssize_t>(values.size());
  if (i < 0) i += count;
  if (i < 0 || i >= count) throw py::index_error("buffer index out of range");
  return static_cast<size_t>(i);
}

// `format` as Python's struct module spells it: Blender's foreach_get copies straight into a buffer
// whose format is that of the property, and goes value by value otherwise.
template <class T>
void bind_buffer(py::module_& module, const char* name, const char* format, const char* doc) {
  using Values = std::vector<T>;
  py::class_<Values, Buffer<T>>(module, name, doc, py::buffer_protocol(), py::module_local())
      .def(py::init([name](const py::object& size) {
             const int64_t count = integer_from_python(size, {name, "size"}, 0,
                                                       std::numeric_limits<int64_t>::max() / 8);
             return std::make_shared<Values>(static_cast<size_t>(count));
           }),
           py::arg("size"))
      .def("__len__", [](const Values& values) { return values.size(); })
      .def(
          "__getitem__",
          [](const Values& values, py::ssize_t i) { return values[checked_index(values, i)]; },
          py::arg("i"))
      // Blender sets value by value where the formats differ.
      .def(
          "__setitem__",
          [name](Values& values, py::ssize_t i, const py::object& value) {
            values[checked_index(values, i)] = Convert<T>::from_python(value, {name, "[]"});
          },
          py::arg("i"), py::arg("value"))
      .def_buffer([format](Values& values) {
        return py::buffer_info(values.data(), sizeof(T), format, 1,
                               {static_cast<py::ssize_t>(values.size())},
                               {static_cast<py::ssize_t>(sizeof(T))});
      });
}

}  // namespace

void bind_buffers(py::module_& module) {
  bind_buffer<float>(module, "FloatBuffer", "f", "n float32, zeroed; for foreach_get and _set.");
  bind_buffer<uint32_t>(module, "UIntBuffer", "I", "n uint32, zeroed; for unsigned properties.");
  // Signed in the core, where they are subtracted; Blender declares these properties unsigned.
  bind_buffer<int32_t>(module, "IntBuffer", "I", "n int32 from 0, zeroed; format 'I'.");
  bind_buffer<uint8_t>(module, "ByteBuffer", "?", "n uint8, zeroed; for boolean properties.");
}

}  // namespace tenniel
