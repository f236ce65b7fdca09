// SPDX-License-Identifier: Apache-2.0
#include "tools/client/recordings/recording.h"

#include <gmock/gmock.h>

#include <cmath>

namespace indurop::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::NanSensitiveDoubleEq;
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
  EXPECT_THAT(problem("time_ns,a\n"), HasSubstr("error: there is no row below the heading"));
  EXPECT_THAT(problem(""), HasSubstr("error"));
}

TEST(RecordingText, Values_of_the_only_row_are_held_for_a_second) {
  const Recording sut = read("time_ns,gain,state,none\n7,2.5,Idle,\n");
  EXPECT_THAT(sut.time_s, ElementsAre(0, 1));
  EXPECT_THAT(sut.series[0].lines, ElementsAre(ElementsAre(2.5, 2.5)));
  EXPECT_THAT(sut.series[1].lines, ElementsAre(ElementsAre(0, 0)));
  EXPECT_TRUE(sut.series[2].lines.empty());
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

TEST(RecordingNames, Columns_and_lines_get_other_names_and_numbers_words) {
  Recording sut = read("time,CELL::state [1],CELL::joint [deg]\n0,1,\"[1,2]\"\n1,5,\"[1,2]\"\n");
  EXPECT_FALSE(rename(sut, "joint[1]=J2"));
  EXPECT_FALSE(rename(sut, "CELL::joint=joints, deg"));
  EXPECT_FALSE(give_words(sut, "state=1 ready,  4 stops hard"));
  drop_common_namespace(sut);
  EXPECT_EQ(sut.series[0].words, (std::vector<std::string>{"0", "ready", "2", "3", "stops hard", "5"}));
  EXPECT_EQ(part_name(sut.series[1], 0), "[0]");
  EXPECT_EQ(part_name(sut.series[1], 1), "J2");
  EXPECT_EQ(sut.series[1].name, "joints, deg");
}

TEST(RecordingNames, What_cannot_be_named_is_reported) {
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

}  // namespace
}  // namespace indurop::tools
