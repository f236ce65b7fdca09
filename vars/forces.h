// SPDX-License-Identifier: Apache-2.0
// Forced parts of variables: numbers that keep the value somebody forced, whoever writes them. The table is in the
// block, so that a force holds in every process of the board, without the node's or its maker's help.

#pragma once

#include <indurop/detail/abi.h>
#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rt/clock.h"
#include "vars/layout.h"

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

// False if the system has no robust locks.
bool init_forces(ForceTable& table) noexcept;

// Forces one more part, or one that is forced already to another value or time. Not real-time safe: waits until every
// processor has seen it. Errors: InvalidArgument (size), NoSpace (kMostForces parts are forced), Busy (somebody who
// changes the table is stopped, or a writer of the variable).
Status force(BlockHeader& header, const Force& what) noexcept;
// A later end, if `was` is still its end: nobody else has forced it or let it go. Errors: NotFound (else), Busy.
Status prolong(BlockHeader& header, const DirectoryEntry& variable, std::uint32_t offset, rt::MonoTime was,
               rt::MonoTime until) noexcept;
// The part keeps its value until somebody writes it. Errors: NotFound (it is not forced), Busy.
Status let_go(BlockHeader& header, const DirectoryEntry& variable, std::uint32_t offset) noexcept;
// Frees the places of those whose time is over. Does nothing while somebody else changes the table.
void let_overdue_go(BlockHeader& header, std::span<const DirectoryEntry> directory) noexcept;
// All of them, for the node that takes over a block: nobody else changes the table now.
void let_all_go(BlockHeader& header, std::span<const DirectoryEntry> directory) noexcept;

// Those whose time is not over at `now`. Points into the directory.
std::vector<Force> forces_of(const BlockHeader& header, std::span<const DirectoryEntry> directory);

// What writers do, real-time safe. See indurop_hold_scalar().
bool hold_scalar(void* entry) noexcept;
// Puts forced values into the version that is about to be committed.
void hold_parts(abi::RingHeader& ring, unsigned char* version) noexcept;

}  // namespace indurop::vars
