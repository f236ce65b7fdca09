// SPDX-License-Identifier: Apache-2.0
// Recordings that begin in the middle of a run: modules that declare what they keep are repeated from a keyframe on.

#include <csignal>
#include <fstream>
#include <iterator>
#include <random>

#include "node_fixture.h"
#include "tests/support/wait_until.h"

namespace indurop::test {
namespace {

std::string bytes_of_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class FromTheMiddle : public NodeTest {
 protected:
  [[nodiscard]] std::string file() const { return folder() / "run.mcap"; }
  Outcome replay(const std::string& file, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"replay", file, "--node", node() + "-r"};
    words.insert(words.end(), more.begin(), more.end());
    return indurop(words);
  }
  static Module rambler(const std::string& file = "rambler.so") {
    return {.file = file, .name = "rambler", .period = "2ms", .priority = 2};
  }
  // Replays the recording from this time on.
  Outcome replay_from(std::uint64_t ms) const {
    const std::string part = folder() / "part.mcap";
    std::filesystem::remove(part);
    EXPECT_EQ(indurop({"recording", "cut", file(), "--from", std::to_string(ms) + "ms", "-o", part}).code, 0);
    return replay(part);
  }
  const Module kCounter{.file = "counter.so", .name = "counter", .priority = 1};
  const Module kWalker{.file = "walker.so", .name = "rambler", .period = "2ms", .priority = 2};
};

TEST_F(FromTheMiddle, A_live_recording_is_repeated_from_its_first_keyframes) {
  Program& sut = start_and_wait({kCounter, rambler()});
  ASSERT_TRUE(runs_reach("rambler", 300));
  const Outcome recorded = indurop({"record", "-o", file(), "--duration", "1500ms"});
  ASSERT_EQ(recorded.code, 0) << recorded.err;
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  const Outcome again = replay(file());
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_CONTAINS(again.out, " values: equal");
  EXPECT_CONTAINS(again.out, "runs of rambler were not repeated: they come before the first keyframe");
  EXPECT_CONTAINS(again.err, "runs of counter before tick ");
  EXPECT_CONTAINS(again.err, "it does not declare what it keeps (INDUROP_STATE)");
  EXPECT_FALSE(contains(again.err, "runs of rambler before tick ")) << again.err;
}

TEST_F(FromTheMiddle, Any_cut_is_repeated_as_the_whole_is) {
  for (const char* module : {"rambler.so", "rambler_by.so"}) {
    std::filesystem::remove(file());
    ASSERT_EQ(run_to_end({kCounter, rambler(module)}, {"--sim", "--until", "4s", "--record", file()}).code, 0);
    EXPECT_CONTAINS(replay(file()).out, "4000 ticks, 6000 runs, 12000 values: equal");
    std::mt19937 random(7);  // NOLINT(cert-msc51-cpp): the same each time
    for (int round = 0; round < 20; ++round) {
      const std::uint64_t from = 1 + random() % 3200;
      const Outcome again = replay_from(from);
      EXPECT_EQ(again.code, 0) << from << again.out << again.err;
      EXPECT_CONTAINS(again.out, " values: equal");
    }
  }
}

TEST_F(FromTheMiddle, A_process_is_repeated_as_a_thread_is) {
  for (const char* program : {"rambler_process.exe", "rambler_by_process.exe"}) {
    std::filesystem::remove(file());
    Module process = rambler(program);
    process.type = "process";
    ASSERT_EQ(run_to_end({kCounter, process}, {"--sim", "--until", "4s", "--record", file()}).code, 0);
    EXPECT_CONTAINS(replay(file()).out, "4000 ticks, 6000 runs, 12000 values: equal");
    std::mt19937 random(11);  // NOLINT(cert-msc51-cpp): the same each time
    for (int round = 0; round < 5; ++round) {
      const Outcome again = replay_from(1 + random() % 3200);
      EXPECT_EQ(again.code, 0) << again.out << again.err;
      EXPECT_CONTAINS(again.out, " values: equal");
      EXPECT_FALSE(contains(again.err, "runs of rambler before tick ")) << again.err;
    }
  }
}

TEST_F(FromTheMiddle, A_live_recording_of_a_process_is_repeated_from_its_first_keyframe) {
  Module process = rambler("rambler_process.exe");
  process.type = "process";
  Program& sut = start_and_wait({kCounter, process});
  ASSERT_TRUE(runs_reach("rambler", 300));
  ASSERT_EQ(indurop({"record", "-o", file(), "--duration", "2s"}).code, 0);
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  const Outcome again = replay(file());
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_CONTAINS(again.out, " values: equal");
  EXPECT_CONTAINS(again.out, "runs of rambler were not repeated: they come before the first keyframe");
}

TEST_F(FromTheMiddle, Without_a_declaration_it_differs) {
  ASSERT_EQ(run_to_end({kCounter, kWalker}, {"--sim", "--until", "2s", "--record", file()}).code, 0);
  const Outcome again = replay_from(1000);
  EXPECT_EQ(again.code, 4) << again.out << again.err;
  EXPECT_CONTAINS(again.err, "runs of rambler before tick 1000 are not in the recording");
}

TEST_F(FromTheMiddle, What_another_file_declares_otherwise_is_named) {
  ASSERT_EQ(run_to_end({kCounter, rambler()}, {"--sim", "--until", "2s", "--record", file()}).code, 0);
  const std::string part = folder() / "part.mcap";
  ASSERT_EQ(indurop({"recording", "cut", file(), "--from", "1s", "-o", part}).code, 0);
  const Outcome again = replay(part, {"--config", write("by.xml", xml({kCounter, rambler("rambler_by.so")}))});
  EXPECT_CONTAINS(again.err, "module rambler: path cannot be put back: it is declared otherwise than in the recording");
}

TEST_F(FromTheMiddle, Simulations_make_the_same_keyframes_each_time) {
  for (const char* name : {"one.mcap", "two.mcap"}) {
    ASSERT_EQ(run_to_end({kCounter, rambler()}, {"--sim", "--until", "2s", "--record", folder() / name}).code, 0);
  }
  const std::string one = bytes_of_file(folder() / "one.mcap");
  EXPECT_NE(one.find("indurop/keyframes/rambler"), std::string::npos);
  EXPECT_TRUE(one == bytes_of_file(folder() / "two.mcap"));
}

TEST_F(FromTheMiddle, Any_ticks_are_repeated_alone) {
  ASSERT_EQ(run_to_end({kCounter, rambler()}, {"--sim", "--until", "3s", "--record", file()}).code, 0);
  const Outcome second_half = replay(file(), {"--from", "1500"});
  EXPECT_EQ(second_half.code, 0) << second_half.out << second_half.err;
  EXPECT_CONTAINS(second_half.out, "1500 ticks, 2250 runs, 4500 values: equal");
  const Outcome first_half = replay(file(), {"--to", "1499"});
  EXPECT_CONTAINS(first_half.out, "1500 ticks, 2250 runs, 4500 values: equal");
  EXPECT_CONTAINS(replay(file(), {"--at", "2222"}).out, "1 ticks, 2 runs, 4 values: equal");
  EXPECT_CONTAINS(replay(file(), {"--from", "1000", "--to", "1099"}).out, "100 ticks, 150 runs, 300 values: equal");
  EXPECT_EQ(replay(file(), {"--from", "2", "--to", "1"}).code, 2);
  const Outcome none = replay(file(), {"--at", "99999"});
  EXPECT_EQ(none.code, 1) << none.out;
  EXPECT_CONTAINS(none.err, "holds no run of these modules that can be repeated between the ticks asked for");
}

bool is_stopped(pid_t process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/stat");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return contains(text, ") T ");
}

