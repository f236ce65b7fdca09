// SPDX-License-Identifier: Apache-2.0
// A block of lines on a terminal that is painted again in place, and single keys from it. Everything is put back to
// normal at the end.

#pragma once

#include <termios.h>

#include <string>
#include <vector>

#include "tools/command/output.h"

namespace indurop::tools {

class Screen {
 public:
  // Reads keys if stdin is a terminal too.
  explicit Screen(Output& output);
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;
  ~Screen();

  // Shows these lines where the last ones were; each is cut at the right border.
  void paint(const std::vector<std::string>& lines);
  // The last lines stay where they are; what is printed next comes below.
  void leave_behind() { painted_ = 0; }
  // File to wait on for keys, -1 if there are none.
  [[nodiscard]] int key_file() const noexcept { return keys_ ? 0 : -1; }
  // Next key typed, 0 if none.
  char key();

 private:
  Output& output_;
  std::size_t painted_ = 0;
  bool keys_ = false;
  termios before_{};
};

// `text` cut to `columns` places on the screen; escape sequences take none and are kept.
std::string cut_to_width(const std::string& text, std::size_t columns);

}  // namespace indurop::tools
