// SPDX-License-Identifier: Apache-2.0
// One variable of abi::Kind::Ring: the writer's side, and the reader's fallback when the lock-free read keeps failing.
// libindurop passes these functions to the inline code of generated headers. Real-time safe, no allocation.

#pragma once

#include <indurop/detail/abi.h>

#include <cstddef>
#include <cstdint>

#include "core/rt/shared_mutex.h"

namespace indurop::vars {

// Values up to this size are copied whole from version to version; for larger ones only the differences are copied.
inline constexpr std::uint32_t kWholeCopyLimit = 512;

// Fills a new entry: version 0 holds `initial` (value_size bytes, null: all zero). `memory` is zeroed, aligned to
// abi::kAlign and abi::entry_size() long. Returns false if the system has no such locks. Not real-time safe.
bool init_ring(void* memory, std::uint32_t value_size, const void* initial) noexcept;

// Takes the lock and returns the next version's slot, equal to the current version everywhere outside [offset, offset +
// length), which must lie inside the value and be filled by the caller. Returns null, and counts in lost_writes, if the
// lock was not free within 5 ms or the caller holds it. Ends with commit() or discard().
void* begin_write(abi::RingHeader& ring, std::uint32_t offset, std::uint32_t length) noexcept;
// The same for changes anywhere: the slot is a copy of the current version.
void* begin_edit(abi::RingHeader& ring) noexcept;
// The same, but returns null at once if another thread holds the lock.
void* try_begin_edit(abi::RingHeader& ring) noexcept;
void commit(abi::RingHeader& ring) noexcept;   // readers see the new version from here on
void discard(abi::RingHeader& ring) noexcept;  // the current version stays

// Returns true if the entry is one that init_ring created with this size and its lock works or is held by a living
// thread. Repairs what a killed writer left. Does not wait.
bool check_ring(abi::RingHeader& ring, std::uint32_t value_size) noexcept;

// Discards the unpublished version if the calling thread is between begin and commit; else nothing happens. `thread` is
// the calling one, passed in so that it is queried once for many rings.
void release_if_mine(abi::RingHeader& ring, rt::ThreadId thread) noexcept;

// Reads one consistent version of value bytes [offset, offset + length). Returns false if detail::kReadTries copies
// were all overtaken by three commits. Works on read-only memory. `value_size` comes from the caller: the size in the
// memory is not trusted.
bool try_read(const abi::RingHeader& ring, std::uint32_t value_size, std::uint32_t offset, void* to,
              std::uint32_t length) noexcept;
// Always succeeds: takes the lock to make writers wait. Needs writable memory.
void read_slow(abi::RingHeader& ring, void* to, std::uint32_t offset, std::uint32_t length) noexcept;
// `value_size` is the caller's, as in try_read().
void read_slow(abi::RingHeader& ring, std::uint32_t value_size, void* to, std::uint32_t offset,
               std::uint32_t length) noexcept;

}  // namespace indurop::vars
