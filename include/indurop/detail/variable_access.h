// SPDX-License-Identifier: Apache-2.0
// Reading and writing one variable in shared memory: atomics for scalars, a ring of versions for the rest.
// Every access leaves one record in the ELF section .indurop.access, so that the platform knows, before anything runs,
// which module reads and writes which variable. No syscall, no allocation.

#pragma once

#include <indurop/detail/abi.h>
#include <indurop/detail/mark.h>

#include <cstring>

namespace indurop::detail {

inline constexpr std::uint32_t kRead = 1;
inline constexpr std::uint32_t kWrite = 2;

#define INDUROP_ALWAYS_INLINE [[gnu::always_inline]] inline

// Record layout: u32 low half of the name hash, u32 high half, u32 direction. Not loaded at run time.
template <class Tag, std::uint32_t Direction>
INDUROP_ALWAYS_INLINE void record_access() noexcept {
  asm volatile(".pushsection .indurop.access,\"\",%%progbits\n\t.long %c0,%c1,%c2\n\t.popsection"
               :
               : "i"(static_cast<std::uint32_t>(Tag::kNameHash)),
                 "i"(static_cast<std::uint32_t>(Tag::kNameHash >> 32U)), "i"(Direction));
}

// Bytes move between private memory and a slot that a writer may be changing; the caller discards the copy if that
// happened. ThreadSanitizer cannot know that, so it sees relaxed atomics instead of memcpy.
INDUROP_ALWAYS_INLINE void copy_from_shared(void* to, const void* from, std::size_t size) noexcept {
#ifdef __SANITIZE_THREAD__
  auto* t = static_cast<unsigned char*>(to);
  const auto* f = static_cast<const unsigned char*>(from);
  for (std::size_t i = 0; i < size; ++i) {
    t[i] = __atomic_load_n(f + i, __ATOMIC_RELAXED);
  }
#else
  std::memcpy(to, from, size);
#endif
}
INDUROP_ALWAYS_INLINE void copy_to_shared(void* to, const void* from, std::size_t size) noexcept {
#ifdef __SANITIZE_THREAD__
  auto* t = static_cast<unsigned char*>(to);
  const auto* f = static_cast<const unsigned char*>(from);
  for (std::size_t i = 0; i < size; ++i) {
    __atomic_store_n(t + i, f[i], __ATOMIC_RELAXED);
  }
#else
  std::memcpy(to, from, size);
#endif
}

INDUROP_ALWAYS_INLINE bool is_forced(void* scalar) noexcept {
  const auto& offset = abi::forces_offset_of(scalar, abi::Kind::Scalar);
  return offset.load(std::memory_order_relaxed) != 0 && indurop_hold_scalar(scalar);
}

// Checks before the write, so that a forced value is never replaced even briefly, and after it, because the value may
// have been forced in between: forcing makes sure that this second check sees it (store/vars/forces.cpp), so no barrier
// is needed here.
template <class T>
INDUROP_ALWAYS_INLINE void scalar_write(void* entry, T value) noexcept {
  if (is_forced(entry)) [[unlikely]] {
    return;
  }
  __atomic_store(static_cast<T*>(entry), &value, __ATOMIC_RELEASE);
  std::atomic_signal_fence(std::memory_order_seq_cst);
  static_cast<void>(is_forced(entry));
}

// Returns the new value, or the forced one. `change` may be called more than once.
template <class T, class Change>
INDUROP_ALWAYS_INLINE T scalar_modify(void* entry, Change change) noexcept {
  T* target = static_cast<T*>(entry);
  T old;
  __atomic_load(target, &old, __ATOMIC_ACQUIRE);
  if (is_forced(entry)) [[unlikely]] {
    __atomic_load(target, &old, __ATOMIC_ACQUIRE);
    return old;
  }
  T wanted = change(old);
  while (!__atomic_compare_exchange(target, &old, &wanted, true, __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE)) {
    wanted = change(old);
  }
  std::atomic_signal_fence(std::memory_order_seq_cst);
  static_cast<void>(is_forced(entry));
  return wanted;
}

INDUROP_ALWAYS_INLINE unsigned char* slot(abi::RingHeader* ring, std::uint64_t seq, std::size_t stride) noexcept {
  return reinterpret_cast<unsigned char*>(ring) + sizeof(abi::RingHeader) + (seq % abi::kSlots) * stride;
}
INDUROP_ALWAYS_INLINE const unsigned char* slot(const abi::RingHeader* ring, std::uint64_t seq,
                                                std::size_t stride) noexcept {
  return reinterpret_cast<const unsigned char*>(ring) + sizeof(abi::RingHeader) + (seq % abi::kSlots) * stride;
}

// Copies a part of the current version; returns false if writers overtook it. The slot is written again only after
// three more commits: two are harmless.
INDUROP_ALWAYS_INLINE bool try_copy(const abi::RingHeader* ring, std::size_t stride, std::uint64_t seq, void* to,
                                    std::uint32_t offset, std::size_t length) noexcept {
  copy_from_shared(to, slot(ring, seq, stride) + offset, length);
  std::atomic_thread_fence(std::memory_order_acquire);
  return ring->seq.load(std::memory_order_relaxed) - seq <= abi::kSlots - 2;
}

// Returns false if writers overtook all kReadTries copies.
inline constexpr int kReadTries = 16;
INDUROP_ALWAYS_INLINE bool try_copies(const abi::RingHeader* ring, std::size_t stride, void* to, std::uint32_t offset,
                                      std::size_t length) noexcept {
  for (int i = 0; i < kReadTries; ++i) {
    if (try_copy(ring, stride, ring->seq.load(std::memory_order_acquire), to, offset, length)) {
      return true;
    }
  }
  return false;
}

template <std::size_t Size>
[[gnu::noinline, gnu::cold]] void ring_read_again(abi::RingHeader* ring, void* to, std::uint32_t offset,
                                                  std::size_t length) noexcept {
  if (!try_copies(ring, abi::slot_stride(Size), to, offset, length)) {
    indurop_read_slow(ring, to, offset, static_cast<std::uint32_t>(length));
  }
}

template <class T, std::size_t Size>
INDUROP_ALWAYS_INLINE T ring_read(abi::RingHeader* ring, std::uint32_t offset) noexcept {
  const std::uint64_t seq = ring->seq.load(std::memory_order_acquire);
  // Not initialised here, so that the compiler sees the value's own initial zeros overwritten and removes them.
  T value;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  if (!try_copy(ring, abi::slot_stride(Size), seq, &value, offset, sizeof(T))) [[unlikely]] {
    ring_read_again<Size>(ring, &value, offset, sizeof(T));
  }
  return value;
}

template <class T>
INDUROP_ALWAYS_INLINE void ring_write(abi::RingHeader* ring, std::uint32_t offset, const T& value) noexcept {
  if (void* to = indurop_begin_write(ring, offset, sizeof(T))) [[likely]] {
    copy_to_shared(static_cast<unsigned char*>(to) + offset, &value, sizeof(T));
    indurop_commit_write(ring);
  }
}

// Reads, changes and writes one part of the value while no other writer can; returns the new part.
template <class T, std::size_t Size, class Change>
INDUROP_ALWAYS_INLINE T ring_modify(abi::RingHeader* ring, std::uint32_t offset, Change change) noexcept {
  void* to = indurop_begin_write(ring, offset, sizeof(T));
  T value;
  if (to == nullptr) [[unlikely]] {
    return ring_read<T, Size>(ring, offset);
  }
  const std::uint64_t now = ring->seq.load(std::memory_order_relaxed);
  copy_from_shared(&value, slot(ring, now, abi::slot_stride(Size)) + offset, sizeof(T));
  value = change(value);
  copy_to_shared(static_cast<unsigned char*>(to) + offset, &value, sizeof(T));
  indurop_commit_write(ring);
  return value;
}

}  // namespace indurop::detail
