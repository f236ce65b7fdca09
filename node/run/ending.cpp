// SPDX-License-Identifier: Apache-2.0
#include "node/run/ending.h"

#include <fmt/format.h>

#include <csignal>
#include <cstring>

namespace indurop::node {

std::optional<Ending> interruption(base::StopSignal& signals) {
  const int number = signals.wait({});
  if (number == 0) {
    return std::nullopt;
  }
  return Ending{number == SIGINT ? kInterrupted : kOk, fmt::format("signal {}", ::strsignal(number))};
}

std::string describe(const Error& error) {
  return error.sys_errno != 0 ? fmt::format("{}: {}", error.where, std::strerror(error.sys_errno))
                              : fmt::format("{}: {}", error.where, to_string(error.code));
}

}  // namespace indurop::node
