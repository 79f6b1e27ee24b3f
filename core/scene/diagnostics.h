// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tenniel {

// A scene that cannot be rendered at all; the text is a sentence for the artist.
class SceneError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Something in the scene that was replaced by a neutral stand-in.
struct Diagnostic {
  std::string severity;                      // "WARNING" or "INFO"
  std::string text;                          // a sentence for the artist
  std::string object, material, node, file;  // where; empty if it does not apply
};

// Collected from several threads while a scene is compiled.
class Diagnostics {
 public:
  void add(Diagnostic diagnostic) {
    const std::lock_guard lock(mutex_);
    list_.push_back(std::move(diagnostic));
  }
  std::vector<Diagnostic> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(list_, {});
  }

 private:
  std::mutex mutex_;
  std::vector<Diagnostic> list_;
};

}  // namespace tenniel
