// SPDX-License-Identifier: Apache-2.0
// Names and numbers of POSIX signals that can wake a legacy program.

#include <csignal>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "config/xml/values.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

struct Name {
  std::string_view name;
  int number;
};
constexpr std::array<Name, 32> kNames{{
    {"HUP", SIGHUP},       {"INT", SIGINT},   {"QUIT", SIGQUIT},   {"ILL", SIGILL},   {"TRAP", SIGTRAP},
    {"ABRT", SIGABRT},     {"BUS", SIGBUS},   {"FPE", SIGFPE},     {"KILL", SIGKILL}, {"USR1", SIGUSR1},
    {"STKFLT", SIGSTKFLT}, {"SEGV", SIGSEGV}, {"USR2", SIGUSR2},   {"PIPE", SIGPIPE}, {"ALRM", SIGALRM},
    {"TERM", SIGTERM},     {"CHLD", SIGCHLD}, {"CONT", SIGCONT},   {"STOP", SIGSTOP}, {"TSTP", SIGTSTP},
    {"TTIN", SIGTTIN},     {"TTOU", SIGTTOU}, {"URG", SIGURG},     {"XCPU", SIGXCPU}, {"XFSZ", SIGXFSZ},
    {"VTALRM", SIGVTALRM}, {"PROF", SIGPROF}, {"WINCH", SIGWINCH}, {"IO", SIGIO},     {"POLL", SIGPOLL},
    {"SYS", SIGSYS},       {"PWR", SIGPWR},
}};

std::optional<int> real_time(std::string_view name) {
  const bool from_low = name.starts_with("RTMIN");
  if (!from_low && !name.starts_with("RTMAX")) {
    return std::nullopt;
  }
  const std::string_view rest = name.substr(5);
  if (rest.empty()) {
    return from_low ? SIGRTMIN : SIGRTMAX;
  }
  if (rest.front() != (from_low ? '+' : '-')) {
    return std::nullopt;
  }
  const auto distance = read_integer(rest.substr(1), 0, SIGRTMAX - SIGRTMIN);
  if (!distance) {
    return std::nullopt;
  }
  return from_low ? SIGRTMIN + static_cast<int>(*distance) : SIGRTMAX - static_cast<int>(*distance);
}

std::optional<int> by_name(std::string_view name) {
  if (name.starts_with("SIG")) {
    name.remove_prefix(3);
  }
  const auto* found = std::find_if(kNames.begin(), kNames.end(), [name](const Name& n) { return n.name == name; });
  if (found != kNames.end()) {
    return found->number;
  }
  return real_time(name);
}

}  // namespace

std::optional<double> read_real(std::string_view text) {
  text.remove_prefix(text.starts_with('+') ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<std::int64_t> read_integer(std::string_view text, std::int64_t low, std::int64_t high) {
  if (text.starts_with('+') && text.size() > 1 && text[1] != '-') {
    text.remove_prefix(1);
  }
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < low || value > high) {
    return std::nullopt;
  }
  return value;
}

std::optional<std::uint32_t> read_hex(std::string_view text, std::uint32_t high) {
  constexpr int kBase = 16;
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, kBase);
  return error == std::errc{} && end == text.data() + text.size() && value <= high ? std::optional(value)
                                                                                   : std::nullopt;
}

SignalText read_signal(std::string_view text) {
  const auto number = read_integer(text, 0, SIGRTMAX);
  const std::optional<int> signal = number ? static_cast<int>(*number) : by_name(text);
  if (!signal) {
    return {std::nullopt, base::in_quotes(text) +
                              " is not a signal; write a name (SIGUSR1, SIGRTMIN+2) or a number 1-" +
                              std::to_string(SIGRTMAX)};
  }
  if (*signal == SIGKILL || *signal == SIGSTOP) {
    return {std::nullopt, signal_name(*signal) + " cannot be handled by any program; use SIGUSR1, for example"};
  }
  if (*signal == 0 || (*signal > SIGSYS && *signal < SIGRTMIN)) {
    return {std::nullopt, std::to_string(*signal) + " is not a signal programs can use; use SIGUSR1, for example"};
  }
  return {signal, {}};
}

std::string signal_name(int signal) {
  const auto* found =
      std::find_if(kNames.begin(), kNames.end(), [signal](const Name& n) { return n.number == signal; });
  if (found != kNames.end()) {
    return "SIG" + std::string(found->name);
  }
  if (signal >= SIGRTMIN && signal <= SIGRTMAX) {
    return signal == SIGRTMIN ? "SIGRTMIN" : "SIGRTMIN+" + std::to_string(signal - SIGRTMIN);
  }
  return "signal " + std::to_string(signal);
}

}  // namespace indurop::config
