// SPDX-License-Identifier: Apache-2.0
// Reads several variables that belong together. Real-time safe, no allocation, no lock.

#pragma once

#include <indurop/detail/abi.h>

#include <cstddef>
#include <span>

namespace indurop::vars {

// Fills every piece's `to`. Variables of this board: as they were at one moment, between two commits (a scalar has no
// version: one that changes and changes back twice meanwhile passes for unchanged). Variables of
// other boards: after one update of their board, if it sends them together. Returns false if this failed within some
// tens of tries; then each value is consistent in itself only. Needs writable memory, as tear_free_ring.h's
// read_slow().
bool read_together(std::span<abi::Piece> pieces) noexcept;

enum class Together {
  Yes,
  No,         // each value is consistent in itself only
  Overtaken,  // writers were faster than some tens of tries; nothing in `to` is reliable
};
// The same for memory that is mapped read-only and that others may have damaged: reads nothing outside of `block`,
// which contains the entries of all pieces.
Together read_together_in(std::span<const std::byte> block, std::span<abi::Piece> pieces) noexcept;

}  // namespace indurop::vars
