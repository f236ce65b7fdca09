// SPDX-License-Identifier: Apache-2.0
#include "core/base/log.h"

#include <array>
#include <cstdio>

#include "core/base/printable.h"
#include "core/base/standard_files.h"

namespace indurop::base {
namespace {

std::string_view kind_of(Journal::Priority priority) noexcept {
  switch (priority) {
    case Journal::Priority::Error:
      return "error: ";
    case Journal::Priority::Warning:
      return "warning: ";
    case Journal::Priority::Info:
      break;
  }
  return "";
}

}  // namespace

void Log::line(Journal::Priority priority, std::string_view text) const {
  const std::string safe = printable(text, "\t");
  if (has_journal()) {
    enter(priority, safe);
    if (priority != Journal::Priority::Error || stderr_is_journal()) {
      return;
    }
  }
  (void)flush_standard_output(std::chrono::milliseconds(0));
  report_line(fmt::format("{}[{}]:", program_, name_), fmt::format("{}{}", kind_of(priority), safe));
}

void Log::enter(Journal::Priority priority, std::string_view text) const {
  const std::array<Journal::Field, 3> fields{
      {{"SYSLOG_IDENTIFIER", program_}, {"INDUROP_BOARD", name_}, {"INDUROP_MODULE", module_}}};
  journal_->write(priority, text, std::span(fields).first(module_.empty() ? 2 : 3));
}

}  // namespace indurop::base
