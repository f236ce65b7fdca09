// SPDX-License-Identifier: Apache-2.0
// A tool that presses for a program (RobotPress): its set points are those of a job's PRESS, what is rejected and what
// ends it, within the limits.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "press_command_cell.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;
using Given = CommandCell::Given;

class Press_command : public PressCommandCell {};

// A job and a program in two cells, against the same springs: the same set points, to the last bit.
TEST_F(Press_command, Has_the_set_points_of_a_job) {
  Springs springs;
  springs.add(20, {0.3, 0, -1}, 1);
  springs.add(15, {-1, 0, -0.2}, 1.5);
  for (const double ms : {1.0, 4.0, 10.0}) {
    SCOPED_TRACE(ms);
    sensor = nullptr;
    const std::string job =
        "PRESS -18, FZ ALONG Z, -8, FX ALONG X MOST 60 N STIFFNESS 25, 20 N/mm LIMIT 10 mm RATE 10 mm/s\nWAIT 2.5s\n";
    std::vector<AxisNumbers> of_job;
    std::vector<AxisNumbers> of_command;
    for (std::vector<AxisNumbers>* seen : {&of_job, &of_command}) {
      start(ms, job);
      if (seen == &of_job) {
        std::map<std::string, double*> values;
        for (std::size_t i = 0; i < cell().sut->signals().size(); ++i) {
          values[cell().sut->signals()[i]] = &cell().values[i];
        }
        sensor = [this, springs, values] {
          const Vec3 f = springs.force(shift());
          *values.at("FX") = f[0];
          *values.at("FZ") = f[2];
          return f;
        };
        cell().in.service.job = 1;
        cell().ask(Service::JobStart);
      } else {
        sensor = [this, springs] { return springs.force(shift()); };
        press({-8, 0, -18}, {20, 0, 25});
      }
      const AxisNumbers begin = cell().out.command;
      for (double t = 0; t < 2; t += period) {
        step();
        if (cell().out.command != begin || !seen->empty()) {
          seen->push_back(cell().out.command);
        }
      }
    }
    const std::size_t both = std::min(of_job.size(), of_command.size());
    ASSERT_GT(both, static_cast<std::size_t>(1.9 / period));
    of_job.resize(both);
    of_command.resize(both);
    EXPECT_TRUE(of_job == of_command);
    EXPECT_NEAR(force[2], -18, 1);
  }
}

TEST_F(Press_command, Presses_at_standstill_and_along_a_line_until_it_is_released) {
  start();
  floor(40, 3);
  const Given sut_press = press({0, 0, -20}, {0, 0, 40});
  ASSERT_TRUE(until([&] { return sut->reached(sut_press); }));
  EXPECT_LE(std::abs(force[2] + 20), 2);
  EXPECT_EQ(cell().out.state, GroupState::Moving);
  for (int i = 0; i < 500; ++i) {
    step();
  }
  EXPECT_NEAR(force[2], -20, 0.05);
  const Given along = line(700, 0, 1300, 100);
  double worst = 0;
  ASSERT_TRUE(until([&] {
    worst = std::max(worst, std::abs(force[2] + 20));
    return sut->ended(along);
  }));
  EXPECT_EQ(sut->state(along), CommandState::Done);
  EXPECT_LT(worst, 0.5);
  EXPECT_NEAR(shift()[0], 500, 1e-6);
  EXPECT_NEAR(shift()[1], 0, 1e-6);
  // Relative to where the path is, and not to the tool.
  const Given side =
      sut->give(Service::LinearRelative, {0, 100, 0, 0, 0, 0}, 100, BufferMode::Buffered, CoordSystem::Machine);
  ASSERT_TRUE(done(side));
  EXPECT_NEAR(shift()[2], -3.5, 0.01);
  release();
  ASSERT_TRUE(done(sut_press));
  EXPECT_EQ(cell().out.state, GroupState::Standby);
  const Vec3 there = shift();
  ASSERT_TRUE(done(line(700, 100, 1350, 100)));
  EXPECT_NEAR(there[2], -3.5, 0.01);
  EXPECT_NEAR(shift()[2], 50, 1e-6);
}

