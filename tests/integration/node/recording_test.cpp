// SPDX-License-Identifier: Apache-2.0
// Runs are recorded, and run again: with the same modules they leave the same, with another one the difference is
// reported.

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "node_fixture.h"
#include "store/vars/store.h"
#include "tests/support/wait_until.h"

namespace indurop::test {
namespace {

class Recording : public NodeTest {
 protected:
  [[nodiscard]] std::string file() const { return folder() / "run.mcap"; }
  Outcome replay(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"replay", file(), "--node", node() + "-r"};
    words.insert(words.end(), more.begin(), more.end());
    return indurop(words);
  }
  // Threads on two periods, an event with a condition, a process; one of them asks for the time.
  const std::vector<Module> kPlant = {
      {.file = "counter.so", .name = "counter", .priority = 1},
      {.file = "walker.so", .name = "walker", .period = "2ms", .priority = 2},
      {.file = "process.exe", .name = "process", .type = "process", .period = "5ms", .priority = 3},
      {.file = "event.so",
       .name = "event",
       .operation = "sporadic",
       .period = "10ms",
       .priority = 9,
       .properties = {{"every", "7"}}}};
  std::vector<Module> threads() const { return {kPlant[0], kPlant[1], kPlant[3]}; }
};

TEST_F(Recording, Of_a_simulation_runs_again_with_the_same_result) {
  const Outcome recorded = run_to_end(kPlant, {"--sim", "--until", "2s", "--record", file()});
  ASSERT_EQ(recorded.code, 0) << recorded.err;
  EXPECT_CONTAINS(recorded.out + recorded.err, "recorded 3686 runs")
      << "2000 + 1000 + 400 + 285, and the variables without readers or writers";
  const Outcome again = replay();
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_CONTAINS(again.out, "2000 ticks, 3685 runs, ");
  EXPECT_CONTAINS(again.out, " values: equal");
  EXPECT_FALSE(std::filesystem::exists("/dev/shm/indurop." + node() + "-r")) << "a replay leaves nothing";
}

TEST_F(Recording, Of_a_run_in_real_time_runs_again_with_the_same_result) {
  std::vector<Module> modules = kPlant;
  modules.back().properties.emplace_back("busy_us", "200");  // it reads the clock until then
  const Outcome recorded = run_to_end(modules, {"--duration", "1s", "--record", file()});
  ASSERT_EQ(recorded.code, 0) << recorded.err;
  const Outcome again = replay();
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_CONTAINS(again.out, " values: equal");
}

TEST_F(Recording, Tells_where_a_changed_module_goes_another_way) {
  ASSERT_EQ(run_to_end(threads(), {"--sim", "--until", "1s", "--record", file()}).code, 0);
  const Outcome changed = replay({"--with", std::string(MODULE_DIR) + "/new/walker.so"});
  EXPECT_EQ(changed.code, 4) << changed.err;
  // In run 0 it keeps 4 inside instead of 3.
  EXPECT_CONTAINS(changed.err, "tick 0, module walker: nt::pace was ");
  EXPECT_CONTAINS(changed.out, "nt::walked of walker: ");
  EXPECT_FALSE(contains(changed.out, "of counter:")) << changed.out;
  const std::filesystem::path now = folder() / "now.mcap";
  const std::filesystem::path svg = folder() / "now.svg";
  const Outcome drawn = replay({"--with", std::string(MODULE_DIR) + "/new/walker.so", "-o", now, "--svg", svg});
  EXPECT_EQ(drawn.code, 4) << drawn.err;
  EXPECT_EQ(drawn.out, changed.out);
  std::ifstream in(svg);
  const std::string picture{std::istreambuf_iterator<char>(in), {}};
  EXPECT_CONTAINS(picture, "run.mcap: recorded, and what is left now");
  EXPECT_CONTAINS(picture, ">walked<");
  EXPECT_FALSE(contains(picture, "counted")) << "is equal";
  // What walker leaves when it runs live: in each run one more of STEP, as the next one begins with what was recorded.
  const auto column = [&](const std::filesystem::path& of) {
    EXPECT_EQ(indurop({"recording", "export", of, "nt::pace", "--csv", folder() / "c.csv"}).code, 0);
    std::ifstream csv(folder() / "c.csv");
    std::vector<double> own;
    for (std::string line; std::getline(csv, line);) {
      own.push_back(std::atof(line.substr(line.rfind(',') + 1).c_str()) * 8);
    }
    return own;
  };
  const std::vector<double> then = column(file());
  const std::vector<double> left = column(now);
  ASSERT_EQ(then.size(), left.size() + 1) << "the first value is none of a run";
  for (std::size_t i = 1; i < left.size(); ++i) {
    EXPECT_EQ(left[i], 4.0 * static_cast<double>(i));
    EXPECT_EQ(then[i + 1], 3.0 * static_cast<double>(i));
  }
  const Outcome same = replay({"--with", std::string(MODULE_DIR) + "/walker.so"});
  EXPECT_EQ(same.code, 0) << same.out << same.err;
  const Outcome unknown = replay({"--with", "/nowhere/stranger.so"});
  EXPECT_EQ(unknown.code, 1);
  EXPECT_CONTAINS(unknown.err, "no module has this name or such a file");
  const Outcome missing = replay({"--with", "/nowhere/walker.so"});
  EXPECT_EQ(missing.code, 1);
  EXPECT_CONTAINS(missing.err, "/nowhere/walker.so: error: no such file");
  const std::string walker = std::string(MODULE_DIR) + "/walker.so";
  const Outcome twice = replay({"--with", std::string(MODULE_DIR) + "/new/walker.so", "--with", walker});
  EXPECT_EQ(twice.code, 1);
  EXPECT_CONTAINS(twice.err, "replaces module walker, as ");
}

TEST_F(Recording, What_runs_print_is_printed_again) {
  const std::vector<Module> talks = {{.file = "flood.so", .name = "flood", .properties = {{"lines", "5"}}}};
  const Outcome recorded = run_to_end(talks, {"--sim", "--until", "1s", "--quiet", "--record", file()});
  ASSERT_EQ(recorded.code, 0) << recorded.err;
  ASSERT_THAT(recorded.out, testing::EndsWith("flood 5000\n"));
  EXPECT_THAT(replay().out, testing::StartsWith(recorded.out));
}

TEST_F(Recording, Says_that_the_condition_of_another_file_is_not_asked) {
  ASSERT_EQ(run_to_end(threads(), {"--sim", "--until", "100ms", "--record", file()}).code, 0);
  const std::string folder = std::string(MODULE_DIR) + "/";
  const Outcome sut = replay({"--with", folder + "event.so", "--with", folder + "counter.so"});
  EXPECT_EQ(sut.code, 0) << sut.err;
  EXPECT_CONTAINS(sut.err, "warning: module event runs when it ran in the recording: the condition of the other file");
  EXPECT_FALSE(contains(sut.err, "module counter runs")) << sut.err;
  EXPECT_FALSE(contains(replay().err, "module event runs when"));
}

TEST_F(Recording, Is_not_equal_as_a_whole_without_one_of_its_modules) {
  ASSERT_EQ(run_to_end(threads(), {"--sim", "--until", "1s", "--record", file()}).code, 0);
  const std::string fewer = write("fewer.xml", xml({kPlant[0], kPlant[1]}));
  const Outcome sut = replay({"--config", fewer});
  EXPECT_EQ(sut.code, 1) << sut.out;
  EXPECT_CONTAINS(sut.err, "module event of the recording is not in this configuration");
  EXPECT_CONTAINS(sut.err, "142 runs of modules that are not in this configuration were not repeated");
  const Outcome nothing = replay({"--config", write("other.xml", xml({{.file = "layout.so", .name = "layout"}}))});
  EXPECT_NE(nothing.code, 0) << nothing.out;
}

TEST_F(Recording, A_run_that_does_not_return_is_ended_in_the_replay_too) {
  const std::vector<Module> modules = {
      kPlant[0],
      {.file = "faulty.so", .name = "stuck", .priority = 2, .properties = {{"fault", "loop"}, {"after", "20"}}}};
  Program& sut = start(modules, {"--sim", "--until", "100ms", "--record", file()});
  ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(file()); }));
  EXPECT_EQ(sut.wait(), 1) << sut.err();
  const Outcome again = replay();
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_CONTAINS(again.out, "values: equal");
}

