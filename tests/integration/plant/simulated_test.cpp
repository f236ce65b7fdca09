// SPDX-License-Identifier: Apache-2.0
// indurop run PLANT --sim: all boards in virtual time, the same on every run.

#include <iterator>
#include <map>

#include "history/recording/mcap_reader.h"
#include "turning_table_fixture.h"

namespace indurop::test {
namespace {

using ::testing::HasSubstr;

class SimulatedPlant : public TurningTable {
 protected:
  SimulatedPlant() : plant_(two_boards()) {}
  Program& run(std::vector<std::string> more) {
    more.insert(more.begin(), {"run", plant_, "--sim"});
    return indurop(more);
  }
  [[nodiscard]] std::string recording(const std::string& name, const std::string& what = "") const {
    std::ifstream file(folder() / ("r." + board(name) + what + ".mcap"), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::string script(const std::string& text) {
    const std::string file = path("script.txt");
    std::ofstream(file) << text;
    return file;
  }
  // All that every board saw and wrote, as two files.
  std::pair<std::string, std::string> record(std::vector<std::string> more) {
    for (const auto& file : std::filesystem::directory_iterator(folder())) {
      if (file.path().extension() == ".mcap") {
        std::filesystem::remove(file);
      }
    }
    more.insert(more.end(), {"-q", "--record", path("r.mcap")});
    Program& sut = run(std::move(more));
    EXPECT_EQ(sut.wait(), 0) << sut.err();
    return {recording("sensor"), recording("control")};
  }
  static double at_end(const std::string& name, const std::string& variable, std::uint32_t offset = 0) {
    return number<double>(name + "-sim", variable, offset);
  }
  const std::string plant_;
};

TEST_F(SimulatedPlant, Closes_its_loop_and_ends_after_its_time) {
  EXPECT_EQ(run({"-q", "--until", "20s"}).wait(), 0);
  EXPECT_NEAR(at_end("sensor", "cell::encoder", 8), 2, 0.001) << "rad/s";
  EXPECT_NEAR(at_end("sensor", "cell::torque"), 0.04, 0.001);
  EXPECT_EQ(number("sensor-sim", "cell::encoder", 16), 20'000U) << "ticks";
  EXPECT_EQ(number("sensor-sim", "cell::lag"), 2U) << "one tick there, one back";
}

TEST_F(SimulatedPlant, Is_the_same_to_the_last_bit_on_every_run) {
  const std::string events = script("300ms kill " + board("control") + "\n900ms return " + board("control") +
                                    "\n1500ms cut " + board("sensor") + "\n2s return " + board("sensor") + "\n");
  const std::vector<std::string> words = {"--until", "3s",        "--script",
                                          events,    "--network", "delay=150us,jitter=900us,loss=0.05,seed=5"};
  const auto first = record(words);
  const std::string returned = recording("control", ".2");
  EXPECT_GT(first.first.size(), 100'000U);
  EXPECT_GT(returned.size(), 50'000U) << "the board that came back has a recording of its own";
  EXPECT_TRUE(first == record(words));
  EXPECT_TRUE(returned == recording("control", ".2"));
  std::vector<std::string> other = words;
  other.back() = "delay=150us,jitter=900us,loss=0.05,seed=6";
  EXPECT_FALSE(first == record(other)) << "another seed is another chance";
}

TEST_F(SimulatedPlant, Waits_longer_for_values_when_the_network_is_slow) {
  EXPECT_EQ(run({"-q", "--until", "2s", "--network", "delay=4200us"}).wait(), 0);
  EXPECT_EQ(number("sensor-sim", "cell::lag"), 10U) << "five ticks there, five back";
}

TEST_F(SimulatedPlant, What_a_board_without_power_sent_is_too_old_soon) {
  const std::string events = script("1s kill " + board("control") + "\n");
  EXPECT_EQ(run({"-q", "--until", "1005ms", "--script", events}).wait(), 0);
  EXPECT_GT(at_end("sensor", "cell::torque"), 0.03);
  EXPECT_EQ(run({"-q", "--until", "1300ms", "--script", events}).wait(), 0);
  EXPECT_EQ(at_end("sensor", "cell::torque"), 0) << "the declared fallback";
}

// The controller asks whether its encoder is fresh, and how long.
TEST_F(SimulatedPlant, A_board_that_lost_another_is_replayed_as_it_was) {
  (void)record({"--until", "1s", "--network", "loss=0.05", "--script",
                script("200ms kill " + board("sensor") + "\n400ms return " + board("sensor") + "\n700ms cut " +
                       board("sensor") + "\n850ms return " + board("sensor") + "\n")});
  const Outcome again =
      indurop({"replay", path("r." + board("control") + ".mcap"), "--node", board("replay")}).finish();
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_THAT(again.out, HasSubstr("1000 ticks, 1000 runs, "));
}

TEST_F(SimulatedPlant, Stands_after_each_tick_and_goes_on_as_standard_input_says) {
  Program& sut = run({"--step"});
  ASSERT_TRUE(sut.prints("tick 0, "));
  sut.input("\n");
  ASSERT_TRUE(sut.prints("tick 1, 1 ms"));
  sut.input("20ms\n");
  ASSERT_TRUE(sut.prints("tick 21, 21 ms"));
  EXPECT_EQ(number("sensor-sim", "cell::encoder", 16), 21U);
  sut.input("q\n");
  EXPECT_EQ(sut.wait(), 0) << sut.err();
}

TEST_F(SimulatedPlant, Says_what_is_wrong_before_anything_runs) {
  Program& wrong = run({"--script", script("1s kil " + board("sensor") + "\n")});
  EXPECT_EQ(wrong.wait(), 4);
  EXPECT_THAT(wrong.err(), HasSubstr("script.txt:1:1: error: 'kil' cannot happen to a board; did you mean 'kill'?"));
  Program& slow = run({"--network", "delay=0"});
  EXPECT_EQ(slow.wait(), 2);
  EXPECT_THAT(slow.err(), HasSubstr("delay: 0 ns is not possible; write a time from 1 us to 10 s"));
}

TEST_F(SimulatedPlant, A_board_that_crashes_leaves_the_others_and_the_code_tells) {
  Program& sut = run({"--speed", "1"});
  ASSERT_TRUE(wait_until([&] { return number("sensor-sim", "cell::encoder", 16) > 10; })) << sut.err();
  ::kill(pid_of("control-sim"), SIGKILL);
  EXPECT_TRUE(sut.says("board " + board("control") + " has ended; the others continue"));
  sut.signal(SIGINT);
  EXPECT_EQ(sut.wait(), 130);
}

TEST_F(SimulatedPlant, Is_replayed_board_by_board_and_joined_to_one_recording) {
  (void)record({"--until", "1s", "--network", "jitter=900us,loss=0.05"});
  const std::string sensor = path("r." + board("sensor") + ".mcap");
  const std::string control = path("r." + board("control") + ".mcap");
  for (const std::string& file : {sensor, control}) {
    const Outcome again = indurop({"replay", file, "--node", board("replay")}).finish();
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_THAT(again.out, HasSubstr("1000 ticks, 1000 runs, ")) << again.err;
  }
  const std::string one = path("one.mcap");
  const Outcome joined = indurop({"recording", "join", sensor, control, "-o", one}).finish();
  EXPECT_EQ(joined.code, 0) << joined.err;
  EXPECT_THAT(joined.err, HasSubstr(" messages of " + board("sensor") + ", " + board("control")));
  auto reader = recording::McapReader::open(one);
  ASSERT_TRUE(reader.ok());
  std::map<std::string, int> messages;
  std::uint64_t last = 0;
  for (auto next = reader->next(); next && *next; next = reader->next()) {
    ++messages[reader->contents().channels.at((*next)->channel).topic];
    EXPECT_GE((*next)->log_time_ns, last);
    last = (*next)->log_time_ns;
  }
  EXPECT_GE(messages[board("sensor") + "/indurop/runs"], 1000);
  EXPECT_GE(messages[board("control") + "/indurop/runs"], 1000);
  EXPECT_GT(messages[board("control") + "/cell::encoder"], 900);
  EXPECT_GT(messages[board("sensor") + "/cell::encoder"], 999);
  const Outcome part = indurop({"replay", one, "--board", board("control"), "--node", board("replay")}).finish();
  EXPECT_EQ(part.code, 0) << part.err;
  EXPECT_THAT(part.out, HasSubstr("1000 ticks, 1000 runs, ")) << "a joined recording is replayed board by board";
  const Outcome which = indurop({"replay", one}).finish();
  EXPECT_EQ(which.code, 1);
  EXPECT_THAT(which.err, HasSubstr("choose one with --board: "));
  EXPECT_EQ(indurop({"replay", sensor, "--board", "sensor"}).wait(), 1) << "it is of one";
  const std::string cut = path("cut.mcap");
  EXPECT_EQ(indurop({"recording", "cut", one, "--to", "400ms", "-o", cut}).wait(), 0);
  const Outcome shorter = indurop({"replay", cut, "--board", board("sensor"), "--node", board("replay")}).finish();
  EXPECT_EQ(shorter.code, 0) << shorter.err;
  const Outcome twice = indurop({"recording", "join", sensor, sensor, "-o", path("two.mcap")}).finish();
  EXPECT_EQ(twice.code, 1);
  EXPECT_THAT(twice.err, HasSubstr("join one of each"));
  EXPECT_EQ(indurop({"recording", "join", sensor, "-o", one}).wait(), 1) << "it is there already";
}

}  // namespace
}  // namespace indurop::test
