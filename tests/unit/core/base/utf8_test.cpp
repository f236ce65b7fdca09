// SPDX-License-Identifier: Apache-2.0
#include "core/base/utf8.h"

#include <gtest/gtest.h>
#include <iconv.h>

#include <array>
#include <string>

namespace indurop::base {
namespace {

// What the C library makes of a character.
std::string by_iconv(iconv_t converter, std::uint32_t code) {
  std::array<char, 8> bytes{};
  char* from = reinterpret_cast<char*>(&code);
  char* to = bytes.data();
  std::size_t left = sizeof code;
  std::size_t room = bytes.size();
  EXPECT_EQ(iconv(converter, &from, &left, &to, &room), 0U) << code;
  return {bytes.data(), bytes.size() - room};
}

TEST(Utf8, Every_character_is_written_as_the_C_library_does) {
  iconv_t converter = iconv_open("UTF-8", "UCS-4LE");
  ASSERT_NE(converter, reinterpret_cast<iconv_t>(-1));
  for (std::uint32_t code = 0; code <= 0x10FFFF; code += code == 0xD7FF ? 0x801 : 1) {
    std::string sut;
    append_utf8(sut, code);
    ASSERT_EQ(sut, by_iconv(converter, code)) << code;
    ASSERT_EQ(utf8_length(sut), sut.size()) << code;
  }
  iconv_close(converter);
}

}  // namespace
}  // namespace indurop::base