TEST_F(Recording, Reports_which_modules_were_restarted) {
  std::vector<Module> modules = {{.file = "counter.so", .name = "counter"},
                                 {.file = "keeper.so", .name = "keeper", .priority = 2},
                                 {.file = "process.exe", .name = "process", .type = "process", .priority = 3}};
  Program& sut = start_and_wait(modules, {"--record", file()});
  ASSERT_TRUE(runs_reach("keeper", 50));
  ASSERT_TRUE(runs_reach("process", 50));
  for (const char* name : {"keeper", "process"}) {
    const Outcome restarted = indurop({"restart", name, "--node", node()});
    EXPECT_EQ(restarted.code, 0) << restarted.err;
    EXPECT_TRUE(runs_reach(name, module(name).runs.load() + 50));
  }
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0) << sut.err();
  const Outcome again = replay();
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_CONTAINS(again.out, " values: equal");
}

class Recording_of_askers : public Recording, public testing::WithParamInterface<bool> {};

TEST_P(Recording_of_askers, Gives_runs_what_functions_channels_and_the_clock_gave_them) {
  Module asker{.file = "asker.so", .name = "asker"};
  if (GetParam()) {
    asker.file = "asker_process.exe";
    asker.type = "process";
  }
  Program& sut = start_and_wait({asker, {.file = "dice.so", .name = "dice"}}, {"--record", file()});
  auto store = vars::Store::attach(node(), vars::Mode::ReadWrite);
  ASSERT_TRUE(store.ok());
  const auto* entry = store->find(abi::fnv1a64("nt::looks", 9));
  ASSERT_NE(entry, nullptr);
  // Nobody of the schedule writes it, and at any time.
  std::uint64_t looks = 0;
  ASSERT_TRUE(wait_until([&] {
    for (int i = 0; i < 100; ++i) {
      ++looks;
      EXPECT_TRUE(store->write(*entry, 0, {reinterpret_cast<const std::uint8_t*>(&looks), sizeof looks}).ok());
    }
    return module("asker").runs.load() >= 500;
  }));
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0) << sut.err();
  const Outcome again = replay();
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_CONTAINS(again.out, " values: equal");
}
INSTANTIATE_TEST_SUITE_P(In_threads_and_processes, Recording_of_askers, testing::Bool());

