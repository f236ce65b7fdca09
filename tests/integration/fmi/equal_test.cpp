// SPDX-License-Identifier: Apache-2.0
// An FMU has the values of <indurop/testing.h>, to the last bit, in each step.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <indurop/testing.h>

#include <bit>
#include <cmath>
#include <csignal>

#include "tests/integration/fmi/running2.h"

namespace indurop::fmi {
namespace {

using irp::testing::Plant;

const std::string kChapter = CHAPTER;
const std::string kBoards = TWO_BOARDS;

// The board on which the plant's own tests read each variable: the one that writes it.
std::string at_board(const std::string& name) {
  const bool control = name == "cell::torque" || name == "cell::echo";
  return name + (control ? "@control" : "@sensor");
}

::testing::AssertionResult equal(Running2& fmu, const Fmu& about, const Plant& plant, bool boards) {
  for (const Described& one : about.variables()) {
    const auto expected = plant.get<double>(boards ? at_board(one.name) : one.name);
    const double found = fmu.get(one.name);
    if (std::bit_cast<std::uint64_t>(found) != std::bit_cast<std::uint64_t>(expected)) {
      return ::testing::AssertionFailure() << one.name << " is " << found << ", in the simulation " << expected;
    }
  }
  return ::testing::AssertionSuccess();
}

TEST(FmuEqual, A_plant_has_the_values_of_its_simulation_in_each_step) {
  const Fmu about(kBoards, "plant.xml", 2);
  Running2 fmu(about);
  ASSERT_NO_FATAL_FAILURE(fmu.initialize());
  Plant plant(kBoards + "/plant.xml");
  EXPECT_TRUE(equal(fmu, about, plant, true)) << "before the first tick";
  for (int tick = 0; tick < 300; ++tick) {
    if (tick == 100 || tick == 200) {
      const double target = tick == 100 ? 5.25 : -0.1;
      EXPECT_EQ(fmu.set_real("cell::target", target), fmi2OK) << fmu.log;
      plant.set("cell::target@sensor", target);
      plant.set("cell::target@control", target);
    }
    ASSERT_EQ(fmu.step(tick * 1e-3, 1e-3), fmi2OK) << fmu.log;
    plant.step();
    ASSERT_TRUE(equal(fmu, about, plant, true)) << "after tick " << tick;
  }
  EXPECT_GT(std::abs(fmu.get("cell::encoder.angle")), 0) << "something has moved";
}

TEST(FmuEqual, Steps_that_are_no_multiple_of_the_basic_period_run_the_ticks_in_them) {
  const Fmu about(kChapter, "module.xml", 2);
  Running2 fmu(about);
  ASSERT_NO_FATAL_FAILURE(fmu.initialize(17.5));
  Plant plant(kChapter + "/module.xml");
  double time = 17.5;
  for (std::uint64_t step = 1; step <= 60; ++step) {
    const double size = step % 5 == 0 ? 20e-6 : 370e-6;
    ASSERT_EQ(fmu.step(time, size), fmi2OK) << fmu.log;
    time += size;
    const std::uint64_t microseconds = step / 5 * (20 + 4 * 370) + step % 5 * 370;
    plant.step((microseconds + 99) / 100 - plant.tick());
    ASSERT_TRUE(equal(fmu, about, plant, false)) << "after step " << step << ", tick " << plant.tick();
  }
  double last = 0;
  EXPECT_EQ(fmu.master.get_real_status(fmu.instance, fmi2LastSuccessfulTime, &last), fmi2OK);
  EXPECT_EQ(last, time);
}

TEST(FmuEqual, Two_FMUs_and_two_instances_of_one_in_one_process_do_not_disturb_each_other) {
  const auto before = std::signal(SIGPIPE, SIG_DFL);
  const Fmu boards(kBoards, "plant.xml", 2);
  const Fmu chapter(kChapter, "module.xml", 2);
  Running2 first(boards);
  Running2 second(boards);
  Running2 third(chapter);
  ASSERT_NO_FATAL_FAILURE(first.initialize());
  ASSERT_NO_FATAL_FAILURE(second.initialize());
  ASSERT_NO_FATAL_FAILURE(third.initialize());
  Plant one(kBoards + "/plant.xml");
  EXPECT_EQ(second.set_real("cell::target", -3), fmi2OK);
  for (int tick = 0; tick < 50; ++tick) {
    ASSERT_EQ(first.step(tick * 1e-3, 1e-3), fmi2OK);
    ASSERT_EQ(third.step(tick * 1e-3, 1e-3), fmi2OK);
    if (tick % 2 == 0) {
      ASSERT_EQ(second.step(tick * 1e-3, 2e-3), fmi2OK);
    }
    one.step();
    ASSERT_TRUE(equal(first, boards, one, true)) << "after tick " << tick;
  }
  EXPECT_NE(first.get("cell::torque"), second.get("cell::torque"));
  EXPECT_EQ(first.get("cell::encoder.count"), second.get("cell::encoder.count"));
  EXPECT_EQ(std::signal(SIGPIPE, before), SIG_DFL) << "a master's signals are its own";
}

TEST(FmuEqual, After_a_reset_it_runs_again_in_the_same_way) {
  const Fmu about(kBoards, "plant.xml", 2);
  Running2 fmu(about);
  std::vector<double> values;
  for (int run = 0; run < 2; ++run) {
    ASSERT_NO_FATAL_FAILURE(fmu.initialize());
    for (int tick = 0; tick < 40; ++tick) {
      ASSERT_EQ(fmu.step(tick * 1e-3, 1e-3), fmi2OK) << fmu.log;
      const double angle = fmu.get("cell::encoder.angle");
      if (run == 0) {
        values.push_back(angle);
      } else {
        ASSERT_EQ(angle, values[static_cast<std::size_t>(tick)]) << tick;
      }
    }
    ASSERT_EQ(fmu.master.terminate(fmu.instance), fmi2OK);
    EXPECT_EQ(fmu.get("cell::encoder.angle"), values.back()) << "values can be read after the end";
    EXPECT_EQ(fmu.step(0.04, 1e-3), fmi2Error);
    EXPECT_THAT(fmu.log, ::testing::HasSubstr("fmi2DoStep: no step is possible while the instance is terminated"));
    ASSERT_EQ(fmu.master.reset(fmu.instance), fmi2OK) << fmu.log;
  }
}

}  // namespace
}  // namespace indurop::fmi
