// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/top/top_screen.h"

#include <clocale>
#include <cstdlib>

#include <curses.h>

namespace indurop::tools {
namespace {

enum Pair : short { kGood = 1, kWarn, kBad, kAccent };

attr_t attributes_of(const TopLine& line) {
  attr_t out = line.reversed ? A_REVERSE : A_NORMAL;
  const bool colours = has_colors();
  const auto pair = [colours](short number, attr_t otherwise) {
    return colours ? static_cast<attr_t>(COLOR_PAIR(number)) : otherwise;
  };
  switch (line.style) {
    case Style::None:
      break;
    case Style::Bold:
      out |= A_BOLD;
      break;
    case Style::Dim:
      out |= A_DIM;
      break;
    case Style::Good:
      out |= pair(kGood, A_BOLD);
      break;
    case Style::Warn:
      out |= pair(kWarn, A_BOLD);
      break;
    case Style::Bad:
      out |= pair(kBad, A_STANDOUT);
      break;
    case Style::Accent:
      out |= pair(kAccent, A_NORMAL);
      break;
  }
  return out;
}

}  // namespace

TopScreen::TopScreen() {
  (void)std::setlocale(LC_CTYPE, "");
  initscr();
  cbreak();
  noecho();
  keypad(stdscr, TRUE);
  curs_set(0);
  if (has_colors() && std::getenv("NO_COLOR") == nullptr) {
    start_color();
    use_default_colors();
    constexpr short kOwn = -1;  // the terminal's default colour
    init_pair(kGood, COLOR_GREEN, kOwn);
    init_pair(kWarn, COLOR_YELLOW, kOwn);
    init_pair(kBad, COLOR_RED, kOwn);
    init_pair(kAccent, COLOR_CYAN, kOwn);
  }
}

TopScreen::~TopScreen() {
  endwin();
}

Extent TopScreen::extent() const {
  return {getmaxx(stdscr), getmaxy(stdscr)};
}

void TopScreen::paint(const std::vector<TopLine>& lines) {
  erase();
  int row = 0;
  for (const TopLine& line : lines) {
    attrset(static_cast<int>(attributes_of(line)));
    // Writing to the last column of the last line would scroll.
    mvaddnstr(row, 0, line.text.c_str(), -1);
    if (line.reversed) {
      for (int column = getcurx(stdscr); column < getmaxx(stdscr) && getcury(stdscr) == row; ++column) {
        addch(' ');
      }
    }
    ++row;
  }
  attrset(A_NORMAL);
  refresh();
}

TopScreen::Key TopScreen::key(int wait_ms) {
  timeout(wait_ms);
  switch (getch()) {
    case ERR:
      return Key::None;
    case 'q':
    case KEY_F(10):
      return Key::Quit;
    case 'n':
    case '\t':
      return Key::Node;
    case 's':
    case KEY_F(6):
      return Key::Sort;
    case ' ':
      return Key::Pause;
    case KEY_UP:
    case 'k':
      return Key::Up;
    case KEY_DOWN:
    case 'j':
      return Key::Down;
    case KEY_PPAGE:
      return Key::PageUp;
    case KEY_NPAGE:
      return Key::PageDown;
    default:
      return Key::Other;
  }
}

}  // namespace indurop::tools
