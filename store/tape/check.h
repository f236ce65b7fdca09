// SPDX-License-Identifier: Apache-2.0
// Checks whether bytes found in shared memory are a tape.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "store/tape/layout.h"

namespace indurop::tape {

// The constant parts of a tape, copied so that no process can change them during use.
struct TapeIndex {
  struct Track {
    std::uint64_t data_offset = 0;
    std::uint64_t words = 0;  // a power of two
    std::uint32_t module = 0;
    std::uint32_t only_read = 0;       // the first `only_read` of `items`
    std::vector<std::uint32_t> items;  // indices of variables
  };
  std::vector<TapeVariable> variables;  // of the start
  std::uint64_t variables_offset = 0;   // kLaterVariables more follow
  std::uint64_t tracks_offset = 0;
  std::uint64_t versions_offset = 0;
  std::uint32_t start_versions = 0;
  std::vector<Track> tracks;
};
// Checks that all offsets stay inside `memory`. Errors: Corrupt, VersionMismatch.
Result<TapeIndex> index_tape(std::span<const std::byte> memory);

inline const TapeHeader& header_of(const std::byte* memory) noexcept {
  return *reinterpret_cast<const TapeHeader*>(memory);
}

}  // namespace indurop::tape
