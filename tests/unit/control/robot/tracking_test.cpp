// SPDX-License-Identifier: Apache-2.0
// Products on belts and tables: how the tool gets onto them, stays there, and comes off, and what is said where it
// cannot.

#include "control/robot/group/tracking.h"

#include "belt_cell.h"

namespace indurop::robot {
namespace {

TEST_F(Belts, The_tool_gets_onto_the_belt_and_its_path_is_straight_on_the_product) {
  belt = [](double t) { return 120 * t; };
  begin_tracking(kAlongY, {0, 20, 0, 0, 0, -90});
  const Given first = product(0, 0, 100);
  ASSERT_TRUE(until([&] { return state(first) == CommandState::Active; }));
  const KDL::Vector begun = tip();
  ASSERT_TRUE(until([&] {
    expect_on_line(begun, {0, 0, 100}, 0.02);
    return ended(first);
  }));
  ASSERT_EQ(state(first), CommandState::Done) << static_cast<int>(error(first));
  EXPECT_EQ(cell.out.state, GroupState::Moving) << "it continues to track";
  const Given second = product(20, 10, 20);
  const Given third = product(20, 10, 60, 400, BufferMode::Buffered);
  ASSERT_TRUE(until([&] {
    expect_on_line({0, 0, 100}, {20, 10, 20}, 0.02);
    return ended(second);
  }));
  ASSERT_TRUE(until([&] {
    expect_on_line({20, 10, 20}, {20, 10, 60}, 0.02);
    return ended(third);
  }));
  EXPECT_EQ(state(third), CommandState::Done);
  for (int i = 0; i < 30; ++i) {
    step();
    expect_at({20, 10, 60}, 0.02);
    EXPECT_NEAR(cell.out.tool_speed, 120, 0.2);
  }
  EXPECT_NEAR(cell.out.product.position[2], 60, 0.2);
}

TEST_F(Belts, A_hold_stops_the_tool_too_and_it_goes_on_where_it_was_on_the_product) {
  belt = [](double t) { return 100 * t; };
  begin_tracking(kAlongY, {0, 20, 0, 0, 0, -90});
  ASSERT_TRUE(run(product(0, 0, 120)));
  for (const bool by_override : {false, true}) {
    const KDL::Vector from = tip();
    const KDL::Vector to(by_override ? 0 : 40, 0, 80);
    const Given motion = product(to[0], to[1], to[2], 200);
    ASSERT_TRUE(until([&] { return (tip() - from).Norm() > 10; }));
    cell.in.hold = !by_override;
    cell.in.speed_override = by_override ? 0 : 100;
    ASSERT_TRUE(until([&] { return stands(); }, 100));
    EXPECT_EQ(cell.out.state, GroupState::Moving);
    for (int i = 0; i < 30; ++i) {
      step();
      EXPECT_TRUE(stands());
    }
    cell.in.hold = false;
    cell.in.speed_override = 100;
    ASSERT_TRUE(until([&] { return std::abs(cell.out.tool_speed - 100) < 0.5 && cell.out.path_speed > 0; }));
    ASSERT_TRUE(until([&] {
      expect_on_line(from, to, 0.03);
      return ended(motion);
    }));
    EXPECT_EQ(state(motion), CommandState::Done);
    expect_at(to, 0.03);
  }
}

TEST_F(Belts, A_motion_of_the_machine_leaves_the_belt_and_another_one_comes_back) {
  belt = [](double t) { return 80 * t; };
  begin_tracking(kAlongY, {0, 20, 0, 0, 0, -90});
  ASSERT_TRUE(run(product(0, 0, 120)));
  const Given away = machine(500, 0, 400);
  const Given back = product(0, 0, 100, 250, BufferMode::Buffered);
  ASSERT_TRUE(until([&] { return ended(away); }));
  EXPECT_EQ(state(away), CommandState::Done);
  EXPECT_NEAR(cell.out.position[1], 0, 1e-3);
  ASSERT_TRUE(run(back));
  expect_at({0, 0, 100}, 0.02);
  const Given joints = give(Service::DirectAbsolute, {0, 10, -20, 0, 60, 0}, 50);
  ASSERT_TRUE(run(joints));
  EXPECT_NEAR(joint(1), 10, 1e-6);
  ASSERT_TRUE(until([&] { return cell.out.state == GroupState::Standby; }, 5));
}

TEST_F(Belts, Stops_bring_the_tool_to_rest_next_to_the_belt) {
  belt = [](double t) { return 60 * t; };
  begin_tracking(kAlongY, {0, 20, 0, 0, 0, -90});
  for (const Service service : {Service::Halt, Service::Stop, Service::SetTransform, Service::TrackBelt}) {
    ASSERT_TRUE(run(product(0, 0, 120)));
    const Given motion = product(0, 0, 60, 100);
    ASSERT_TRUE(until([&] { return tip()[2] < 115; }));
    Given stop = give(service, service == Service::TrackBelt ? kAlongY : Eight{500, 0, 300});
    command(stop).option = 1;
    ASSERT_TRUE(until([&] { return stands(); }, 150));
    command(stop).execute = 0;
    ASSERT_TRUE(until([&] { return cell.out.state == GroupState::Standby; }, 5)) << static_cast<int>(service);
    EXPECT_EQ(state(motion), CommandState::Aborted);
    EXPECT_EQ(state(stop), CommandState::Done);
    begin_tracking(kAlongY, {0, 20, 0, 0, 0, -90});
  }
  ASSERT_TRUE(run(product(0, 0, 120)));
  cell.ask(Service::GroupDisable);
  ASSERT_TRUE(until([&] { return cell.out.state == GroupState::Disabled; }, 300));
}

TEST_F(Belts, An_interruption_keeps_what_is_to_do) {
  belt = [](double t) { return 60 * t; };
  begin_tracking(kAlongY, {0, 20, 0, 0, 0, -90});
  ASSERT_TRUE(run(product(0, 0, 120)));
  const Given motion = product(0, 0, 60, 100);
  ASSERT_TRUE(until([&] { return tip()[2] < 110; }));
  const Given pause = give(Service::Interrupt);
  ASSERT_TRUE(run(pause));
  step();
  EXPECT_TRUE(stands());
  give(Service::Continue);
  ASSERT_TRUE(run(motion));
  expect_at({0, 0, 60}, 0.02);
}

// What the belt does wrong, and what is said of it.
TEST_F(Belts, A_belt_that_cannot_be_followed_ends_in_rest_and_an_error) {
  struct Case {
    const char* says;
    std::function<void()> what;
  };
  const Case cases[] = {
      {"not reported", [&] { reported = false; }},
      {"jumped", [&] { belt = [old = belt](double t) { return old(t) + 40; }; }},
      {"jumped", [&] { belt = [](double) { return std::nan(""); }; }},
      {"too suddenly", [&] { belt = [at = belt(time), from = time](double t) { return at + 400 * (t - from); }; }},
  };
  for (const Case& wrong : cases) {
    belt = [](double t) { return 60 * t; };
    reported = true;
    begin_tracking(kAlongY, {0, 20, 0, 0, 0, -90});
    ASSERT_TRUE(run(product(0, 0, 120)));
    const Given motion = product(0, 0, 60, 50);
    ASSERT_TRUE(until([&] { return tip()[2] < 115; }));
    wrong.what();
    ASSERT_TRUE(until([&] { return cell.out.state == GroupState::ErrorStop; }, 150)) << wrong.says;
    EXPECT_TRUE(stands());
    EXPECT_EQ(cell.out.error, ErrorCode::Belt) << wrong.says;
    EXPECT_EQ(error(motion), ErrorCode::Belt) << wrong.says;
    EXPECT_NE(message().find("belt 1"), std::string::npos) << message();
    ASSERT_TRUE(run(give(Service::GroupReset)));
    const Given again = product(0, 0, 60, 50);
    step();
    EXPECT_EQ(error(again), ErrorCode::Belt) << "it has to be tracked again";
    ASSERT_TRUE(run(machine(500, 0, 400)));
  }
}

TEST_F(Belts, Who_rides_out_of_reach_stops_within_all_limits) {
  belt = [](double t) { return 150 * t; };
  begin_tracking(kAlongY, {0, 20, 0, 0, 0, -90});
  ASSERT_TRUE(run(product(0, 0, 120)));
  ASSERT_TRUE(until([&] { return cell.out.state == GroupState::ErrorStop; }));
  EXPECT_TRUE(stands());
  EXPECT_NE(message().find("no longer follows belt 1"), std::string::npos) << message();
}

TEST_F(Belts, An_emergency_stop_brakes_each_axis) {
  belt = [](double t) { return 100 * t; };
  begin_tracking(kAlongY, {0, 20, 0, 0, 0, -90});
  ASSERT_TRUE(run(product(0, 0, 120)));
  const Given motion = product(0, 0, 60, 200);
  ASSERT_TRUE(until([&] { return tip()[2] < 100; }));
  hardness = kEmergency;
  cell.in.emergency = true;
  ASSERT_TRUE(until([&] { return cell.out.state == GroupState::ErrorStop; }, 40));
  EXPECT_TRUE(stands());
  EXPECT_EQ(error(motion), ErrorCode::Emergency);
}

TEST_F(Belts, What_cannot_be_is_refused) {
  belt = [](double t) { return 60 * t; };
  step();
  const Given early = track(kAlongY, {});
  step();
  EXPECT_EQ(error(early), ErrorCode::Belt);
  EXPECT_NE(message().find("MC_BELT[0]"), std::string::npos) << message();
  begin_tracking(kAlongY, {0, 20, 0, 0, 0, -90});
  for (const int number : {0, 3, -1}) {
    const Given none = track(kAlongY, {});
    command(none).option = static_cast<std::int16_t>(number);
    step();
    EXPECT_EQ(error(none), ErrorCode::Value) << number;
  }
  const Given nowhere = track({std::nan("")}, {});
  step();
  EXPECT_EQ(error(nowhere), ErrorCode::Value);
  const Given second = track(kAlongY, {});
  command(second).option = 2;
  step();
  EXPECT_EQ(error(second), ErrorCode::Belt) << "it is not reported";
  begin_tracking(kAlongY, {0, 20, 0, 0, 0, -90});
  ASSERT_TRUE(run(product(0, 0, 120)));
  for (const Service service : {Service::MoveJoints, Service::DirectAborting, Service::SelectTool, Service::JobStart}) {
    cell.ask(service);
    ASSERT_TRUE(until([&] { return cell.out.done == cell.in.service.number; }));
    EXPECT_EQ(cell.out.error, ErrorCode::State) << static_cast<int>(service);
  }
  const Given far = product(0, 2000, 0);
  ASSERT_TRUE(until([&] { return ended(far); }));
  EXPECT_EQ(error(far), ErrorCode::Unreachable);
  step();
  expect_at({0, 0, 120}, 0.02);
}

TEST_F(Belts, Manual_mode_keeps_its_speed_on_the_belt_and_rests_without_its_switch) {
  cell.in.mode = {OperatingMode::Manual, true};
  belt = [](double t) { return 100 * t; };
  begin_tracking(kAlongY, {0, 20, 0, 0, 0, -90});
  double fastest = 0;
  for (const auto& [y, z] : {std::pair{0.0, 120.0}, {0.0, 60.0}, {40.0, 100.0}, {-40.0, 100.0}}) {
    const Given motion = product(y, 0, z, 1000);
    ASSERT_TRUE(until([&] {
      fastest = std::max(fastest, cell.out.tool_speed);
      return ended(motion);
    }));
    EXPECT_EQ(state(motion), CommandState::Done) << static_cast<int>(error(motion)) << message();
  }
  EXPECT_GT(fastest, 150);
  EXPECT_LT(fastest, 250);
  hardness = kEmergency;
  cell.in.mode.enabled = false;
  ASSERT_TRUE(until([&] { return stands(); }, 40));
  ASSERT_TRUE(until([&] { return cell.out.state == GroupState::Standby; }, 5));
}

TEST_F(Belts, A_rotary_table_turns_the_tool_with_it) {
  belt = [](double t) { return 12 * t; };
  begin_tracking({500, 0, 200, 0, 0, 0}, {0, -120, 0, 0, 0, 0}, true);
  ASSERT_TRUE(run(product(0, 0, 120)));
  const Given line = product(30, 20, 60);
  ASSERT_TRUE(until([&] {
    expect_on_line({0, 0, 120}, {30, 20, 60}, 0.02);
    return ended(line);
  }));
  EXPECT_EQ(state(line), CommandState::Done);
  const KDL::Rotation begun = tip_on_product().M;
  for (int i = 0; i < 100; ++i) {
    step();
    expect_at({30, 20, 60}, 0.02);
    EXPECT_LT(KDL::diff(begun, tip_on_product().M).Norm(), 1e-4);
  }
  ASSERT_TRUE(run(machine(500, 0, 400)));
}

class BeltInABox : public Belts {
 protected:
  BeltInABox() : Belts(boxed()) {}
  static Settings boxed() {
    Settings settings = in_tick();
    settings.workspace = {200, -200, 100, 4000, 300, 900};
    return settings;
  }
};

TEST_F(BeltInABox, The_tool_rests_inside_of_the_workspace) {
  belt = [](double t) { return 100 * t; };
  begin_tracking(kAlongY, {0, 20, 0, 0, 0, -90});
  ASSERT_TRUE(run(product(0, 0, 120)));
  ASSERT_TRUE(until([&] {
    EXPECT_LT(cell.out.position[1], 300 + 1e-3);
    return cell.out.state == GroupState::ErrorStop;
  }));
  EXPECT_EQ(cell.out.error, ErrorCode::Workspace);
  EXPECT_TRUE(stands());
}

}  // namespace
}  // namespace indurop::robot
