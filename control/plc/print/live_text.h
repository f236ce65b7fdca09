// SPDX-License-Identifier: Apache-2.0
// Structured Text and instruction lists of a running program: each line with the values of its variables.

#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::plc {

// The value of a variable, named as in the text but in capitals: "T.ET", "A[3].X"; "" if it has none.
using ValueOf = std::function<std::string(const std::string& path)>;

struct LiveLine {
  std::string text;
  std::string values;  // "speed = 5   t.ET = T#100ms"
};

[[nodiscard]] std::vector<LiveLine> live_lines(std::string_view text, const ValueOf& value_of);
// Returns the paths for which values are searched, in capitals, each once.
[[nodiscard]] std::vector<std::string> paths_in(std::string_view text);

}  // namespace indurop::plc
