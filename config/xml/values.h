// SPDX-License-Identifier: Apache-2.0
// Values written in module.xml, from text. Where the contract's functions only say no, these say why.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace indurop::config {

// "10", "USR1", "SIGUSR1", "SIGRTMIN+2". Empty `value`: `problem` says why.
struct SignalText {
  std::optional<int> value;
  std::string problem;
};
SignalText read_signal(std::string_view text);
std::string signal_name(int signal);

// Whole decimal number within [low, high]; empty otherwise.
std::optional<std::int64_t> read_integer(std::string_view text, std::int64_t low, std::int64_t high);
// Finite number, "-0.5" or "1e-3"; empty otherwise.
std::optional<double> read_real(std::string_view text);

}  // namespace indurop::config
