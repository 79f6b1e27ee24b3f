// SPDX-License-Identifier: Apache-2.0
#include <exception>
#include <string>

#include "bindings/bind.h"
#include "bindings/convert.h"
#include "geometry/accel.h"
#include "image/image_io.h"
#include "scene/diagnostics.h"

// The build compiles this module once per instruction set and names each.
PYBIND11_MODULE(TENNIEL_MODULE, module) {
  using namespace tenniel;
  module.doc() = "The native core of Tenniel; see _core.pyi for shapes, types and units.";
  module.attr("version") = TENNIEL_VERSION;
  module.attr("isa") = TENNIEL_ISA_LEVEL;
  module.attr("python_version") =
      std::to_string(PY_MAJOR_VERSION) + "." + std::to_string(PY_MINOR_VERSION);
  module.attr("embree_version") = Accel::embree_version();
  module.attr("oiio_version") = oiio_version();

  // NOLINTNEXTLINE: pybind11 fixes the type of the parameter.
  py::register_local_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const SceneError& error) {
      // Its sentence may name files, whose names need not be UTF-8.
      PyErr_SetObject(PyExc_RuntimeError, text_to_python(error.what()).ptr());
    }
  });

  bind_buffers(module);
  bind_nodes(module);
  bind_scene(module);
  bind_session(module);
}
