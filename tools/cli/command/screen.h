// SPDX-License-Identifier: Apache-2.0
// A block of lines on a terminal that is repainted in place, and single keys typed there. The terminal is restored at
// the end.

#pragma once

#include <termios.h>

#include <string>
#include <vector>

#include "tools/console/output.h"

namespace indurop::tools {

class Screen {
 public:
  // Reads keys if stdin is a terminal too.
  explicit Screen(Output& output);
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;
  ~Screen();

  // Shows these lines in place of the previous ones; each is cut at the right border.
  void paint(const std::vector<std::string>& lines);
  // The current lines stay where they are; later output comes below them.
  void leave_behind() { painted_ = 0; }
  // File descriptor to wait on for keys, -1 if there are no keys.
  [[nodiscard]] int key_file() const noexcept { return keys_ ? 0 : -1; }
  // Returns the next key typed, 0 if there is none.
  char key();

 private:
  Output& output_;
  std::size_t painted_ = 0;
  bool keys_ = false;
  termios before_{};
};

// Returns `text` cut to `columns` columns of the screen; escape sequences take no column and are kept.
std::string cut_to_width(const std::string& text, std::size_t columns);

}  // namespace indurop::tools
