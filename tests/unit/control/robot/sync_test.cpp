// SPDX-License-Identifier: Apache-2.0
// Axes that come into gear at a place, that follow two others, and whose master is shifted: as the standard has it, and
// by random commands, with no set point beyond a limit. INDUROP_ROBOT_GEARS says how many random runs,
// INDUROP_ROBOT_SEED from which one on.

#include <optional>

#include "follow_cell.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

struct Meeting {
  double master = 0, slave = 0, distance = 0, numerator = 1, denominator = 1;
};

class SyncCell : public FollowCell {
 public:
  using FollowCell::FollowCell;

 protected:
  Given meet(int slave, int master, const Meeting& at) {
    const Given given = give(slave, AxisService::GearInPos);
    command(given).option = static_cast<std::int16_t>(master);
    command(given).to = {at.numerator, at.denominator, at.master, at.slave, at.distance};
    return given;
  }
  Given combine(int slave, int first, int second, double one, double two) {
    const Given given = give(slave, AxisService::Combine);
    command(given).option = static_cast<std::int16_t>(first);
    command(given).job = static_cast<std::int16_t>(second);
    command(given).to = {one, 1, two, 1};
    return given;
  }
  Given shift(int slave, int master, double by, bool relative, double velocity = 0) {
    const Given given = give(slave, AxisService::ShiftMaster, by, velocity);
    command(given).option = static_cast<std::int16_t>(master);
    command(given).job = relative ? 1 : 0;
    return given;
  }
};

class Meetings : public SyncCell {};

TEST_F(Meetings, The_follower_is_in_gear_where_both_were_to_meet) {
  give(1, AxisService::MoveVelocity, 0, 20);
  const Given in = meet(2, 1, {.master = 40, .slave = 10, .distance = 20, .numerator = -1, .denominator = 2});
  step();
  EXPECT_EQ(state(in), CommandState::Active);
  EXPECT_EQ(axis(1), AxisState::SynchronizedMotion);
  for (int i = 0; i < 3000 && joint(0) < 80 && !HasFailure(); ++i) {
    if (joint(0) < 20) {
      EXPECT_EQ(joint(1), 0) << "the master is not there yet";
    }
    EXPECT_EQ(reached(in), joint(0) >= 40);
    if (joint(0) >= 40) {
      EXPECT_NEAR(joint(1) - 10, -(joint(0) - 40) / 2, 1e-9);
    }
    step();
  }
  // Back over the place where they met: it is a gear now.
  give(1, AxisService::MoveAbsolute, 0, 60);
  ASSERT_TRUE(until([&] { return axis(0) == AxisState::Standstill; }));
  EXPECT_NEAR(joint(1), 30, 1e-9);
  EXPECT_TRUE(reached(in));
}

TEST_F(Meetings, A_follower_that_moves_gets_there_as_well) {
  give(1, AxisService::MoveVelocity, 0, 20);
  give(2, AxisService::MoveVelocity, 0, -30);
  ASSERT_TRUE(until([&] { return joint(1) < -10; }));
  const double there = joint(0);
  const Given in = meet(2, 1, {.master = there + 60, .slave = 5});
  ASSERT_TRUE(until([&] { return reached(in); }));
  EXPECT_GE(joint(0), there + 60);
  EXPECT_NEAR(joint(1) - 5, joint(0) - there - 60, 1e-9);
}

TEST_F(Meetings, A_master_that_turns_back_takes_the_follower_with_it) {
  const Given in = meet(2, 1, {.master = 60, .slave = 20});
  ASSERT_TRUE(done(give(1, AxisService::MoveAbsolute, 50, 40)));
  EXPECT_FALSE(reached(in));
  EXPECT_GT(joint(1), 5);
  ASSERT_TRUE(done(give(1, AxisService::MoveAbsolute, 0, 40)));
  EXPECT_NEAR(joint(1), 0, 1e-9);
  ASSERT_TRUE(done(give(1, AxisService::MoveAbsolute, 70, 40)));
  EXPECT_NEAR(joint(1), 30, 1e-9);
  EXPECT_TRUE(reached(in));
}

TEST_F(Meetings, A_way_that_is_too_short_is_an_error_and_it_comes_to_rest) {
  give(1, AxisService::MoveVelocity, 0, 60);
  ASSERT_TRUE(until([&] { return moved(0) > 0.6 - 1e-9; }));
  const Given in = meet(2, 1, {.master = joint(0) + 3, .slave = 30});
  ASSERT_TRUE(until([&] { return ended(in); }));
  EXPECT_TRUE(error(in) == ErrorCode::Speed || error(in) == ErrorCode::Acceleration || error(in) == ErrorCode::Jerk);
  ASSERT_TRUE(until([&] { return axis(1) == AxisState::Standstill; }));
  EXPECT_EQ(axis(0), AxisState::ContinuousMotion);
}

