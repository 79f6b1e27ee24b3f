// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace tenniel {

// Thrown out of work that nobody wants any more.
struct Cancelled {};

// Asked in the loops of what may take longer than a tenth of a second; costs next to nothing.
class Cancellation {
 public:
  Cancellation() = default;  // never cancelled
  explicit Cancellation(const std::atomic<bool>* flag) : flag_(flag) {}

  void check() const {
    if (flag_ != nullptr && flag_->load(std::memory_order_relaxed)) throw Cancelled();
  }

 private:
  const std::atomic<bool>* flag_ = nullptr;
};

}  // namespace tenniel
