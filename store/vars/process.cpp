// SPDX-License-Identifier: Apache-2.0

#include "store/vars/process.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace indurop::vars {

namespace {

struct Stat {
  char state = '\0';
  std::uint64_t start_time = 0;
};

// The second field, the program's name in parentheses, may itself contain blanks and parentheses.
Stat read_stat(pid_t pid) noexcept {
  char path[32];
  std::snprintf(path, sizeof(path), "/proc/%d/stat", static_cast<int>(pid));
  const int file = ::open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    return {};
  }
  char text[1024];
  const ssize_t length = ::read(file, text, sizeof(text) - 1);
  ::close(file);
  if (length <= 0) {
    return {};
  }
  text[length] = '\0';
  const char* at = std::strrchr(text, ')');
  if (at == nullptr || at[1] != ' ') {
    return {};
  }
  Stat result;
  result.state = at[2];
  constexpr int kFieldsBetween = 20;  // from the blank before field 3 to the blank before field 22
  ++at;
  for (int i = 1; i < kFieldsBetween && at != nullptr; ++i) {
    at = std::strchr(at + 1, ' ');
  }
  if (at != nullptr) {
    result.start_time = std::strtoull(at, nullptr, 10);
  }
  return result;
}

}  // namespace

std::uint64_t process_start_time(pid_t pid) noexcept {
  return pid > 0 ? read_stat(pid).start_time : 0;
}

bool process_alive(pid_t pid, std::uint64_t start_time) noexcept {
  if (pid <= 0) {
    return false;
  }
  const Stat stat = read_stat(pid);
  return stat.start_time != 0 && stat.start_time == start_time && stat.state != 'Z' && stat.state != 'X';
}

}  // namespace indurop::vars
