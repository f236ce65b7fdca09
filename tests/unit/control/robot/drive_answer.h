// SPDX-License-Identifier: Apache-2.0
// The status words of a simulated drive, as far as these tests need CiA 402.

#pragma once

#include <cstdint>

namespace indurop::robot::test {

// Returns the next status word of a drive with `status` that receives the lower four bits of a control word.
inline std::uint16_t next_status(unsigned status, unsigned control) {
  constexpr std::uint16_t kDisabled = 0x40;
  constexpr std::uint16_t kReady = 0x21;
  constexpr std::uint16_t kSwitchedOn = 0x23;
  constexpr std::uint16_t kEnabled = 0x27;
  switch (control) {
    case 0x0F:
      if (status == kSwitchedOn || status == kEnabled) {
        return kEnabled;
      }
      return status == kReady ? kSwitchedOn : kReady;
    case 0x07:
      return status == kDisabled ? kReady : kSwitchedOn;
    case 0x06:
      return kReady;
    default:
      return kDisabled;
  }
}

}  // namespace indurop::robot::test
