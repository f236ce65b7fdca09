// SPDX-License-Identifier: Apache-2.0
// Replays of recordings that do not tell everything: chosen variables, runs that are missing, processes that died.

#include <csignal>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "node_fixture.h"
#include "tests/support/wait_until.h"

namespace indurop::test {
namespace {

class ReplayOfLess : public NodeTest {
 protected:
  [[nodiscard]] std::string file() const { return folder() / "run.mcap"; }
  Outcome replay(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"replay", file(), "--node", node() + "-r"};
    words.insert(words.end(), more.begin(), more.end());
    return indurop(words);
  }
  static Module process(const std::string& how) {
    return {.file = "process.exe",
            .name = "process",
            .type = "process",
            .period = "5ms",
            .priority = 3,
            .more = how + "<restart delay=\"50ms\" max=\"100\"/>"};
  }
  const Module kCounter{.file = "counter.so", .name = "counter", .priority = 1};
  const Module kWalker{.file = "walker.so", .name = "walker", .period = "2ms", .priority = 2};
};

TEST_F(ReplayOfLess, Chosen_variables_are_compared_where_all_inputs_are_recorded) {
  Program& sut = start_and_wait({kCounter, kWalker, process("")});
  ASSERT_TRUE(runs_reach("walker", 20));
  const Outcome recorded =
      indurop({"record", "nt::counted", "nt::kept", "nt::pace", "-o", file(), "--duration", "300ms"});
  ASSERT_EQ(recorded.code, 0) << recorded.err;
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  const Outcome again = replay();
  EXPECT_EQ(again.code, 1) << again.out << again.err;
  EXPECT_CONTAINS(again.out, " values: equal");
  EXPECT_CONTAINS(again.err, "module walker does not run: the recording has no values of its inputs (nt::walked);");
  EXPECT_CONTAINS(again.err, "runs of walker could not be repeated: the recording has no values of its inputs");
  EXPECT_CONTAINS(again.err, "runs of process could not be repeated: the recording has no values of its inputs");
  EXPECT_FALSE(contains(again.err, "of counter could not")) << again.err;
}

TEST_F(ReplayOfLess, Nothing_that_a_module_wrote_is_no_comparison_of_it) {
  Program& sut = start_and_wait({kCounter, {.file = "keeper.so", .name = "keeper", .priority = 2}});
  ASSERT_TRUE(runs_reach("keeper", 20));
  ASSERT_EQ(indurop({"record", "nt::counted", "nt::kept", "-o", file(), "--duration", "200ms"}).code, 0);
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  const Outcome again = replay();
  EXPECT_EQ(again.code, 1) << again.out << again.err;
  EXPECT_CONTAINS(again.err,
                  "runs of keeper were repeated, but not compared: the recording has no values of its outputs");
}

// walker writes both in each run; the recording cannot tell whether it wrote the one that was not chosen.
TEST_F(ReplayOfLess, Explains_no_value_that_is_not_recorded) {
  Program& sut = start_and_wait({kCounter, kWalker});
  ASSERT_TRUE(runs_reach("walker", 20));
  ASSERT_EQ(indurop({"record", "nt::pace", "-o", file(), "--duration", "200ms"}).code, 0);
  for (const std::string name : {"nt::walked", "nt::pace"}) {
    const Outcome why = indurop({"explain", name, "--from", file()});
    EXPECT_EQ(why.code, 0) << why.err;
    EXPECT_FALSE(contains(why.out, "leaves " + name + " as it is")) << why.out;
  }
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

// counter knows only what it reads: after a gap it has to get that again.
TEST_F(ReplayOfLess, Runs_after_missing_ones_wait_for_what_they_read) {
  Program& sut = start_and_wait({kCounter});
  Program recorder({INDUROP_PROGRAM, "record", "-o", file(), "--node", node()}, environment());
  ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(file()); }));
  ASSERT_TRUE(runs_reach("counter", module("counter").runs.load() + 100));
  recorder.signal(SIGSTOP);
  ASSERT_TRUE(runs_reach("counter", module("counter").runs.load() + 10'000));  // more than the tape holds
  recorder.signal(SIGCONT);
  ASSERT_TRUE(runs_reach("counter", module("counter").runs.load() + 100));
  recorder.signal(SIGINT);
  EXPECT_EQ(recorder.wait(), 1) << "runs are missing: " << recorder.err();
  EXPECT_CONTAINS(recorder.err(), "runs of counter are not in the recording");
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  const Outcome again = replay();
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_CONTAINS(again.out, " values: equal");
  EXPECT_CONTAINS(again.err, "runs of counter before tick ");
}

// The releases after a run that took too long are caught up; each gets its own tick, live and replayed.
TEST_F(ReplayOfLess, Late_runs_get_their_own_release) {
  const Module late{
      .file = "late.so", .name = "late", .period = "2ms", .priority = 2, .more = "<overrun>catch-up</overrun>"};
  Program& sut = start_and_wait({kCounter, late});
  ASSERT_TRUE(runs_reach("late", 20));
  const Outcome recorded = indurop({"record", "-o", file(), "--duration", "300ms"});
  ASSERT_EQ(recorded.code, 0) << recorded.err;
  EXPECT_GT(module("late").overruns.load(), 3U);
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  const Outcome again = replay();
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_CONTAINS(again.out, " values: equal");
}

// What a module writes into a variable that is forced is not what that holds, live; a replay has no forces.
TEST_F(ReplayOfLess, What_was_forced_is_not_compared_meanwhile) {
  const Module late{.file = "late.so", .name = "late", .period = "2ms", .priority = 2};
  Program& sut = start_and_wait({kCounter, late});
  Program recorder({INDUROP_PROGRAM, "record", "-o", file(), "--node", node()}, environment());
  ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(file()); }));
  const auto later = [&] { return runs_reach("counter", module("counter").runs.load() + 300); };
  ASSERT_TRUE(later());
  ASSERT_EQ(indurop({"force", "nt::pace.walked", "3"}).code, 0);
  ASSERT_TRUE(later());
  ASSERT_EQ(indurop({"unforce", "nt::pace.walked"}).code, 0);
  ASSERT_TRUE(later());
  recorder.signal(SIGINT);
  EXPECT_EQ(recorder.wait(), 130) << recorder.err();
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  const Outcome again = replay();
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_CONTAINS(again.out, " values of nt::pace were not compared: it was forced\n");
  EXPECT_FALSE(contains(again.out, "values of nt::walked were")) << again.out;
  EXPECT_CONTAINS(again.out, " values: equal");
}

