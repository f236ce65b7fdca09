// SPDX-License-Identifier: Apache-2.0
// Stops of faults keep the path: a drive that has no power leaves it, the other axes do not. And what is reset, said
// and gone on with after a stop.
#include <fmt/format.h>

#include "drive_faults.h"
#include "limit_judge.h"

namespace indurop::robot {
namespace {

// The straight line that an arm was on near its stretched elbow as a drive failed, in manual mode.
constexpr const char* kLine =
    "POINT P1 = JOINT -4.685892 66.906047 -95.113092 -10.547300 39.047443 0\n"
    "POINT P2 = POSE {} {} {} RPY {} {} {}\n";

class Line : public testing::TestWithParam<OperatingMode> {
 protected:
  static constexpr double kPeriod = 0.004;
  Line()
      : spec(irb4600_spec()),
        cell(job(), 1000 * kPeriod, 0, true, {}, spec.urdf()),
        places(spec, KDL::Frame::Identity()),
        judge(kPeriod, spec.urdf()) {
    begin_again();
  }
  static std::string job() {
    const Arm arm = arm_from_urdf("arm.urdf", irb4600_spec().urdf()).value().arm;
    const Pose from = arm.forward(radians(1) * joints_of({-4.685892, 66.906047, -95.113092, -10.5473, 39.047443, 0}));
    const Vec3 rpy = to_rpy(from.orientation) * (180 / kPi);
    const Vec3 to = 1000 * from.position + Vec3(-150, -260, -150);
    return fmt::format(fmt::runtime(kLine), to[0], to[1], to[2], rpy[0], rpy[1], rpy[2]);
  }
  // Another controller, at rest.
  void begin_again() {
    Cell other(job(), 1000 * kPeriod, 0, true, {}, spec.urdf());
    std::swap(other.sut, cell.sut);
    cell.in = other.in;
    cell.out = other.out;
    cell.in.mode.mode = GetParam();
    cell.in.mode.enabled = true;
    judge = Judge(kPeriod, spec.urdf());
  }
  void step() {
    cell.step();
    const KdlPlaces::Place now = places.at(cell.out.command);
    fastest = first ? 0 : std::max(fastest, 1000 * KdlPlaces::apart(now, before) / kPeriod);
    first = false;
    before = now;
    ASSERT_EQ(judge.look(cell, 1), "");
  }
  // Distance in mm from the line from one place to the other.
  static double distance_from_line(const KDL::Vector& place, const KDL::Vector& from, const KDL::Vector& to) {
    const KDL::Vector way = (to - from) / (to - from).Norm();
    const KDL::Vector off = place - from;
    return 1000 * (off - way * KDL::dot(off, way)).Norm();
  }
  void serve(Service service) {
    cell.ask(service);
    for (int i = 0; i < 20'000 && cell.out.done != cell.in.service.number; ++i) {
      ASSERT_NO_FATAL_FAILURE(step());
    }
    ASSERT_EQ(cell.out.done, cell.in.service.number);
    ASSERT_EQ(cell.out.error, ErrorCode::Ok);
  }
  void move_until(double part) {
    ASSERT_NO_FATAL_FAILURE(serve(Service::GroupEnable));
    cell.in.service.point = 1;
    ASSERT_NO_FATAL_FAILURE(serve(Service::MoveJoints));
    from = places.at(cell.out.command).tip;
    cell.in.service.point = 2;
    cell.ask(Service::MoveLine);
    const auto gone = [&] { return (places.at(cell.out.command).tip - from).Norm(); };
    first = true;
    fastest = 0;
    for (int i = 0; i < 20'000 && gone() < 0.33 * part; ++i) {
      ASSERT_NO_FATAL_FAILURE(step());
    }
    ASSERT_GE(gone(), 0.33 * part);
    on_line = places.at(cell.out.command).tip;
  }
  void come_to_rest() {
    for (int i = 0; i < 1000 && cell.out.state != GroupState::ErrorStop; ++i) {
      ASSERT_NO_FATAL_FAILURE(step());
    }
    ASSERT_EQ(cell.out.state, GroupState::ErrorStop);
  }

