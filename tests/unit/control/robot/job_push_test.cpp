// SPDX-License-Identifier: Apache-2.0
// PUSH in jobs: an axis pushes against a wall with what the job says, ends as it says, and returns; whatever happens
// meanwhile, limits are kept. The plant is orocos-kdl.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <map>

#include "control/robot/files/check_pushes.h"
#include "control/robot/job/job.h"
#include "torque_cell.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

constexpr double kStep = 0.45;  // N m, what a thousandth is at most and rounding

class Job_push : public testing::Test {
 protected:
  void start(const std::string& job, std::size_t axis = 0, double way = 1, double period = 0.004) {
    sut = std::make_unique<TorqueCell>(TorqueCell::Setup{axis, period, 2, 1, 0, job});
    values.clear();
    const auto& names = sut->cell.sut->signals();
    for (std::size_t i = 0; i < names.size(); ++i) {
      values[names[i]] = &sut->cell.values[i];
    }
    ask(Service::GroupEnable);
    ASSERT_TRUE(sut->until([&] { return sut->cell.out.state == GroupState::Standby; }));
    sut->run(0.3);
    sut->wall = {sut->q + way * 0.1, way};
    from = sut->q;
    sut->cell.in.service.job = 1;
    ask(Service::JobStart);
  }
  void ask(Service service) { sut->cell.ask(service); }
  [[nodiscard]] bool ended() const { return sut->cell.out.done == sut->cell.in.service.number; }
  [[nodiscard]] std::string message() const { return sut->cell.out.job.message; }
  [[nodiscard]] bool pushes() const { return sut->now() == AxisState::ContinuousMotion; }
  void expect_end() {
    ASSERT_TRUE(sut->until([&] { return ended(); }, 20'000)) << message();
    EXPECT_EQ(sut->cell.out.error, ErrorCode::Ok) << message();
    EXPECT_EQ(sut->broken, "");
    EXPECT_EQ(sut->commanded().mode, 8);
    EXPECT_EQ(sut->commanded().torque, 0);
  }

  std::unique_ptr<TorqueCell> sut;
  std::map<std::string, double*> values;
  double from = 0;  // rad
};

TEST_F(Job_push, Pushes_with_what_is_asked_for_and_returns) {
  for (const auto& [axis, torque] : {std::pair{0U, 40.0}, {0U, -40.0}, {1U, 60.0}, {4U, -6.0}}) {
    SCOPED_TRACE(torque);
    start(fmt::format("PUSH AXIS {} TORQUE {} Nm SPEED 20 deg/s RAMP 200 Nm/s FOR 0.5s TIMEOUT 5s\nSET OUT = FOUND\n",
                      axis + 1, torque),
          axis, torque > 0 ? 1 : -1);
    double most = 0;
    double last = 0;
    int held = 0;
    ASSERT_TRUE(sut->until([&, wanted = std::abs(torque)] {
      if (pushes()) {
        most = std::max(most, std::abs(sut->commanded_torque()));
        last = sut->against_wall();
        held += std::abs(sut->commanded_torque()) > wanted - kStep ? 1 : 0;
      }
      return *values["OUT"] > 0 || ended();
    })) << message();
    EXPECT_LE(most, std::abs(torque) + kStep);
    EXPECT_NEAR(last, torque, 0.05 * std::abs(torque));
    EXPECT_GE(held, 0.5 / 0.004 - 2);
    expect_end();
    sut->run(0.2);
    EXPECT_NEAR(sut->q, from, 1e-4);
  }
}

TEST_F(Job_push, Ends_where_its_condition_holds_and_may_stay_there) {
  start("PUSH AXIS 1 TORQUE 40 Nm SPEED 20 deg/s UNTIL I4 TIMEOUT 5s STAY\nSET OUT = X(FOUND)\nSET SEEN = X(HERE)\n");
  ASSERT_TRUE(sut->until([&] { return sut->q > from + 0.05; }));
  *values["I4"] = 1;
  const double y = sut->cell.out.position[0];
  expect_end();
  EXPECT_NEAR(*values["OUT"], y, 3);  // mm, of two periods and the delay of the drive
  EXPECT_GT(std::abs(*values["OUT"] - *values["SEEN"]), 0.1) << "it has braked since";
  EXPECT_GT(sut->q, from + 0.05);
}

TEST_F(Job_push, With_nothing_in_its_way_its_time_ends) {
  start(
      "TRY\nPUSH AXIS 1 TORQUE 40 Nm SPEED 5 deg/s TIMEOUT 1s\nRECOVER\nSET OUT = ERROR\nPUSH AXIS 1 TORQUE -40 Nm "
      "SPEED "
      "20 deg/s TIMEOUT 2s\nEND\n");
  ASSERT_TRUE(sut->until([&] { return *values["OUT"] > 0; }));
  EXPECT_THAT(message(), HasSubstr("pushed in vain for the time of its TIMEOUT"));
  EXPECT_NEAR((sut->q - from) * 180 / kPi, 5, 0.7);
  sut->wall = {from - 0.05, -1};
  expect_end();
}

TEST_F(Job_push, An_obstacle_that_gives_way_is_an_error_of_its_line) {
  start("WAIT 10 ms\nPUSH AXIS 1 TORQUE 60 Nm SPEED 3 deg/s RAMP 5000 Nm/s FOR 5s\n");
  ASSERT_TRUE(sut->until([&] { return sut->against_wall() > 55; }));
  sut->wall.way = 0;
  sut->pull = 60;
  ASSERT_TRUE(sut->until([&] { return ended(); }));
  sut->pull = 0;
  EXPECT_EQ(sut->cell.out.error, ErrorCode::Line);
  EXPECT_THAT(message(), HasSubstr("main.job:2: the axis got faster than the SPEED of its PUSH"));
  sut->run(0.5);
  EXPECT_EQ(sut->broken, "");
  EXPECT_EQ(sut->commanded().mode, 8);
}

TEST_F(Job_push, What_cannot_be_is_an_error_and_moves_nothing) {
  EXPECT_THAT([this] { start("PUSH AXIS 1 TORQUE 251 Nm SPEED 3 deg/s\n"); },
              ::testing::ThrowsMessage<std::runtime_error>(
                  HasSubstr("main.job:1:1: error: axis 1 pushes with at most 250 Nm")));
  start("PUSH AXIS 1 TORQUE 10 Nm SPEED 3 deg/s\n");
  sut->has_torque_mode = false;
  ASSERT_TRUE(sut->until([&] { return ended(); }));
  EXPECT_THAT(message(), HasSubstr("cannot push with a torque"));
  EXPECT_NEAR(sut->q, from, 1e-4);
}

TEST_F(Job_push, A_stopped_job_pushes_again_and_returns_to_where_it_began) {
  start("PUSH AXIS 1 TORQUE 40 Nm SPEED 20 deg/s FOR 0.5s\nSET OUT = 1\n");
  ASSERT_TRUE(sut->until([&] { return sut->against_wall() > 20; }));
  ask(Service::JobStop);
  ASSERT_TRUE(sut->until([&] { return sut->cell.out.state == GroupState::Standby; }));
  EXPECT_FALSE(pushes());
  ASSERT_TRUE(sut->until([&] { return sut->commanded().mode == 8; }));
  ASSERT_TRUE(sut->cell.out.job.can_resume);
  sut->run(0.3);
  ask(Service::JobResume);
  double last = 0;
  ASSERT_TRUE(sut->until([&] {
    last = pushes() ? sut->against_wall() : last;
    return *values["OUT"] > 0 || ended();
  }));
  EXPECT_NEAR(last, 40, 2);
  expect_end();
  sut->run(0.2);
  EXPECT_NEAR(sut->q, from, 1e-4);
}

// An output of the job that cannot be computed is an error of the job, although its push is not at fault.
TEST_F(Job_push, An_error_elsewhere_in_the_job_ends_it) {
  start("FOLLOW OUT = 1 / (1 - I4)\nPUSH AXIS 1 TORQUE 40 Nm SPEED 20 deg/s FOR 5s\n");
  ASSERT_TRUE(sut->until([&] { return sut->against_wall() > 20; }));
  *values["I4"] = 1;
  ASSERT_TRUE(sut->until([&] { return ended(); }));
  EXPECT_EQ(sut->cell.out.error, ErrorCode::Line);
  EXPECT_THAT(message(), HasSubstr("main.job:1:14: this has no value: it divides by 0"));
  ASSERT_TRUE(sut->until([&] { return !pushes(); }));
  sut->run(0.5);
  EXPECT_EQ(sut->broken, "");
  EXPECT_EQ(sut->commanded().mode, 8);
  EXPECT_EQ(sut->commanded().torque, 0);
}

TEST_F(Job_push, A_hold_stops_pushing) {
  start("PUSH AXIS 1 TORQUE 40 Nm SPEED 20 deg/s FOR 0.5s\nSET OUT = 1\n");
  ASSERT_TRUE(sut->until([&] { return sut->against_wall() > 20; }));
  sut->cell.in.hold = true;
  sut->run(1);
  EXPECT_LT(sut->against_wall(), 2);
  EXPECT_EQ(*values["OUT"], 0);
  sut->cell.in.hold = false;
  expect_end();
}

// Anything at any time: limits, and never more torque than the job says.
TEST_F(Job_push, Whatever_happens_keeps_the_limits) {
  std::mt19937 random(5);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const char* const runs = std::getenv("INDUROP_ROBOT_PUSHES");
  for (int each = 0; each < (runs == nullptr ? 24 : std::atoi(runs)); ++each) {
    SCOPED_TRACE(each);
    const double torque = in(5, 100) * (each % 2 == 0 ? 1 : -1);
    constexpr std::array<double, 3> kPeriods{0.001, 0.004, 0.01};
    start(fmt::format("LOOP 3\nPUSH AXIS {} TORQUE {} Nm SPEED {} deg/s FOR {}s\nEND\nSET OUT = 1\n", each % 3 + 1,
                      torque, in(2, 40), in(0, 0.3)),
          static_cast<std::size_t>(each % 3), torque > 0 ? 1 : -1, kPeriods[static_cast<std::size_t>(each / 2 % 3)]);
    sut->run(in(0.1, 2.5));
    switch (each % 5) {
      case 0:
        ask(Service::JobStop);
        break;
      case 1:
        sut->cell.in.emergency = true;
        break;
      case 2:
        ask(Service::GroupDisable);
        break;
      case 3:
        sut->cell.in.hold = true;
        break;
      default:
        sut->wall.way = 0;
    }
    sut->run(1.5);
    EXPECT_EQ(sut->broken, "");
    EXPECT_LE(sut->most_given, std::abs(torque) + 2 * kStep);
    if (each % 5 < 3) {
      EXPECT_EQ(sut->commanded().torque, 0);
      EXPECT_FALSE(pushes());
      EXPECT_LT(std::abs(sut->velocity), 1e-3);
    }
  }
}

TEST(Push_lines, Wrong_ones_are_named) {
  const auto errors = [](const std::string& text) {
    ArmShape shape;
    shape.slides[2] = true;
    return base::to_text(parse_jobs({{"a.job", text}}, shape).diagnostics);
  };
  EXPECT_EQ(errors("PUSH AXIS 1 TORQUE -20 Nm SPEED 10 deg/s RAMP 50 Nm/s FOR 0.5s TIMEOUT 5s STAY\n"
                   "PUSH AXIS 3 FORCE 80 N SPEED 20 mm/s UNTIL I4 > 2 TIMEOUT 5s\n"),
            "");
  EXPECT_THAT(errors("PUSH 3\n"), HasSubstr("a.job:1:6: error: expected AXIS and its number"));
  EXPECT_THAT(errors("PUSH AXIS 7 TORQUE 3 Nm SPEED 10 deg/s\n"), HasSubstr("the arm has axes 1 to 6"));
  EXPECT_THAT(errors("PUSH AXIS 3 TORQUE 3 Nm SPEED 10 mm/s\n"),
              HasSubstr("expected FORCE and a number of N, since axis 3 slides"));
  EXPECT_THAT(errors("PUSH AXIS 1 TORQUE 3 N SPEED 10 deg/s\n"), HasSubstr("expected Nm, found 'N'"));
  EXPECT_THAT(errors("PUSH AXIS 1 TORQUE 3 Nm\n"), HasSubstr("expected SPEED"));
  EXPECT_THAT(errors("PUSH AXIS 1 TORQUE 3 Nm SPEED 10 mm/s\n"), HasSubstr("expected deg/s, found 'mm'"));
  EXPECT_THAT(errors("PUSH AXIS 1 TORQUE 3 Nm SPEED 0 deg/s\n"), HasSubstr("at least 0.001"));
  EXPECT_THAT(errors("PUSH AXIS 1 TORQUE 3 Nm SPEED 5 deg/s RAMP 0 Nm/s\n"), HasSubstr("more than 0"));
  EXPECT_THAT(errors("PUSH AXIS 1 TORQUE 3 Nm SPEED 5 deg/s FOR 5s TIMEOUT 5s\n"),
              HasSubstr("a.job:1:43: error: the axis is to push for as long as its TIMEOUT or longer"));
}

// Of the URDF, else what the drive is rated for.
TEST(Push_lines, More_torque_than_the_axis_has_is_named) {
  const ArmModel model = arm_from_urdf("arm.urdf", heavy_cell_arm(most_torques()).urdf).value();
  const ArmModel free = arm_from_urdf("arm.urdf", heavy_cell_arm(Joints::Zero()).urdf).value();
  const ReadJobs read =
      parse_jobs({{"a.job",
                   "PUSH AXIS 2 TORQUE -249 Nm SPEED 5 deg/s\nPUSH AXIS 5 TORQUE 23 Nm SPEED 5 deg/s\n"
                   "PUSH AXIS 2 TORQUE -401 Nm SPEED 5 deg/s\n"}});
  EXPECT_EQ(base::to_text(check_pushes(read.book, model, kRatedTorque)),
            "a.job:2:1: error: axis 5 pushes with at most 22 Nm (<limit effort> of the URDF)\n"
            "a.job:3:1: error: axis 2 pushes with at most 250 Nm (<limit effort> of the URDF)\n");
  EXPECT_EQ(base::to_text(check_pushes(read.book, free, kRatedTorque)),
            "a.job:3:1: error: axis 2 pushes with at most 400 Nm (property rated_torque)\n");
  EXPECT_EQ(base::to_text(check_pushes(read.book, model, {})), "");
}

}  // namespace
}  // namespace indurop::robot
