// SPDX-License-Identifier: Apache-2.0
// Motions by tables of times, against curves that are found another way: splines by their moments, speeds and places by
// summing up. Random tables are given to an axis: what is taken keeps all limits, by differences of set points.

#include "control/robot/path/time_profile.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "command_cell.h"

namespace indurop::robot {
namespace {

using Of = TimeProfile::Of;

class Tables : public testing::Test {
 protected:
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  int one_of(int many) { return std::uniform_int_distribution<int>(0, many - 1)(random); }
  ProfileTable any(double most, int points) {
    ProfileTable table;
    table.points = static_cast<std::int16_t>(points);
    double time = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(points); ++i) {
      time += in(0.1, 1);
      table.time[i] = time;
      table.value[i] = in(-most, most);
    }
    return table;
  }
  static std::size_t last(const ProfileTable& table) { return static_cast<std::size_t>(table.points) - 1; }

  std::mt19937 random{8};
};

// Slopes of the spline by its second derivatives, all equations at once.
std::vector<double> slopes_by_moments(const std::vector<double>& x, const std::vector<double>& y, double first) {
  const std::size_t n = x.size();
  std::vector<std::vector<double>> m(n, std::vector<double>(n + 1));
  const auto h = [&](std::size_t i) { return x[i + 1] - x[i]; };
  const auto d = [&](std::size_t i) { return (y[i + 1] - y[i]) / h(i); };
  m[0][0] = 2 * h(0);
  m[0][1] = h(0);
  m[0][n] = 6 * (d(0) - first);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    m[i][i - 1] = h(i - 1);
    m[i][i] = 2 * (h(i - 1) + h(i));
    m[i][i + 1] = h(i);
    m[i][n] = 6 * (d(i) - d(i - 1));
  }
  m[n - 1][n - 2] = h(n - 2);
  m[n - 1][n - 1] = 2 * h(n - 2);
  m[n - 1][n] = -6 * d(n - 2);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      const double part = k == i ? 0 : m[k][i] / m[i][i];
      for (std::size_t j = 0; j <= n; ++j) {
        m[k][j] -= part * m[i][j];
      }
    }
  }
  std::vector<double> slopes(n);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    slopes[i] = d(i) - h(i) * (2 * m[i][n] / m[i][i] + m[i + 1][n] / m[i + 1][i + 1]) / 6;
  }
  return slopes;
}

TEST_F(Tables, Positions_are_on_the_spline_and_nothing_jumps) {
  for (int round = 0; round < 60; ++round) {
    const ProfileTable table = any(50, 1 + one_of(64));
    const LineState start{in(-10, 10), in(-5, 5), in(-5, 5)};
    TimeProfile sut;
    ASSERT_EQ(sut.set(table, Of::Position, {}, start), ErrorCode::Ok);
    std::vector<double> x{0};
    std::vector<double> y{start.position};
    for (std::size_t i = 0; i <= last(table); ++i) {
      x.push_back(table.time[i]);
      y.push_back(table.value[i]);
    }
    const std::vector<double> slopes = slopes_by_moments(x, y, start.velocity);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const LineState there = sut.at(x[i]);
      const LineState before = sut.at(x[i] - 1e-9);
      EXPECT_NEAR(there.position, y[i], 1e-6);
      EXPECT_NEAR(there.velocity, slopes[i], 1e-5) << i;
      EXPECT_NEAR(before.velocity, slopes[i], 1e-4);
      EXPECT_NEAR(before.acceleration, there.acceleration, 1e-2);
    }
    EXPECT_NEAR(sut.at(0).acceleration, start.acceleration, 1e-9);
    EXPECT_NEAR(sut.at(sut.duration()).acceleration, 0, 1e-4);
    EXPECT_NEAR(sut.at(sut.duration() + 5).position, table.value[last(table)], 1e-3);
  }
}

