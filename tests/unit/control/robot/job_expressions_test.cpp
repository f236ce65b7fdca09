// SPDX-License-Identifier: Apache-2.0
// Functions and arrays of jobs. Random expressions are compared with another evaluator by expressions_test.py.
#include <gmock/gmock.h>

#include <string>
#include <utility>

#include "job_world.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

std::string errors_of_job(const std::string& text) {
  return base::to_text(parse_jobs({{"a.job", text}}).diagnostics);
}

// The shared variable OUT after the job.
double out_of(const std::string& text) {
  const auto [book, errors] = parse_jobs({{"a.job", text}});
  EXPECT_TRUE(errors.empty()) << base::to_text(errors);
  World world(book.signals);
  const Ended ended = run(book, world);
  EXPECT_EQ(ended.state, JobState::Ended) << text << ended.message;
  return world.values["OUT"];
}

std::string failure_of(const std::string& text) {
  const auto [book, errors] = parse_jobs({{"a.job", text}});
  EXPECT_TRUE(errors.empty()) << base::to_text(errors);
  World world(book.signals);
  return run(book, world).message;
}

TEST(JobExpressions, Functions_take_degrees) {
  EXPECT_NEAR(out_of("SET OUT = SIN(30) + COS(60) + TAN(45)\n"), 2, 1e-15);
  EXPECT_NEAR(out_of("SET OUT = ASIN(1) + ACOS(0) + ATAN(-1)\n"), 135, 1e-12);
  EXPECT_NEAR(out_of("SET OUT = ATAN2(3, -3)\n"), 135, 1e-12);
  EXPECT_EQ(out_of("SET OUT = SQRT(16) + ABS(-2) * abs(3)\n"), 10);
  EXPECT_EQ(out_of("SET OUT = MIN(3, -1, 2) + MAX(1, 5)\n"), 4);
  EXPECT_EQ(out_of("SET OUT = ROUND(2.5) * 100 + ROUND(-2.5) * 10 + TRUNC(-2.9)\n"), 300 - 30 - 2);
}

TEST(JobExpressions, A_variable_may_be_called_like_a_function) {
  EXPECT_EQ(out_of("VAR max = 3\nVAR sin[2] = 4, 5\nSET OUT = max + sin[1]\n"), 8);
}

TEST(JobExpressions, Arrays_are_read_and_written_by_computed_numbers) {
  EXPECT_EQ(out_of("VAR a[5]\nFOR i = 0 TO 4\na[i] = i * i\nEND\nVAR sum = 0\nFOR i = 0 TO 4\nsum = sum + a[4 - i]\n"
                   "END\nSET OUT = sum\n"),
            30);
  EXPECT_EQ(out_of("VAR order[3] = 2, 0, 1\nVAR b[3] = 10, 20, 30\nSET OUT = b[order[0]] * 100 + b[order[2]]\n"), 3020);
  EXPECT_EQ(out_of("VAR a[3]\nVAR n = 7\na[ 2 ] = n\na[0] = a[2] - 1\nSET OUT = a[0]\n"), 6);
  EXPECT_EQ(out_of("SET T[3].x = 4\nSET OUT = T[3].x\n"), 4) << "of a shared variable";
}

TEST(JobExpressions, What_has_no_value_is_named_with_line_and_column) {
  EXPECT_THAT(failure_of("VAR n = 0\nSET O1 = 3 / n\n"), HasSubstr("a.job:2:10: this has no value: it divides by 0"));
  EXPECT_THAT(failure_of("VAR a[3]\nVAR i = 3\nVAR n = 1 + a[i]\n"),
              HasSubstr("a.job:3:9: this has no value: an array"));
  EXPECT_THAT(failure_of("VAR a[3]\nVAR i = 0.5\na[i] = 1\n"), HasSubstr("a.job:3:3: an array has no such element"));
  EXPECT_THAT(failure_of("VAR n = -1\nIF SQRT(n) > 1\nEND\n"), HasSubstr("a.job:2:4: this has no value: SQRT"));
  EXPECT_THAT(failure_of("VAR n = 2\nn = ASIN(n)\n"), HasSubstr("ASIN and ACOS take numbers from -1 to 1"));
  EXPECT_THAT(failure_of("VAR n = 1e300\nn = n * n\n"), HasSubstr("a number in it is too large"));
}

TEST(JobExpressions, Mistakes_are_named_where_they_are) {
  const std::pair<const char*, const char*> cases[] = {
      {"VAR n = SINE(3)\n", "a.job:1:9: error: there is no function 'SINE'; known are ABS, SQRT,"},
      {"VAR n = SIN(3, 4)\n", "a.job:1:9: error: SIN takes one value, here are 2"},
      {"VAR n = MAX(3)\n", "a.job:1:9: error: MAX takes two values or more, here is 1"},
      {"VAR n = ATAN2(1, 2, 3)\n", "a.job:1:9: error: ATAN2 takes two values, here are 3"},
      {"VAR n = SQRT(3\n", "a.job:1:15: error: expected ')'"},
      {"VAR a[0]\n", "a.job:1:5: error: an array has 1 element or more"},
      {"VAR a[129]\n", "so there is room for 128"},
      {"VAR a[2] = 1\n", "a.job:1:5: error: this array has 2 elements, and here are 1 values"},
      {"VAR a[2]\nSET O = a\n", "a.job:2:9: error: which element of 'a'? The first one is a[0]"},
      {"VAR a[2]\nSET O = a[2]\n", "a.job:2:9: error: the last element of 'a' is a[1]"},
      {"VAR a\nSET O = a[2]\n", "a.job:2:9: error: 'a' is no array; declare it, VAR a[10]"},
      {"VAR a\na[1] = 2\n", "a.job:2:1: error: 'a' is no array"},
      {"VAR i\nSET O = T[i]\n", "a.job:2:10: error: the number of an element of a shared variable is written as T[3]"},
      {"VAR a[2]\na[1 = 2\n", "a.job:2:5: error: expected ']'"},
  };
  for (const auto& [text, wanted] : cases) {
    EXPECT_THAT(errors_of_job(text), HasSubstr(wanted)) << text;
  }
}

}  // namespace
}  // namespace indurop::robot
