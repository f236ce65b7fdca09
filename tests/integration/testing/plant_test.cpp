// SPDX-License-Identifier: Apache-2.0
// <indurop/testing.h> with the chapter's example.

#include <gmock/gmock.h>
#include <indurop/testing.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string>

namespace irp::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;
using namespace std::chrono_literals;

const std::string kConfiguration = std::string(EXAMPLE_DIR) + "/module.xml";

struct Joint {
  double x;
  double y;
  double z;
};

TEST(PlantUnderTest, Runs_as_many_ticks_as_the_time_has_and_stands_between_them) {
  Plant p(kConfiguration);
  EXPECT_EQ(p.tick(), 0U);
  EXPECT_EQ(p.module("cntr3").runs, 0U);
  p.run(10ms);
  EXPECT_EQ(p.tick(), 100U);
  EXPECT_EQ(p.time(), 10ms);
  EXPECT_EQ(p.module("cntr3").runs, 100U);
  EXPECT_EQ(p.module("cntr4").runs, 19U) << "a process: its last run is counted with its next release";
  EXPECT_EQ(p.get<std::uint32_t>("knu::Robot::tick"), p.get<int>("tick"));
  p.step();
  p.run(1ns);
  EXPECT_EQ(p.tick(), 102U) << "what is begun is completed";
  EXPECT_TRUE(p.run_until([&] { return p.get<int>("limits_reached") == 1; }, 5s));
  EXPECT_FALSE(p.run_until([] { return false; }, 1ms));
}

TEST(PlantUnderTest, Reads_and_writes_variables_and_their_parts) {
  Plant p(kConfiguration);
  p.set("joint[3]", Joint{1.5, -2, 1e9});
  const auto joint = p.get<Joint>("joint[3]");
  EXPECT_EQ(joint.x, 1.5);
  EXPECT_EQ(joint.y, -2);
  EXPECT_EQ(p.get<float>("joint[3].z"), 1e9F);
  p.set("joint[3].y", 7);
  p.set("limits_reached", "0x20");
  EXPECT_EQ(p.get<int>("joint[3].y"), 7);
  EXPECT_EQ(p.get<std::string>("limits_reached"), "32");
  p.force("joint[4].x", 0.25);
  p.set("joint[4].x", 9.0);
  EXPECT_EQ(p.get<double>("joint[4].x"), 0.25);
  p.unforce("joint[4].x");
  p.set("joint[4].x", 9.0);
  EXPECT_EQ(p.get<double>("joint[4].x"), 9.0);
}

