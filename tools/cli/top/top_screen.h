// SPDX-License-Identifier: Apache-2.0
// The terminal of `indurop top`: the only place that includes ncurses. Restores the terminal at the end.

#pragma once

#include <vector>

#include "tools/cli/top/top_page.h"

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
  // Returns the next key; waits at most this long. A change of the terminal's size also counts as a key.
  Key key(int wait_ms);
};

}  // namespace indurop::tools
