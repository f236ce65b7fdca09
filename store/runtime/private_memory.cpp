// SPDX-License-Identifier: Apache-2.0

#include "store/runtime/private_memory.h"

#include <cstdio>
#include <cstring>

#include "store/vars/tear_free_ring.h"

namespace indurop::runtime {

void* PrivateMemory::entry_of(const abi::Ref& ref) {
  auto& entry = entries_[{ref.name_hash, ref.type_hash}];
  if (entry != nullptr) {
    return entry.get();
  }
  const std::size_t size = abi::entry_size(ref.kind, ref.value_size);
  entry.reset(std::aligned_alloc(abi::kAlign, size));  // NOLINT: needs its own alignment
  bool made = entry != nullptr;
  if (made) {
    std::memset(entry.get(), 0, size);
    if (ref.kind == abi::Kind::Ring) {
      made = vars::init_ring(entry.get(), ref.value_size, ref.initial);
    } else if (ref.initial != nullptr) {
      std::memcpy(entry.get(), ref.initial, ref.value_size);
    }
  }
  if (!made) {
    std::fprintf(stderr, "indurop: variable %s: no memory or no robust locks on this system\n", ref.name);
    std::abort();
  }
  return entry.get();
}

}  // namespace indurop::runtime
