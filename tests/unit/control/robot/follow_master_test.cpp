// SPDX-License-Identifier: Apache-2.0
// The path of the group follows a master (MC_SyncGroupToAxis): how near it stays to what the ratio asks for, what ends
// it, and that no set point breaks a limit whatever the master does. INDUROP_ROBOT_SYNCS says how many random runs,
// INDUROP_ROBOT_SEED from which one on.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <random>

#include "synced_cell.h"

namespace indurop::robot {
namespace {

class FollowMaster : public testing::Test, public SyncedCell {
 protected:
  void SetUp() override {
    ASSERT_TRUE(start());
    ASSERT_TRUE(go_to_begin());
  }
  Given lead(double numerator, double denominator = 1, double most = 0) {
    const Given given = give(Service::FollowMaster, {numerator, denominator, most});
    command(given).option = kFeeder;
    return given;
  }
  Given lead_by_belt(double ratio) {
    const Given given = give(Service::FollowMaster, {ratio, 1, 0});
    command(given).job = 1;
    return given;
  }
  void step_with_belt(double speed) {
    cell.in.belts[0].place += speed * 0.01;
    ++cell.in.belts[0].beat;
    step();
  }
};

TEST_F(FollowMaster, Goes_as_far_as_the_ratio_says) {
  const Given sut = lead(1, 2);
  const Given path = line(500, -300, 400, 500);
  ASSERT_TRUE(until([&] { return state(path) == CommandState::Active; }));
  for (int i = 0; i < 50; ++i) {
    step();
  }
  const double at_rest = way;
  EXPECT_FALSE(ended(path)) << "the master stands still";
  const double fed_before = cell.out.command[kAt];
  give(kFeeder, AxisService::MoveVelocity, 0, 200);
  const auto lag = [&] { return (cell.out.command[kAt] - fed_before) / 2 - (way - at_rest); };
  double most = 0;
  ASSERT_TRUE(until([&] {
    most = std::max(most, std::abs(lag()));
    return way - at_rest > 150;
  }));
  EXPECT_TRUE(reached(sut));
  EXPECT_LT(most, 60);
  for (; way - at_rest < 300; step()) {
    EXPECT_NEAR(lag(), 0, 1.5) << cell.periods;
    EXPECT_TRUE(reached(sut));
    ASSERT_FALSE(HasFailure());
  }
  fmt::print("most {} mm while it begins\n", most);
  ASSERT_TRUE(until([&] { return ended(path); }));
  EXPECT_EQ(state(path), CommandState::Done);
  EXPECT_EQ(state(sut), CommandState::Active);
}

TEST_F(FollowMaster, Waits_where_the_master_turned_back) {
  const Given sut = lead(1);
  const Given path = line(500, -300, 400, 500);
  give(kFeeder, AxisService::MoveVelocity, 0, 100);
  ASSERT_TRUE(until([&] { return way > 250; }));
  const double turned = cell.out.command[kAt];
  give(kFeeder, AxisService::MoveVelocity, 0, -100);
  ASSERT_TRUE(until([&] { return cell.out.command[kAt] < turned - 30; }));
  const double waits = way;
  ASSERT_TRUE(until([&] { return cell.out.command[kAt] < turned - 60; }));
  EXPECT_EQ(way, waits);
  EXPECT_FALSE(reached(sut));
  give(kFeeder, AxisService::MoveVelocity, 0, 100);
  ASSERT_TRUE(until([&] { return cell.out.command[kAt] > turned - 20; }));
  EXPECT_NEAR(way, waits, 1e-6);
  ASSERT_TRUE(until([&] { return way > waits + 30; }));
  EXPECT_TRUE(reached(sut));
  EXPECT_FALSE(ended(path));
}

TEST_F(FollowMaster, Is_no_faster_than_planned_and_lags_or_fails) {
  const Given sut = lead(1);
  const Given path = line(500, 0, 400, 50);
  const Given fast = give(kFeeder, AxisService::MoveVelocity, 0, 1000);
  ASSERT_TRUE(until([&] {
    EXPECT_LE(gone, 0.5 * 1.001);
    return ended(path);
  }));
  EXPECT_EQ(state(path), CommandState::Done);
  EXPECT_FALSE(reached(sut));
  EXPECT_EQ(state(fast), CommandState::Active);
  const Given strict = lead(1, 1, 30);
  const Given again = line(500, -300, 400, 50);
  ASSERT_TRUE(until([&] { return ended(strict); }));
  EXPECT_EQ(state(sut), CommandState::Aborted);
  EXPECT_EQ(error(strict), ErrorCode::Speed);
  EXPECT_EQ(error(again), ErrorCode::Speed);
  ASSERT_TRUE(until([&] { return cell.out.state == GroupState::ErrorStop; }));
  EXPECT_THAT(cell.out.job.message, testing::HasSubstr("cannot keep up"));
}

TEST_F(FollowMaster, A_hold_is_not_made_up_for) {
  lead(1);
  line(500, -300, 400, 500);
  give(kFeeder, AxisService::MoveVelocity, 0, 100);
  ASSERT_TRUE(until([&] { return way > 100; }));
  const double lag = cell.out.command[kAt] - way;
  cell.in.factors.group = 0;
  ASSERT_TRUE(until([&] { return gone == 0; }));
  const double held = cell.out.command[kAt];
  ASSERT_TRUE(until([&] { return cell.out.command[kAt] > held + 100; }));
  cell.in.factors.group = 1;
  const double missed = cell.out.command[kAt] - way - lag;
  const double from = way;
  ASSERT_TRUE(until([&] { return way > from + 100; }));
  EXPECT_NEAR(cell.out.command[kAt] - way - lag, missed, 10);
}

TEST_F(FollowMaster, Stops_if_the_master_is_lost) {
  const Given sut = lead(1);
  const Given path = line(500, -300, 400, 500);
  give(kFeeder, AxisService::MoveVelocity, 0, 100);
  ASSERT_TRUE(until([&] { return way > 100; }));
  cell.in.drives[kAt].status = Cell::kFault;
  ASSERT_TRUE(until([&] { return cell.out.state == GroupState::ErrorStop; }));
  EXPECT_EQ(error(sut), ErrorCode::Master);
  EXPECT_EQ(error(path), ErrorCode::Master);
  EXPECT_THAT(cell.out.job.message, testing::HasSubstr("is lost"));
}

TEST_F(FollowMaster, Follows_a_belt_until_that_jumps) {
  for (int i = 0; i < 60; ++i) {
    step_with_belt(0);
  }
  const Given sut = lead_by_belt(0.5);
  line(500, -300, 400, 500);
  for (int i = 0; i < 300; ++i) {
    step_with_belt(100);
  }
  EXPECT_TRUE(reached(sut));
  EXPECT_NEAR(gone, 0.5, 0.01);
  cell.in.belts[0].place += 300;
  for (int i = 0; i < 100; ++i) {
    step_with_belt(100);
  }
  EXPECT_EQ(error(sut), ErrorCode::Belt);
  EXPECT_EQ(cell.out.state, GroupState::ErrorStop);
}

TEST_F(FollowMaster, Ends_with_a_halt_and_a_stop) {
  const Given sut = lead(1);
  line(500, -300, 400, 500);
  give(kFeeder, AxisService::MoveVelocity, 0, 100);
  ASSERT_TRUE(until([&] { return way > 100; }));
  const Given halt = give(Service::Halt);
  ASSERT_TRUE(until([&] { return ended(sut); }));
  EXPECT_EQ(state(sut), CommandState::Aborted);
  EXPECT_EQ(state(halt), CommandState::Done);
  EXPECT_LT(gone, 1e-9);
  const Given free = line(500, 100, 400, 500);
  ASSERT_TRUE(until([&] { return ended(free); }, 400)) << "follows nothing";
  const Given other = lead(1);
  line(500, -300, 400, 500);
  ASSERT_TRUE(until([&] { return gone > 0.9; }));
  give(Service::Stop);
  step();
  EXPECT_TRUE(until([&] { return state(other) == CommandState::Aborted; }, 2));
}

TEST_F(FollowMaster, Rejects_what_makes_no_sense) {
  const auto rejected = [&](const Given& given, ErrorCode code) {
    step();
    EXPECT_EQ(error(given), code);
  };
  rejected(lead(1, 0), ErrorCode::Value);
  rejected(lead(0), ErrorCode::Value);
  rejected(lead(1, 1, -1), ErrorCode::Value);
  Given of_arm = lead(1);
  command(of_arm).option = 2;
  rejected(of_arm, ErrorCode::Value);
  rejected(lead_by_belt(1), ErrorCode::Belt);
  Given both = lead(1);
  command(both).job = 1;
  rejected(both, ErrorCode::Value);
  ASSERT_TRUE(done(give(kFeeder, AxisService::PowerOff)));
  rejected(lead(1), ErrorCode::Master);
}

// A master that stands, runs at up to full speed, turns back, jumps (a belt) and is lost, while motions are given,
// held, slowed down and stopped.
class RandomMaster : public SyncedCell {
 public:
  RandomMaster(unsigned seed, double period_ms)
      : SyncedCell(period_ms), random_(seed), seconds_(period_ms / 1000), between_(static_cast<int>(250 / period_ms)) {}

