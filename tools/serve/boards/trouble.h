// SPDX-License-Identifier: Apache-2.0
// Describes what is wrong with a board, worst first.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "history/alarms/alarm_book.h"
#include "tools/serve/boards/board.h"

namespace indurop::serve {

enum class Severity : std::uint8_t { Error, Warning, Note };
const char* word_of(Severity severity) noexcept;

struct Trouble {
  Severity severity = Severity::Error;
  std::string module;  // empty: the node
  std::string text;
  std::optional<std::uint64_t> tick;
};

std::vector<Trouble> troubles_of(const Board& board, const std::optional<tools::RunView>& run,
                                 const alarms::AlarmCounts& alarms);

}  // namespace indurop::serve
