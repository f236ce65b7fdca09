// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/version_text.h"

#include <fmt/format.h>

namespace indurop::node {

using scheduler::Exchange;

namespace {

constexpr std::size_t kShownDigits = 12;

}  // namespace

std::string short_digest(const std::string& digest) {
  return digest.substr(0, kShownDigits);
}

std::string count_errors(const operate::ReloadReport& report) {
  return fmt::format("the new version cannot run here: {} error{}", report.errors.size(),
                     report.errors.size() == 1 ? "" : "s");
}

std::string text_of(Exchange::Reason reason, const scheduler::ModuleRecord& module) {
  switch (reason) {
    case Exchange::Reason::None:
    case Exchange::Reason::Command:
      break;
    case Exchange::Reason::Fault:
      return fmt::format("the new one faulted in tick {}: {}", module.fault_tick.load(), module.last_fault);
    case Exchange::Reason::Overrun:
      return "the new one overran its period";
    case Exchange::Reason::Guard:
      return "the guard did not hold";
  }
  return "by command";
}

}  // namespace indurop::node
