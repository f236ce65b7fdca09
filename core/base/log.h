// SPDX-License-Identifier: Apache-2.0
// Messages of a program without a terminal of its own: lines on stderr that begin with the program's name.

#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace indurop::base {

// Not real-time safe. Any thread may write; each line is written whole.
class Log {
 public:
  // Lines begin with "PROGRAM[NAME]: ". `quiet` leaves out info().
  Log(std::string_view program, std::string_view name, bool quiet)
      : who_(fmt::format("{}[{}]", program, name)), quiet_(quiet) {}

  template <class... Argument>
  void info(fmt::format_string<Argument...> format, Argument&&... arguments) const {
    if (!quiet_) {
      line("", fmt::format(format, std::forward<Argument>(arguments)...));
    }
  }
  template <class... Argument>
  void warning(fmt::format_string<Argument...> format, Argument&&... arguments) const {
    line("warning: ", fmt::format(format, std::forward<Argument>(arguments)...));
  }
  template <class... Argument>
  void error(fmt::format_string<Argument...> format, Argument&&... arguments) const {
    line("error: ", fmt::format(format, std::forward<Argument>(arguments)...));
  }

 private:
  void line(std::string_view kind, std::string_view text) const;

  std::string who_;
  bool quiet_;
};

}  // namespace indurop::base
