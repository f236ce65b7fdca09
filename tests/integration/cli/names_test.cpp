// SPDX-License-Identifier: Apache-2.0
// One way to name a variable in all verbs: the full name, with dots, or without leading namespaces.
#include "fixture.h"

namespace indurop::test {
namespace {

class Names : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    if (IsSkipped()) {
      return;
    }
    std::string modules;
    for (const std::string name : {"table", "controller"}) {
      modules += "<module><filename>" + std::string(TWO_BOARDS) + "/" + name +
                 ".so</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>"
                 "<period>10ms</period><priority>1</priority></module>\n";
    }
    put(config(), "<root>\n" + modules + "</root>\n");
  }
  static void run(const std::string& node) {
    const Outcome ran = indurop({"run", config(), "--node", node, "--detach"});
    ASSERT_EQ(ran.code, 0) << ran.err;
  }
  static std::string file(const std::string& name) { return (scratch() / name).string(); }
  static std::string config() { return file("names.xml"); }
};

TEST_F(Names, Every_verb_takes_full_names_dots_and_short_ones) {
  run("local");
  for (const std::string target : {"cell::target", "cell.target", "target"}) {
    const std::string name = target.substr(0, target.size() - 6);
    const std::string recording = file(target + ".mcap");
    const std::vector<std::vector<std::string>> commands{
        {"get", target},
        {"set", target, "1.5"},
        {"set", target + "=2"},
        {"typeof", target},
        {"vars", target},
        {"watch", target, "-n", "1"},
        {"hz", target, "--timeout", "50ms"},
        {"scope", target, "--post", "3", "-o", "csv"},
        {"scope", "a = " + name + "encoder.speed + " + target, "--post", "3", "-o", "csv"},
        {"force", target + "=1", "--for", "1min"},
        {"unforce", target},
        {"recipe", "save", "mine", target},
        {"explain", target},
        {"check", config(), "--chain", name + "encoder", name + "torque"},
        {"age", name + "encoder", name + "torque", "--network", "1s"},
        {"stream", target, "--plotjuggler", "--timeout", "50ms"},
        {"blackbox", "keep", "--when", target},
        {"record", target, "-o", recording, "--duration", "200ms"},
        {"recording", "export", recording, target, "--csv", file(target + ".csv")},
        {"explain", target, "--from", recording},
    };
    for (const auto& command : commands) {
      const Outcome sut = indurop(command);
      // On a busy machine `age` may find values that are older than predicted, and a node keeps a box every 10 s only.
      const bool old = command[0] == "age" && sut.code == 4;
      const bool soon = command[0] == "blackbox" && sut.err.find("it has just written") != std::string::npos;
      EXPECT_TRUE(sut.code == 0 || old || soon) << command[0] << " " << target << ": " << sut.code << "\n" << sut.err;
    }
  }
  EXPECT_EQ(indurop({"stop"}).code, 0);
}

TEST_F(Names, Explain_names_the_node_and_asks_when_several_ended_ones_know_the_subject) {
  run("first");
  run("second");
  ASSERT_EQ(indurop({"stop", "--node", "first"}).code, 0);
  const Outcome running = indurop({"explain", "controller"});
  EXPECT_EQ(running.code, 0) << running.err;
  EXPECT_THAT(running.err, HasSubstr("of node 'second'\n"));
  ASSERT_EQ(indurop({"stop", "--node", "second"}).code, 0);
  const Outcome both = indurop({"explain", "controller"});
  EXPECT_EQ(both.code, 2);
  EXPECT_THAT(both.err, HasSubstr("several nodes know 'controller'; say which with --node: first, second"));
  const Outcome ended = indurop({"explain", "controller", "--node", "first"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("of node 'first', which does not run any more"));
}

}  // namespace
}  // namespace indurop::test
