// SPDX-License-Identifier: Apache-2.0
// Whether bytes found in shared memory are a tape.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "tape/layout.h"

namespace indurop::tape {

// Everything leads to inside of `memory`. Errors: Corrupt, VersionMismatch.
Status check_tape(std::span<const std::byte> memory);

inline const TapeHeader& header_of(const std::byte* memory) noexcept {
  return *reinterpret_cast<const TapeHeader*>(memory);
}
std::span<const TapeVariable> variables_of(const std::byte* memory) noexcept;
std::span<const TapeTrack> tracks_of(const std::byte* memory) noexcept;

}  // namespace indurop::tape
