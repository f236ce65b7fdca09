// SPDX-License-Identifier: Apache-2.0
// Files that are not written in UTF-8.

#include "control/plc/front/encoding.h"

#include <gmock/gmock.h>

#include "tests/unit/control/plc/front/compiled.h"

namespace indurop::plc {
namespace {

using testing::compiled;
using ::testing::HasSubstr;
using testing::messages;

// Each byte becomes a unit.
std::string utf16(const std::string& text, bool big, bool mark) {
  std::string out = mark ? (big ? "\xFE\xFF" : "\xFF\xFE") : "";
  for (const char c : text) {
    out += big ? std::string{'\0', c} : std::string{c, '\0'};
  }
  return out;
}

TEST(PlcEncoding, UTF_16_with_and_without_a_mark) {
  const std::string text = "PROGRAM Main VAR x : INT; END_VAR x := x + 1; END_PROGRAM\n";
  for (const bool big : {false, true}) {
    for (const bool mark : {false, true}) {
      EXPECT_EQ(as_utf8(utf16(text, big, mark)), text);
      EXPECT_TRUE(compiled(utf16(text, big, mark)).ok);
    }
  }
}

TEST(PlcEncoding, Characters_beyond_ASCII) {
  using namespace std::string_literals;
  EXPECT_EQ(as_utf8("\xFF\xFE\xFC\x00\xAC\x20\x3D\xD8\x00\xDE"s), "\u00FC\u20AC\U0001F600");
  EXPECT_EQ(as_utf8("\xFF\xFE\x3D\xD8"s), "\uFFFD") << "half of a pair";
  EXPECT_EQ(as_utf8("(* \xFC\xDF *)"), "(* \u00FC\u00DF *)") << "Latin-1";
  EXPECT_EQ(as_utf8("(* \u00FC\u20AC *)"), "(* \u00FC\u20AC *)") << "UTF-8 stays";
  EXPECT_EQ(as_utf8(""), "");
}

TEST(PlcEncoding, Places_are_those_of_the_text) {
  EXPECT_THAT(messages(compiled("(* \xFC *)\nPROGRAM Main VAR x : INT; END_VAR y := 1; END_PROGRAM")),
              HasSubstr("in.st:2:35: error: Main: 'y' is not declared"));
}

}  // namespace
}  // namespace indurop::plc
