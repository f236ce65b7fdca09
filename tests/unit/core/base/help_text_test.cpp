// SPDX-License-Identifier: Apache-2.0
// Lines of a help text end before column 100.
#include "core/base/help_text.h"

#include <gtest/gtest.h>

#include <string>

namespace indurop::base {
namespace {

std::string words(std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    text += "word ";
  }
  text.pop_back();
  return text;
}

TEST(HelpText, That_is_short_enough_stays) {
  const std::string text = "Hold values\n\nOptions:\n  -h,--help                   Print help\n\n  indurop get a\n";
  EXPECT_EQ(wrapped_help(text), text);
}

TEST(HelpText, A_description_continues_below_its_begin) {
  const std::string option = "  --for TIME                  ";
  EXPECT_EQ(wrapped_help(option + words(20) + "\n"),
            option + words(14) + "\n" + std::string(kHelpDescription, ' ') + words(6) + "\n");
}

TEST(HelpText, A_description_below_a_long_name_continues_there) {
  const std::string indent(kHelpDescription, ' ');
  EXPECT_EQ(wrapped_help("  assignment NAME=VALUE ... (required)\n" + indent + words(20) + "\n"),
            "  assignment NAME=VALUE ... (required)\n" + indent + words(14) + "\n" + indent + words(6) + "\n");
}

TEST(HelpText, A_paragraph_with_a_long_line_is_filled_again) {
  EXPECT_EQ(wrapped_help("short line\n" + words(21) + "\nand a last one.\nExamples:\n  indurop get a\n"),
            "short line " + words(17) + "\n" + words(4) + " and a last one.\nExamples:\n  indurop get a\n");
}

// Its space in column 29 makes the first line look like an option with its description.
TEST(HelpText, A_paragraph_is_no_option_wherever_its_words_end) {
  const std::string line = "Reads everything that a board keeps " + words(14);
  EXPECT_EQ(wrapped_help(line + "\nand a last line.\n"),
            "Reads everything that a board keeps " + words(12) + "\nword word and a last line.\n");
}

TEST(HelpText, A_letter_of_several_bytes_is_one_column) {
  std::string line;
  for (std::size_t i = 0; i < kHelpWidth; ++i) {
    line += "\xc3\xa9";
  }
  EXPECT_EQ(wrapped_help(line + "\n"), line + "\n");
  EXPECT_EQ(wrapped_help(line + " a\n"), line + "\na\n");
}

TEST(HelpText, A_word_longer_than_a_line_stays_whole) {
  const std::string word(120, 'x');
  EXPECT_EQ(wrapped_help("a " + word + " b\n"), "a\n" + word + "\nb\n");
}

}  // namespace
}  // namespace indurop::base