TEST_F(Meetings, Its_own_limits_count_on_the_way) {
  give(1, AxisService::MoveVelocity, 0, 20);
  const Given in = meet(2, 1, {.master = 40, .slave = 30});  // the curve is 1.115 times as fast as its end
  command(in).velocity = 22;
  const Given slow = meet(3, 1, {.master = 40, .slave = -30, .numerator = -1});
  command(slow).velocity = 22.5;
  ASSERT_TRUE(until([&] { return ended(in); }));
  EXPECT_EQ(error(in), ErrorCode::Speed);
  ASSERT_TRUE(until([&] { return reached(slow); }));
}

TEST_F(Meetings, What_cannot_be_is_refused_and_moves_nothing) {
  const std::pair<Given, ErrorCode> all[] = {{meet(2, 1, {.master = 40, .denominator = 0}), ErrorCode::Value},
                                             {meet(2, 1, {.master = std::nan("")}), ErrorCode::Value},
                                             {meet(2, 1, {.master = 40, .distance = -1}), ErrorCode::Value},
                                             {meet(2, 2, {.master = 40}), ErrorCode::Value},
                                             {meet(2, 5, {.master = 40}), ErrorCode::Master},
                                             {meet(2, 1, {.master = 40, .slave = 400}), ErrorCode::JointLimit},
                                             {meet(2, 1, {.master = 0, .slave = 1}), ErrorCode::Speed}};
  for (const auto& [given, code] : all) {
    step();
    EXPECT_EQ(error(given), code) << given.number;
    EXPECT_EQ(moved(1), 0);
  }
  EXPECT_EQ(axis(1), AxisState::Standstill);
}

class Combined : public SyncCell {};

TEST_F(Combined, Each_step_is_that_of_both_together) {
  give(1, AxisService::MoveVelocity, 0, 20);
  give(2, AxisService::MoveVelocity, 0, -15);
  ASSERT_TRUE(until([&] { return joint(0) > 10; }));
  const Given in = combine(3, 1, 2, 1, -0.5);
  step();
  EXPECT_EQ(axis(2), AxisState::SynchronizedMotion);
  ASSERT_TRUE(until([&] { return reached(in); }));
  // Both together are what the follower can do.
  for (const Given& given : {give(1, AxisService::MoveAbsolute, 0, 30), give(2, AxisService::Halt)}) {
    command(given).acceleration = 60;
    command(given).jerk = 600;
  }
  for (int i = 0; i < 300; ++i) {
    step();
    ASSERT_NEAR(moved(2), moved(0) - 0.5 * moved(1), 1e-9);
  }
  EXPECT_EQ(axis(2), AxisState::SynchronizedMotion);
  command(in).to[2] = 0.5;
  ++command(in).updates;
  const Given again = give(2, AxisService::MoveVelocity, 0, 10);
  ASSERT_TRUE(until([&] { return reached(in) && reached(again); }));
  EXPECT_NEAR(moved(2), moved(0) + 0.5 * moved(1), 1e-9);
}

TEST_F(Combined, What_cannot_be_is_refused) {
  const Given itself = combine(2, 1, 2, 1, 1);
  const Given no_master = combine(3, 1, 9, 1, 1);
  const Given no_number = combine(3, 1, 2, 1, std::nan(""));
  step();
  EXPECT_EQ(error(itself), ErrorCode::Value);
  EXPECT_EQ(error(no_master), ErrorCode::Value);
  EXPECT_EQ(error(no_number), ErrorCode::Value);
  const Given good = combine(3, 1, 2, 1, 1);
  const Given round = gear(2, 3, 1);
  step();
  EXPECT_EQ(state(good), CommandState::Active);
  EXPECT_EQ(error(round), ErrorCode::Value) << "it leads axis 3, by way of which it would follow itself";
}

TEST_F(Combined, Either_master_that_fails_is_left) {
  const Given in = combine(3, 1, 2, 1, 1);
  give(1, AxisService::MoveVelocity, 0, 20);
  ASSERT_TRUE(until([&] { return joint(2) > 5; }));
  cell.in.drives[1].status = Cell::kFault;
  step();
  EXPECT_EQ(error(in), ErrorCode::Master);
  ASSERT_TRUE(until([&] { return axis(2) == AxisState::Standstill; }));
}

class Phases : public SyncCell {};

