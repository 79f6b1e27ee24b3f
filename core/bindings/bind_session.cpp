// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bindings/bind.h"
#include "bindings/check_sizes.h"
#include "bindings/convert.h"
#include "film/pass.h"
#include "image/image_io.h"
#include "render/session.h"

namespace tenniel {

namespace {

// Every method of a session may lock or block: the threads of the interpreter go on meanwhile.
template <class Work>
auto without_gil(const Work& work) {
  const py::gil_scoped_release release;
  return work();
}

// What Python holds. A method takes its own reference while it still has the GIL, so `close` in one
// thread cannot free the session under a `wait` in another: the last of them does.
class SessionHandle {
 public:
  explicit SessionHandle(SceneDescription& scene) {
    SceneDescription taken = std::exchange(scene, {});
    without_gil([&] { session_ = std::make_shared<RenderSession>(std::move(taken)); });
  }
  ~SessionHandle() { release(std::move(session_)); }
  SessionHandle(const SessionHandle&) = delete;
  SessionHandle& operator=(const SessionHandle&) = delete;

  // Runs `work(session)` without the GIL.
  template <class Work>
  auto call(const Work& work) const {
    std::shared_ptr<RenderSession> session = session_;
    const py::gil_scoped_release released;
    const std::shared_ptr<RenderSession> held = std::move(session);
    return work(*held);
  }

  void close() {
    auto closed = std::make_shared<RenderSession>(SceneDescription());
    closed->close();
    release(std::exchange(session_, std::move(closed)));
  }

 private:
  // The destructor joins threads.
  static void release(std::shared_ptr<RenderSession> session) {
    if (!session) return;
    without_gil([&] {
      session->cancel();
      session.reset();
    });
  }