TEST_F(Recording, Is_readable_when_the_node_was_killed) {
  Program& sut = start_and_wait(threads(), {"--record", file()});
  ASSERT_TRUE(runs_reach("counter", 2500));
  sut.kill();
  sut.wait();
  const Outcome again = replay();
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_CONTAINS(again.err, "the recording was not closed");
  EXPECT_CONTAINS(again.out, " values: equal");
}

TEST_F(Recording, Of_a_node_that_runs_is_taken_by_record) {
  Program& sut = start_and_wait(threads());
  ASSERT_TRUE(runs_reach("counter", 20));
  const Outcome all = indurop({"record", "-o", file(), "--duration", "300ms"});
  EXPECT_EQ(all.code, 0) << all.err;
  EXPECT_CONTAINS(all.out + all.err, " variables, ");
  const std::string one = folder() / "one.mcap";
  EXPECT_CONTAINS(indurop({"record", "nt::wal*", "-o", one, "--past", "--duration", "100ms"}).err, " of 1 variable,");
  EXPECT_CONTAINS(indurop({"record", "-o", file()}).err, file()) << "it is there already";
  const Outcome wrong = indurop({"record", "missing", "-o", (folder() / "x.mcap").string()});
  EXPECT_EQ(wrong.code, 1);
  EXPECT_CONTAINS(wrong.err, "has no variable 'missing'");
  EXPECT_FALSE(std::filesystem::exists(folder() / "x.mcap"));
  // Begun in the middle: what walker kept inside before is not known, and that is said.
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  const Outcome again = replay();
  EXPECT_CONTAINS(again.err, "are not in the recording: its internal state may differ");
  EXPECT_EQ(again.code, 4) << again.out;
  EXPECT_CONTAINS(again.err, "module walker: nt::pace was ");
}

TEST_F(Recording, Ends_with_the_node_and_needs_its_tape) {
  Program& sut = start_and_wait(threads(), {"--duration", "500ms"});
  const Outcome to_the_end = indurop({"record", "-o", file()});
  EXPECT_EQ(to_the_end.code, 0) << to_the_end.err;
  EXPECT_EQ(sut.wait(), 0);
  Program& bare = start_and_wait(threads(), {"--tape", "0"});
  const Outcome none = indurop({"record", "-o", (folder() / "y.mcap").string()});
  EXPECT_EQ(none.code, 1);
  EXPECT_CONTAINS(none.err, "keeps no tape");
  bare.signal(SIGTERM);
  EXPECT_EQ(bare.wait(), 0);
}

std::string newest_box(const Outcome& list) {
  const auto boxes = nlohmann::json::parse(list.out)["boxes"];
  return boxes.empty() ? "" : boxes[0]["file"].get<std::string>();
}

TEST_F(Recording, Is_kept_when_a_module_faults) {
  SKIP_CRASHES_UNDER_TSAN();
  Program& sut = start_and_wait(
      {{.file = "counter.so", .name = "counter"},
       {.file = "faulty.so", .name = "faulty", .priority = 2, .properties = {{"fault", "segv"}, {"after", "100"}}}});
  ASSERT_TRUE(sut.says("the black box is in ")) << sut.err();
  EXPECT_CONTAINS(sut.err(), "fault of module faulty at tick ");
  EXPECT_TRUE(runs_reach("counter", 400)) << "it goes on";
  sut.signal(SIGTERM);
  sut.wait();
  const Outcome list = indurop({"blackbox", "-o", "json", "--node", node()});
  EXPECT_CONTAINS(list.out, "fault of module faulty at tick ");
  const Outcome again = indurop({"replay", newest_box(list), "--node", node() + "-r"});
  EXPECT_CONTAINS(again.out, " runs, ") << again.err;
}

