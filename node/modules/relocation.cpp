// SPDX-License-Identifier: Apache-2.0
#include "node/modules/relocation.h"

namespace indurop::node {

// A variable of exactly this place and size counts, else the smallest one around all that it leads to.
std::optional<std::uint64_t> Relocation::find(const StateAddress& address) const {
  const auto to = reinterpret_cast<std::uintptr_t>(address.to);
  if (to == 0 || address.ended != 0) {
    return to;
  }
  const Place* best = nullptr;
  for (const Place& one : places_) {
    if (one.before == to && one.size == address.size) {
      return one.now;
    }
    const bool inside = to >= one.before && to - one.before < one.size && address.size <= one.size - (to - one.before);
    best = inside && (best == nullptr || one.size < best->size) ? &one : best;
  }
  return best == nullptr ? std::nullopt : std::optional(best->now + (to - best->before));
}

}  // namespace indurop::node
