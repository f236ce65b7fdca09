// SPDX-License-Identifier: Apache-2.0
// Collects what readers and checker find wrong with a PLC program, all of it, for one report in the order of the text.

#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plc/model/place.h"

namespace indurop::plc {

class Diagnostics {
 public:
  // Text: what is wrong, then what to do. The same text at the same place is kept once.
  void error(const Place& at, std::string text) { add(true, at, std::move(text)); }
  void warning(const Place& at, std::string text) { add(false, at, std::move(text)); }

  // The text of a file whose lines are shown below messages about it. Drawn programs have none.
  void show_lines_of(const std::string& file, std::string text) { texts_[file] = std::move(text); }

  [[nodiscard]] bool failed() const noexcept { return errors_ > 0; }
  [[nodiscard]] std::size_t errors() const noexcept { return errors_; }

  // "prog.st:12:5: error: text" or, with Place::within, "prog.xml:80:3: error: POU main, rung 3: text", then the line
  // of the source where it is known, with a mark. Files in the order in which they were first complained about, lines
  // ascending; at most 100 errors.
  [[nodiscard]] std::string render() const;

 private:
  struct Message {
    bool is_error = true;
    Place at;
    std::string text;
  };
  void add(bool is_error, const Place& at, std::string text);

  [[nodiscard]] std::string picture(const Place& at) const;

  std::vector<Message> messages_;
  std::map<std::string, std::string> texts_;
  std::size_t errors_ = 0;
};

}  // namespace indurop::plc
