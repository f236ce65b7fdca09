// SPDX-License-Identifier: Apache-2.0
// The dialect whose rules apply where the standard and an editor differ.

#pragma once

#include <cstdint>

namespace indurop::plc {

enum class Dialect : std::uint8_t {
  Iec,
  Codesys,  // and TwinCAT: bit strings are numbers, values are converted if no digit can be lost
};

}  // namespace indurop::plc
