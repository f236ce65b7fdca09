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
  EXPECT_TRUE(wait_for(rung(2), "│T#0s")) << "the timer has not begun";
  set("start", "true");
  EXPECT_TRUE(wait_for(rung(2), "│T#2s")) << "it has counted to its end";
  EXPECT_TRUE(wait_for(rung(2), kPowered)) << "and the motor runs";
}

// A program in Structured Text with a function block, and a chart.
class PlcWatchText : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    if (IsSkipped()) {
      return;
    }
    put(file("line.st"),
        "VAR_GLOBAL go : BOOL; END_VAR\n"
        "FUNCTION_BLOCK Motor\nVAR_INPUT on : BOOL; END_VAR\nVAR t : TON; END_VAR\n"
        "  t(IN := on, PT := T#100ms);\nEND_FUNCTION_BLOCK\n"
        "PROGRAM main\nVAR_EXTERNAL go : BOOL; END_VAR\nVAR m : Motor; list : ARRAY[1..3] OF INT; name : STRING; "
        "END_VAR\n"
        "  m(on := go);\n  list[2] := 7;\n  name := 'belt';\nEND_PROGRAM\n"
        "PROGRAM steps\nVAR_EXTERNAL go : BOOL; END_VAR\nINITIAL_STEP rest: END_STEP\nSTEP run: END_STEP\n"
        "TRANSITION FROM rest TO run := go; END_TRANSITION\nTRANSITION FROM run TO rest := NOT go; END_TRANSITION\n"
        "END_PROGRAM\n");
    const Outcome built = indurop({"plc", "build", file("line.st"), "-o", file("out"), "--watch"});
    ASSERT_EQ(built.code, 0) << built.err;
    put(file("out/module.xml"), "<root>\n" + built.out + "</root>\n");
    node_ = std::make_unique<Program>(indurop_command({"run", file("out/module.xml"), "-q", "--node", "text"}),
                                      background());
    ASSERT_TRUE(wait_for({}, "main")) << node_->out();
  }
  static std::string file(const std::string& name) { return (scratch() / name).string(); }
  static Outcome watch(const std::vector<std::string>& more) {
    std::vector<std::string> command{"plc", "watch", file("line.st"), "--node", "text", "--once"};
    command.insert(command.end(), more.begin(), more.end());
    return indurop(command);
  }
  static bool wait_for(const std::vector<std::string>& more, const std::string& text) {
    return wait_until([&] { return watch(more).out.find(text) != std::string::npos; });
  }

  std::unique_ptr<Program> node_;
};

TEST_F(PlcWatchText, Values_are_next_to_the_lines_and_steps_are_active) {
  EXPECT_TRUE(wait_for({}, "list[2] = 7"));
  const std::string all = watch({}).out;
  EXPECT_THAT(all, HasSubstr("  m(on := go);     go = FALSE"));
  EXPECT_THAT(all, HasSubstr("name = 'belt'"));
  EXPECT_TRUE(wait_for({"--pou", "steps"}, "[[rest]] "));
  ASSERT_EQ(indurop({"set", "--node", "text", "go", "true"}).code, 0);
  EXPECT_TRUE(wait_for({"--pou", "steps"}, "[run] ")) << watch({"--pou", "steps"}).out;
  EXPECT_TRUE(wait_for({"--pou", "Motor"}, "PT := T#100ms);  on = TRUE"));
  EXPECT_THAT(watch({"--instance", "main.m"}).out, HasSubstr("main.m\n"));
  EXPECT_THAT(watch({"--pou", "steps"}).out, HasSubstr("go  ──> run  go = TRUE"));
  const Outcome none = watch({"--instance", "main.x"});
  EXPECT_EQ(none.code, 1);
  EXPECT_THAT(none.err, HasSubstr("there is no instance 'main.x'"));
}

TEST_F(PlcWatchText, A_program_other_than_the_running_one_is_reported) {
  ASSERT_TRUE(wait_for({}, "list[2] = 7")) << "its first scan";
  put(file("line.st"), "PROGRAM main VAR x : INT; END_VAR x := x + 1; END_PROGRAM\n");
  const Outcome other = watch({"--namespace", "line"});
  EXPECT_NE(other.code, 0);
  EXPECT_THAT(other.err, HasSubstr("is not the one in these files"));
}

}  // namespace
}  // namespace indurop::test