  std::shared_ptr<RenderSession> session_;
};

bool wait(const SessionHandle& handle, double seconds) {
  if (std::isnan(seconds)) throw_value_error({"RenderSession.wait", "seconds"}, "is not a number");
  constexpr double k_decades = 1e9;  // what a clock of nanoseconds can still be set to
  const double limit = std::clamp(seconds, 0.0, k_decades);
  return handle.call([&](RenderSession& session) { return session.wait(limit); });
}

py::list take_diagnostics(const SessionHandle& handle) {
  std::vector<Diagnostic> diagnostics =
      handle.call([](RenderSession& session) { return session.take_diagnostics(); });
  py::list result;
  for (Diagnostic& diagnostic : diagnostics)
    result.append(py::cast(std::move(diagnostic)));
  return result;
}

py::list finished_tiles(const SessionHandle& handle) {
  const std::vector<TileRect> tiles =
      handle.call([](RenderSession& session) { return session.finished_tiles(); });
  py::list result;
  for (const TileRect& tile : tiles)
    result.append(py::make_tuple(tile.x, tile.y, tile.width, tile.height));
  return result;
}

// Sizes of 0 reach to the edge of the picture.
TileRect checked_rectangle(TileRect rect, int width, int height) {
  const auto check = [](const char* name, const char* extent_name, int start, int& extent,
                        int limit) {
    if (start < 0 || start >= limit)
      throw_value_error({"read_pass", name}, "must be from 0 to " + std::to_string(limit - 1) +
                                                 ", not " + std::to_string(start));
    if (extent == 0) extent = limit - start;
    if (extent < 0 || extent > limit - start)
      throw_value_error(
          {"read_pass", extent_name},
          "must be from 0 to " + std::to_string(limit - start) + ", not " + std::to_string(extent));
  };
  check("x", "width", rect.x, rect.width, width);
  check("y", "height", rect.y, rect.height, height);
  return rect;
}

void read_pass(const SessionHandle& handle, const py::object& name, const py::object& target, int x,
               int y, int width, int height) {
  // Held here: Python may drop its own reference while the GIL is released.
  const auto buffer = Convert<Buffer<float>>::from_python(target, {"read_pass", "target"});

  const auto [full_width, full_height] = handle.call(
      [](RenderSession& session) { return std::pair(session.width(), session.height()); });
  if (full_width == 0) throw std::runtime_error("The render session is closed.");
  const std::vector<std::string> names =
      handle.call([](RenderSession& session) { return session.pass_names(); });
  const std::string pass = choice_from_python(name, {"read_pass", "name"}, names);
  const TileRect rect = checked_rectangle({x, y, width, height}, full_width, full_height);
  const bool done = handle.call([&](RenderSession& session) {
    return session.read_pass(pass, rect, buffer->data(), buffer->size());
  });
  if (done) return;
  const size_t needed =
      handle.call([&](RenderSession& session) { return session.pass_size(pass, rect); });
  throw_value_error({"read_pass", "target"}, "needs " + std::to_string(needed) + " values, not " +
                                                 std::to_string(buffer->size()));
}

void write_picture(const py::object& path, const py::object& pixels, int width, int height) {
  const std::string file = text_from_python(path, {"write_image", "path"});
  const auto buffer = Convert<Buffer<float>>::from_python(pixels, {"write_image", "pixels"});
  check_pixels(buffer, width, height, "write_image");
  const std::string error =
      without_gil([&] { return write_image(file, buffer->data(), width, height); });
  if (error.empty()) return;
  PyErr_SetObject(PyExc_OSError, text_to_python(error).ptr());
  throw py::error_already_set();
}

// A read-only text attribute.
template <class Owner, class Text>
auto text(Text Owner::*member) {
  return [member](const Owner& owner) { return text_to_python(owner.*member); };
}

void bind_reports(py::module_& module) {
  py::class_<Diagnostic>(module, "Diagnostic",
                         "What was replaced by a neutral stand-in, and where.", py::module_local())
      .def_property_readonly("severity", text(&Diagnostic::severity))
      .def_property_readonly("text", text(&Diagnostic::text))
      .def_property_readonly("object", text(&Diagnostic::object))
      .def_property_readonly("material", text(&Diagnostic::material))
      .def_property_readonly("node", text(&Diagnostic::node))
      .def_property_readonly("file", text(&Diagnostic::file));
  py::class_<Progress>(module, "Progress", "How far a render is; times in seconds.",
                       py::module_local())
      .def_property_readonly("stage", text(&Progress::stage))
      .def_readonly("samples_done", &Progress::samples_done)
      .def_readonly("samples_total", &Progress::samples_total)
      .def_readonly("fraction", &Progress::fraction)
      .def_readonly("elapsed", &Progress::elapsed)
      .def_readonly("remaining", &Progress::remaining)
      .def_readonly("memory_bytes", &Progress::memory_bytes)
      .def_readonly("peak_memory_bytes", &Progress::peak_memory_bytes)
      .def_readonly("dropped_samples", &Progress::dropped_samples)
      .def_readonly("generation", &Progress::generation);
}

void bind_passes(py::module_& module) {
  py::class_<PassInfo>(module, "PassInfo", "A pass as Blender names it.", py::module_local())
      .def_property_readonly("name", text(&PassInfo::name))
      .def_readonly("channels", &PassInfo::channels)
      .def_property_readonly("channel_ids", text(&PassInfo::channel_ids));
  module.def(
      "passes",
      []() {
        py::list result;
        for (const PassInfo& pass : k_passes)
          result.append(py::cast(PassInfo(pass)));
        return result;
      },
      "Every pass the core can deliver.");
}

void bind_render_session(py::module_& module) {
  py::class_<SessionHandle>(module, "RenderSession",
                            "Renders on native threads; none calls Python.", py::module_local())
      .def(py::init<SceneDescription&>(), py::arg("scene"),
           "Takes the contents of `scene`: it is empty afterwards. Starts nothing.")
      .def(
          "start",
          [](const SessionHandle& handle) {
            handle.call([](RenderSession& session) { session.start(); });
          },
          "Compiles and renders in the background.")
      .def("wait", &wait, py::arg("seconds"),
           "Until done or `seconds` are over; True when finished.")
      .def("cancel",
           [](const SessionHandle& handle) {
             handle.call([](RenderSession& session) { session.cancel(); });
           })
      .def_property_readonly(
          "progress",
          [](const SessionHandle& handle) {
            return handle.call([](RenderSession& session) { return session.progress(); });
          })
      .def_property_readonly("error",
                             [](const SessionHandle& handle) {
                               return text_to_python(handle.call(
                                   [](RenderSession& session) { return session.error(); }));
                             })
      .def("take_diagnostics", &take_diagnostics)
      .def("finished_tiles", &finished_tiles,
           "(x, y, width, height) of tiles finished since the last call, y up.")
      .def("read_pass", &read_pass, py::arg("name"), py::arg("target"), py::arg("x") = 0,
           py::arg("y") = 0, py::arg("width") = 0, py::arg("height") = 0,
           "Copies a rectangle (0 sizes: to the edge), bottom row first, channels interleaved.")
      .def("close", &SessionHandle::close, "Cancels, joins and frees; harmless twice.");
}

}  // namespace

void bind_session(py::module_& module) {
  bind_reports(module);
  bind_passes(module);
  bind_render_session(module);
  module.def("write_image", &write_picture, py::arg("path"), py::arg("pixels"), py::arg("width"),
             py::arg("height"),
             "Scene-linear RGBA, bottom row first, as EXR or PNG. Raises OSError.");
}

}  // namespace tenniel
