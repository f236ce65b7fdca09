// SPDX-License-Identifier: Apache-2.0
// Collects what readers and checker find wrong with a PLC program, all of it, for one report in the order of the text.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "plc/model/place.h"

namespace indurop::plc {

class Diagnostics {
 public:
  // Text: what is wrong, then what to do. The same text at the same place is kept once.
  void error(const Place& at, std::string text) { add(true, at, std::move(text)); }
  void warning(const Place& at, std::string text) { add(false, at, std::move(text)); }

  [[nodiscard]] bool failed() const noexcept { return errors_ > 0; }
  [[nodiscard]] std::size_t errors() const noexcept { return errors_; }

  // One line each, "prog.st:12:5: error: text" or, with Place::within, "prog.xml:80:3: error: POU main, rung 3: text".
  // Files in the order in which they were first complained about, lines ascending; at most 100 errors.
  [[nodiscard]] std::string render() const;

 private:
  struct Message {
    bool is_error = true;
    Place at;
    std::string text;
  };
  void add(bool is_error, const Place& at, std::string text);

  std::vector<Message> messages_;
  std::size_t errors_ = 0;
};

}  // namespace indurop::plc
