// SPDX-License-Identifier: Apache-2.0
// Forced parts of variables: numbers held at a value against all writers. The table is in the block, so that a force
// holds in every process of the board, without help of the node or of the process that forced it.

#pragma once

#include <indurop/detail/abi.h>
#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/rt/clock.h"
#include "store/vars/layout.h"

namespace indurop::vars {

inline constexpr rt::MonoTime kForever = rt::MonoTime::max();

struct Force {
  const DirectoryEntry* variable = nullptr;
  std::uint32_t offset = 0;  // of the part in the value
  std::uint32_t size = 0;    // 1, 2, 4 or 8
  std::uint64_t value = 0;   // its first `size` bytes
  rt::MonoTime until;        // or kForever
  [[nodiscard]] std::span<const std::uint8_t> bytes() const noexcept {
    return {reinterpret_cast<const std::uint8_t*>(&value), size};
  }
};

// Returns false if the system has no robust locks.
bool init_forces(ForceTable& table) noexcept;

// Forces one more part, or changes the value or time of a forced one. Not real-time safe: waits until every processor
// has seen it. Errors: InvalidArgument (size), NoSpace (kMaxForces parts are forced), Busy (a process that changes the
// table, or a writer of the variable, is stopped).
Status force(BlockHeader& header, const Force& what) noexcept;
// Sets a later end, if `was` is still its end: no other user has re-forced or released it. Errors: NotFound
// (otherwise), Busy.
Status prolong(BlockHeader& header, const DirectoryEntry& variable, std::uint32_t offset, rt::MonoTime was,
               rt::MonoTime until) noexcept;
// Releases a force: the part keeps its value until the next write. Errors: NotFound (it is not forced), Busy.
Status release(BlockHeader& header, const DirectoryEntry& variable, std::uint32_t offset) noexcept;
// Frees the slots of expired forces. Does nothing while another process changes the table.
void release_overdue(BlockHeader& header, std::span<const DirectoryEntry> directory) noexcept;
// Releases all forces, for the node that takes over a block: no other process may change the table now.
void release_all(BlockHeader& header, std::span<const DirectoryEntry> directory) noexcept;

// Returns the forces that have not expired now. Points into the directory.
std::vector<Force> forces_of(const BlockHeader& header, std::span<const DirectoryEntry> directory);

// The writers' part, real-time safe. See indurop_hold_scalar().
bool hold_scalar(void* entry) noexcept;
// Copies forced values into the version that is about to be committed.
void hold_parts(abi::RingHeader& ring, unsigned char* version) noexcept;

}  // namespace indurop::vars
