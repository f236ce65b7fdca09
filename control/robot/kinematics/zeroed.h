// SPDX-License-Identifier: Apache-2.0
// An allocator whose memory is zero before anything is constructed in it, so that what has no initial value is the same
// in each process (KeptImage compares it).

#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

namespace indurop::robot {

template <class T>
struct Zeroed {
  using value_type = T;
  static_assert(alignof(T) <= alignof(std::max_align_t));

  Zeroed() = default;
  template <class U>
  Zeroed(const Zeroed<U>& /*other*/) noexcept {}  // NOLINT(google-explicit-constructor): as allocators are

  [[nodiscard, gnu::noinline]] T* allocate(std::size_t count) const {
    void* const memory = std::calloc(count, sizeof(T));  // NOLINT(cppcoreguidelines-no-malloc): only it gives zeros
    if (memory == nullptr) {
      throw std::bad_alloc();
    }
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t /*count*/) const noexcept {
    std::free(memory);  // NOLINT(cppcoreguidelines-no-malloc): of calloc
  }
  friend bool operator==(const Zeroed& /*a*/, const Zeroed& /*b*/) noexcept { return true; }
};

// A base of classes whose objects lie in such memory.
struct InZeroedMemory {
  static void* operator new(std::size_t bytes) { return Zeroed<std::byte>().allocate(bytes); }
  static void operator delete(void* object) noexcept {
    Zeroed<std::byte>().deallocate(static_cast<std::byte*>(object), 0);
  }
};

}  // namespace indurop::robot
