// SPDX-License-Identifier: Apache-2.0
// indurop explain of simulated plants to which something happened at a known time: the right one is named, and never a
// wrong one.

#include <random>

#include "core/base/json.h"
#include "turning_table_fixture.h"

namespace indurop::test {
namespace {

class ExplainPlant : public TurningTable {
 protected:
  ExplainPlant() : plant_(two_boards()) {}

  [[nodiscard]] std::string recording(const std::string& name) const { return path("r." + board(name) + ".mcap"); }

  void run(const std::string& events) {
    for (const char* name : {"sensor", "control"}) {
      std::filesystem::remove(recording(name));
    }
    const std::string script = path("script.txt");
    std::ofstream(script) << events;
    const Outcome sut =
        indurop({"run", plant_, "--sim", "-q", "--until", "4s", "--script", script, "--record", path("r.mcap")})
            .finish();
    EXPECT_EQ(sut.code, 0) << sut.err;
  }

  // Cause and culprit of the first answer.
  std::pair<std::string, std::string> explain(std::vector<std::string> words, std::size_t number = 0) {
    words.insert(words.begin(), "explain");
    words.insert(words.end(), {"-o", "json"});
    const Outcome sut = indurop(words).finish();
    EXPECT_EQ(sut.code, 0) << sut.err;
    std::string cause;
    std::string culprit;
    const auto json = base::Json::parse(sut.out);
    if (json && (*json)["answers"].values().size() > number) {
      const base::Json& answer = (*json)["answers"].values()[number];
      base::read(answer, "cause", cause);
      base::read(answer, "culprit", culprit);
    }
    return {cause, culprit};
  }

