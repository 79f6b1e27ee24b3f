// SPDX-License-Identifier: Apache-2.0
#include "shading/node_arena.h"

#include <algorithm>
#include <new>

namespace tenniel {

NodeArena::NodeArena(const std::vector<const NodeType*>& types) : types_(types) {
  size_t end = 0;
  for (const NodeType* type : types_) {
    offsets_.push_back((end + type->alignment - 1) / type->alignment * type->alignment);
    end = offsets_.back() + type->size;
    alignment_ = std::max(alignment_, type->alignment);
  }
  block_ = static_cast<std::byte*>(::operator new (end, std::align_val_t{alignment_}));
}

NodeArena::~NodeArena() {
  for (size_t i = 0; i < filled_; ++i)
    types_[i]->destroy(block_ + offsets_[i]);
  ::operator delete (block_, std::align_val_t{alignment_});
}

void* NodeArena::add(const void* node) {
  void* place = block_ + offsets_[filled_];
  types_[filled_]->copy(place, node);
  ++filled_;
  return place;
}

}  // namespace tenniel
