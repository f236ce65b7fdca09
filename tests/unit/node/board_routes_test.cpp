// SPDX-License-Identifier: Apache-2.0
#include "node/parts/board_routes.h"

#include <gmock/gmock.h>

#include <set>

namespace indurop::node {
namespace {

using ::testing::HasSubstr;

// A board that sends "out" and reads "in" from board x.
class BoardRoutesTest : public ::testing::Test {
 protected:
  BoardRoutesTest() {
    start_.outgoing = {{"out"}};
    start_.incoming = {{"in", "x"}};
    next_ = start_;
  }
  [[nodiscard]] std::string difference() const {
    const auto in = [](const std::set<std::string>& names) {
      return [&names](const std::string& name) { return names.contains(name); };
    };
    return BoardRoutes(start_).difference(next_, {in(used_), in(first_), in(will_be_used_)});
  }

  mirror::Routes start_;
  mirror::Routes next_;
  std::set<std::string> used_{"out", "in"};
  std::set<std::string> first_{"out", "in", "own"};
  std::set<std::string> will_be_used_{"out", "in"};
};

TEST_F(BoardRoutesTest, More_may_be_sent_and_read_and_less) {
  EXPECT_EQ(difference(), "");
  next_.outgoing.push_back({"own"});
  next_.outgoing.push_back({"new"});
  next_.incoming.push_back({"other_new", "x"});
  EXPECT_EQ(difference(), "");
  next_ = {};
  will_be_used_ = {"out"};
  EXPECT_EQ(difference(), "");
}

TEST_F(BoardRoutesTest, A_variable_in_use_does_not_come_from_another_board) {
  next_.incoming = {{"in", "y"}};
  EXPECT_THAT(difference(), HasSubstr("variable in would not be read from board x any more"));
  next_.incoming = {{"in", "x"}, {"in", "y"}};
  EXPECT_THAT(difference(), HasSubstr("variable in")) << "from a second one, neither";
  next_.incoming.clear();
  EXPECT_THAT(difference(), HasSubstr("variable in")) << "it would be one of this board";
}

TEST_F(BoardRoutesTest, A_variable_of_this_board_does_not_become_one_of_another) {
  next_.incoming.push_back({"own", "x"});
  EXPECT_THAT(difference(), HasSubstr("variable own would be read from board x, and is one of this board now"));
  next_.incoming.back().variable = "appeared";
  EXPECT_EQ(difference(), "");
  used_.insert("appeared");
  EXPECT_THAT(difference(), HasSubstr("variable appeared"));
}

TEST_F(BoardRoutesTest, A_variable_is_not_sent_in_another_way_or_passed_on) {
  next_.outgoing[0].every_ns = 5;
  EXPECT_THAT(difference(), HasSubstr("variable out would be sent to other boards in another way"));
  next_ = start_;
  next_.outgoing[0].best_effort = true;
  EXPECT_THAT(difference(), HasSubstr("variable out"));
  next_ = start_;
  next_.outgoing.push_back({"in"});
  EXPECT_THAT(difference(), HasSubstr("variable in is read from another board"));
}

}  // namespace
}  // namespace indurop::node