TEST_F(Recording, Is_not_said_to_be_kept_when_it_is_not) {
  Program& sut = start_and_wait(threads());
  EXPECT_EQ(indurop({"blackbox", "keep", "mine", "--node", node()}).code, 0);
  ASSERT_TRUE(sut.says("mine: the black box is in ")) << sut.err();
  const Outcome second = indurop({"blackbox", "keep", "yours", "--node", node()});
  EXPECT_EQ(second.code, 1);
  EXPECT_CONTAINS(second.err, "it has just written a black box; the next one is possible ten seconds after that");
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
  Program& next = start_and_wait(threads());
  EXPECT_EQ(indurop({"blackbox", "keep", "ours", "--node", node()}).code, 0) << "another run begins again";
  ASSERT_TRUE(next.says("ours: the black box is in ")) << next.err();
  next.signal(SIGTERM);
  EXPECT_EQ(next.wait(), 0);
}

// A command of another user, who has another state folder, reaches the node as little as one to a node without a tape.
TEST_F(Recording, Is_not_said_to_be_kept_if_the_node_reads_no_request) {
  Program& sut = start_and_wait(threads());
  Environment elsewhere = environment();
  elsewhere.variables.push_back("INDUROP_STATE_DIR=" + (folder() / "elsewhere").string());
  const Outcome kept = Program({INDUROP_PROGRAM, "blackbox", "keep", "mine", "--node", node()}, elsewhere).finish();
  EXPECT_EQ(kept.code, 1) << kept.err;
  EXPECT_CONTAINS(kept.err, "keeps no black box: it is a simulation, has no tape (--tape 0), or does not read");
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

TEST_F(Recording, Of_a_node_that_is_killed_says_so) {
  Program& sut = start_and_wait(threads());
  Program recorder({INDUROP_PROGRAM, "record", "-o", file(), "--node", node()}, environment());
  ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(file()); }));
  sut.kill();
  sut.wait();
  EXPECT_EQ(recorder.wait(), 1);
  EXPECT_CONTAINS(recorder.err(), "node " + node() + " crashed or was killed: of it the recording ends at about tick ");
}

TEST_F(Recording, Is_kept_by_the_next_run_when_the_node_crashed) {
  Program& first = start_and_wait(threads());
  ASSERT_TRUE(runs_reach("counter", 100));
  first.kill();
  first.wait();
  Program& second = start_and_wait(threads());
  EXPECT_TRUE(second.says("crashed: the black box is in ")) << second.err();
  second.signal(SIGTERM);
  EXPECT_EQ(second.wait(), 0);
  Program& third = start_and_wait(threads());
  third.signal(SIGTERM);
  EXPECT_EQ(third.wait(), 0);
  EXPECT_FALSE(contains(third.err(), "crashed")) << "the second one ended well";
  const Outcome list = indurop({"blackbox", "-o", "json", "--node", node()});
  const Outcome again = indurop({"replay", newest_box(list), "--node", node() + "-r"});
  EXPECT_EQ(again.code, 0) << again.out << again.err;

  // The same by its verb.
  const Outcome replayed = indurop({"blackbox", "replay", "--node", node()});
  EXPECT_EQ(replayed.out, again.out) << replayed.err;
  EXPECT_EQ(replayed.code, 0);
  const Outcome shown = indurop({"blackbox", "show", "--node", node()});
  EXPECT_EQ(shown.out, indurop({"recording", "info", newest_box(list)}).out) << shown.err;
  EXPECT_CONTAINS(shown.err, "crashed");
  const auto csv = folder() / "box.csv";
  EXPECT_EQ(indurop({"blackbox", "export", "--csv", csv, "--node", node()}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(csv));
  EXPECT_EQ(indurop({"blackbox", "export", "--node", node()}).code, 2) << "what?";
  EXPECT_EQ(indurop({"blackbox", "show", "--at", "other.mcap", "--node", node()}).code, 1);
}

TEST_F(Recording, Of_other_variables_is_not_replayed) {
  ASSERT_EQ(
      run_to_end({{.file = "layout_old.so", .name = "layout"}}, {"--sim", "--until", "50ms", "--record", file()}).code,
      0);
  const std::string now = write("now.xml", xml({{.file = "layout_new.so", .name = "layout"}}));
  const Outcome refused = replay({"--config", now});
  EXPECT_EQ(refused.code, 8) << refused.err;
  EXPECT_CONTAINS(refused.err, "has another type in this configuration");
  write("run.txt", "no recording");
  EXPECT_EQ(indurop({"replay", folder() / "run.txt"}).code, 1);
}

}  // namespace
}  // namespace indurop::test
