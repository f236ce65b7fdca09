// SPDX-License-Identifier: Apache-2.0
// Messages of a program without a terminal of its own: lines on stderr that begin with the program's name, or entries
// of systemd's journal.

#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/journal.h"

namespace indurop::base {

// Not real-time safe. Any thread may write; each line is written whole.
class Log {
 public:
  // Lines begin with "PROGRAM[NAME]: "; entries of the journal have the fields SYSLOG_IDENTIFIER and INDUROP_BOARD.
  // `quiet` leaves out info(). With a journal, errors are lines as well, unless stderr is the journal.
  Log(std::string_view program, std::string_view name, bool quiet, std::shared_ptr<const Journal> journal = {})
      : program_(program), name_(name), quiet_(quiet), journal_(std::move(journal)) {}

  // Returns this log for messages about a module, which have the field INDUROP_MODULE.
  [[nodiscard]] Log about(std::string_view module) const {
    Log log = *this;
    log.module_ = module;
    return log;
  }

  template <class... Argument>
  void info(fmt::format_string<Argument...> format, Argument&&... arguments) const {
    if (!quiet_) {
      line(Journal::Priority::Info, fmt::format(format, std::forward<Argument>(arguments)...));
    }
  }
  template <class... Argument>
  void warning(fmt::format_string<Argument...> format, Argument&&... arguments) const {
    line(Journal::Priority::Warning, fmt::format(format, std::forward<Argument>(arguments)...));
  }
  template <class... Argument>
  void error(fmt::format_string<Argument...> format, Argument&&... arguments) const {
    line(Journal::Priority::Error, fmt::format(format, std::forward<Argument>(arguments)...));
  }

  [[nodiscard]] bool has_journal() const noexcept { return journal_ != nullptr; }

  // Writes an entry of the journal as it is; there must be a journal.
  void enter(Journal::Priority priority, std::string_view text) const;

 private:
  void line(Journal::Priority priority, std::string_view text) const;

  std::string program_;
  std::string name_;
  std::string module_;  // empty: no module
  bool quiet_;
  std::shared_ptr<const Journal> journal_;  // null: none
};

}  // namespace indurop::base