TEST_F(Tables, Velocities_are_met_and_stay_between_their_neighbours) {
  for (int round = 0; round < 60; ++round) {
    const ProfileTable table = any(50, 1 + one_of(64));
    TimeProfile sut;
    ASSERT_EQ(sut.set(table, Of::Velocity, {}, {3, 0, 0}), ErrorCode::Ok);
    double time = 0;
    double speed = 0;
    double place = 3;
    for (std::size_t i = 0; i <= last(table); ++i) {
      const auto [low, high] = std::minmax(speed, table.value[i]);
      const double step = (table.time[i] - time) / 64;
      for (int k = 0; k < 64; ++k) {
        const double t = time + k * step;
        EXPECT_GE(sut.at(t).velocity, low - 1e-9);
        EXPECT_LE(sut.at(t).velocity, high + 1e-9);
        // Simpson's rule
        place += step / 6 * (sut.at(t).velocity + 4 * sut.at(t + step / 2).velocity + sut.at(t + step).velocity);
      }
      time = table.time[i];
      speed = table.value[i];
      EXPECT_NEAR(sut.at(time).velocity, speed, 1e-6);
      EXPECT_NEAR(sut.at(time).position, place, 1e-6);
      EXPECT_NEAR(sut.at(time - 1e-9).acceleration, sut.at(time).acceleration, 1e-3);
    }
    EXPECT_NEAR(sut.at(time).acceleration, 0, 1e-6);
  }
}

TEST_F(Tables, Accelerations_are_straight_between_points) {
  for (int round = 0; round < 20; ++round) {
    const ProfileTable table = any(50, 1 + one_of(20));
    const LineState start{1, -2, in(-5, 5)};
    TimeProfile sut;
    ASSERT_EQ(sut.set(table, Of::Acceleration, {}, start), ErrorCode::Ok);
    double speed = start.velocity;
    double place = start.position;
    double from = 0;
    double before = start.acceleration;
    for (std::size_t i = 0; i <= last(table); ++i) {
      const double step = (table.time[i] - from) / 1000;
      for (int k = 0; k < 1000; ++k) {  // the middle of each step
        const double part = (k + 0.5) / 1000;
        const double hard = before + part * (table.value[i] - before);
        place += step * (speed + step / 2 * hard);
        speed += step * hard;
      }
      from = table.time[i];
      before = table.value[i];
      EXPECT_NEAR(sut.at(from).acceleration, before, 1e-6);
      EXPECT_NEAR(sut.at(from).velocity, speed, 1e-6);
      EXPECT_NEAR(sut.at(from).position, place, 1e-4);
    }
  }
}

TEST_F(Tables, Ranges_are_those_that_one_sees_on_the_way) {
  for (int round = 0; round < 60; ++round) {
    const Of of = round % 3 == 0 ? Of::Position : round % 3 == 1 ? Of::Velocity : Of::Acceleration;
    const ProfileTable table = any(50, 1 + one_of(6));
    TimeProfile sut;
    ASSERT_EQ(sut.set(table, of, {}, {in(-5, 5), in(-5, 5), in(-5, 5)}), ErrorCode::Ok);
    constexpr double kNone = HUGE_VAL;
    std::array<double, 6> seen{kNone, -kNone, kNone, -kNone, kNone, -kNone};
    constexpr int kLooks = 4000;
    for (int i = 0; i <= kLooks; ++i) {
      const LineState at = sut.at(sut.duration() * i / kLooks);
      const std::array<double, 3> now{at.position, at.velocity, at.acceleration};
      for (std::size_t k = 0; k < 3; ++k) {
        seen[2 * k] = std::min(seen[2 * k], now[k]);
        seen[2 * k + 1] = std::max(seen[2 * k + 1], now[k]);
      }
    }
    const auto all = sut.ranges();
    const std::array<double, 6> said{all.position.least,    all.position.greatest,  all.velocity.least,
                                     all.velocity.greatest, all.acceleration.least, all.acceleration.greatest};
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_NEAR(said[k], seen[k], 1e-2 * (1 + std::abs(seen[k]))) << k;
      EXPECT_TRUE(k % 2 == 0 ? said[k] <= seen[k] + 1e-9 : said[k] >= seen[k] - 1e-9) << k;
    }
  }
}

