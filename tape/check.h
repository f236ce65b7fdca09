// SPDX-License-Identifier: Apache-2.0
// Whether bytes found in shared memory are a tape.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tape/layout.h"

namespace indurop::tape {

// What of a tape does not change while it is written, copied so that nobody can change it under us.
struct TapeIndex {
  struct Track {
    std::uint64_t data_offset = 0;
    std::uint64_t words = 0;  // a power of two
    std::uint32_t module = 0;
    std::uint32_t only_read = 0;       // so many of `items`, at its begin
    std::vector<std::uint32_t> items;  // indices of variables
  };
  std::vector<TapeVariable> variables;
  std::uint64_t tracks_offset = 0;
  std::vector<Track> tracks;
};
// Everything leads to inside of `memory`. Errors: Corrupt, VersionMismatch.
Result<TapeIndex> index_tape(std::span<const std::byte> memory);

inline const TapeHeader& header_of(const std::byte* memory) noexcept {
  return *reinterpret_cast<const TapeHeader*>(memory);
}

}  // namespace indurop::tape
