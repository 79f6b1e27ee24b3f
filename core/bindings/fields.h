// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bindings/convert.h"

namespace tenniel {

// Binds a plain struct: a default constructor and checked attributes. A `path` is one pointer to
// member, or several when a struct within the struct is flattened:
//   Fields<LightDesc>(module, "LightDesc", "...")
//       .field("energy", &LightDesc::energy)
//       .field("worlds", &LightDesc::visibility, &VisibilityDesc::worlds);
template <class Desc>
class Fields {
 public:
  // `name` must be a literal: messages refer to it later.
  Fields(py::module_& module, const char* name, const char* doc)
      : class_(module, name, doc, py::module_local()), name_(name) {
    class_.def(py::init<>());
  }

  // A value: copied in, a copy comes out.
  template <class... Path>
  Fields& field(const char* name, Path... path) {
    return property(name, Convert<Member<Path...>>::from_python, path...);
  }

  // A buffer or None.
  template <class... Path>
  Fields& optional(const char* name, Path... path) {
    using T = Member<Path...>;
    const auto read = [](py::handle value, FieldName field) {
      return value.is_none() ? T() : Convert<T>::from_python(value, field);
    };
    return property(name, read, path...);
  }

  // An integer within [low, high].
  template <class... Path>
  Fields& ranged(const char* name, int low, int high, Path... path) {
    const auto read = [low, high](py::handle value, FieldName field) {
      return static_cast<Member<Path...>>(integer_from_python(value, field, low, high));
    };
    return property(name, read, path...);
  }

  // One of Blender's identifiers.
  template <class... Path>
  Fields& choice(const char* name, std::vector<std::string> allowed, Path... path) {
    const auto read = [allowed = std::move(allowed)](py::handle value, FieldName field) {
      return choice_from_python(value, field, allowed);
    };
    return property(name, read, path...);
  }

  // A struct bound by itself: copied in, a reference into this one comes out.
  template <class T>
  Fields& part(const char* name, T Desc::*member) {
    const FieldName field{name_, name};
    class_.def_property(name,
                        py::cpp_function([member](Desc& desc) -> T& { return desc.*member; },
                                         py::return_value_policy::reference_internal),
                        [member, field](Desc& desc, const py::object& value) {
                          desc.*member = bound_from_python<T>(value, field);
                        });
    return *this;
  }

  // For methods.
  py::class_<Desc>& bound() { return class_; }

 private:
  template <class... Path>
  using Member = std::remove_cvref_t<decltype((std::declval<Desc&>().*....*std::declval<Path>()))>;

  template <class Read, class... Path>
  Fields& property(const char* name, Read read, Path... path) {
    const FieldName field{name_, name};
    class_.def_property(
        name,
        [path...](const Desc& desc) {
          return Convert<Member<Path...>>::to_python((desc.*....*path));
        },
        [read, field, path...](Desc& desc, const py::object& value) {
          (desc.*....*path) = read(value, field);
        });
    return *this;
  }

  py::class_<Desc> class_;
  const char* name_;
};

}  // namespace tenniel
