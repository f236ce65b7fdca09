// SPDX-License-Identifier: Apache-2.0
#include "node/modules/expected_signal.h"

#include <sys/syscall.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

namespace indurop::node {
namespace {

std::uint64_t signals_in_status(const std::filesystem::path& thread) {
  std::ifstream file(thread / "status");
  std::uint64_t found = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("SigCgt:") || line.starts_with("SigBlk:") || line.starts_with("SigIgn:")) {
      found |= std::strtoull(line.c_str() + std::strlen("SigCgt:"), nullptr, 16);
    }
  }
  return found;
}

// While a thread is in sigwait() the kernel does not count the signals it waits for as blocked.
bool waits_for_signals(const std::filesystem::path& thread) {
  std::ifstream file(thread / "syscall");
  long number = -1;
  return file >> number && number == SYS_rt_sigtimedwait;
}

// Returns true if the thread sleeps ("State:\tS (sleeping)") and the signal is in none of the sets of pending ones.
bool rests(const std::filesystem::path& thread, int signal) {
  std::ifstream file(thread / "status");
  bool sleeps = false;
  std::uint64_t pending = 0;
  for (std::string line; std::getline(file, line);) {
    sleeps = sleeps || line.starts_with("State:\tS");
    if (line.starts_with("SigPnd:") || line.starts_with("ShdPnd:")) {
      pending |= std::strtoull(line.c_str() + std::strlen("SigPnd:"), nullptr, 16);
    }
  }
  return sleeps && (pending >> static_cast<unsigned>(signal - 1) & 1U) == 0;
}

}  // namespace

bool has_dealt_with(pid_t process, int signal) {
  return rests("/proc/" + std::to_string(process), signal);
}

bool expects_signal(pid_t process, int signal) {
  std::error_code ignored;
  const std::filesystem::path threads = "/proc/" + std::to_string(process) + "/task";
  for (std::filesystem::directory_iterator at(threads, ignored), end; at != end; at.increment(ignored)) {
    if ((signals_in_status(at->path()) >> static_cast<unsigned>(signal - 1) & 1U) != 0 ||
        waits_for_signals(at->path())) {
      return true;
    }
  }
  return false;
}

}  // namespace indurop::node
