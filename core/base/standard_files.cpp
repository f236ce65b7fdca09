// SPDX-License-Identifier: Apache-2.0
#include "core/base/standard_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdio>
#include <string>
#include <thread>

namespace indurop::base {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

// Returns true if a write of at most PIPE_BUF bytes does not wait. One that fails does not.
bool takes(int file, milliseconds patience) noexcept {
  pollfd ready{file, POLLOUT, 0};
  return ::poll(&ready, 1, static_cast<int>(std::clamp<milliseconds::rep>(patience.count(), 0, INT_MAX))) != 0;
}

// Returns false if it is not taken.
bool write_all(int file, std::string_view text, milliseconds patience) noexcept {
  while (!text.empty()) {
    if (!takes(file, patience)) {
      return false;
    }
    const ssize_t written = ::write(file, text.data(), std::min(text.size(), std::size_t{PIPE_BUF}));
    if (written < 0 && errno != EINTR) {
      return true;  // it cannot be written at all
    }
    text.remove_prefix(written < 0 ? 0 : static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

void open_standard_files() noexcept {
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(file, F_GETFD) < 0) {
      (void)::open("/dev/null", O_RDWR);  // takes the lowest number that is free: this one. Children get it, too
    }
  }
}

void report_line(std::string_view prefix, std::string_view text) {
  constexpr milliseconds kPatience{100};
  static std::atomic<std::uint64_t> dropped{0};
  const milliseconds patience = dropped.load() == 0 ? kPatience : milliseconds(0);
  if (!takes(STDERR_FILENO, patience)) {
    ++dropped;
    return;
  }
  std::string lines;
  if (const std::uint64_t lost = dropped.exchange(0); lost > 0) {
    lines = fmt::format("{} warning: {} messages were dropped: standard error was not read\n", prefix, lost);
  }
  lines += fmt::format("{} {}\n", prefix, text);
  if (!write_all(STDERR_FILENO, lines, patience)) {
    ++dropped;
  }
}

bool flush_standard_output(milliseconds patience) noexcept {
  constexpr milliseconds kPoll{5};
  const auto end = Clock::now() + patience;
  const auto rest = [end] { return std::chrono::duration_cast<milliseconds>(end - Clock::now()); };
  while (::ftrylockfile(stdout) != 0) {
    if (rest() <= milliseconds(0)) {
      return false;
    }
    std::this_thread::sleep_for(kPoll);
  }
  const bool taken = takes(STDOUT_FILENO, rest());
  if (taken) {
    ::fflush_unlocked(stdout);
  }
  ::funlockfile(stdout);
  return taken;
}

bool print_within(milliseconds patience, std::string_view text) noexcept {
  constexpr std::size_t kPart = PIPE_BUF / 2;  // stays in stdio's buffer until it is flushed
  bool taken = flush_standard_output(patience);
  while (taken && !text.empty()) {
    const std::string_view part = text.substr(0, kPart);
    (void)std::fwrite(part.data(), 1, part.size(), stdout);
    text.remove_prefix(part.size());
    taken = flush_standard_output(patience);
  }
  return taken;
}

}  // namespace indurop::base
