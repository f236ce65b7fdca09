// SPDX-License-Identifier: Apache-2.0
// plc watch: the power in the rungs of examples/plc while a node runs it.
#include "fixture.h"

namespace indurop::test {
namespace {

const std::string kFolder = PLC_EXAMPLE;
constexpr const char* kDead = "───( )────┤";
constexpr const char* kPowered = "━━━( )━━━━┫";  // heavy to the right rail

class PlcWatch : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    if (!IsSkipped()) {
      node_ = std::make_unique<Program>(indurop_command({"run", kFolder + "/module.xml", "-q", "--node", "belt"}),
                                        background());
      ASSERT_TRUE(wait_for(rung(1), "rung 1: ")) << node_->out();
    }
  }
  static std::vector<std::string> rung(int number) {
    return {"plc", "watch", kFolder + "/conveyor.xml", "--node", "belt", "--once", "--rung", std::to_string(number)};
  }
  static void set(const char* name, const char* value) {
    ASSERT_EQ(indurop({"set", "--node", "belt", name, value}).code, 0) << name;
  }
  // Until what it prints holds the text.
  static bool wait_for(const std::vector<std::string>& command, const std::string& text) {
    return wait_until([&] { return indurop(command).out.find(text) != std::string::npos; });
  }

  std::unique_ptr<Program> node_;
};

TEST_F(PlcWatch, Power_comes_and_goes_with_the_contacts) {
  ASSERT_TRUE(wait_for(rung(1), kDead));
  set("start", "true");
  EXPECT_TRUE(wait_for(rung(1), kPowered));
  set("start", "false");
  // The belt keeps itself on: its branch is heavy, that of the button is not.
  EXPECT_TRUE(wait_for(rung(1), "┣━━━━┤ ├───┳━━━┤/├━━━━━━┤/├"));
  set("stop", "true");
  EXPECT_TRUE(wait_for(rung(1), kDead));
}

TEST_F(PlcWatch, Values_stand_at_the_outputs_of_boxes) {
  EXPECT_TRUE(wait_for(rung(2), "│0 ns")) << "the timer has not begun";
  set("start", "true");
  EXPECT_TRUE(wait_for(rung(2), "│2.00 s")) << "it has counted to its end";
  EXPECT_TRUE(wait_for(rung(2), kPowered)) << "and the motor runs";
}

}  // namespace
}  // namespace indurop::test
