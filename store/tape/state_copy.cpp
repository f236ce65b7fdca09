// SPDX-License-Identifier: Apache-2.0
#include "store/tape/state_copy.h"

#include <csetjmp>
#include <cstdint>
#include <cstring>

#include "core/rt/guard.h"

namespace indurop::tape {

__attribute__((no_sanitize("thread"))) void copy_racing(std::byte* to, const void* from, std::size_t size) noexcept {
  const auto* const bytes = static_cast<const volatile std::byte*>(from);
  std::size_t i = 0;
  for (; i < size && (reinterpret_cast<std::uintptr_t>(from) + i) % sizeof(std::uint64_t) != 0; ++i) {
    to[i] = bytes[i];
  }
  for (; i + sizeof(std::uint64_t) <= size; i += sizeof(std::uint64_t)) {
    const std::uint64_t word = *reinterpret_cast<const volatile std::uint64_t*>(bytes + i);
    std::memcpy(to + i, &word, sizeof word);
  }
  for (; i < size; ++i) {
    to[i] = bytes[i];
  }
}

std::size_t save_by_function(const StateDescriptor& declared, std::span<std::byte> to) {
  rt::Guard guard;
  guard.enter();
  volatile std::size_t written = 0;
  if (sigsetjmp(guard.target(), 0) != 0) {
    guard.recovered();
    guard.leave();
    return 0;
  }
  guard.arm();
  try {
    written = declared.save(to.data(), to.size());
  } catch (...) {
    written = 0;
  }
  guard.disarm();
  guard.leave();
  return written <= to.size() ? written : 0;
}

}  // namespace indurop::tape
