// SPDX-License-Identifier: Apache-2.0
#include "core/base/print.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>

namespace indurop::base {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

TEST(Print, Writes_what_is_formatted) {
  const File file(std::tmpfile(), std::fclose);
  ASSERT_NE(file, nullptr);
  print(file.get(), "{} of {}", 1, "two");
  std::rewind(file.get());
  std::array<char, 32> text{};
  EXPECT_EQ(std::fgets(text.data(), text.size(), file.get()), text.data());
  EXPECT_STREQ(text.data(), "1 of two");
}

TEST(Print, Loses_the_text_if_the_disk_is_full) {
  const File file(std::fopen("/dev/full", "w"), std::fclose);
  ASSERT_NE(file, nullptr);
  ASSERT_EQ(std::setvbuf(file.get(), nullptr, _IONBF, 0), 0);  // as standard error
  EXPECT_NO_THROW(print(file.get(), "{}\n", 1));
}

}  // namespace
}  // namespace indurop::base