TEST(PlantUnderTest, Says_what_cannot_be_done) {
  Plant p(kConfiguration);
  EXPECT_THAT([&] { (void)p.get<int>("jiont[3].x"); }, ThrowsMessage<std::runtime_error>(HasSubstr("joint")));
  EXPECT_THAT([&] { (void)p.get<int>("joint[3]"); }, ThrowsMessage<std::runtime_error>(HasSubstr("not a number")));
  EXPECT_THAT([&] { (void)p.get<Joint>("tick"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("of 4 bytes, not of 24")));
  p.set("joint[0].x", 1.5);
  EXPECT_THAT([&] { (void)p.get<int>("joint[0].x"); }, ThrowsMessage<std::runtime_error>(HasSubstr("is 1.5, which")));
  p.set("limits_reached", 300);
  EXPECT_THAT([&] { (void)p.get<std::uint8_t>("limits_reached"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("300")));
  EXPECT_THAT([&] { p.set("limits_reached", -1); }, ThrowsMessage<std::runtime_error>(StartsWith("limits_reached: ")));
  EXPECT_THAT([&] { (void)p.module("cntr9"); }, ThrowsMessage<std::runtime_error>(HasSubstr("there is cntr")));
  EXPECT_THAT([&] { p.kill("cntr1"); }, ThrowsMessage<std::runtime_error>(HasSubstr("no process")));
  EXPECT_THAT([] { Plant none("/nowhere/module.xml"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("/nowhere/module.xml")));
}

std::set<std::string> files_in(const std::filesystem::path& folder, const std::string& prefix) {
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with(prefix)) {
      found.insert(entry.path().filename());
    }
  }
  return found;
}

TEST(PlantUnderTest, Leaves_nothing_on_the_machine) {
  const std::string name = "indurop.test-" + std::to_string(::getpid());
  const char* const given = std::getenv("INDUROP_STATE_DIR");  // NOLINT(concurrency-mt-unsafe): one thread
  const std::string chosen = given == nullptr ? "" : given;
  ::unsetenv("INDUROP_STATE_DIR");  // NOLINT(concurrency-mt-unsafe): likewise
  const auto temporary = std::filesystem::temp_directory_path() / ("leaves_nothing_" + std::to_string(::getpid()));
  std::filesystem::create_directory(temporary);
  ::setenv("TMPDIR", temporary.c_str(), 1);  // NOLINT(concurrency-mt-unsafe): likewise
  {
    Plant p(kConfiguration);
    p.run(1ms);
    EXPECT_EQ(files_in(temporary, "").size(), 1U) << "the state of the node";
    EXPECT_FALSE(files_in("/dev/shm", name).empty());
    std::ofstream(temporary / "module.xml") << "<root><module><filename>./none.so</filename></module></root>";
    EXPECT_ANY_THROW(Plant(temporary / "module.xml"));
    std::filesystem::remove(temporary / "module.xml");
  }
  EXPECT_EQ(files_in(temporary, ""), std::set<std::string>{});
  EXPECT_EQ(files_in("/dev/shm", name), std::set<std::string>{});
  std::filesystem::remove(temporary);
  ::unsetenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe): likewise
  if (!chosen.empty()) {
    ::setenv("INDUROP_STATE_DIR", chosen.c_str(), 1);  // NOLINT(concurrency-mt-unsafe): likewise
  }
}

TEST(PlantUnderTest, Repeats_a_crash_of_a_process_and_its_return) {
  const auto story = [] {
    Plant p(kConfiguration);
    p.trace({"total", "seen_by_vision"});
    p.run(50ms);
    p.kill("cntr4");
    p.run(250ms);
    EXPECT_EQ(p.module("cntr4").restarts, 1U);
    EXPECT_GT(p.module("cntr4").skipped, 100U);
    const std::string file = ::testing::TempDir() + "golden-" + std::to_string(::getpid()) + ".csv";
    ::setenv("INDUROP_UPDATE_GOLDEN", "1", 1);
    EXPECT_EQ(p.differs_from_golden(file), "");
    ::unsetenv("INDUROP_UPDATE_GOLDEN");
    std::ifstream in(file);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    std::filesystem::remove(file);
    return text;
  };
  const std::string first = story();
  EXPECT_GT(std::count(first.begin(), first.end(), '\n'), 50);
  EXPECT_EQ(first, story());
}

// The same after any number of calls: a death is noticed where the test stands, a restart comes at its time.
TEST(PlantUnderTest, A_death_and_a_return_do_not_depend_on_how_the_time_is_cut) {
  const auto runs = [](std::chrono::milliseconds cut) {
    Plant p(kConfiguration);
    p.run(53ms);
    p.kill("cntr4");
    for (std::chrono::milliseconds passed{0}; passed < 300ms; passed += cut) {
      p.run(cut);
    }
    return std::pair(p.module("cntr4").runs, p.module("cntr4").restarts);
  };
  const auto whole = runs(300ms);
  EXPECT_EQ(whole.second, 1U);
  EXPECT_GT(whole.first, 200U);
  for (const auto cut : {1ms, 4ms, 10ms, 100ms}) {
    EXPECT_EQ(runs(cut), whole) << cut.count();
  }
}