TEST_F(Tables, Those_that_cannot_be_are_refused_and_change_nothing) {
  TimeProfile sut;
  ProfileTable table = any(10, 5);
  ASSERT_EQ(sut.set(table, Of::Position, {}, {}), ErrorCode::Ok);
  const LineState before = sut.at(0.7);
  const auto refused = [&](const ProfileTable& bad, TimeProfile::Scale scale = {}) {
    EXPECT_EQ(sut.set(bad, Of::Position, scale, {}), ErrorCode::Value);
    EXPECT_EQ(sut.at(0.7).position, before.position);
  };
  for (const int points : {0, -1, 65, 32767}) {
    ProfileTable bad = table;
    bad.points = static_cast<std::int16_t>(points);
    refused(bad);
  }
  ProfileTable bad = table;
  bad.time[0] = 0;
  refused(bad);
  bad = table;
  bad.time[3] = bad.time[2];
  refused(bad);
  bad = table;
  bad.value[4] = std::nan("");
  refused(bad);
  bad = table;
  bad.time[4] = HUGE_VAL;
  refused(bad);
  refused(table, {0, 1, 0});
  refused(table, {-1, 1, 0});
  refused(table, {1, std::nan(""), 0});
  refused(table, {1, 1, HUGE_VAL});
}

class TableCommands : public Tables, public CommandCell {
 protected:
  void SetUp() override { ASSERT_TRUE(done(give(1, AxisService::PowerOn))); }
  Given along(AxisService service, const ProfileTable& table, bool relative = true,
              BufferMode buffer = BufferMode::Aborting) {
    const Given given = give(1, service, 1, 0, buffer);
    Command& c = command(given);
    c.to = {1, 1, 0};
    c.option = relative ? 1 : 0;
    c.job = static_cast<std::int16_t>(which_ + 1);
    cell.in.profiles[which_] = table;
    cell.in.profiles[which_].command = given.number;
    which_ = (which_ + 1) % kProfiles;
    return given;
  }
  static ProfileTable two(double t1, double v1, double t2, double v2) {
    ProfileTable table;
    table.points = 2;
    table.time = {t1, t2};
    table.value = {v1, v2};
    return table;
  }

 private:
  std::size_t which_ = 0;
};

TEST_F(TableCommands, Positions_end_at_rest_and_are_where_they_are_to_be_in_time) {
  const Given sut = along(AxisService::PositionProfile, two(1, 20, 2, 10), false);
  cell.step();
  EXPECT_EQ(axis(0), AxisState::DiscreteMotion);
  for (int i = 1; i < 100; ++i) {
    cell.step();
  }
  EXPECT_NEAR(joint(0), 20, 0.01);
  ASSERT_TRUE(done(sut));
  EXPECT_NEAR(joint(0), 10, 1e-9);
  EXPECT_EQ(axis(0), AxisState::Standstill);
  const Given next = along(AxisService::PositionProfile, two(1, 5, 2, -5));
  ASSERT_TRUE(done(next));
  EXPECT_NEAR(joint(0), 5, 1e-9);
}

TEST_F(TableCommands, The_others_go_on_and_one_takes_over_from_the_other) {
  const Given speeds = along(AxisService::VelocityProfile, two(0.5, 20, 1, 15));
  ASSERT_TRUE(cell.until([&] { return reached(speeds); }));
  EXPECT_EQ(axis(0), AxisState::ContinuousMotion);
  EXPECT_NEAR(cell.out.axes[0].velocity, 15, 1e-6);
  const Given pushes = along(AxisService::AccelerationProfile, two(0.3, -40, 0.6, 0));
  cell.step();
  EXPECT_EQ(state(speeds), CommandState::Aborted);
  ASSERT_TRUE(cell.until([&] { return reached(pushes); }));
  EXPECT_NEAR(cell.out.axes[0].velocity, 15 - 12, 1e-6);
  EXPECT_EQ(state(pushes), CommandState::Active);
  ASSERT_TRUE(done(give(1, AxisService::Halt)));
  EXPECT_EQ(state(pushes), CommandState::Aborted);
}

TEST_F(TableCommands, One_that_waits_begins_where_the_one_before_it_rests) {
  const Given first = along(AxisService::PositionProfile, two(1, 20, 2, 10));
  const Given second = along(AxisService::PositionProfile, two(1, 5, 2, 20), true, BufferMode::Buffered);
  ASSERT_TRUE(done(first));
  EXPECT_EQ(state(second), CommandState::Active);
  ASSERT_TRUE(done(second));
  EXPECT_NEAR(joint(0), 30, 1e-9);
}

