// SPDX-License-Identifier: Apache-2.0
#include "tools/command/people.h"

#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <ctime>

#include "rt/clock.h"

namespace indurop::tools {

std::string user_name() {
  const passwd* const user = ::getpwuid(::geteuid());  // NOLINT(concurrency-mt-unsafe): one thread
  return user != nullptr ? user->pw_name : fmt::format("user {}", ::geteuid());
}

std::string local_time(std::int64_t wall_ns) {
  const std::time_t seconds = wall_ns / rt::kNanosPerSecond;
  std::tm parts{};
  ::localtime_r(&seconds, &parts);
  char text[32] = "";
  (void)std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &parts);
  return text;
}

}  // namespace indurop::tools