TEST(PlantUnderTest, Names_the_first_difference_from_a_golden_signal) {
  const std::string file = ::testing::TempDir() + "signal-" + std::to_string(::getpid()) + ".csv";
  const auto difference = [&file](double at_tick_5) {
    Plant p(kConfiguration);
    p.trace({"limits_reached", "joint[5].z"});
    p.step(5);
    p.set("joint[5].z", at_tick_5);
    p.step(5);
    return p.differs_from_golden(file);
  };
  ::setenv("INDUROP_UPDATE_GOLDEN", "1", 1);
  EXPECT_EQ(difference(2.5), "");
  ::unsetenv("INDUROP_UPDATE_GOLDEN");
  EXPECT_EQ(difference(2.5), "");
  EXPECT_EQ(difference(3), "tick 5: joint[5].z is 3, was 2.5");
  std::filesystem::remove(file);
  EXPECT_THAT([&] { (void)difference(1); }, ThrowsMessage<std::runtime_error>(HasSubstr("INDUROP_UPDATE_GOLDEN=1")));
}

TEST(PlantOfSeveralBoards, Runs_them_together_and_names_what_is_on_which) {
  Plant p(std::string(TWO_BOARDS) + "/plant.xml", {.arguments = {"--network", "delay=2500us"}});
  EXPECT_EQ(p.get<double>("cell::torque@sensor"), 0);
  p.run(3s);
  EXPECT_EQ(p.tick(), 3000U);
  EXPECT_NEAR(p.get<double>("encoder.speed@sensor"), 2, 0.05) << "the loop is closed";
  EXPECT_GT(p.get<double>("cell::torque@sensor"), 0.03);
  EXPECT_EQ(p.get<int>("lag@sensor"), 6) << "three ticks there, three back";
  EXPECT_EQ(p.module("table").runs, 3000U);
  EXPECT_EQ(p.module("controller@control").runs, 3000U);
  p.set("cell::target@control", 1.0);
  EXPECT_TRUE(p.run_until([&] { return p.get<double>("encoder.speed@control") < 1.1; }, 5s));
}

TEST(PlantOfSeveralBoards, Says_that_a_name_is_on_several) {
  Plant p(std::string(TWO_BOARDS) + "/plant.xml");
  EXPECT_THAT([&] { (void)p.get<double>("cell::torque"); },
              ThrowsMessage<std::runtime_error>(
                  HasSubstr("several boards have cell::torque: say which is meant, as in cell::torque@control")));
  EXPECT_THAT([&] { (void)p.get<double>("cell::torque@contrl"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("there is no board contrl; there is control, sensor")));
}

TEST(PlantOfSeveralBoards, Has_a_board_again_that_returned) {
  const std::filesystem::path script = std::filesystem::temp_directory_path() / ("back" + std::to_string(::getpid()));
  std::ofstream(script) << "1s kill sensor\n1500ms return sensor\n";
  Plant p(std::string(TWO_BOARDS) + "/plant.xml", {.arguments = {"--script", script.string()}});
  p.run(1200ms);
  EXPECT_THAT([&] { p.set("cell::target@sensor", 3.0); },
              ThrowsMessage<std::runtime_error>(HasSubstr("board sensor does not run")));
  p.run(200ms);
  const auto before = p.get<double>("cell::torque@control");
  EXPECT_EQ(before, 0) << "it knows nothing of the table";
  for (int i = 0; i < 10; ++i) {
    p.run(100ms);
  }
  EXPECT_EQ(p.tick(), 2400U);
  EXPECT_NE(p.get<double>("cell::torque@control"), 0) << "it does again";
  std::filesystem::remove(script);
}

TEST(PlantOfSeveralBoards, Misses_a_board_that_was_killed) {
  const std::filesystem::path script = std::filesystem::temp_directory_path() / ("night" + std::to_string(::getpid()));
  std::ofstream(script) << "1s kill control\n";
  Plant p(std::string(TWO_BOARDS) + "/plant.xml", {.arguments = {"--script", script.string()}});
  p.run(999ms);
  EXPECT_GT(p.get<double>("cell::torque@sensor"), 0.03);
  p.run(100ms);
  EXPECT_EQ(p.get<double>("cell::torque@sensor"), 0) << "the declared fallback";
  std::filesystem::remove(script);
}

}  // namespace
}  // namespace irp::testing
