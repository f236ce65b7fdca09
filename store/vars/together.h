// SPDX-License-Identifier: Apache-2.0
// Reads several variables that belong together. Real-time safe, no allocation, no lock.

#pragma once

#include <indurop/detail/abi.h>

#include <span>

namespace indurop::vars {

// Fills every piece's `to`. Variables of this board: as they were at one moment, between two commits. Variables of
// other boards: after one update of their board, if it sends them together. Returns false if this failed within some
// tens of tries; then each value is consistent in itself only. Needs writable memory, as ring.h's read_slow().
bool read_together(std::span<abi::Piece> pieces) noexcept;

}  // namespace indurop::vars
