// SPDX-License-Identifier: Apache-2.0
// Questions of jobs in a node: asked and answered from the command line, and by a PLC program.
#include <future>
#include <string>

#include "robot_node.h"

namespace indurop::test {
namespace {

using testing::HasSubstr;

TEST_F(RobotNode, Its_questions_are_answered_from_a_terminal) {
  begin(
      "POINT A = JOINT 30 10 -10 0 40 -20\nMOVJ A\nASK tray = \"Which tray?\" CHOICE \"left\", \"right\"\n"
      "ASK count = \"How many in tray \", tray, \"?\" 1 TO 40\nSET O8 = 100 * tray + count\n");
  EXPECT_THAT(indurop({"robot", "question"}).err, HasSubstr("no question is open"));
  EXPECT_THAT(indurop({"robot", "answer", "left"}).err, HasSubstr("no question is open"));
  EXPECT_NE(indurop({"robot", "question", "--timeout", "50ms"}).code, 0);
  ASSERT_EQ(serve("eOpCode: 1"), 0);
  set("PLC_ROBOT::ROBOT_MODULE_SERVICE", "{eOpCode: 11, nJob: 1, nRequest: " + std::to_string(next_request()) + "}");

  const Outcome first = indurop({"robot", "question", "--timeout", "60s", "-o", "json"});
  ASSERT_EQ(first.code, 0) << first.err;
  const auto asked = first.json()["questions"][0];
  const auto asked_first = asked["number"].get<std::uint32_t>();
  EXPECT_GT(asked_first, 0U);
  const std::string one = std::to_string(asked_first);
  const std::string two = std::to_string(asked_first + 1);
  EXPECT_EQ(asked["question"], "Which tray?");
  EXPECT_EQ(asked["answers"], nlohmann::json({"left", "right"}));
  EXPECT_TRUE(asked["left_s"].is_null());
  EXPECT_NEAR(joint(1), 30, 0.01);
  const Outcome none = indurop({"robot", "answer", "middle"});
  EXPECT_EQ(none.code, 1);
  EXPECT_THAT(none.err, HasSubstr("'middle' does not answer question " + one + ", 'Which tray?': 1 left, 2 right"));
  const Outcome right = indurop({"robot", "answer", "right", "--reason", "the left one is empty"});
  EXPECT_EQ(right.code, 0) << right.err;
  EXPECT_THAT(right.err, HasSubstr("question " + one + ", 'Which tray?', is answered: right"));

  ASSERT_EQ(indurop({"robot", "question", "--timeout", "60s"}).code, 0);
  EXPECT_THAT(indurop({"robot", "question"}).out, HasSubstr("How many in tray 2?  1 to 40"));
  EXPECT_THAT(indurop({"top", "-n", "1"}).out,
              HasSubstr("PLC_ROBOT asks (question " + two + "): How many in tray 2? 1 to 40"));
  const Outcome more = indurop({"robot", "answer", "41"});
  EXPECT_EQ(more.code, 1);
  EXPECT_THAT(more.err, HasSubstr("question " + two + " takes 1 to 40 in steps of 1, not 41"));
  EXPECT_THAT(indurop({"robot", "answer", "12", "--question", one}).err,
              HasSubstr("question " + one + " is not open, question " + two + " is"));
  ASSERT_EQ(indurop({"lock", "all"}).code, 0);
  EXPECT_THAT(indurop({"robot", "answer", "12"}).err, HasSubstr("its write lock is 'all'"));
  ASSERT_EQ(indurop({"lock", "none"}).code, 0);
  EXPECT_EQ(number("PLC_ROBOT::ROBOT_QUESTION.nNumber"), asked_first + 1);
  EXPECT_EQ(indurop({"robot", "answer", "12"}).code, 0);
  EXPECT_TRUE(wait_until([&] { return number("PLC_ROBOT::O8") == 212 && state() == 1; }));
  const std::string audit = indurop({"audit"}).out;
  EXPECT_THAT(audit, HasSubstr("ROBOT_ANSWER"));
  EXPECT_THAT(audit, HasSubstr("the left one is empty"));
}

TEST_F(RobotNode, Of_two_answers_at_once_only_that_which_counts_succeeds) {
  begin("LOOP 20\nASK tray = \"Which tray?\" CHOICE \"left\", \"right\"\nSET O8 = tray\nEND\n");
  ASSERT_EQ(serve("eOpCode: 1"), 0);
  set("PLC_ROBOT::ROBOT_MODULE_SERVICE", "{eOpCode: 11, nJob: 1, nRequest: " + std::to_string(next_request()) + "}");
  for (int i = 0; i < 20; ++i) {
    const Outcome open = indurop({"robot", "question", "--timeout", "60s", "-o", "json"});
    ASSERT_EQ(open.code, 0) << open.err;
    const std::string asked = std::to_string(open.json()["questions"][0]["number"].get<std::uint32_t>());
    auto other = std::async(std::launch::async, [&] {
      return indurop({"robot", "answer", "left", "--question", asked});
    });
    const Outcome right = indurop({"robot", "answer", "right", "--question", asked});
    const Outcome left = other.get();
    ASSERT_TRUE(wait_until([&] { return number("PLC_ROBOT::ROBOT_QUESTION.nNumber") != std::stod(asked); }));
    EXPECT_FALSE(left.code == 0 && right.code == 0) << left.err << right.err;
    EXPECT_TRUE(left.code != 0 || number("PLC_ROBOT::O8") == 1) << left.err << right.err;
    EXPECT_TRUE(right.code != 0 || number("PLC_ROBOT::O8") == 2) << left.err << right.err;
  }
}

TEST_F(RobotNode, Its_questions_are_answered_by_a_plc_program) {
  run_blocks("answers", 3,
             "ASK tray = \"Which tray?\" CHOICE \"left\", \"right\"\nASK count = \"How many?\" 1 TO 40\n"
             "SET O8 = 100 * tray + count\n");
}

}  // namespace
}  // namespace indurop::test
