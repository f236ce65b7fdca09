// SPDX-License-Identifier: Apache-2.0
// Commands of the group, as function blocks give them: each one learns its own end.
#include "command_cell.h"

namespace indurop::robot {
namespace {

using Eight = std::array<double, 8>;

class GroupCommands : public testing::Test, public CommandCell {
 protected:
  GroupCommands() : CommandCell(10, in_tick()) {}
  static Settings in_tick() {
    Settings settings;
    settings.plan_in_tick = true;
    return settings;
  }
  void SetUp() override {
    ASSERT_TRUE(done(give(Service::GroupEnable)));
    ASSERT_TRUE(done(give(Service::DirectAbsolute, kHome)));
  }
  Given line(double x, double y, double z, BufferMode mode = BufferMode::Buffered, double transition = 0,
             double speed = 250) {
    return give(Service::LinearAbsolute, {x, y, z, 180, 0, 180}, speed, mode, CoordSystem::Machine, transition);
  }
  void expect_at(double x, double y, double z) {
    cell.step();
    EXPECT_NEAR(cell.out.position[0], x, 0.1);
    EXPECT_NEAR(cell.out.position[1], y, 0.1);
    EXPECT_NEAR(cell.out.position[2], z, 0.1);
  }
  static constexpr Eight kHome{0, 10, -20, 0, 60, 0};
};

TEST_F(GroupCommands, Several_of_one_period_run_one_after_the_other) {
  const Given first = line(500, 0, 400);
  const Given second = line(500, 100, 400);
  const Given third = line(500, 100, 300);
  cell.step();
  EXPECT_EQ(state(third), CommandState::Waits);
  ASSERT_TRUE(done(first));
  expect_at(500, 0, 400);
  ASSERT_TRUE(cell.until([&] { return state(second) == CommandState::Active; }));
  EXPECT_EQ(state(third), CommandState::Waits);
  ASSERT_TRUE(done(second));
  ASSERT_TRUE(done(third));
  expect_at(500, 100, 300);
  EXPECT_EQ(cell.out.state, GroupState::Standby);
}

TEST_F(GroupCommands, A_transition_passes_the_corner_without_a_stop) {
  ASSERT_TRUE(done(line(500, 0, 400)));
  const Given first = line(500, 200, 400);
  const Given second = line(500, 200, 200, BufferMode::BlendingPrevious, 50);
  double slowest = 1000;
  double nearest = 1000;
  ASSERT_TRUE(cell.until([&] {
    const double gap = std::hypot(cell.out.position[1] - 200, cell.out.position[2] - 400);
    nearest = std::min(nearest, gap);
    if (gap < 40) {
      slowest = std::min(slowest, cell.out.tool_speed);
    }
    return ended(second);
  }));
  EXPECT_EQ(state(first), CommandState::Done);
  EXPECT_EQ(state(second), CommandState::Done);
  EXPECT_GT(slowest, 20);
  EXPECT_GT(nearest, 2);
  EXPECT_LT(nearest, 50);
  expect_at(500, 200, 200);
}

TEST_F(GroupCommands, An_aborting_line_begins_where_the_path_could_stop) {
  ASSERT_TRUE(done(line(500, 0, 400)));
  const Given first = line(500, 300, 400);
  const Given queued = line(500, 0, 500);
  ASSERT_TRUE(cell.until([&] { return cell.out.position[1] > 100; }));
  const Given other = line(500, 0, 300, BufferMode::Aborting);
  cell.step();
  EXPECT_EQ(state(first), CommandState::Aborted);
  EXPECT_EQ(state(queued), CommandState::Aborted);
  EXPECT_EQ(cell.out.state, GroupState::Moving);
  ASSERT_TRUE(done(other));
  expect_at(500, 0, 300);
}

TEST_F(GroupCommands, An_aborting_joint_motion_goes_on_from_where_it_is) {
  const Given first = give(Service::DirectAbsolute, {90, 10, -20, 0, 60, 0}, 50);
  ASSERT_TRUE(cell.until([&] { return joint(0) > 20; }));
  const Given other = give(Service::DirectAbsolute, {120, 10, -20, 0, 60, 0}, 100);
  double slowest = 1000;
  cell.step();
  EXPECT_EQ(state(first), CommandState::Aborted);
  ASSERT_TRUE(cell.until([&] {
    if (joint(0) < 100) {
      slowest = std::min(slowest, cell.out.speed[0]);
    }
    return ended(other);
  }));
  EXPECT_GT(slowest, 10);
  EXPECT_EQ(state(other), CommandState::Done);
  EXPECT_NEAR(joint(0), 120, 0.01);
}

TEST_F(GroupCommands, Relative_ones_begin_where_the_one_before_ends) {
  ASSERT_TRUE(done(line(500, 0, 400)));
  line(500, 100, 400);
  const Given by = give(Service::LinearRelative, {0, 0, -50, 0, 0, 0}, 200, BufferMode::Buffered, CoordSystem::Machine);
  ASSERT_TRUE(done(by));
  expect_at(500, 100, 350);
  const double before = joint(0);
  ASSERT_TRUE(done(give(Service::DirectRelative, {5, 0, 0, 0, 0, 0}, 50)));
  EXPECT_NEAR(joint(0), before + 5, 0.01);
}

TEST_F(GroupCommands, Circles_by_a_point_a_centre_and_a_radius) {
  const auto circle = [&](Service service, Eight to, Eight aux, int option) {
    Given given = give(service, to, 200, BufferMode::Aborting, CoordSystem::Machine);
    command(given).aux = aux;
    command(given).option = static_cast<std::int16_t>(option);
    return given;
  };
  const auto most = [&](const Given& given, std::size_t i, double sign) {
    double far = -1e9;
    EXPECT_TRUE(cell.until([&] {
      far = std::max(far, sign * cell.out.position[i]);
      return ended(given);
    }));
    EXPECT_EQ(state(given), CommandState::Done) << static_cast<int>(error(given));
    return sign * far;
  };
  ASSERT_TRUE(done(line(500, -50, 400)));
  EXPECT_NEAR(most(circle(Service::CircularAbsolute, {500, 50, 400, 180, 0, 180}, {550, 0, 400}, 0), 0, 1), 550, 0.5);
  expect_at(500, 50, 400);
  // Counter-clockwise, seen from above: over the side of smaller x.
  EXPECT_NEAR(most(circle(Service::CircularAbsolute, {500, -50, 400, 180, 0, 180}, {500, 0, 400}, 1), 0, -1), 450, 0.5);
  EXPECT_NEAR(most(circle(Service::CircularAbsolute, {500, 50, 400, 180, 0, 180}, {500, 0, 400}, 1 + 16), 0, -1), 450,
              0.5);
  EXPECT_TRUE(done(circle(Service::CircularRelative, {-50, -50, 0, 0, 0, 0}, {0, 0, 50}, 2)));
  expect_at(450, 0, 400);
  const Given wrong = circle(Service::CircularAbsolute, {500, 50, 400, 180, 0, 180}, {600, 0, 400}, 1);
  EXPECT_FALSE(done(wrong));
  EXPECT_EQ(error(wrong), ErrorCode::Circle);
}

TEST_F(GroupCommands, The_products_coordinates) {
  ASSERT_TRUE(done(give(Service::SetTransform, {500, 100, 300, 0, 0, 90})));
  ASSERT_TRUE(
      done(give(Service::LinearAbsolute, {20, 10, 5, 180, 0, 90}, 300, BufferMode::Aborting, CoordSystem::Product)));
  expect_at(490, 120, 305);
  ASSERT_TRUE(
      done(give(Service::LinearRelative, {10, 0, 0, 0, 0, 0}, 300, BufferMode::Aborting, CoordSystem::Product)));
  expect_at(490, 130, 305);
  EXPECT_EQ(error(give(Service::SetTransform, {std::nan("")})), ErrorCode::Ok);
}

TEST_F(GroupCommands, A_stop_holds_as_long_as_its_block_says) {
  const Given move = give(Service::DirectAbsolute, {90, 10, -20, 0, 60, 0}, 50);
  ASSERT_TRUE(cell.until([&] { return joint(0) > 20; }));
  const Given stop = give(Service::Stop);
  ASSERT_TRUE(done(stop));
  EXPECT_EQ(state(move), CommandState::Aborted);
  const Given refused = line(500, 0, 400);
  cell.step();
  EXPECT_EQ(error(refused), ErrorCode::State);
  EXPECT_EQ(cell.out.state, GroupState::Stopping);
  command(stop).execute = 0;
  cell.step();
  EXPECT_EQ(cell.out.state, GroupState::Standby);
  EXPECT_TRUE(done(give(Service::DirectAbsolute, kHome)));
}

TEST_F(GroupCommands, A_halt_ends_motions_and_an_interruption_does_not) {
  ASSERT_TRUE(done(line(500, 0, 400)));
  const Given move = line(500, 300, 400);
  ASSERT_TRUE(cell.until([&] { return cell.out.position[1] > 50; }));
  const Given hold = give(Service::Interrupt);
  ASSERT_TRUE(done(hold));
  EXPECT_EQ(cell.out.state, GroupState::Moving);
  cell.step();
  EXPECT_EQ(cell.out.tool_speed, 0);
  EXPECT_EQ(state(move), CommandState::Waits);
  ASSERT_TRUE(done(give(Service::Continue)));
  cell.step();
  EXPECT_EQ(state(move), CommandState::Active);
  ASSERT_TRUE(cell.until([&] { return cell.out.position[1] > 150; }));
  const Given halt = give(Service::Halt);
  ASSERT_TRUE(done(halt));
  EXPECT_EQ(state(move), CommandState::Aborted);
  EXPECT_LT(cell.out.position[1], 299);
  EXPECT_EQ(cell.out.state, GroupState::Standby);
  const Given nothing = give(Service::Continue);
  cell.step();
  EXPECT_EQ(error(nothing), ErrorCode::State);
}

TEST_F(GroupCommands, One_that_cannot_be_done_ends_those_behind_it_only) {
  const Given first = line(500, 0, 400);
  const Given beyond = line(5000, 0, 400);
  const Given behind = line(500, 100, 400);
  ASSERT_TRUE(cell.until([&] { return ended(beyond); }));
  EXPECT_EQ(error(beyond), ErrorCode::Unreachable);
  EXPECT_EQ(state(behind), CommandState::Aborted);
  EXPECT_TRUE(done(first));
  cell.step();
  EXPECT_EQ(cell.out.state, GroupState::Standby);
}

TEST_F(GroupCommands, An_emergency_stop_ends_all_of_them) {
  const Given move = give(Service::DirectAbsolute, {90, 10, -20, 0, 60, 0}, 50);
  const Given behind = line(500, 0, 400);
  ASSERT_TRUE(cell.until([&] { return joint(0) > 20; }));
  cell.in.emergency = true;
  cell.step();
  EXPECT_EQ(error(move), ErrorCode::Emergency);
  EXPECT_EQ(state(behind), CommandState::Aborted);
  ASSERT_TRUE(cell.until([&] { return cell.out.state == GroupState::ErrorStop; }));
  cell.in.emergency = false;
  EXPECT_TRUE(done(give(Service::GroupReset)));
}

}  // namespace
}  // namespace indurop::robot