TEST_F(Phases, In_gear_the_follower_goes_on_by_that_times_the_ratio) {
  give(1, AxisService::MoveVelocity, 0, 20);
  const Given in = gear(2, 1, 1, 2);
  ASSERT_TRUE(until([&] { return reached(in); }));
  const double apart = joint(1) - joint(0) / 2;
  const Given on = shift(2, 1, 30, false, 10);
  step();
  EXPECT_EQ(state(on), CommandState::Active);
  double fastest = 0;
  ASSERT_TRUE(until([&] {
    fastest = std::max(fastest, std::abs(moved(1)));
    return ended(on);
  }));
  EXPECT_NEAR(fastest, (20 + 10) / 2.0 / 100, 1e-6);
  EXPECT_EQ(state(on), CommandState::Done);
  EXPECT_NEAR(joint(1) - joint(0) / 2, apart + 15, 1e-9);
  EXPECT_NEAR(cell.out.axes[1].phase, 30, 1e-9);
  ASSERT_TRUE(done(shift(2, 1, -10, true)));
  EXPECT_NEAR(joint(1) - joint(0) / 2, apart + 10, 1e-9);
  ASSERT_TRUE(done(shift(2, 1, 0, false)));
  EXPECT_NEAR(joint(1) - joint(0) / 2, apart, 1e-9);
  EXPECT_TRUE(reached(in));
}

TEST_F(Phases, On_a_cam_the_follower_is_where_the_master_would_be_then) {
  ASSERT_TRUE(done(select(1, {{0, 0}, {20, 15}, {40, 0}}, true)));
  const Given in = cam(2, 1, 1, {});
  ASSERT_TRUE(until([&] { return reached(in); }));
  ASSERT_TRUE(done(shift(2, 1, 20, false, 20)));
  EXPECT_NEAR(joint(1), 15, 1e-9);
  ASSERT_TRUE(done(give(1, AxisService::MoveAbsolute, 20, 20)));
  EXPECT_NEAR(joint(1), 0, 1e-9);
  EXPECT_TRUE(reached(in));
}

TEST_F(Phases, A_later_one_takes_over_from_where_it_is) {
  gear(2, 1, 1);
  const Given far = (step(), shift(2, 1, 40, false, 20));
  ASSERT_TRUE(until([&] { return joint(1) > 10; }));
  const Given back = shift(2, 1, 5, false, 20);
  step();
  EXPECT_EQ(state(far), CommandState::Aborted);
  ASSERT_TRUE(done(back));
  EXPECT_NEAR(joint(1), 5, 1e-9);
}

TEST_F(Phases, The_fastest_waits_for_room) {
  give(1, AxisService::MoveVelocity, 0, 60);
  const Given in = gear(2, 1, 1);
  ASSERT_TRUE(until([&] { return reached(in); }));
  const double apart = joint(1) - joint(0);
  const Given on = shift(2, 1, 10, false);
  give(1, AxisService::MoveVelocity, 0, 20);
  ASSERT_TRUE(done(on));
  EXPECT_NEAR(joint(1) - joint(0), apart + 10, 1e-9);
}

TEST_F(Phases, A_hold_stops_it_and_it_goes_on) {
  const Given in = gear(2, 1, 1);
  const Given on = (step(), shift(2, 1, 20, false, 20));
  ASSERT_TRUE(until([&] { return joint(1) > 8; }));
  cell.in.hold = true;
  ASSERT_TRUE(until([&] { return moved(1) == 0; }));
  EXPECT_LT(joint(1), 19);
  EXPECT_EQ(state(on), CommandState::Active);
  cell.in.hold = false;
  ASSERT_TRUE(done(on));
  EXPECT_NEAR(joint(1), 20, 1e-9);
  EXPECT_TRUE(reached(in));
}

TEST_F(Phases, What_cannot_be_is_refused) {
  const Given free = shift(2, 1, 10, false);
  step();
  EXPECT_EQ(error(free), ErrorCode::State) << "it has no master";
  gear(2, 1, 1);
  step();
  const Given other = shift(2, 3, 10, false);
  const Given no_number = shift(2, 1, std::nan(""), false);
  const Given huge = shift(2, 1, 1e9, false);
  const Given slow = shift(2, 1, 1, false, -1);
  step();
  EXPECT_EQ(error(other), ErrorCode::Value);
  EXPECT_EQ(error(no_number), ErrorCode::Value);
  EXPECT_EQ(error(huge), ErrorCode::Value);
  EXPECT_EQ(error(slow), ErrorCode::Value);
  const Given on_top = give(2, AxisService::MoveSuperimposed, 10, 10);
  const Given meanwhile = shift(2, 1, 1, false);
  step();
  EXPECT_EQ(error(meanwhile), ErrorCode::State);
  ASSERT_TRUE(done(on_top));
  combine(2, 1, 3, 1, 1);
  step();
  const Given of_two = shift(2, 1, 1, false);
  step();
  EXPECT_EQ(error(of_two), ErrorCode::Value);
}

