// SPDX-License-Identifier: Apache-2.0
#include "geometry/attributes.h"

namespace tenniel {

int AttributeIds::intern(const std::string& name) {
  return ids_.try_emplace(name, static_cast<int>(ids_.size())).first->second;
}

int AttributeIds::find(const std::string& name) const {
  const auto it = ids_.find(name);
  return it == ids_.end() ? k_none : it->second;
}

}  // namespace tenniel
