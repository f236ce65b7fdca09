// SPDX-License-Identifier: Apache-2.0
// What a controller keeps, put into another one of the same files at random instants: the two together do what one does
// that is never exchanged, to the last bit. INDUROP_ROBOT_JOBS says how many jobs, INDUROP_ROBOT_SEED from which one
// on.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <random>
#include <string>
#include <tuple>
#include <utility>

#include "command_cell.h"
#include "random_job.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

bool same(const DriveOut& a, const DriveOut& b) {
  return std::tie(a.control, a.mode, a.position, a.probe, a.torque_offset, a.torque) ==
         std::tie(b.control, b.mode, b.position, b.probe, b.torque_offset, b.torque);
}
bool same(const AxisReport& a, const AxisReport& b) {
  const auto all = [](const AxisReport& r) {
    return std::tuple(r.state, r.acknowledged, r.done, r.aborted, r.error, r.power, r.homed, r.in_velocity, r.position,
                      r.velocity, r.command, r.acceleration, r.measured_velocity, r.probe, r.phase, r.torque, r.push,
                      r.own_lower, r.own_velocity);
  };
  return all(a) == all(b);
}
bool same(const CommandAnswer& a, const CommandAnswer& b) {
  return std::tie(a.number, a.state, a.reached, a.error) == std::tie(b.number, b.state, b.reached, b.error);
}
template <class Row>
bool same_rows(const Row& a, const Row& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) { return same(x, y); });
}

// The first part that differs; empty: none does.
std::string difference(const Outputs& a, const Outputs& b) {
  const auto group = [](const Outputs& o) {
    return std::tuple(o.state, o.motion_done, o.busy, o.edit_done, o.moving_by_job, o.acknowledged, o.done, o.error,
                      o.error_axis, o.mode, o.may_move, o.tool);
  };
  const auto job = [](const JobReport& j) {
    return std::tuple(j.state, j.job, j.line, j.cycles, j.can_resume, std::string(j.name), std::string(j.message),
                      std::string(j.called));
  };
  const auto question = [](const JobReport& j) {
    const QuestionReport& q = j.question;
    return std::tuple(q.number, std::string(q.text), q.count, std::string(q.choices[0]), q.lower, q.upper, q.step,
                      q.left, q.acknowledged, q.error, std::string(q.reason));
  };
  const auto tool = [](const Outputs& o) {
    return std::tuple(o.position, o.velocity, o.turning, o.tool_speed, o.path_speed, o.to_go);
  };
  const auto joints = [](const Outputs& o) {
    return std::array<AxisNumbers, 4>{o.joints, o.command, o.speed, o.acceleration};
  };
  const std::pair<const char*, bool> parts[] = {
      {"drives", same_rows(a.drives, b.drives)}, {"group", group(a) == group(b)},
      {"job", job(a.job) == job(b.job)},         {"question", question(a.job) == question(b.job)},
      {"axes", same_rows(a.axes, b.axes)},       {"commands", same_rows(a.commands, b.commands)},
      {"joints", joints(a) == joints(b)},        {"tool", tool(a) == tool(b)}};
  const auto* const part =
      std::find_if(std::begin(parts), std::end(parts), [](const auto& one) { return !one.second; });
  return part == std::end(parts) ? "" : part->first;
}

