// SPDX-License-Identifier: Apache-2.0
// Messages of a client of the stream, parsed from JSON and checked, and the answers that are always the same.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/json.h"

namespace indurop::serve {

inline constexpr double kLeastRateHz = 0.1;
inline constexpr double kUsualRateHz = 10;
inline constexpr double kHighestRateHz = 100;
inline constexpr std::size_t kMostNames = 2000;       // maximum of one subscription, a glob counts once
inline constexpr std::size_t kMostVariables = 20000;  // maximum of one client
inline constexpr std::size_t kMostStreams = 32;       // maximum of one client

struct ClientWord {
  enum class Kind { Subscribe, Unsubscribe };
  Kind kind = Kind::Subscribe;
  std::uint32_t id = 0;
  std::string board;  // empty: the only board
  std::vector<std::string> names;
  double rate_hz = kUsualRateHz;
  bool binary = false;
};

struct WordProblem {
  bool garbage = false;  // not a JSON object: gets no answer
  std::optional<std::uint32_t> id;
  std::string message;
};

Result<ClientWord, WordProblem> read_word(std::string_view text);

// {"type": "error", "id", "error", "message"}
base::Json error_word(std::optional<std::uint32_t> id, std::string_view error, const std::string& message);

}  // namespace indurop::serve
