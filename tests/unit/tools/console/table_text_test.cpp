// SPDX-License-Identifier: Apache-2.0
// A table as text: its columns are aligned, and its cells cannot change the terminal.
#include "tools/console/table_text.h"

#include <gtest/gtest.h>

namespace indurop::tools {
namespace {

TEST(TableText, Is_aligned_without_spaces_at_the_end) {
  Table sut({{"NAME", "name"}, {"TIME", "time_ns", Align::Right}, {"", "hidden"}, {"NOTE", ""}});
  sut.add({Cell("a"), {"12.3 us", 12345}, {"", true}, {"x", nullptr}});
  sut.add({Cell("longer, \"name\""), {"1 ns", 1}, {"", false}, {"", nullptr}});
  const Output plain(ColorWhen::Never);
  EXPECT_EQ(table_text(sut, plain),
            "NAME               TIME  NOTE\n"
            "a               12.3 us  x\n"
            "longer, \"name\"     1 ns\n");
}

TEST(TableText, Colour_does_not_change_the_alignment) {
  Table sut({{"A", "a"}, {"B", "b"}});
  sut.add({Cell("x", Style::Bad), Cell("y")});
  sut.add({Cell("long"), Cell("z")});
  const Output colored(ColorWhen::Always);
  EXPECT_EQ(table_text(sut, colored), "\x1b[1mA     B\x1b[0m\n\x1b[1;31mx\x1b[0m     y\nlong  z\n");
}

TEST(TableText, Is_empty_without_rows) {
  const Table sut(std::vector<Column>{{"A", "a"}});
  EXPECT_EQ(table_text(sut, Output(ColorWhen::Never)), "");
}

TEST(TableText, Of_a_broken_cell_cannot_reach_the_terminal) {
  Table sut(std::vector<Column>{{"A", "a"}});
  sut.add({Cell("\x1b[2J\xff")});
  EXPECT_EQ(table_text(sut, Output(ColorWhen::Never)), "A\n?[2J?\n");
}

}  // namespace
}  // namespace indurop::tools
