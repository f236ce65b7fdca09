// SPDX-License-Identifier: Apache-2.0
// One variable of abi::Kind::Ring: its writer's side, and the reader's way out when the lock-free one keeps failing.
// libindurop hands these functions to the inline code of generated headers. Real-time safe, no allocation.

#pragma once

#include <indurop/detail/abi.h>

#include <cstddef>
#include <cstdint>

#include "rt/shared_mutex.h"

namespace indurop::vars {

// Values up to this size are copied whole from version to version; larger ones only where versions differ.
inline constexpr std::uint32_t kWholeCopyLimit = 512;

// Fills a new entry: version 0 holds `initial` (value_size bytes, null: all zero). `memory` is zeroed, aligned to
// abi::kAlign and abi::entry_size() long. False if the system has no such locks. Not real-time safe.
bool init_ring(void* memory, std::uint32_t value_size, const void* initial) noexcept;

// Takes the lock and returns the next version's slot, equal to the current version everywhere outside
// [offset, offset + length), which must lie inside the value and be filled by the caller. Null, and one more
// lost_writes, if the lock was not free within 5 ms or the caller has it. Ends with commit() or discard().
void* begin_write(abi::RingHeader& ring, std::uint32_t offset, std::uint32_t length) noexcept;
// The same for changes anywhere: the slot is a copy of the current version.
void* begin_edit(abi::RingHeader& ring) noexcept;
// The same, but null at once if somebody has the lock.
void* try_begin_edit(abi::RingHeader& ring) noexcept;
void commit(abi::RingHeader& ring) noexcept;   // readers see the new version from here on
void discard(abi::RingHeader& ring) noexcept;  // the current version stays

// True if the entry is what init_ring made of this size and its lock works or is held by a living thread. Repairs
// what a killed writer left. Does not wait.
bool check_ring(abi::RingHeader& ring, std::uint32_t value_size) noexcept;

// Drops the unpublished version if the calling thread is between begin and commit; else nothing happens. `thread` is
// the calling one, asked for once when there are many rings.
void release_if_mine(abi::RingHeader& ring, rt::ThreadId thread) noexcept;

// One consistent version of value bytes [offset, offset + length). False if detail::kReadTries copies were all
// overtaken by three commits. Works on read-only memory. `value_size` is the caller's: what the memory says is not
// trusted.
bool try_read(const abi::RingHeader& ring, std::uint32_t value_size, std::uint32_t offset, void* to,
              std::uint32_t length) noexcept;
// Always succeeds: asks writers to wait through the lock. Needs writable memory.
void read_slow(abi::RingHeader& ring, void* to, std::uint32_t offset, std::uint32_t length) noexcept;
// `value_size` is the caller's, as in try_read().
void read_slow(abi::RingHeader& ring, std::uint32_t value_size, void* to, std::uint32_t offset,
               std::uint32_t length) noexcept;

}  // namespace indurop::vars