TEST_F(FromTheMiddle, A_replay_stops_before_a_tick_for_a_debugger) {
  ASSERT_EQ(run_to_end({kCounter, rambler()}, {"--sim", "--until", "3s", "--record", file()}).code, 0);
  Program again({INDUROP_PROGRAM, "replay", file(), "--node", node() + "-r", "--stop-at", "2222"}, environment());
  ASSERT_TRUE(wait_until([&] { return is_stopped(again.pid()); })) << again.err();
  EXPECT_CONTAINS(again.err(), "stopped before tick 2222, the next run is one of counter: gdb -p ");
  EXPECT_CONTAINS(indurop({"get", "--node", node() + "-r", "nt::counted"}).out, "2222\n");  // runs of ticks 0 to 2221
  again.signal(SIGCONT);
  const Outcome outcome = again.finish();
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_CONTAINS(outcome.out, "778 ticks, 1167 runs, 2334 values: equal");
}

// Each keyframe is of a moment between two runs, however short that is.
TEST_F(FromTheMiddle, A_module_that_is_nearly_always_running_has_whole_keyframes) {
  Module busy = rambler("rambler_busy.so");
  Program& sut = start_and_wait({kCounter, busy});
  ASSERT_TRUE(runs_reach("rambler", 300));
  ASSERT_EQ(indurop({"record", "-o", file(), "--duration", "3s"}).code, 0);
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  for (std::uint64_t from = 0; from < 2000; from += 250) {
    const Outcome again = replay_from(from);
    EXPECT_EQ(again.code, 0) << from << again.out << again.err;
    EXPECT_CONTAINS(again.out, " values: equal");
  }
}

}  // namespace
}  // namespace indurop::test