// The sum of its commands, checked from outside: while a follower says that it is in sync, it is where the last
// of its commands says, whatever was on top of it.
class RandomSync : public SyncCell {
 public:
  RandomSync(unsigned seed, double period_ms) : SyncCell(period_ms), random_(seed) {}
  void TestBody() override {}
  void run(int periods) {
    power_on({1, 2, 3});
    for (int i = 0; i < periods && !HasFailure(); ++i) {
      if (one_of(60) == 0) {
        act();
      }
      const bool was = in_sync();
      step();
      if (was && in_sync()) {
        ++synced_;
        ASSERT_NEAR(moved(2), one_ * moved(0) + two_ * moved(1), 3e-8) << "period " << i;
        if (meeting_ && shifts_.empty()) {
          ASSERT_NEAR(joint(2) - meeting_->slave, one_ * (joint(0) - meeting_->master), 1e-6) << "period " << i;
        }
      }
      check_shift();
      ASSERT_NE(cell.out.state, GroupState::ErrorStop) << "period " << i;
    }
  }
  [[nodiscard]] long synced() const { return synced_; }
  [[nodiscard]] long shifted() const { return shifted_; }

 private:
  int one_of(int many) { return std::uniform_int_distribution<int>(0, many - 1)(random_); }
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  [[nodiscard]] bool in_sync() const { return state(in_) == CommandState::Active && reached(in_); }
  void softly(const Given& given) {
    Command& c = command(given);
    c.acceleration = in(30, 900);
    c.deceleration = in(30, 900);
    c.jerk = in(500, 9000);
  }
  void follow(const Given& given, double one, double two) {
    in_ = given;
    one_ = one;
    two_ = two;
    meeting_ = {};
    shifts_.clear();
  }
  void act() {
    switch (one_of(9)) {
      case 0:
      case 1:
        softly(give(one_of(2) + 1, AxisService::MoveAbsolute, in(-80, 80), in(5, 120)));
        break;
      case 2:
        softly(give(one_of(2) + 1, AxisService::MoveVelocity, 0, in(-40, 40)));
        break;
      case 3: {
        const double one = in(-1, 1);
        const double two = in(-1, 1);
        follow(combine(3, 1, 2, one, two), one, two);
        softly(in_);
        break;
      }
      case 4: {
        const double ratio = in(-1.2, 1.2);
        follow(gear(3, 1, ratio), ratio, 0);
        softly(in_);
        break;
      }
      case 5: {
        const Meeting at{joint(0) + in(-40, 40), in(-40, 20), one_of(2) * in(5, 40), in(-1, 1), 1};
        follow(meet(3, 1, at), at.numerator, 0);
        meeting_ = at;
        break;
      }
      case 6:
        if (two_ == 0) {
          shifts_.push_back(shift(3, 1, in(-20, 20), one_of(2) == 0, one_of(2) * in(5, 60)));
          apart_ = in_sync() ? joint(2) - one_ * joint(0) - one_ * cell.out.axes[2].phase : std::nan("");
        }
        break;
      case 7:
        softly(give(3, one_of(2) == 0 ? AxisService::Decouple : AxisService::MoveAbsolute, in(-60, 40), in(5, 100)));
        break;
      default:
        command(give(3, AxisService::Stop)).execute = 0;
    }
  }
  // What is between both is what the phase says, once it is done.
  void check_shift() {
    if (shifts_.size() == 1 && state(shifts_.back()) == CommandState::Done && in_sync() && !std::isnan(apart_)) {
      ++shifted_;
      ASSERT_NEAR(joint(2) - one_ * joint(0) - one_ * cell.out.axes[2].phase, apart_, 1e-6);
    }
  }

  std::mt19937 random_;
  Given in_;
  std::optional<Meeting> meeting_;
  std::vector<Given> shifts_;
  double one_ = 0, two_ = 0, apart_ = 0;
  long synced_ = 0, shifted_ = 0;
};

TEST(RandomSyncs, Break_no_limit_and_are_exact) {
  const long runs = number_of("INDUROP_ROBOT_GEARS", 40);
  const long first = number_of("INDUROP_ROBOT_SEED", 1);
  long synced = 0;
  long shifted = 0;
  for (long i = first; i < first + runs && !HasFailure(); ++i) {
    SCOPED_TRACE(fmt::format("INDUROP_ROBOT_SEED={}", i));
    RandomSync sut(static_cast<unsigned>(i), i % 2 == 0 ? 10 : 4);
    sut.run(4000);
    synced += sut.synced();
    shifted += sut.shifted();
  }
  EXPECT_GT(synced, runs * 100);
  EXPECT_GT(shifted, runs);
}

}  // namespace
}  // namespace indurop::robot
