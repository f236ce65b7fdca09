// SPDX-License-Identifier: Apache-2.0

#include "store/runtime/print_format.h"

#include <gtest/gtest.h>
#include <indurop/irp.h>

#include <cstdio>
#include <string>
#include <vector>

namespace indurop::runtime {
namespace {

template <class... Value>
std::string formatted(const char* text, const Value&... values) {
  const detail::PrintArgument arguments[] = {detail::print_argument(values)..., {}};
  char to[128];
  EXPECT_LT(format_message(to, sizeof to, text, {arguments, sizeof...(values)}), sizeof to);
  return to;
}

template <class... Value>
std::string in_c(const char* text, Value... values) {
  char to[128];
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
  std::snprintf(to, sizeof to, text, values...);
#pragma GCC diagnostic pop
  return to;
}

enum class Color : int { Red, Green = 5 };

TEST(FormatMessage, Prints_what_C_prints) {
  for (const char* text : {"%d", "%5d|", "%-5d|", "%05d", "%+d", "% d", "%.4d", "%x", "%#x", "%X", "%o", "%u", "%c",
                           "%i", "%hhd", "%hd", "%8.3d|"}) {
    for (const int value : {0, 1, -1, 65, 300, -70000}) {
      EXPECT_EQ(formatted(text, value), in_c(text, value)) << text << ' ' << value;
    }
  }
  for (const char* text : {"%f", "%lf", "%.3f", "%10.2e|", "%g", "%-12G|", "%a", "%+.1f", "%010.3f"}) {
    for (const double value : {0.0, 1.5, -2.25, 1e100}) {
      EXPECT_EQ(formatted(text, value), in_c(text, value)) << text << ' ' << value;
    }
  }
  for (const char* text : {"%s", "%10s|", "%-10s|", "%.2s"}) {
    EXPECT_EQ(formatted(text, "hello"), in_c(text, "hello")) << text;
  }
  EXPECT_EQ(formatted("%ld %llu %zu", 5L, ~0ULL, sizeof(int)), in_c("%ld %llu %zu", 5L, ~0ULL, sizeof(int)));
  EXPECT_EQ(formatted("%*d %-*d|%.*f", 4, 7, 4, 7, 1, 2.55), in_c("%*d %-*d|%.*f", 4, 7, 4, 7, 1, 2.55));
  EXPECT_EQ(formatted("100%% {%lf, %lf}\n", 1.0, 2.0), "100% {1.000000, 2.000000}\n");
  EXPECT_EQ(formatted("%p", static_cast<const void*>(nullptr)), in_c("%p", static_cast<const void*>(nullptr)));
}

TEST(FormatMessage, Takes_the_type_from_the_argument) {
  EXPECT_EQ(formatted("%d", 2.5), "2.5");
  EXPECT_EQ(formatted("%f", 3), "3.000000");
  EXPECT_EQ(formatted("%d", std::uint64_t{18446744073709551615U}), "18446744073709551615");
  EXPECT_EQ(formatted("%lu", std::uint32_t{7}), "7");
  EXPECT_EQ(formatted("%s", 42), "42");
  EXPECT_EQ(formatted("%d", "text"), "text");
  EXPECT_EQ(formatted("%x", "text"), "text");
  EXPECT_EQ(formatted("%d %d", Color::Green, true), "5 1");
  EXPECT_EQ(formatted("%f", 1.5F), "1.500000");
  EXPECT_EQ(formatted("%s|%.3s", string<8>("abc"), std::string("defgh")), "abc|def");
}

TEST(FormatMessage, Shows_a_conversion_without_argument_as_written) {
  EXPECT_EQ(formatted("a %d b %s", 1), "a 1 b %s");
  EXPECT_EQ(formatted("%"), "%");
  EXPECT_EQ(formatted("%-5"), "%-5");
  EXPECT_EQ(formatted("%n", 1), "%n");
  EXPECT_EQ(formatted("%k %d", 1), "%k 1");
  EXPECT_EQ(formatted("%s", static_cast<const char*>(nullptr)), "(null)");
  EXPECT_EQ(formatted(nullptr), "(null)");
}

TEST(FormatMessage, Cuts_and_marks_what_is_too_long) {
  const std::string longer(500, 'x');
  const std::string sut = formatted("%s", longer);
  EXPECT_EQ(sut.size(), 127U);
  EXPECT_EQ(sut.substr(121), "[cut]\n");
  EXPECT_EQ(formatted("%400d", 1).substr(121), "[cut]\n");
  EXPECT_EQ(formatted(longer.c_str()).size(), 127U);
  EXPECT_EQ(formatted("%s", std::string(127, 'y')), std::string(127, 'y'));
  EXPECT_EQ(formatted("%999999999d|%.999999999f", 1, 1.0).size(), 127U);
}

}  // namespace
}  // namespace indurop::runtime