  ArmSpec spec;
  Cell cell;
  KdlPlaces places;
  Judge judge;
  bool first = true;
  double fastest = 0;
  KDL::Vector from, on_line;
  KdlPlaces::Place before;
};

// The last axis turns the tool only, so the others show whether they stay on the line.
TEST_P(Line, A_drive_that_fails_leaves_the_others_on_it) {
  for (const std::uint16_t status : {Cell::kFault, Cell::kSwitchOnDisabled}) {
    begin_again();
    ASSERT_NO_FATAL_FAILURE(move_until(0.2));
    cell.in.drives[5].status = status;
    ASSERT_NO_FATAL_FAILURE(step());
    EXPECT_EQ(cell.out.axes[5].state, AxisState::ErrorStop);
    ASSERT_NO_FATAL_FAILURE(come_to_rest());
    const KDL::Vector end = places.at(cell.out.command).tip;
    EXPECT_GT((end - on_line).Norm(), 0);
    EXPECT_LT(distance_from_line(end, from, on_line), 0.02);
    EXPECT_LE(fastest, GetParam() == OperatingMode::Manual ? 250 : 1000);
    EXPECT_EQ(cell.out.error, status == Cell::kFault ? ErrorCode::Drive : ErrorCode::Power);
    EXPECT_EQ(cell.out.error_axis, 6U);
  }
}

TEST_P(Line, An_axis_that_does_not_follow_stops_it_on_it) {
  ASSERT_NO_FATAL_FAILURE(move_until(0.2));
  cell.in.drives[1].position += 1'320'000 / 30;  // 12 degrees
  cell.stuck = true;
  ASSERT_NO_FATAL_FAILURE(come_to_rest());
  EXPECT_LT(distance_from_line(places.at(cell.out.command).tip, from, on_line), 0.02);
  EXPECT_LE(fastest, GetParam() == OperatingMode::Manual ? 250 : 1000);
  EXPECT_EQ(cell.out.error, ErrorCode::Following);
}

// The harder stop counts, whichever comes first.
TEST_P(Line, An_emergency_stop_takes_over_from_the_stop_of_a_fault) {
  const auto periods = [&](bool fault, int later, bool emergency) {
    begin_again();
    move_until(0.3);
    int needed = 0;
    cell.in.drives[5].status = fault ? Cell::kFault : cell.in.drives[5].status;
    for (; cell.out.state != GroupState::ErrorStop && needed < 1000; ++needed) {
      cell.in.emergency = emergency && needed >= later;
      cell.step();
    }
    EXPECT_LT(distance_from_line(places.at(cell.out.command).tip, from, on_line), 0.05);
    cell.in.emergency = false;
    return needed;
  };
  const int soft = periods(true, 0, false);
  const int hard = periods(false, 0, true);
  const int both = periods(true, 2, true);
  EXPECT_LT(hard, soft);
  EXPECT_LT(both, soft);
  EXPECT_GE(both, hard);
}

INSTANTIATE_TEST_SUITE_P(Modes, Line,
                         testing::Values(OperatingMode::Any, OperatingMode::Automatic, OperatingMode::Manual));

TEST(Reset, Acknowledges_drives_that_failed_without_power) {
  Cell cell;
  ASSERT_EQ(cell.out.state, GroupState::Disabled);
  cell.in.drives[2].status = Cell::kFault;
  cell.in.drives[4].status = Cell::kFault;
  cell.step();
  EXPECT_FALSE(cell.serve(Service::GroupEnable));
  EXPECT_EQ(cell.out.error, ErrorCode::Drive);
  EXPECT_EQ(cell.out.error_axis, 3U);
  ASSERT_TRUE(cell.serve(Service::GroupReset));
  EXPECT_NE(cell.in.drives[2].status, Cell::kFault);
  EXPECT_NE(cell.in.drives[4].status, Cell::kFault);
  EXPECT_TRUE(cell.serve(Service::GroupEnable)) << to_string(cell.out.error);
  EXPECT_EQ(cell.out.state, GroupState::Standby);
}

TEST(Reset, Names_a_drive_that_keeps_its_fault_without_power) {
  Cell cell;
  cell.in.drives[3].status = Cell::kFault;
  cell.step();
  cell.stuck = true;
  EXPECT_FALSE(cell.serve(Service::GroupReset));
  EXPECT_EQ(cell.out.error, ErrorCode::Drive);
  EXPECT_EQ(cell.out.error_axis, 4U);
}

TEST(Override, Above_all_of_the_speed_is_all_of_it_and_what_is_no_number_is_said) {
  const auto periods = [](double percent) {
    Cell cell;
    EXPECT_TRUE(cell.serve(Service::GroupEnable));
    cell.in.speed_override = percent;
    cell.in.service.point = 1;
    cell.ask(Service::MoveJoints);
    static_cast<void>(cell.until([&] { return cell.out.done == cell.in.service.number; }, 500));
    return cell.out.done == cell.in.service.number ? cell.periods : -1;
  };
  EXPECT_EQ(periods(100.001), periods(100));
  EXPECT_EQ(periods(1e6), periods(100));
  Cell cell;
  EXPECT_TRUE(cell.serve(Service::GroupEnable));
  for (const double wrong : {HUGE_VAL, -HUGE_VAL, std::nan(""), -1.0}) {
    cell.in.speed_override = wrong;
    EXPECT_EQ(periods(wrong), -1);
    cell.step();
    EXPECT_NE(std::string(cell.out.job.message).find("ROBOT_OVERRIDE"), std::string::npos) << wrong;
    cell.in.speed_override = 50;
    cell.step();
    EXPECT_STREQ(cell.out.job.message, "") << "it is a number again";
  }
}

TEST(Resume, Waits_until_the_robot_stands) {
  Cell cell("MOVJ P1\nMOVL P2\n");
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  ASSERT_TRUE(cell.until([&] { return cell.out.tool_speed > 100; }));
  cell.ask(Service::JobStop);
  cell.step();
  cell.step();
  ASSERT_EQ(cell.out.state, GroupState::Stopping);
  EXPECT_TRUE(cell.serve(Service::JobResume)) << to_string(cell.out.error);
  EXPECT_EQ(cell.out.job.state, JobState::Ended);
}

TEST(Resume, Does_not_wait_for_what_ends_in_an_error) {
  Cell cell("MOVJ P1\nMOVL P2\n");
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  ASSERT_TRUE(cell.until([&] { return cell.out.tool_speed > 100; }));
  cell.in.emergency = true;
  cell.step();
  cell.ask(Service::JobResume);
  cell.step();
  EXPECT_EQ(cell.out.done, cell.in.service.number);
}

}  // namespace
}  // namespace indurop::robot
