// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

// One function a file; each adds its group of types to the module, after those it uses.
// All classes are module_local: two levels of the core may be loaded in one process.
namespace tenniel {

void bind_buffers(pybind11::module_& module);
void bind_nodes(pybind11::module_& module);
void bind_scene(pybind11::module_& module);
void bind_session(pybind11::module_& module);

}  // namespace tenniel