  const std::string plant_;
  std::mt19937 random_{7};
};

TEST_F(ExplainPlant, Tells_a_board_without_power_from_a_pulled_cable) {
  for (int i = 0; i < 10; ++i) {
    const bool killed = i % 2 == 0;
    const std::string name = random_() % 2 == 0 ? "sensor" : "control";
    const std::string other = name == "sensor" ? "control" : "sensor";
    const std::string variable = name == "sensor" ? "cell::encoder" : "cell::torque";
    const std::string at = std::to_string(1200 + random_() % 1500) + "ms ";
    SCOPED_TRACE(at + name);
    run(at + (killed ? "kill " : "cut ") + board(name) + "\n");
    const std::pair<std::string, std::string> right{killed ? "board" : "network", board(name)};
    const std::vector<std::string> both{"--from", recording(other), "--from", recording(name)};
    std::vector<std::string> words{board(name)};
    words.insert(words.end(), both.begin(), both.end());
    EXPECT_EQ(explain(words), right);
    words[0] = variable;
    EXPECT_EQ(explain(words), right);
    EXPECT_EQ(explain({board(name), "--from", recording(other)}).first, "not-known") << "it may be either";
    const std::string joined = (folder() / ("joined." + std::to_string(i) + ".mcap")).string();
    ASSERT_EQ(indurop({"recording", "join", recording(other), recording(name), "-o", joined}).wait(), 0);
    EXPECT_EQ(explain({variable, "--from", joined}), right) << "in one file";
  }
}

// A chain of three boards: each reads of the one before it only. The board that ends first is not reported as the
// cause.
TEST_F(ExplainPlant, Names_no_cause_where_nothing_happened) {
  std::string boards;
  const std::vector<std::string> names{"one", "two", "three"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string period = std::to_string(2 * i + 1) + "ms";
    boards += "<board name=\"" + board(names[i]) + "\"><module><filename>" AGE_MODULES "/age_" + std::to_string(i + 1) +
              ".so</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype><period>" + period +
              "</period><priority>1</priority></module></board>";
  }
  const std::string chain = write(boards);
  for (const char* until : {"500ms", "2s", "3s", "4001ms"}) {
    for (const std::string& name : names) {
      std::filesystem::remove(recording(name));
    }
    ASSERT_EQ(indurop({"run", chain, "--sim", "-q", "--until", until, "--record", path("r.mcap")}).wait(), 0);
    for (const std::string& of : names) {
      for (const std::string& by : names) {
        if (of != by) {
          const std::string cause = explain({board(of), "--from", recording(by), "--from", recording(of)}).first;
          EXPECT_THAT(cause, testing::AnyOf("all-is-well", "not-known", "board")) << of << " by " << by << " " << until;
          if (cause == "board") {
            const Outcome said =
                indurop({"explain", board(of), "--from", recording(by), "--from", recording(of)}).finish();
            EXPECT_THAT(said.out, testing::HasSubstr("ended: end of the duration")) << "as it did";
          }
        }
      }
    }
  }
  for (const std::string& name : names) {
    std::filesystem::remove(recording(name));
  }
  std::ofstream(path("kill.txt")) << "1s kill " << board("two") << "\n";
  ASSERT_EQ(
      indurop({"run", chain, "--sim", "-q", "--until", "3s", "--record", path("r.mcap"), "--script", path("kill.txt")})
          .wait(),
      0);
  const std::pair<std::string, std::string> right{"board", board("two")};
  EXPECT_EQ(explain({board("two"), "--from", recording("three"), "--from", recording("two")}), right);
  EXPECT_EQ(explain({board("two"), "--from", recording("one"), "--from", recording("two")}), right);
  const Outcome twice =
      indurop({"explain", board("two"), "--from", recording("one"), "--from", recording("one")}).finish();
  EXPECT_EQ(twice.code, 2);
  EXPECT_THAT(twice.err, testing::HasSubstr("two recordings of " + board("one")));
}

TEST_F(ExplainPlant, Chains_have_an_age_over_boards) {
  const auto ask = [&](const char* from, const char* to) {
    return indurop({"check", plant_, "--chain", from, to, "--network", "300us", "-o", "json"}).finish();
  };
  const auto json = base::Json::parse(ask("cell::encoder", "cell::torque").out);
  ASSERT_TRUE(json);
  ASSERT_EQ((*json)["chains"].values().size(), 1U);
  const base::Json& chain = (*json)["chains"].values()[0];
  EXPECT_EQ(chain["worst_ns"].integer(), 1'300'000) << "a cycle and the network";
  EXPECT_EQ(chain["crossings"].integer(), 1);
  EXPECT_EQ(ask("cell::torque", "cell::lag").code, 0);
  EXPECT_EQ(ask("cell::torqe", "cell::lag").code, 1);
}

TEST_F(ExplainPlant, Says_who_set_and_who_forces_a_value_and_which_module_wrote_it) {
  Program& sut = indurop({"run", plant_, "--sim", "--step"});
  ASSERT_TRUE(sut.prints("tick 0, "));
  sut.input("100ms\n");
  ASSERT_TRUE(sut.prints("tick 100, "));
  const std::string node = board("control-sim");
  const auto ask = [&](const char* variable, std::size_t number) {
    return explain({variable, "--node", node}, number);
  };
  EXPECT_EQ(ask("cell::torque", 1), std::pair(std::string("module"), std::string("controller")));
  const Outcome forced = indurop({"force", "cell::torque=0.5", "--node", node}).finish();
  EXPECT_EQ(forced.code, 0) << forced.err;
  const auto [cause, culprit] = ask("cell::torque", 1);
  EXPECT_EQ(cause, "force");
  EXPECT_NE(culprit, "");
  EXPECT_EQ(ask("cell::torque", 0).first, "force") << "that is why it is old";
  EXPECT_EQ(indurop({"unforce", "--all", "--node", node}).finish().code, 0);
  sut.input("100ms\n");
  ASSERT_TRUE(sut.prints("tick 200, "));
  EXPECT_EQ(ask("cell::torque", 1), std::pair(std::string("module"), std::string("controller")));
  sut.input("q\n");
  EXPECT_EQ(sut.wait(), 0) << sut.err();
}

}  // namespace
}  // namespace indurop::test