TEST_F(ReplayOfLess, A_process_that_died_dies_again) {
  SKIP_CRASHES_UNDER_TSAN();
  const std::vector<Module> modules = {kCounter, kWalker,
                                       process("<argument>change</argument><argument>100</argument>")};
  const Outcome recorded = run_to_end(modules, {"--sim", "--until", "1s", "--record", file()});
  ASSERT_EQ(recorded.code, 0) << recorded.err;
  const auto info = indurop({"recording", "info", file(), "-o", "json"}).json();
  EXPECT_GT(info["modules"][2]["faults"], 2) << info;
  const Outcome again = replay();
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_CONTAINS(again.out, " values: equal");

  const Outcome mended = replay({"--config", write("mended.xml", xml({kCounter, kWalker, process("")}))});
  EXPECT_EQ(mended.code, 4) << mended.out << mended.err;
  EXPECT_CONTAINS(mended.err, "module process faulted in the recording and does not now");
  EXPECT_FALSE(contains(mended.out, "of walker")) << mended.out;
}

TEST_F(ReplayOfLess, Says_that_another_schedule_changes_nothing) {
  ASSERT_EQ(run_to_end({kCounter, kWalker}, {"--sim", "--until", "100ms", "--record", file()}).code, 0);
  Module slower = kWalker;
  slower.period = "4ms";
  Module later = kCounter;
  later.priority = 5;
  const Outcome again = replay({"--config", write("other.xml", xml({later, slower}))});
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_CONTAINS(again.err, "module walker has a period of 4 ms in this configuration and had one of 2 ms");
  EXPECT_CONTAINS(again.err, "module counter has priority 5 in this configuration and had 1");
  EXPECT_TRUE(replay().err.empty()) << "the same schedule";
}

// A recording that does not say its format is older than format numbers.
TEST_F(ReplayOfLess, Says_that_an_older_recording_tells_less) {
  ASSERT_EQ(run_to_end({kCounter}, {"--sim", "--until", "100ms", "--record", file()}).code, 0);
  std::ifstream in(file(), std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::size_t at = bytes.find("format");
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, 6, "tamrof");
  std::ofstream(file(), std::ios::binary) << bytes;
  const Outcome again = replay();
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_CONTAINS(again.err, "the recording is of an older release: what snapshot()");
}

TEST_F(ReplayOfLess, A_process_that_dies_only_now_does_not_end_the_replay) {
  const Outcome recorded = run_to_end({kCounter, kWalker, process("")}, {"--sim", "--until", "1s", "--record", file()});
  ASSERT_EQ(recorded.code, 0) << recorded.err;
  const std::string broken =
      write("broken.xml", xml({kCounter, kWalker, process("<argument>die</argument><argument>40</argument>")}));
  const Outcome again = replay({"--config", broken});
  EXPECT_EQ(again.code, 4) << again.out << again.err;
  EXPECT_CONTAINS(again.err,
                  "tick 195: module process did not fault in the recording and faults now: ended by signal 9");
  EXPECT_CONTAINS(again.out, "1000 ticks, 1540 runs, ");
}

}  // namespace
}  // namespace indurop::test
