// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>

#include "tools/cli/pictures/chart_svg.h"
#include "tools/cli/pictures/chart_text.h"
#include "tools/cli/pictures/way_svg.h"
#include "tools/client/recordings/recording.h"

namespace indurop::tools {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::NanSensitiveDoubleEq;
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

std::string problem(std::string_view text) {
  return base::to_string(read_recording(text, "run.csv").error());
}

TEST(RecordingText, Numbers_words_arrays_and_gaps_are_read) {
  const Recording sut = read(kRun);
  EXPECT_THAT(sut.time_s, ElementsAre(0, 0.5, 1.0));
  ASSERT_EQ(sut.series.size(), 4U);
  EXPECT_THAT(sut.series[0].lines, ElementsAre(ElementsAre(0.5, 1.5, NanSensitiveDoubleEq(std::nan("")))));
  EXPECT_FALSE(sut.series[0].steps);
  EXPECT_THAT(sut.series[1].words, ElementsAre("Idle", "Moving"));
  EXPECT_THAT(sut.series[1].lines, ElementsAre(ElementsAre(0, 1, 0)));
  EXPECT_TRUE(sut.series[1].steps);
  EXPECT_EQ(sut.series[2].name, "arm,joint");
  EXPECT_THAT(sut.series[2].lines, ElementsAre(ElementsAre(1, 1.5, 2), ElementsAre(2, 2.5, 3)));
  EXPECT_THAT(sut.series[3].lines, ElementsAre(ElementsAre(0, 1, 1)));
}

TEST(RecordingText, What_is_no_recording_is_named_with_its_line) {
  EXPECT_THAT(problem("a,b\n1,2\n"), StartsWith("run.csv:1:1: error: the heading is not that of a recording"));
  EXPECT_THAT(problem("time_ns,a\n1,2\n2\n"), StartsWith("run.csv:3:1: error: 1 values for 2 columns"));
  EXPECT_THAT(problem("time_ns,a\nx,2\n"), StartsWith("run.csv:2:1: error: the first column is not a time"));
  EXPECT_THAT(problem("time_ns,a\n2,2\n1,2\n"), HasSubstr("error: the times are not rising"));
  EXPECT_THAT(problem("time_ns,a\n1,2\n"), HasSubstr("at least two rows"));
  EXPECT_THAT(problem(""), HasSubstr("error"));
}

TEST(RecordingText, A_number_of_many_values_is_a_line_and_one_of_few_a_lane) {
  std::string text = "time,many,few\n";
  for (int i = 0; i < 20; ++i) {
    text += std::to_string(i) + "," + std::to_string(i) + "," + std::to_string(i % 3) + "\n";
  }
  const Recording sut = read(text);
  EXPECT_FALSE(sut.series[0].steps);
  EXPECT_TRUE(sut.series[1].steps);
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

TEST(RecordingNames, Columns_and_lines_get_other_names_and_numbers_words) {
  Recording sut = read("time,CELL::state [1],CELL::joint [deg]\n0,1,\"[1,2]\"\n1,5,\"[1,2]\"\n");
  EXPECT_FALSE(rename(sut, "joint[1]=J2"));
  EXPECT_FALSE(rename(sut, "CELL::joint=joints, deg"));
  EXPECT_FALSE(give_words(sut, "state=1 ready,  4 stops hard"));
  drop_common_namespace(sut);
  EXPECT_EQ(sut.series[0].words, (std::vector<std::string>{"0", "ready", "2", "3", "stops hard", "5"}));
  EXPECT_EQ(part_name(sut.series[1], 0), "[0]");
  EXPECT_EQ(part_name(sut.series[1], 1), "J2");
  const std::string svg = chart_svg("", sut);
  for (const char* word : {"joints, deg", ">J2<", "ready from 0.000 s"}) {
    EXPECT_THAT(svg, HasSubstr(word));
  }
}

TEST(RecordingNames, What_cannot_be_named_is_told) {
  Recording sut = read("time,CELL::speed,CELL::on\n0,0.5,1\n1,2,0\n");
  EXPECT_THAT(rename(sut, "sped=v").value_or(""), HasSubstr("no column 'sped'; there are CELL::speed and CELL::on"));
  EXPECT_THAT(rename(sut, "speed[0]").value_or(""), HasSubstr("write OLD=NEW"));
  EXPECT_THAT(rename(sut, "speed[7]=v").value_or(""), HasSubstr("no column"));
  EXPECT_THAT(give_words(sut, "speed=0 off").value_or(""), HasSubstr("no small whole number"));
  EXPECT_THAT(give_words(sut, "on=off").value_or(""), HasSubstr("write 0 off, 1 on"));
  EXPECT_THAT(give_words(sut, "on").value_or(""), HasSubstr("write NAME=0 off"));
}

TEST(RecordingNames, The_namespace_that_all_have_is_left_out) {
  Recording sut = read("time,A::x,A::B::y\n0,0.5,1\n1,2,0\n");
  drop_common_namespace(sut);
  EXPECT_EQ(sut.series[0].name, "x");
  EXPECT_EQ(sut.series[1].name, "B::y");
  Recording other = read("time,A::x,B::y\n0,0.5,1\n1,2,0\n");
  drop_common_namespace(other);
  EXPECT_EQ(other.series[0].name, "A::x");
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

}  // namespace
}  // namespace indurop::tools
