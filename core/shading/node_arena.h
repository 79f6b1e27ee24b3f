// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "shading/node_type.h"

namespace tenniel {

// The nodes of a program side by side in memory, in execution order.
class NodeArena {
 public:
  // Room for one node of each type, in this order.
  explicit NodeArena(const std::vector<const NodeType*>& types);
  NodeArena(const NodeArena&) = delete;
  NodeArena& operator=(const NodeArena&) = delete;
  ~NodeArena();

  // Copies `node` into the next place. Its type is that of the constructor's list.
  void* add(const void* node);

 private:
  std::vector<const NodeType*> types_;
  std::vector<size_t> offsets_;
  size_t alignment_ = 1, filled_ = 0;
  std::byte* block_ = nullptr;
};

}  // namespace tenniel
