// SPDX-License-Identifier: Apache-2.0
// The terminal of `indurop top`: the one place that includes ncurses. Put back to normal at the end.

#pragma once

#include <vector>

#include "tools/top/top_page.h"

namespace indurop::tools {

class TopScreen {
 public:
  TopScreen();
  TopScreen(const TopScreen&) = delete;
  TopScreen& operator=(const TopScreen&) = delete;
  ~TopScreen();

  [[nodiscard]] Extent extent() const;
  void paint(const std::vector<TopLine>& lines);
  enum class Key { None, Quit, Node, Sort, Pause, Up, Down, PageUp, PageDown, Other };
  // The next key; waits at most so long. A new size of the terminal is one, too.
  Key key(int wait_ms);
};

}  // namespace indurop::tools
