// SPDX-License-Identifier: Apache-2.0
#include "control/plc/st/c_code.h"
#include "control/plc/st/letters.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

namespace indurop::plc::st {
namespace {

std::vector<std::string_view> words_of(std::string_view code) {
  std::vector<std::string_view> out;
  for (std::size_t at = 0; at < code.size();) {
    std::size_t end = at + 1;
    if (is_word(code[at])) {
      while (end < code.size() && is_word(code[end])) {
        ++end;
      }
    }
    if (std::string_view(" \t\r\n{}").find(code[at]) == std::string_view::npos) {
      out.push_back(code.substr(at, end - at));
    }
    at = end;
  }
  return out;
}

constexpr std::string_view kTick = "__tick";
constexpr std::string_view kTickTime = "common_ticktime__";
constexpr std::array<std::string_view, 15> kTypes{"extern",  "unsigned", "signed",   "long",  "int",
                                                  "const",   "uint32_t", "uint64_t", "UDINT", "DINT",
                                                  "int64_t", "ULINT",    "LINT",     "DWORD", "LWORD"};
bool is_type(std::string_view word) noexcept {
  return std::find(kTypes.begin(), kTypes.end(), word) != kTypes.end();
}

// Returns the divisor; 0 if it is not a number of full thousands.
std::int64_t divisor(std::string_view word) noexcept {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const std::string_view rest(end, static_cast<std::size_t>(word.data() + word.size() - end));
  const bool fine = error == std::errc{} && rest.find_first_not_of("uUlL") == std::string_view::npos;
  return fine && (number == 1000 || number == 1'000'000) ? number : 0;
}

}  // namespace

// Accepts declarations of C, products of the two and of declared variables, and quotients by thousands: nothing else.
std::optional<TimeBase> time_base(std::string_view code) {
  const std::vector<std::string_view> words = words_of(code);
  std::vector<std::string_view> known{kTick, kTickTime};
  TimeBase out;
  bool ticks = false;
  bool tick_time = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string_view word = words[i];
    const std::string_view before = i > 0 ? words[i - 1] : ";";
    const std::string_view next = i + 1 < words.size() ? words[i + 1] : ";";
    if (!is_word(word[0])) {
      if (std::string_view(";()=*/").find(word[0]) == std::string_view::npos) {
        return std::nullopt;
      }
      continue;
    }
    ticks = ticks || word == kTick;
    tick_time = tick_time || word == kTickTime;
    if (is_digit(word[0])) {
      const std::int64_t by = before == "/" ? divisor(word) : 0;
      if (by == 0 || out.unit_ns > 1'000'000'000 / by) {
        return std::nullopt;
      }
      out.unit_ns *= by;
    } else if (is_type(before) && !is_type(word)) {  // declared
      known.push_back(word);
    } else if (next == "=" && before == ";" && out.variable.empty()) {
      out.variable = word;
    } else if (!is_type(word) && std::find(known.begin(), known.end(), word) == known.end()) {
      return std::nullopt;
    }
  }
  const bool fine = ticks && tick_time && !out.variable.empty() && out.unit_ns <= 1'000'000;
  return fine ? std::optional(out) : std::nullopt;
}

}  // namespace indurop::plc::st
