// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>

#include "tools/cli/pictures/chart_text.h"
#include "tools/cli/pictures/recording_svg.h"
#include "tools/cli/pictures/way_svg.h"
#include "tools/client/recordings/recording.h"

namespace indurop::tools {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr const char* kRun =
    "time_ns,speed,state,\"arm,joint\",on\n"
    "5000000000,0.5,Idle,\"[1.0,2.0]\",false\n"
    "5500000000,1.5,Moving,\"[1.5,2.5]\",true\n"
    "\r\n"
    "6000000000,,Idle,\"[2.0,3.0]\",true\n";

Recording read(std::string_view text) {
  auto recording = read_recording(text, "run.csv");
  EXPECT_TRUE(recording) << base::to_string(recording.error());
  return *recording;
}

TEST(ChartSvg, Every_column_is_there_and_nothing_is_not_a_number) {
  const std::string svg = chart_svg("A <run>", read(kRun));
  EXPECT_THAT(svg, StartsWith("<svg "));
  EXPECT_THAT(svg, HasSubstr("A &lt;run&gt;"));
  for (const char* name : {"speed", "state", "arm,joint", "on", "[0]", "[1]", "Moving"}) {
    EXPECT_THAT(svg, HasSubstr(name));
  }
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(ChartSvg, A_constant_and_a_column_without_values_can_be_drawn) {
  const std::string svg = chart_svg("", read("time,a,b\n0,3.5,\n1,3.5,\n"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(ChartSvg, A_way_is_seen_from_above_and_from_the_side_in_one_scale) {
  Recording sut = read("time,A::p [mm],A::on\n0,\"[0,0,5]\",1\n1,\"[100,0,5]\",0\n2,\"[100,50,25]\",1\n");
  EXPECT_FALSE(take_series(sut, "q"));
  const auto way = take_series(sut, "p");
  ASSERT_TRUE(way);
  EXPECT_EQ(sut.series.size(), 1U);
  const std::string svg = way_svg(*way, 1000).elements();
  EXPECT_THAT(svg, HasSubstr("A::p [mm]: x across, y up"));
  EXPECT_THAT(svg, HasSubstr("A::p [mm]: x across, z up"));
  // Of 100 mm across and 50 up, or 20: the same number of pixels for 100 mm in both.
  std::vector<double> across;
  for (std::size_t at = svg.find("d=\"M"); at != std::string::npos; at = svg.find("d=\"M", at + 1)) {
    double x1 = 0;
    double y1 = 0;
    double x2 = 0;
    ASSERT_EQ(std::sscanf(svg.c_str() + at, "d=\"M%lf %lfL%lf", &x1, &y1, &x2), 3) << svg;
    across.push_back(x2 - x1);
  }
  ASSERT_EQ(across.size(), 2U);
  EXPECT_NEAR(across[0], across[1], 0.2);
  EXPECT_GT(across[0], 300);
}

TEST(ChartSvg, A_way_that_stands_or_has_no_values_is_no_problem) {
  for (const char* text :
       {"time,p\n0,\"[1,1,1]\"\n1,\"[1,1,1]\"\n", "time,p\n0,\"[null,null]\"\n1,\"[null,null]\"\n"}) {
    Recording sut = read(text);
    const std::string svg = way_svg(*take_series(sut, "p"), 800).elements();
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
  }
}

TEST(ChartSvg, Round_values_are_round) {
  EXPECT_THAT(round_values(0, 20, 10), ElementsAre(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20));
  EXPECT_THAT(round_values(-1.2, 1.1, 4), ElementsAre(-1, 0, 1));
}

TEST(ChartText, A_row_each_between_smallest_and_largest) {
  const auto lines = chart_lines(read("time,ramp\n0,0\n1,1\n2,2.5\n3,3\n"), 60, false);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_THAT(lines[0], StartsWith("ramp  0"));
  EXPECT_THAT(lines[0], HasSubstr("9  0 .. 3"));
  EXPECT_THAT(lines[1], HasSubstr("3 s"));
}

TEST(ChartText, Fits_a_narrow_terminal) {
  EXPECT_THAT(chart_lines(read(kRun), 1, true), Each(Not(IsEmpty())));
}

// As a scope saves it: 0 s is its trigger.
Recording triggered() {
  Recording out;
  out.time_s = {-0.002, -0.001, 0, 0.001};
  out.series = {{"on", {{0, 0, 1, 1}}, {"false", "true"}, true},
                {"joints", {{0.5, 1.5, std::nan(""), 3.5}, {0, 0, 0, 0}, {1, 1, 1, 1}}, {}, false}};
  out.marked = true;
  return out;
}

TEST(ChartText, Marks_the_trigger_below_its_time) {
  const auto lines = chart_lines(triggered(), 80, false);
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_THAT(lines[0], StartsWith("on "));
  EXPECT_THAT(lines[4], HasSubstr("-0.002 s"));
  EXPECT_NE(lines[4].find('^'), std::string::npos);
}

TEST(ChartSvg, Shows_other_names_and_words_for_numbers) {
  Recording sut = read("time,CELL::state [1],CELL::joint [deg]\n0,1,\"[1,2]\"\n1,5,\"[1,2]\"\n");
  EXPECT_FALSE(rename(sut, "joint[1]=J2"));
  EXPECT_FALSE(rename(sut, "CELL::joint=joints, deg"));
  EXPECT_FALSE(give_words(sut, "state=1 ready,  4 stops hard"));
  const std::string svg = chart_svg("", sut);
  for (const char* word : {"joints, deg", ">J2<", "ready from 0.000 s"}) {
    EXPECT_THAT(svg, HasSubstr(word));
  }
}

TEST(ChartSvg, Marks_the_trigger) {
  EXPECT_THAT(chart_svg("capture", triggered()), HasSubstr("class=\"mark\""));
}

}  // namespace
}  // namespace indurop::tools
