// SPDX-License-Identifier: Apache-2.0
// Output of the Beremiz LOGGER block: a line of the module. Real-time safe in a node.

#pragma once

#include <indurop/irp.h>
#include <indurop/plc/types.h>

#include <array>
#include <cstdint>

namespace indurop::iec {

// `level`: 0 critical, 1 warning, 2 info, 3 debug. Returns false if the line was dropped because too many are waiting.
template <Text Message>
bool log_message(std::int16_t level, const Message& message) noexcept {
  constexpr std::array<const char*, 4> kNames{"CRITICAL", "WARNING", "INFO", "DEBUG"};
  const bool known = level >= 0 && level < static_cast<std::int16_t>(kNames.size());
  return irp::printf("%s: %s\n", kNames[known ? static_cast<std::size_t>(level) : 2], message) >= 0;
}

}  // namespace indurop::iec
