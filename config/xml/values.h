// SPDX-License-Identifier: Apache-2.0
// Parses values of module.xml. Where the contract's functions only return failure, these return the reason.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace indurop::config {

// A signal: "10", "USR1", "SIGUSR1", "SIGRTMIN+2". If `value` is empty, `problem` is the reason.
struct SignalText {
  std::optional<int> value;
  std::string problem;
};
SignalText read_signal(std::string_view text);
std::string signal_name(int signal);

// Parses a whole decimal number within [low, high]; empty otherwise.
std::optional<std::int64_t> read_integer(std::string_view text, std::int64_t low, std::int64_t high);
// Parses a whole number in hexadecimal digits, at most `high`; empty otherwise.
std::optional<std::uint32_t> read_hex(std::string_view text, std::uint32_t high);
// Parses a finite number, "-0.5" or "1e-3"; empty otherwise.
std::optional<double> read_real(std::string_view text);

}  // namespace indurop::config
