// SPDX-License-Identifier: Apache-2.0
// When the report of a shadow lets its version be exchanged.

#include "tools/cli/shadow/shadow_report.h"

#include <gmock/gmock.h>

#include <cmath>

namespace indurop::tools {
namespace {

using testing::HasSubstr;

ShadowReport report(const std::string& more, const std::string& variable) {
  auto read = read_shadow_report(R"({"module": "press", "runs": 10, "variables": [{"name": "a::x", )" + variable +
                                 "}]" + more + "}");
  EXPECT_TRUE(read);
  return read.value_or(ShadowReport{});
}
const std::string kEqual = R"("compared": 10, "differing": 0, "unclear": 0, "largest": 0.0)";
const std::string kDiffers = R"("compared": 10, "differing": 3, "unclear": 0, "first_tick": 7, "largest": 0.5)";

std::string why(const ShadowReport& sut, const std::string& accept = "", bool lossy = false) {
  const auto rules = AcceptedDifferences::parse(accept);
  EXPECT_TRUE(rules.ok());
  return objection(sut, *rules, lossy).value_or("");
}

TEST(ShadowReport, What_is_equal_is_exchanged) {
  EXPECT_EQ(why(report("", kEqual)), "");
}

TEST(ShadowReport, What_differs_is_exchanged_if_that_is_accepted) {
  const ShadowReport sut = report("", kDiffers);
  EXPECT_THAT(why(sut), HasSubstr("a::x differs in 3 runs by 0.5 at most; to exchange it nevertheless: --accept"));
  EXPECT_THAT(why(sut, "x < 0.5"), HasSubstr("a::x differs"));
  EXPECT_EQ(why(sut, "x <= 0.5"), "");
  EXPECT_THAT(why(sut, "y <= 0.5"), HasSubstr("'y <= 0.5' is for no variable that it writes"));
}

TEST(ShadowReport, What_is_unclear_or_was_not_compared_is_not_equal) {
  const std::string unclear = R"("compared": 9, "differing": 0, "unclear": 1, "largest": 0.5)";
  EXPECT_THAT(why(report("", unclear)), HasSubstr("a::x differs in 1 run by 0.5"));
  EXPECT_EQ(why(report("", unclear), "x <= 1"), "");
  const std::string absent = R"("compared": 0, "differing": 0, "unclear": 0, "largest": 0.0)";
  EXPECT_THAT(why(report("", absent)), HasSubstr("a::x was not compared"));
  EXPECT_THAT(why(report("", absent), "x <= 1"), HasSubstr("a::x was not compared"));
  EXPECT_EQ(why(report("", absent), "x <= inf"), "");
  const ShadowReport gone = report(R"(, "not_written": ["a::y"])", kEqual);
  EXPECT_THAT(why(gone), HasSubstr("a::y was not compared"));
}

TEST(ShadowReport, New_variables_need_no_rule_and_may_have_one) {
  const ShadowReport sut = report(R"(, "new": ["a::y"], "converted": ["a::x.z"])", kEqual);
  EXPECT_EQ(why(sut), "");
  EXPECT_EQ(why(sut, "y <= 1"), "");
  EXPECT_THAT(why(sut, "z <= 1"), HasSubstr("is for no variable"));
  EXPECT_EQ(sut.added, std::vector<std::string>{"a::y"});
}

TEST(ShadowReport, A_difference_that_is_no_number_is_infinite) {
  const ShadowReport sut = report("", R"("compared": 9, "differing": 1, "unclear": 0, "largest": null)");
  EXPECT_TRUE(std::isinf(sut.variables.front().largest));
}

TEST(ShadowReport, A_fault_and_initial_values_are_no_matter_of_limits) {
  EXPECT_THAT(why(report(R"(, "fault": "exception: no ink", "fault_tick": 8)", kEqual), "x <= inf"),
              HasSubstr("with the inputs of tick 8 it faults: exception: no ink"));
  EXPECT_THAT(why(report(R"(, "only_recorded_fault": true)", kEqual)), HasSubstr("faulted meanwhile"));
  const ShadowReport sut = report(R"(, "initial_values": "it does not declare what it keeps")", kEqual);
  EXPECT_THAT(why(sut), HasSubstr("from initial values on"));
  EXPECT_EQ(why(sut, "", true), "");
}

TEST(ShadowReport, Text_that_is_no_report_is_refused) {
  EXPECT_FALSE(read_shadow_report(""));
  EXPECT_FALSE(read_shadow_report("{}"));
  EXPECT_FALSE(read_shadow_report("[1]"));
}

}  // namespace
}  // namespace indurop::tools
