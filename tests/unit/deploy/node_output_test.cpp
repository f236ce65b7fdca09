// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/node_output.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <string>
#include <string_view>

namespace indurop::deploy {
namespace {

// The output of one node: what it writes, and what the agent makes of it.
class NodeOutputTest : public ::testing::Test {
 protected:
  NodeOutputTest() { start(); }
  ~NodeOutputTest() override { die(); }

  void start() {
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK), 0);
    read_end_ = ends[0];
    write_end_ = ends[1];
    sut_.open(read_end_);
  }
  void write(std::string_view text) const {
    ASSERT_EQ(::write(write_end_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void die() {
    if (write_end_ >= 0) {
      ::close(write_end_);
    }
    write_end_ = -1;
  }
  std::string copied(bool replace = true) {
    ::testing::internal::CaptureStderr();
    sut_.copy(replace);
    return ::testing::internal::GetCapturedStderr();
  }
  [[nodiscard]] bool is_open() const { return ::fcntl(read_end_, F_GETFD) >= 0; }

  NodeOutput sut_;
  int read_end_ = -1;
  int write_end_ = -1;
};

TEST_F(NodeOutputTest, All_that_has_arrived_is_copied_as_it_is) {
  EXPECT_EQ(copied(), "");
  write("one\ntw");
  EXPECT_EQ(copied(), "one\ntw");
  write("o\n");
  EXPECT_EQ(copied(), "o\n");
  const std::string much(20'000, 'x');
  write(much);
  EXPECT_EQ(copied(), much);
}

TEST_F(NodeOutputTest, Remembers_the_last_line_with_an_error) {
  write("a.xml:1:1: error: first\nwarning: none\na.xml:2:1: error: second\nends\n");
  (void)copied();
  EXPECT_EQ(sut_.last_error(), "a.xml:2:1: error: second");
  sut_.forget_error();
  EXPECT_EQ(sut_.last_error(), "");
}

TEST_F(NodeOutputTest, Keeps_the_first_error_if_newer_ones_are_not_to_replace_it) {
  write("error: first\nerror: second\n");
  (void)copied(false);
  EXPECT_EQ(sut_.last_error(), "error: first");
}

TEST_F(NodeOutputTest, A_line_may_arrive_in_pieces) {
  write("err");
  (void)copied();
  write("or: in pie");
  (void)copied();
  EXPECT_EQ(sut_.last_error(), "") << "the line has not ended";
  write("ces\n");
  (void)copied();
  EXPECT_EQ(sut_.last_error(), "error: in pieces");
}

TEST_F(NodeOutputTest, A_long_line_is_copied_whole_and_its_beginning_is_remembered) {
  const std::string line = "error: " + std::string(2000, 'x');
  write(line + "\nerror: next\n");
  EXPECT_EQ(copied(false), line + "\nerror: next\n");
  EXPECT_EQ(sut_.last_error(), line.substr(0, 500));
}

TEST_F(NodeOutputTest, Is_closed_when_the_node_has_died) {
  write("error: lost\n");
  die();
  EXPECT_EQ(copied(), "error: lost\n");
  EXPECT_EQ(sut_.last_error(), "error: lost");
  EXPECT_FALSE(is_open());
  EXPECT_EQ(copied(), "");
}

TEST_F(NodeOutputTest, A_line_that_the_node_did_not_end_is_its_last_one) {
  write("error: died in the middle of");
  die();
  (void)copied();
  EXPECT_EQ(sut_.last_error(), "error: died in the middle of");
  sut_.forget_error();
  start();
  write("the next node says error: its own\n");
  (void)copied();
  EXPECT_EQ(sut_.last_error(), "the next node says error: its own");
}

TEST_F(NodeOutputTest, What_was_not_read_before_it_is_closed_does_not_reach_the_next_node) {
  write("half");
  (void)copied();
  sut_.close();
  EXPECT_FALSE(is_open());
  die();
  start();
  write(" error: whole\n");
  (void)copied();
  EXPECT_EQ(sut_.last_error(), " error: whole");
}

// A text and all ways to cut it in two, against the rule applied to whole lines.
TEST(LineFilter, Leaves_out_the_lines_that_begin_so_wherever_they_are_cut) {
  const std::string text = "node[a]: error: x\nraw\nnode[a\n\nnode[b]: y\n node[a]: z\nnode[a]: \nnode[a]: w";
  const std::string left = "raw\nnode[a\n\nnode[b]: y\n node[a]: z\n";
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    LineFilter sut("node[a]: ");
    std::string out = sut.pass(text.substr(0, cut));
    out += sut.pass(text.substr(cut));
    EXPECT_EQ(out + sut.rest(), left) << "cut at " << cut;
  }
}

TEST(LineFilter, What_has_begun_like_one_of_them_and_does_not_end_stays) {
  LineFilter sut("node[a]: ");
  EXPECT_EQ(sut.pass("whole\nnode["), "whole\n");
  EXPECT_EQ(sut.rest(), "node[");
  EXPECT_EQ(sut.pass("a]: not at the begin of a line before\n"), "a]: not at the begin of a line before\n");
  EXPECT_EQ(LineFilter("").pass("all\nof it"), "all\nof it");
}

TEST(NodeOutput, An_error_that_the_journal_has_is_remembered_and_not_copied) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK), 0);
  const std::string_view text = "indurop-node[a]: error: gone\nterminate called\n";
  ASSERT_EQ(::write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  NodeOutput sut("indurop-node[a]: ");
  sut.open(ends[0]);
  ::testing::internal::CaptureStderr();
  sut.copy(true);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "terminate called\n");
  EXPECT_EQ(sut.last_error(), "indurop-node[a]: error: gone");
  ::close(ends[1]);
}

TEST(NodeOutput, Closes_its_pipe_at_its_end) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK), 0);
  {
    NodeOutput sut;
    sut.open(ends[0]);
  }
  EXPECT_LT(::fcntl(ends[0], F_GETFD), 0);
  ::close(ends[1]);
}

}  // namespace
}  // namespace indurop::deploy
