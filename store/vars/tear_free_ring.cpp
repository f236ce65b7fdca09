// SPDX-License-Identifier: Apache-2.0
// Reason for four slots and no undo: a reader of version v fails only if version v + 4 is begun before it is done, and
// a writer that dies has changed nothing but a slot that was never published.

#include "store/vars/tear_free_ring.h"

#include <indurop/detail/variable_access.h>

#include <algorithm>
#include <array>

#include "store/vars/forces.h"

namespace indurop::vars {

namespace {

using abi::DirtyRange;
using abi::kSlots;
using abi::RingHeader;

// Half-open byte range with room for sums of 32-bit offsets.
struct Span {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

Span load_dirty(const RingHeader& ring, std::uint64_t version) noexcept {
  DirtyRange range{};
  __atomic_load(&ring.dirty[version % kSlots], &range, __ATOMIC_RELAXED);
  const std::uint64_t begin = std::min(range.offset, ring.value_size);
  return {begin, std::min<std::uint64_t>(std::uint64_t{range.offset} + range.length, ring.value_size)};
}

// One 8-byte store: a writer that dies leaves the old range or the new one.
void store_dirty(RingHeader& ring, std::uint64_t version, Span span) noexcept {
  DirtyRange range{static_cast<std::uint32_t>(span.begin), static_cast<std::uint32_t>(span.end - span.begin)};
  __atomic_store(&ring.dirty[version % kSlots], &range, __ATOMIC_RELAXED);
}

void copy_span(unsigned char* to, const unsigned char* from, std::uint64_t begin, std::uint64_t end) noexcept {
#ifdef __SANITIZE_THREAD__  // see copy_from_shared
  for (; begin < end; ++begin) {
    __atomic_store_n(to + begin, __atomic_load_n(from + begin, __ATOMIC_RELAXED), __ATOMIC_RELAXED);
  }
#else
  if (begin < end) {
    std::memcpy(to + begin, from + begin, end - begin);
  }
#endif
}

// Copies `span` except what is in `hole`.
void copy_around(unsigned char* to, const unsigned char* from, Span span, Span hole) noexcept {
  copy_span(to, from, span.begin, std::min(span.end, hole.begin));
  copy_span(to, from, std::max(span.begin, hole.end), span.end);
}

// Updates the slot of version `now + 1` to version `now` outside `hole`. The slot holds version now - 3, so they differ
// where versions now - 2, now - 1 and now were dirty, and where an unfinished write left traces.
void catch_up(RingHeader& ring, std::uint64_t now, unsigned char* to, const unsigned char* from, Span hole) noexcept {
  std::array<Span, kSlots> spans{load_dirty(ring, now), load_dirty(ring, now - 1), load_dirty(ring, now - 2)};
  std::size_t count = kSlots - 1;
  Span announced = hole;
  if (ring.begun == now + 1) {
    spans[count] = load_dirty(ring, now + 1);
    announced = {std::min(hole.begin, spans[count].begin), std::max(hole.end, spans[count].end)};
    ++count;
  }
  // Announced before anything is changed, in this order, so that a process that finds this write unfinished knows
  // where.
  store_dirty(ring, now + 1, announced);
  std::atomic_signal_fence(std::memory_order_seq_cst);
  __atomic_store_n(&ring.begun, now + 1, __ATOMIC_RELAXED);
  std::atomic_thread_fence(std::memory_order_release);

  std::sort(spans.begin(), spans.begin() + count, [](Span a, Span b) { return a.begin < b.begin; });
  std::uint64_t done = 0;  // overlapping ranges are copied once
  for (std::size_t i = 0; i < count; ++i) {
    copy_around(to, from, {std::max(spans[i].begin, done), spans[i].end}, hole);
    done = std::max(done, spans[i].end);
  }
}

// A holder died: it is unknown which of its stores became visible, so everything is copied once.
[[gnu::noinline, gnu::cold]] void mark_all_dirty(RingHeader& ring) noexcept {
  for (std::uint64_t i = 0; i < kSlots; ++i) {
    store_dirty(ring, i, {0, ring.value_size});
  }
  __atomic_store_n(&ring.begun, ring.seq.load(std::memory_order_relaxed) + 1, __ATOMIC_RELAXED);
}

[[gnu::noinline, gnu::cold]] bool not_locked(RingHeader& ring, rt::LockResult result) noexcept {
  if (result == rt::LockResult::OwnerDied) {
    mark_all_dirty(ring);
    return true;
  }
  ring.lost_writes.fetch_add(1, std::memory_order_relaxed);
  return false;
}

// Kept out of the common path: whole writes of small values need none of this.
[[gnu::noinline]] void bring_up_to_date(RingHeader& ring, unsigned char* to, Span hole) noexcept {
  const std::uint64_t now = ring.seq.load(std::memory_order_relaxed);
  const unsigned char* from = indurop::detail::slot(&ring, now, ring.slot_stride);
  if (ring.value_size <= kWholeCopyLimit) {
    copy_around(to, from, {0, ring.value_size}, hole);
  } else {
    catch_up(ring, now, to, from, hole);
  }
}

// Requires the lock.
inline unsigned char* open_slot(RingHeader& ring, std::uint32_t offset, std::uint32_t length) noexcept {
  const std::uint64_t now = ring.seq.load(std::memory_order_relaxed);
  // A reader that sees any byte of the new version must see `seq` as it is now, or a later one.
  std::atomic_thread_fence(std::memory_order_release);
  unsigned char* to = indurop::detail::slot(&ring, now + 1, ring.slot_stride);
  if (length != ring.value_size || length > kWholeCopyLimit) {
    bring_up_to_date(ring, to, {offset, std::uint64_t{offset} + length});
  }
  return to;
}

inline unsigned char* begin(RingHeader& ring, std::uint32_t offset, std::uint32_t length) noexcept {
  const rt::LockResult result = rt::lock_within(ring.lock);
  if (result != rt::LockResult::Locked) [[unlikely]] {
    if (!not_locked(ring, result)) {
      return nullptr;
    }
  }
  return open_slot(ring, offset, length);
}

}  // namespace

bool init_ring(void* memory, std::uint32_t value_size, const void* initial) noexcept {
  auto* ring = static_cast<RingHeader*>(memory);
  ring->value_size = value_size;
  ring->slot_stride = static_cast<std::uint32_t>(abi::slot_stride(value_size));
  if (initial != nullptr) {
    std::memcpy(indurop::detail::slot(ring, 0, ring->slot_stride), initial, value_size);
  }
  mark_all_dirty(*ring);
  return rt::init_shared_mutex(ring->lock);
}

void* begin_write(RingHeader& ring, std::uint32_t offset, std::uint32_t length) noexcept {
  return begin(ring, offset, length);
}

void* begin_edit(RingHeader& ring) noexcept {
  unsigned char* to = begin(ring, 0, 0);
  if (to != nullptr && ring.value_size > kWholeCopyLimit) {
    store_dirty(ring, ring.seq.load(std::memory_order_relaxed) + 1, {0, ring.value_size});
  }
  return to;
}

void* try_begin_edit(RingHeader& ring) noexcept {
  const rt::LockResult result = rt::try_lock(ring.lock);
  if (!rt::is_locked(result)) {
    return nullptr;
  }
  if (result == rt::LockResult::OwnerDied) {
    mark_all_dirty(ring);
  }
  unsigned char* to = open_slot(ring, 0, 0);
  if (ring.value_size > kWholeCopyLimit) {
    store_dirty(ring, ring.seq.load(std::memory_order_relaxed) + 1, {0, ring.value_size});
  }
  return to;
}

void commit(RingHeader& ring) noexcept {
  if (ring.forces_offset.load(std::memory_order_relaxed) != 0) [[unlikely]] {
    hold_parts(ring, indurop::detail::slot(&ring, ring.seq.load(std::memory_order_relaxed) + 1, ring.slot_stride));
  }
  ring.seq.store(ring.seq.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  rt::unlock(ring.lock);
}

void discard(RingHeader& ring) noexcept {
  rt::unlock(ring.lock);
}

void release_if_mine(RingHeader& ring, rt::ThreadId thread) noexcept {
  if (rt::held_by(ring.lock, thread)) {
    rt::unlock(ring.lock);
  }
}

bool try_read(const RingHeader& ring, std::uint32_t value_size, std::uint32_t offset, void* to,
              std::uint32_t length) noexcept {
  return indurop::detail::try_copies(&ring, abi::slot_stride(value_size), to, offset, length);
}

bool check_ring(RingHeader& ring, std::uint32_t value_size) noexcept {
  if (ring.value_size != value_size || ring.slot_stride != abi::slot_stride(value_size)) {
    return false;
  }
  const rt::LockResult result = rt::lock_within(ring.lock, std::chrono::nanoseconds{0});
  if (result == rt::LockResult::OwnerDied) {
    mark_all_dirty(ring);
  }
  if (rt::is_locked(result)) {
    rt::unlock(ring.lock);
  }
  rt::inherit_shared_mutex(ring.lock);
  return result != rt::LockResult::Broken;
}

void read_slow(RingHeader& ring, void* to, std::uint32_t offset, std::uint32_t length) noexcept {
  read_slow(ring, ring.value_size, to, offset, length);
}

void read_slow(RingHeader& ring, std::uint32_t value_size, void* to, std::uint32_t offset,
               std::uint32_t length) noexcept {
  // This loop ends: without the lock no writer commits for long, and while a stopped or dead holder has it none
  // commits.
  while (!try_read(ring, value_size, offset, to, length)) {
    const rt::LockResult result = rt::lock_within(ring.lock);
    if (result == rt::LockResult::OwnerDied) {
      mark_all_dirty(ring);
    }
    if (rt::is_locked(result)) {
      const std::uint64_t now = ring.seq.load(std::memory_order_relaxed);
      indurop::detail::copy_from_shared(to, indurop::detail::slot(&ring, now, abi::slot_stride(value_size)) + offset,
                                        length);
      rt::unlock(ring.lock);
      return;
    }
  }
}

}  // namespace indurop::vars
