// SPDX-License-Identifier: Apache-2.0
// watch: rounds, forms, and a node that goes and comes back.
#include <sstream>

#include "fixture.h"

namespace indurop::test {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    out.push_back(line);
  }
  return out;
}

TEST_F(WithNode, Watch_prints_a_line_per_change) {
  const auto sut = indurop({"watch", "tick", "gain", "-n", "4", "--hz", "100"});
  EXPECT_EQ(sut.code, 0) << sut.err;
  const auto lines = lines_of(sut.out);
  ASSERT_GE(lines.size(), 4U);
  EXPECT_THAT(sut.out, ContainsRegex("^[0-9]+[.][0-9]+  knu::Robot::tick = [0-9]+\n"));
  // gain did not change: only its first value is printed.
  EXPECT_EQ(sut.out.find("gain = 1 mm"), sut.out.rfind("gain = 1 mm"));
}

TEST_F(WithNode, Watch_in_a_pipe_begins_with_every_value_even_a_zero) {
  EXPECT_EQ(indurop({"set", "starts", "0"}).code, 0);
  const auto sut = indurop({"watch", "starts", "joints[2].z", "-n", "2", "--hz", "100"});
  EXPECT_EQ(sut.code, 0) << sut.err;
  EXPECT_THAT(sut.out, HasSubstr("starts = 0"));
  EXPECT_THAT(sut.out, HasSubstr("joints[2].z = "));
}

TEST_F(WithNode, Watch_as_csv_has_a_heading_and_a_row_per_round) {
  const auto lines = lines_of(indurop({"watch", "tick", "mode", "-o", "csv", "-n", "3", "--hz", "200"}).out);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0], "time_ns,knu::Robot::tick,knu::Robot::mode");
  EXPECT_THAT(lines[1], ContainsRegex("^[0-9]+,[0-9]+,OFF$"));
}

TEST_F(WithNode, Watch_as_json_has_an_object_per_round) {
  const auto lines = lines_of(indurop({"watch", "joints[0]", "-o", "json", "-n", "2", "--hz", "200"}).out);
  ASSERT_EQ(lines.size(), 2U);
  const auto json = nlohmann::json::parse(lines[1], nullptr, false);
  EXPECT_EQ(json["schema_version"], 1);
  EXPECT_EQ(json["running"], true);
  EXPECT_TRUE(json["values"]["knu::Robot::joints[0]"]["x"].is_number());
}

TEST_F(WithNode, Watch_reads_lists_and_says_what_is_wrong_with_them) {
  const std::string file = (scratch() / "arm.watch").string();
  put(file, "# the arm\ngain   # amplitude\n\n  station::*\r\n");
  const auto sut = indurop({"watch", "-f", file, "--once"});
  EXPECT_EQ(sut.code, 0) << sut.err;
  EXPECT_EQ(lines_of(sut.out).size(), 4U);
  put(file, "# nothing\n");
  EXPECT_EQ(indurop({"watch", "-f", file}).code, 1);
  EXPECT_EQ(indurop({"watch", "-f", file + ".none"}).code, 1);
  EXPECT_EQ(indurop({"watch"}).code, 2);
  EXPECT_EQ(indurop({"watch", "nothing"}).code, 1);
}

TEST_F(WithNode, Watch_ends_after_its_time) {
  const auto sut = indurop({"watch", "tick", "--timeout", "50ms", "--hz", "100"});
  EXPECT_EQ(sut.code, 0);
  EXPECT_THAT(sut.out, Not(IsEmpty()));
}

TEST_F(WithNode, Watch_ends_with_130_at_an_interrupt) {
  Program sut(indurop_command({"watch", "tick"}), background());
  ASSERT_TRUE(sut.prints("tick = "));
  sut.signal(SIGINT);
  EXPECT_EQ(sut.wait(), 130);
}

TEST_F(WithNode, Watch_is_quiet_when_its_reader_goes) {
  Program sut({"/bin/sh", "-c", std::string(INDUROP_PROGRAM) + " watch tick --hz 1000 | head -n 1; echo ended"},
              background());
  EXPECT_TRUE(sut.prints("ended"));
  EXPECT_EQ(lines_of(sut.out()).size(), 2U) << sut.out();
}

TEST_F(WithNode, Watch_outlives_the_node_and_goes_on_with_the_next) {
  Program sut(indurop_command({"watch", "tick", "--hz", "100"}), background());
  ASSERT_TRUE(sut.prints("tick = "));
  kill_node();
  ASSERT_TRUE(sut.prints("is not running")) << sut.out();
  node_ = std::make_unique<Program>(fake_node("local"), background());
  ASSERT_TRUE(sut.prints("runs again")) << sut.out();
  EXPECT_TRUE(wait_until([&] { return sut.out().find("tick = ", sut.out().find("runs again")) != std::string::npos; }))
      << sut.out();
}

TEST_F(WithNode, Watch_goes_on_after_everything_was_removed_in_between) {
  Program sut(indurop_command({"watch", "tick", "--hz", "100"}), background());
  ASSERT_TRUE(sut.prints("tick = "));
  kill_node();
  ASSERT_EQ(indurop({"clean"}).code, 0);
  ASSERT_TRUE(sut.prints("is not running"));
  node_ = std::make_unique<Program>(fake_node("local"), background());
  EXPECT_TRUE(sut.prints("runs again")) << sut.out();
}

}  // namespace
}  // namespace indurop::test