  void run(int many) {
    ASSERT_TRUE(start());
    ASSERT_TRUE(go_to_begin());
    for (int i = 0; i < many && !testing::Test::HasFailure(); ++i) {
      if (one_of(between_) == 0) {
        act();
      }
      belt_speed_ += std::clamp(speed_ - belt_speed_, -seconds_ * 500, seconds_ * 500);
      belt_ += seconds_ * belt_speed_;
      cell.in.belts[0].place = belt_;
      cell.in.belts[0].beat += silent_ ? 0 : 1;
      step();
      in_step += sut_.number != 0 && state(sut_) == CommandState::Active && reached(sut_) && gone > 0 ? 1 : 0;
      if (cell.out.state == GroupState::ErrorStop) {
        ++stops;
        EXPECT_THAT(cell.out.error,
                    testing::AnyOf(ErrorCode::Belt, ErrorCode::Master, ErrorCode::Speed, ErrorCode::State))
            << "no other fault, above all none that the last gate found; " << cell.out.job.message;
        ASSERT_TRUE(reset_group());
        silent_ = false;
      }
    }
  }
  long in_step = 0;
  int stops = 0;

 private:
  int one_of(int many) { return std::uniform_int_distribution<int>(0, many - 1)(random_); }
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  void act() {
    switch (one_of(16)) {
      case 0:
        cell.in.hold = one_of(3) == 0;
        break;
      case 1:
        cell.in.speed_override = one_of(3) == 0 ? in(0, 120) : 100;
        break;
      case 2:
        give(Service::Halt);
        break;
      case 3:
      case 4:
      case 5:
      case 6:
        line(in(400, 550), in(-200, 200), in(300, 450), in(50, 800), BufferMode::BlendingLow, in(0, 60));
        break;
      case 7:
        give(Service::DirectAbsolute, {in(-30, 30), in(0, 30), in(-40, -10), in(-20, 20), in(50, 90), in(-60, 60)},
             in(5, 100), one_of(2) == 0 ? BufferMode::Aborting : BufferMode::Buffered);
        break;
      case 8:
      case 9:
      case 10: {
        const bool belt = one_of(2) == 0;
        sut_ =
            give(Service::FollowMaster, {in(0.1, 2) * (one_of(6) == 0 ? -1 : 1), 1, one_of(3) == 0 ? in(20, 300) : 0});
        command(sut_).option = belt ? 0 : kFeeder;
        command(sut_).job = belt ? 1 : 0;
        break;
      }
      case 11:
        belt_ += one_of(3) == 0 ? in(-300, 300) : 0;
        silent_ = one_of(5) == 0;
        break;
      default:
        speed_ = in(-200, 500);
        give(kFeeder, AxisService::MoveVelocity, 0, one_of(8) == 0 ? in(-10000, 10000) : in(-200, 800));
    }
  }

  std::mt19937 random_;
  double seconds_;
  int between_;
  Given sut_;
  double speed_ = 0, belt_speed_ = 0, belt_ = 0;
  bool silent_ = false;
};

TEST(RandomFollowMaster, Breaks_no_limit_whatever_the_master_does) {
  const long runs = number_of("INDUROP_ROBOT_SYNCS", 20);
  const long first = number_of("INDUROP_ROBOT_SEED", 1);
  long in_step = 0;
  int stops = 0;
  for (long i = first; i < first + runs && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(fmt::format("INDUROP_ROBOT_SEED={}", i));
    RandomMaster sut(static_cast<unsigned>(i), std::array{10.0, 4.0, 1.0}[static_cast<std::size_t>(i) % 3]);
    sut.run(4000);
    in_step += sut.in_step;
    stops += sut.stops;
  }
  fmt::print("in step for {} periods; stopped by its master {} times\n", in_step, stops);
  EXPECT_GT(in_step, runs * 20);
}

}  // namespace
}  // namespace indurop::robot