TEST_F(TableCommands, What_it_cannot_do_is_an_error_and_nothing_moves) {
  const double most = cell.out.axes[0].most_velocity;
  const double hardest = cell.out.axes[0].most_acceleration;
  const std::pair<Given, ErrorCode> cases[] = {
      {along(AxisService::VelocityProfile, two(5, most * 1.01, 10, 0)), ErrorCode::Speed},
      {along(AxisService::AccelerationProfile, two(1, hardest * 1.01, 2, 0)), ErrorCode::Speed},
      {along(AxisService::PositionProfile, two(0.01, 5, 2, 0)), ErrorCode::Speed},
      {along(AxisService::PositionProfile, two(20, cell.out.axes[0].upper + 1, 40, 0)), ErrorCode::JointLimit}};
  cell.step();
  for (const auto& [given, code] : cases) {
    EXPECT_EQ(error(given), code);
  }
  const Given stale = along(AxisService::PositionProfile, two(1, 5, 2, 0));
  command(stale).job = 2;  // that of another command
  const Given none = along(AxisService::PositionProfile, two(1, 5, 2, 0));
  command(none).job = 9;
  const Given hard = along(AxisService::VelocityProfile, two(1, hardest, 2, 0));
  const Given jerky = along(AxisService::AccelerationProfile, two(0.0005, hardest / 10, 0.001, 0));
  cell.step();
  EXPECT_EQ(error(stale), ErrorCode::Value);
  EXPECT_EQ(error(none), ErrorCode::Value);
  EXPECT_NE(error(hard), ErrorCode::Ok);
  EXPECT_EQ(error(jerky), ErrorCode::Jerk);
  EXPECT_EQ(axis(0), AxisState::Standstill);
}

TEST_F(TableCommands, An_override_or_a_hold_ends_it) {
  for (const bool holds : {true, false}) {
    const Given sut = along(AxisService::PositionProfile, two(1, 20, 2, 0));
    for (int i = 0; i < 60; ++i) {
      cell.step();
    }
    if (holds) {
      cell.in.factors.velocity[0] = 0;
    } else {
      cell.in.speed_override = 50;
    }
    cell.step();
    EXPECT_EQ(error(sut), ErrorCode::State);
    EXPECT_EQ(axis(0), AxisState::Stopping);
    ASSERT_TRUE(cell.until([&] { return axis(0) == AxisState::Standstill; }));
    const Given refused = along(AxisService::PositionProfile, two(1, 20, 2, 0));
    cell.step();
    EXPECT_EQ(error(refused), ErrorCode::State);
    cell.in.factors.velocity[0] = 1;
    cell.in.speed_override = 100;
    cell.step();
  }
}

TEST_F(TableCommands, Random_ones_keep_all_limits_by_their_set_points) {
  int taken = 0;
  for (int i = 0; i < 300 && !HasFailure(); ++i) {
    const AxisReport& now = cell.out.axes[0];
    static constexpr AxisService kAll[] = {AxisService::PositionProfile, AxisService::VelocityProfile,
                                           AxisService::AccelerationProfile};
    const double most[] = {60, now.most_velocity, now.most_acceleration};
    const int which = one_of(3);
    const Given sut = along(kAll[which], any(in(0.05, 1) * most[which], 1 + one_of(8)), one_of(2) == 0);
    double place = joint(0);
    double speed = 0;
    double hard = 0;
    cell.step();
    if (state(sut) == CommandState::Error) {
      EXPECT_EQ(joint(0), place);
      continue;
    }
    ++taken;
    for (int k = 0; k < 2000 && !ended(sut) && !reached(sut); ++k) {
      const double v = (joint(0) - place) / 0.01;
      const double a = (v - speed) / 0.01;
      EXPECT_LE(std::abs(v), now.most_velocity * 1.0001);
      EXPECT_LE(std::abs(a), now.most_acceleration * 1.0001);
      EXPECT_LE(std::abs(a - hard) / 0.01, now.most_jerk * 1.0001);
      place = joint(0);
      speed = v;
      hard = a;
      cell.step();
    }
    EXPECT_TRUE(reached(sut) || state(sut) == CommandState::Done);
    give(1, AxisService::Halt);
    ASSERT_TRUE(done(give(1, AxisService::MoveAbsolute, in(-20, 20))));
  }
  EXPECT_GT(taken, 60);
}

}  // namespace
}  // namespace indurop::robot