TEST_F(Press_command, Rejects_what_is_out_of_range) {
  start();
  const auto code_of = [&](const std::function<void(Command&)>& change) {
    const Given given = press({0, 0, -20}, {0, 0, 40});
    change(sut->command(given));
    EXPECT_TRUE(until([&] { return sut->ended(given); }, 10));
    EXPECT_EQ(cell().out.state, GroupState::Standby);
    return sut->error(given);
  };
  const std::vector<std::function<void(Command&)>> wrong{[](Command& c) { c.aux[2] = 0; },
                                                         [](Command& c) { c.aux[2] = -1; },
                                                         [](Command& c) { c.aux[2] = 2e5; },
                                                         [](Command& c) { c.aux[0] = std::nan(""); },
                                                         [](Command& c) { c.aux[3] = 0; },
                                                         [](Command& c) { c.aux[3] = 2e5; },
                                                         [](Command& c) { c.aux[4] = 0; },
                                                         [](Command& c) { c.aux[4] = HUGE_VAL; },
                                                         [](Command& c) { c.aux[5] = -1; },
                                                         [](Command& c) { c.velocity = 0; },
                                                         [](Command& c) { c.velocity = 1001; },
                                                         [](Command& c) { c.option = 2; },
                                                         [](Command& c) { c.option = -1; },
                                                         [](Command& c) { c.coords = CoordSystem::Axes; },
                                                         [](Command& c) { c.buffer = BufferMode::Buffered; }};
  for (std::size_t i = 0; i < wrong.size(); ++i) {
    EXPECT_EQ(code_of(wrong[i]), ErrorCode::Value) << i;
  }
}

TEST_F(Press_command, Rejects_meanwhile_what_would_leave_its_path) {
  start(4, "WAIT 1s\n");
  floor(40, 1);
  const Given first = press({0, 0, -20}, {0, 0, 40});
  ASSERT_TRUE(until([&] { return sut->reached(first); }));
  for (const Service motion : {Service::DirectAbsolute, Service::DirectRelative, Service::FreeAbsolute,
                               Service::GroupHome, Service::JobStart, Service::SelectTool, Service::Press}) {
    const Given given = sut->give(motion, {0, 0, 0, 0, 0, 0}, motion == Service::Press ? 10 : 0, BufferMode::Aborting,
                                  CoordSystem::Machine);
    Command& c = sut->command(given);
    c.job = 1;
    if (motion == Service::Press) {
      c.aux = {0, 0, 40, 60, 10, 0, 0, 0};
    }
    ASSERT_TRUE(until([&] { return sut->ended(given); }, 10)) << static_cast<int>(motion);
    EXPECT_EQ(sut->error(given), ErrorCode::State) << static_cast<int>(motion);
  }
  cell().ask(Service::JobStart);
  ASSERT_TRUE(until([&] { return cell().out.done == cell().in.service.number; }, 10));
  EXPECT_EQ(cell().out.error, ErrorCode::State);
  EXPECT_EQ(sut->state(first), CommandState::Active);
  EXPECT_NEAR(force[2], -20, 2);
  release();
  step();
  const Given too_late = line(300, 0, 1300, 100);
  ASSERT_TRUE(until([&] { return sut->ended(too_late); }, 3));
  EXPECT_EQ(sut->error(too_late), ErrorCode::State) << "it comes to rest";
  ASSERT_TRUE(done(first));
  // Nor can it begin while something moves.
  const Given moves = line(400, 0, 1300, 100);
  ASSERT_TRUE(until([&] { return sut->state(moves) == CommandState::Active; }));
  const Given late = press({0, 0, -20}, {0, 0, 40});
  ASSERT_TRUE(until([&] { return sut->ended(late); }, 10));
  EXPECT_EQ(sut->error(late), ErrorCode::State);
  ASSERT_TRUE(done(moves));
}

TEST_F(Press_command, Fails_for_too_much_force_and_for_a_sensor_or_a_program_that_is_silent) {
  const auto fails = [&](const char* why) {
    const Given path = line(900, 0, 1300, 50);
    ASSERT_TRUE(until([&] { return cell().out.state == GroupState::ErrorStop; }));
    EXPECT_EQ(sut->error(*pressing), ErrorCode::Force) << why;
    EXPECT_EQ(sut->error(path), ErrorCode::Force) << why;
    EXPECT_EQ(cell().out.error, ErrorCode::Force);
    EXPECT_THAT(cell().out.job.message, HasSubstr(why));
    step();
    EXPECT_EQ(cell().out.tool_speed, 0);
    const Vec3 rests = shift();
    for (int i = 0; i < 100; ++i) {
      step();
    }
    EXPECT_EQ(shift(), rests);
  };
  start();
  press({0, 0, -20}, {0, 0, 40});
  sensor = [&] { return Vec3(0, 0, shift()[0] > 100 ? 61 : -20); };
  fails("more than the MaxForce");
  EXPECT_LT(shift()[0], 120);
  start();
  press({0, 0, -20}, {0, 0, 40});
  sensor = [&] { return Vec3(0, 0, shift()[0] > 100 ? std::nan("") : -20); };
  fails("more than the MaxForce");
  start();
  press({0, 0, -20}, {0, 0, 40});
  sensor = [&] {
    wanted[2] = shift()[0] > 100 ? HUGE_VAL : -20;
    return Vec3(0, 0, -20);
  };
  fails("is no number");
  start();
  press({0, 0, -20}, {0, 0, 40}, 60, 10, 10, 0.05);
  sensor = [&] {
    count += shift()[0] < 100 ? 1 : 0;
    return Vec3(0, 0, -20);
  };
  fails("no new measurement");
  start();
  press({0, 0, -20}, {0, 0, 40});
  sensor = [&] {
    talks = shift()[0] < 100;
    return Vec3(0, 0, -20);
  };
  fails("no new measurement");
}

