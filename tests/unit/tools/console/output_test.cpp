// SPDX-License-Identifier: Apache-2.0
// Foreign text moves no cursor and sets no colour on the terminal of the reader.
#include "tools/console/output.h"

#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <array>
#include <string>

namespace indurop::tools {
namespace {

TEST(Output, Messages_have_no_escape_sequences_of_others) {
  testing::internal::CaptureStderr();
  Output out(ColorWhen::Always);
  out.error(
      "board \x1b[2J\x1b]0;title\x07 says \xc2\x9b"
      "5A\rhello\n  and more");
  out.note(
      "a\x1b[1A"
      "b");
  out.message_line("\x1b[8mhidden " + out.paint(Style::Bad, "red"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "indurop: \x1b[1;31merror: \x1b[0mboard ?[2J?]0;title? says ?5A?hello\n  and more\n"
            "indurop: a?[1Ab\n"
            "?[8mhidden \x1b[1;31mred\x1b[0m\n");
}

// What Output writes to a terminal that is its standard output.
std::string on_a_terminal(const std::string& text) {
  int terminal = -1;
  int end = -1;
  if (::openpty(&terminal, &end, nullptr, nullptr, nullptr) != 0) {
    return "no terminal";
  }
  const int before = ::dup(STDOUT_FILENO);
  ::dup2(end, STDOUT_FILENO);
  {
    Output out;
    out.write(text);
    out.flush();
  }
  ::dup2(before, STDOUT_FILENO);
  ::close(before);
  ::close(end);
  std::string seen;
  std::array<char, 256> block{};
  for (ssize_t got = 0; (got = ::read(terminal, block.data(), block.size())) > 0;) {
    seen.append(block.data(), static_cast<std::size_t>(got));
  }
  ::close(terminal);
  return seen;
}

TEST(Output, A_screen_moves_the_cursor_and_a_value_does_not) {
  const std::string screen = "\x1b[?25l\x1b[3A\rone\x1b[K\r\n\x1b[J";
  EXPECT_EQ(on_a_terminal("\x1b[?25l\x1b[3A\rone\x1b[K\n\x1b[J"), screen);
  EXPECT_EQ(on_a_terminal("\x1b[H\x1b[Jtable"), "\x1b[H\x1b[Jtable");
  EXPECT_EQ(on_a_terminal("name = \x1b[3A\x1b[2J\x1b[J\x07"), "name = ?[3A?[2J?[J?");
}

}  // namespace
}  // namespace indurop::tools