void disturb(Cell& cell, int axes, std::mt19937& random) {
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto one_of = [&](std::size_t many) { return std::uniform_int_distribution<std::size_t>(0, many - 1)(random); };
  const std::size_t axis = one_of(static_cast<std::size_t>(axes));
  switch (one_of(18)) {
    case 0:
      cell.in.hold = !cell.in.hold;
      break;
    case 1:
    case 2:
      cell.in.speed_override = in(0, 100);
      break;
    case 3:
      cell.ask(Service::Stop);
      break;
    case 4:
      cell.in.emergency = !cell.in.emergency;
      break;
    case 5:
      cell.in.drives[axis].status = Cell::kFault;
      break;
    case 6:
      cell.ask(Service::GroupReset);
      break;
    case 7:
      cell.ask(Service::JobResume);
      break;
    case 8:
      cell.ask_axis(axis, AxisService::MoveAbsolute, in(-60, 60), in(1, 200));
      break;
    case 9:
      cell.ask(Service::JobStart);
      break;
    case 10:
    case 11:
      cell.in.answer = {cell.out.job.question.acknowledged + 1, cell.out.job.question.number, in(1, 3)};
      cell.in.answer.value = std::round(cell.in.answer.value);
      break;
    default:
      cell.in.hold = false;
      cell.in.emergency = false;
  }
}

class Kept : public testing::Test {
 protected:
  std::size_t most = 0;
  int exchanges = 0;

  void run(unsigned seed, double period_ms, const std::string& urdf) {
    std::mt19937 random(seed);
    const Arm arm = arm_from_urdf("arm.urdf", urdf).value().arm;
    std::string job = random_job(arm, random).text;
    job +=
        "ASK n = \"where to\" CHOICE \"left\", \"right\" TIMEOUT 0.5s ELSE\nn = 0\nEND\nSET a = n\n"
        "LOOP 2\nMOVJ Q0\nASK n = \"how far, \", n 1 TO 40 TIMEOUT 0.3s ELSE\nn = 5\nEND\nMOVL Q1\nEND\n";
    Cell one(job, period_ms, 0, true, {}, urdf);
    Cell sut(job, period_ms, 0, true, {}, urdf);
    ASSERT_TRUE(one.serve(Service::GroupEnable));
    ASSERT_TRUE(sut.serve(Service::GroupEnable));
    for (Cell* cell : {&one, &sut}) {
      cell->in.service.job = 1;
      cell->ask(Service::JobStart);
    }
    const bool disturbed = seed % 3 != 0;
    for (int i = 0; i < 12000 / period_ms; ++i) {
      if (disturbed && std::uniform_real_distribution<double>(0, 1)(random) < 3 * period_ms / 1000) {
        std::mt19937 both = random;
        disturb(one, arm.count(), both);
        disturb(sut, arm.count(), random);
      }
      if (std::uniform_int_distribution<int>(0, 20)(random) == 0) {
        ASSERT_TRUE(sut.exchange());
        ++exchanges;
      }
      one.step();
      sut.step();
      ASSERT_EQ(difference(one.out, sut.out), "")
          << "seed " << seed << ", period " << i << " of " << period_ms << " ms\n"
          << job;
    }
    most = std::max(most, sut.most_kept);
  }
};

TEST_F(Kept, Controllers_that_take_turns_do_what_one_does) {
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  const int jobs = number_of("INDUROP_ROBOT_JOBS", 40);
  for (int i = 0; i < jobs && !HasFatalFailure(); ++i) {
    const auto seed = static_cast<unsigned>(first + i);
    run(seed, seed % 3 == 0 ? 1 : seed % 3 == 1 ? 4 : 10, seed % 2 == 0 ? cell_urdf() : solid_cell_urdf());
  }
  fmt::print("{} exchanges, {} bytes at most\n", exchanges, most);
}

TEST_F(Kept, Of_other_files_nothing_is_put_back) {
  Cell one("MOVJ P1\n");
  Cell other("", 10, 0, true, {}, urdf_of("ur5"));
  std::vector<std::byte> bytes(Controller::kMostKept);
  const std::size_t size = one.sut->save(bytes.data(), bytes.size());
  ASSERT_GT(size, 0U);
  EXPECT_TRUE(one.sut->restore(bytes.data(), size));
  EXPECT_FALSE(one.sut->restore(bytes.data(), size - 16));
  EXPECT_EQ(one.sut->save(bytes.data(), 64), 0U);
  EXPECT_FALSE(other.sut->restore(bytes.data(), size));
}

}  // namespace
}  // namespace indurop::robot