TEST_F(Press_command, A_hold_an_interrupt_and_an_override_of_zero_let_it_rest) {
  for (int kind = 0; kind < 3; ++kind) {
    SCOPED_TRACE(kind);
    start();
    floor(40, 3);
    const Given given = press({0, 0, -20}, {0, 0, 40});
    ASSERT_TRUE(until([&] { return shift()[2] < -1; }));
    cell().in.hold = kind == 0;
    cell().in.factors.group = kind == 1 ? 0 : 1;
    if (kind == 2) {
      sut->give(Service::Interrupt);
    }
    for (int i = 0; i < 100; ++i) {
      step();
    }
    const Vec3 held = shift();
    for (int i = 0; i < 200; ++i) {
      step();
      EXPECT_LT((shift() - held).norm(), 1e-9);
    }
    cell().in.hold = false;
    cell().in.factors.group = 1;
    if (kind == 2) {
      sut->give(Service::Continue);
    }
    ASSERT_TRUE(until([&] { return std::abs(force[2] + 20) < 0.1; }));
    EXPECT_EQ(sut->state(given), CommandState::Active);
  }
}

// 0: MC_GroupHalt, 1: MC_GroupStop, 2: SVC_MV_STOP, 3: disabled, 4: emergency stop, 5: a drive, 6: the block is gone.
TEST_F(Press_command, Whatever_ends_it_keeps_the_limits_and_the_next_one_begins) {
  for (int kind = 0; kind < 7; ++kind) {
    for (const bool moves : {false, true}) {
      SCOPED_TRACE(fmt::format("{} {}", kind, moves));
      start();
      floor(40, 2);
      const Given given = press({0, 0, -20}, {0, 0, 40});
      ASSERT_TRUE(until([&] { return shift()[2] < -1.5; }));
      const Given path = moves ? line(900, 0, 1300, 200) : given;
      ASSERT_TRUE(until([&] { return !moves || shift()[0] > 50; }));
      std::optional<Given> ends;
      if (kind < 2) {
        ends = sut->give(kind == 0 ? Service::Halt : Service::Stop);
      } else if (kind == 2) {
        cell().ask(Service::Stop);
      } else if (kind == 3) {
        cell().ask(Service::GroupDisable);
      } else if (kind == 4) {
        cell().in.emergency = true;
      } else if (kind == 5) {
        cell().in.drives[0].status = Cell::kFault;
      } else {
        sut->command(given).number = 0;
        pressing.reset();
      }
      const double hardness = kind >= 4 ? kEmergency : 1;
      ASSERT_TRUE(until(
          [&] {
            return cell().out.state != GroupState::Moving &&
                   (cell().out.state != GroupState::Stopping || (ends && sut->ended(*ends)));
          },
          8000, hardness));
      for (int i = 0; i < 10; ++i) {  // drives without power report their positions in counts
        step(hardness);
      }
      EXPECT_EQ(cell().out.tool_speed, 0);
      if (ends) {
        EXPECT_EQ(sut->state(*ends), CommandState::Done);
      }
      if (kind < 6) {
        EXPECT_EQ(sut->state(given), kind < 4 ? CommandState::Aborted : CommandState::Error);
        EXPECT_EQ(sut->error(given), kind < 4 ? ErrorCode::Ok : kind == 4 ? ErrorCode::Emergency : ErrorCode::Drive);
      }
      if (moves && kind < 4) {
        EXPECT_EQ(sut->state(path), CommandState::Aborted);
      }
      EXPECT_GE(shift()[2], -10);
      if (kind == 2) {
        EXPECT_FALSE(cell().serve(Service::JobResume));
        EXPECT_EQ(cell().out.error, ErrorCode::NoResume);
        EXPECT_THAT(cell().out.job.message, testing::HasSubstr("a RobotPress that was stopped cannot be resumed"));
      }
    }
  }
}

}  // namespace
}  // namespace indurop::robot
