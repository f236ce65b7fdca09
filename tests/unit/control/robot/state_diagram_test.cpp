// SPDX-License-Identifier: Apache-2.0
// Random commands against the state diagrams of PLCopen Motion Control, part 1 (figure of the axis) and part 4 (figure
// of the group), written down here separately: each state is one that may follow, each command ends once and as its
// state allows, and no set point breaks a limit. INDUROP_ROBOT_DIAGRAMS says how many runs, INDUROP_ROBOT_SEED from
// which one on.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <set>
#include <vector>

#include "command_cell.h"
#include "heavy_arm.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

// What may follow in the next period, whatever caused it. A motion may end and another one begin in the same period, so
// that the state between them is not seen.
bool may_follow(AxisState from, AxisState to) {
  using enum AxisState;
  static const std::set<std::pair<AxisState, AxisState>> kArrows = {
      {Disabled, Standstill},
      {Disabled, ErrorStop},
      {Standstill, Homing},
      {Standstill, DiscreteMotion},
      {Standstill, ContinuousMotion},
      {Standstill, Stopping},
      {Homing, Standstill},
      {Homing, Stopping},
      {Homing, DiscreteMotion},    // over Standstill
      {Homing, ContinuousMotion},  // over Standstill
      {DiscreteMotion, Standstill},
      {DiscreteMotion, ContinuousMotion},
      {DiscreteMotion, Stopping},
      {DiscreteMotion, Homing},  // over Standstill
      {ContinuousMotion, DiscreteMotion},
      {ContinuousMotion, Stopping},
      {ContinuousMotion, Standstill},  // power is taken away at rest
      {Standstill, SynchronizedMotion},
      {DiscreteMotion, SynchronizedMotion},
      {ContinuousMotion, SynchronizedMotion},
      {Homing, SynchronizedMotion},  // over Standstill
      {SynchronizedMotion, DiscreteMotion},
      {SynchronizedMotion, ContinuousMotion},
      {SynchronizedMotion, Stopping},
      {SynchronizedMotion, Standstill},  // a motion that has nothing to do
      {Stopping, Standstill},
      {ErrorStop, Standstill},
      {ErrorStop, Disabled},
  };
  return from == to || to == Disabled || to == ErrorStop || kArrows.contains({from, to});
}

bool may_follow(GroupState from, GroupState to) {
  using enum GroupState;
  static const std::set<std::pair<GroupState, GroupState>> kArrows = {
      {Disabled, Standby},  {Standby, Moving},     {Standby, Homing},   {Standby, Stopping}, {Moving, Standby},
      {Moving, Stopping},   {Homing, Standby},     {Homing, Stopping},  {Stopping, Standby}, {Stopping, Disabled},
      {ErrorStop, Standby}, {ErrorStop, Disabled}, {Standby, Disabled}, {Moving, Disabled},  // which stands
      {Disabled, Stopping},  // an emergency while it gets power
  };
  return from == to || to == ErrorStop || kArrows.contains({from, to});
}

// Whether a command that is given in this state may be carried out at all.
bool accepts(AxisState state, AxisService service) {
  using enum AxisState;
  switch (service) {
    case AxisService::Home:
      return state == Standstill;
    case AxisService::MoveAbsolute:
    case AxisService::MoveRelative:
    case AxisService::MoveAdditive:
    case AxisService::MoveVelocity:
    case AxisService::MoveContinuousAbsolute:
    case AxisService::MoveContinuousRelative:
    case AxisService::PositionProfile:
    case AxisService::VelocityProfile:
    case AxisService::AccelerationProfile:
    case AxisService::TorqueControl:
    case AxisService::Halt:
    case AxisService::GearIn:
    case AxisService::GearInPos:
    case AxisService::CamIn:
    case AxisService::Combine:
    case AxisService::MoveSuperimposed:
      return state == Standstill || state == DiscreteMotion || state == ContinuousMotion || state == SynchronizedMotion;
    case AxisService::Decouple:
    case AxisService::ShiftMaster:
      return state == SynchronizedMotion;
    case AxisService::HaltSuperimposed:
      return state == DiscreteMotion || state == ContinuousMotion || state == SynchronizedMotion;
    case AxisService::Stop:
      return state != Disabled && state != ErrorStop;
    default:
      return true;
  }
}

bool accepts(GroupState state, Service service) {
  using enum GroupState;
  switch (service) {
    case Service::GroupHome:
      return state == Standby;
    case Service::DirectAbsolute:
    case Service::LinearAbsolute:
    case Service::Halt:
      return state == Standby || state == Moving;
    case Service::Interrupt:
    case Service::Continue:
      return state == Moving;
    case Service::Stop:
      return state == Standby || state == Moving || state == Homing || state == Stopping;
    default:
      return true;
  }
}

class Diagram : public CommandCell {
 public:
  explicit Diagram(unsigned seed, const std::string& urdf = "") : CommandCell(10, in_tick(), urdf), random_(seed) {}
  static Settings in_tick() {
    Settings settings;
    settings.plan_in_tick = true;
    settings.rated_torque = {400, 400, 200, 60, 50, 30};
    return settings;
  }

 protected:
  struct Watched {
    Given given;
    bool may = true;  // be carried out, by the diagram
    std::string name;
    CommandState last = CommandState::None;
  };
  int one_of(int many) { return std::uniform_int_distribution<int>(0, many - 1)(random_); }
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  BufferMode any_mode() { return static_cast<BufferMode>(one_of(2) == 0 ? 0 : one_of(6)); }

  void watch(const Given& given, bool may, std::string name) { watched_.push_back({given, may, std::move(name)}); }
  // Answers go forward only, and what the diagram forbids is refused.
  void check_answers() {
    for (Watched& w : watched_) {
      const CommandState now = state(w.given);
      if (now == CommandState::None) {
        continue;  // its place has another one
      }
      const bool ended = w.last >= CommandState::Done;
      const bool stopped = w.last == CommandState::Done && now == CommandState::Aborted;  // a stop that was held
      EXPECT_TRUE(!ended || now == w.last || stopped) << w.name;
      EXPECT_TRUE(w.may || (now == CommandState::Error && error(w.given) != ErrorCode::Ok)) << w.name << " was taken";
      w.last = now;
    }
  }
  void release_stops() {
    for (Command& c : cell.in.commands) {
      if (one_of(20) == 0) {
        c.execute = 0;
      }
    }
  }
  // Differences between set points.
  void check_limits() {
    for (std::size_t i = 0; i < 6; ++i) {
      const double p = cell.out.command[i];
      const double v = (p - place_[i]) / 0.01;
      const double most = cell.out.axes[i].most_velocity;
      const bool follows = (cell.in.drives[i].status & 0x6FU) == 0x27 && cell.in.drives[i].mode == 8;
      known_[i] = follows ? known_[i] + 1 : 0;
      if (known_[i] > 2) {
        EXPECT_LE(std::abs(v), most * 1.001) << "axis " << i + 1;
        EXPECT_LE(std::abs(v - speed_[i]) / 0.01, cell.out.axes[i].most_acceleration * 1.501) << "axis " << i + 1;
      }
      place_[i] = p;
      speed_[i] = v;
    }
  }

  std::mt19937 random_;
  std::vector<Watched> watched_;

 private:
  std::array<double, 6> place_{}, speed_{};
  std::array<int, 6> known_{};  // periods since the drive follows
};

class AxisDiagram : public Diagram {
 public:
  // With masses, so that it can push with a torque.
  explicit AxisDiagram(unsigned seed) : Diagram(seed, heavy_cell_arm(joints_of({400, 400, 200, 60, 50, 30})).urdf) {}
  void run(int periods) {
    AxisState before = axis(0);
    for (int i = 0; i < periods && !testing::Test::HasFailure(); ++i) {
      const bool given = one_of(15) == 0;
      if (given) {
        give_one();
      }
      release_stops();
      if (one_of(800) == 0) {
        cell.in.drives[0].status = Cell::kFault;
      }
      cell.step();
      EXPECT_TRUE(may_follow(before, axis(0)))
          << "from " << static_cast<int>(before) << " to " << static_cast<int>(axis(0));
      before = axis(0);
      followed_ += before == AxisState::SynchronizedMotion ? 1 : 0;
      pushed_ += cell.out.drives[0].mode == 10 ? 1 : 0;
      check_answers();
      check_limits();
    }
  }

  [[nodiscard]] long followed() const { return followed_; }
  [[nodiscard]] long pushed() const { return pushed_; }

 private:
  long followed_ = 0;  // so many periods
  long pushed_ = 0;
  void give_one() {
    using enum AxisService;
    static constexpr AxisService kAll[] = {
        PowerOn, PowerOn, PowerOn,  MoveAbsolute, MoveAbsolute, MoveRelative, MoveAdditive, Halt,        MoveVelocity,
        Stop,    Reset,   Home,     GearIn,       GearIn,       GearInPos,    CamIn,        Combine,     ShiftMaster,
        Reset,   Stop,    Decouple, Decouple,     TouchProbe,   AbortTrigger, ShiftMaster,  MoveRelative};
    static constexpr AxisService kMore[] = {MoveContinuousAbsolute, MoveContinuousRelative, PositionProfile,
                                            VelocityProfile,        AccelerationProfile,    WriteParameter,
                                            TorqueControl};
    constexpr int kMany = std::size(kAll);
    if (one_of(4) == 0) {
      move_masters();
      return;
    }
    const int pick = one_of(5 * kMany + 10);
    const AxisService other = pick < 5 * kMany ? kAll[pick % kMany] : pick % 2 == 0 ? PowerOff : MoveSuperimposed;
    const AxisService service = one_of(5) == 0 ? kMore[one_of(7)] : other;
    const bool at_once = service == ShiftMaster || service == MoveSuperimposed;
    const BufferMode mode = at_once ? BufferMode::Aborting : any_mode();
    const Given given = give(1, service, in(-100, 100), in(5, 150), mode);
    follow(command(given), service);
    // Buffered ones wait for their turn; whether the state allows them is seen then.
    const bool may = accepts(axis(0), service) || (mode != BufferMode::Aborting && axis(0) == AxisState::Homing) ||
                     (mode != BufferMode::Aborting && service == Home && accepts(axis(0), Halt));
    watch(given, may || faulty_now(), fmt::format("service {}", static_cast<int>(service)));
  }
  // Axes 2 and 3, which axis 1 follows.
  void move_masters() {
    using enum AxisService;
    const int which = one_of(2) + 2;
    if (cell.out.axes[static_cast<std::size_t>(which - 1)].state == AxisState::Disabled) {
      give(which, PowerOn);
    } else {
      give(which, one_of(2) == 0 ? MoveAbsolute : MoveVelocity, in(-50, 20), in(5, 60));
    }
    if (one_of(4) == 0) {
      CamTable& table = cell.in.cams[0];
      table.points = 3;
      table.master = {-40, 0, 40};
      table.slave = {in(-30, 30), in(-30, 30), in(-30, 30)};
      Command& c = next();
      c.code = static_cast<std::int32_t>(Service::SelectCam);
      c.option = 1;
    }
  }
  void follow(Command& c, AxisService service) {
    c.option = static_cast<std::int16_t>(one_of(2) + 2);
    c.job = service == AxisService::Combine ? 2 : 1;
    switch (service) {
      case AxisService::GearIn:
      case AxisService::Combine:
        c.to = {in(-1, 1), 1, in(-1, 1), 1};
        break;
      case AxisService::GearInPos:
        c.to = {in(-1, 1), 1, in(-50, 20), in(-60, 60), one_of(2) * in(5, 40)};
        c.velocity = 0;
        break;
      case AxisService::MoveContinuousAbsolute:
      case AxisService::MoveContinuousRelative:
        c.option = 0;
        c.to[1] = one_of(5) == 0 ? 0 : in(-60, 60);
        break;
      case AxisService::TorqueControl:
        c.option = 0;
        c.to[1] = one_of(2) * in(10, 1000);
        break;
      case AxisService::WriteParameter:
        c.option = static_cast<std::int16_t>(2 + one_of(16));
        break;
      case AxisService::CamIn:
        c.to = {0, 0, 1, 1};
        c.aux = {1, 1};
        break;
      case AxisService::PositionProfile:
      case AxisService::VelocityProfile:
      case AxisService::AccelerationProfile:
        c.to = {1, 1, 0};
        c.option = 1;
        write_table(cell.in.profiles[0], service == AxisService::PositionProfile ? 20 : 60);
        cell.in.profiles[0].command = c.number;
        break;
      case AxisService::TouchProbe:
        c.option = c.job = 0;
        break;
      default:
        if (service != AxisService::ShiftMaster) {
          c.option = 0;
        }
    }
  }
  void write_table(ProfileTable& table, double most) {
    table.points = 2;
    table.time = {in(0.3, 1), in(1.2, 2)};
    table.value = {in(-most, most), in(-most, most)};
  }
  // The next answer of the drive is not known when the command is given.
  [[nodiscard]] bool faulty_now() const { return axis(0) == AxisState::Disabled && cell.in.drives[0].status == 0x27; }
};

class GroupDiagram : public Diagram {
 public:
  using Diagram::Diagram;
  void run(int periods) {
    GroupState before = cell.out.state;
    for (int i = 0; i < periods && !testing::Test::HasFailure(); ++i) {
      if (one_of(20) == 0) {
        give_one();
      }
      release_stops();
      cell.in.emergency = one_of(600) == 0 || (cell.in.emergency && one_of(20) != 0);
      cell.step();
      EXPECT_TRUE(may_follow(before, cell.out.state))
          << "from " << static_cast<int>(before) << " to " << static_cast<int>(cell.out.state);
      before = cell.out.state;
      check_answers();
      check_limits();
    }
  }

 private:
  void give_one() {
    using enum Service;
    static constexpr Service kAll[] = {GroupEnable,    GroupEnable,    DirectAbsolute, DirectAbsolute,
                                       LinearAbsolute, LinearAbsolute, Halt,           Stop,
                                       GroupReset,     Interrupt,      Continue,       GroupHome};
    const int pick = one_of(60);
    const Service service = pick < 58 ? kAll[pick % 12] : GroupDisable;
    const BufferMode mode = any_mode();
    Given given;
    if (service == LinearAbsolute) {
      given = give(service, {in(350, 600), in(-250, 250), in(250, 500), 180, 0, 180}, in(100, 600), mode,
                   CoordSystem::Machine, one_of(2) * 40);
    } else {
      given = give(service, {in(-60, 60), in(-20, 40), in(-40, 20), in(-30, 30), in(30, 90), in(-90, 90)}, in(20, 100),
                   mode);
    }
    watch(given, accepts(cell.out.state, service), fmt::format("service {}", static_cast<int>(service)));
  }
};

TEST(StateDiagram, Of_an_axis_by_random_commands) {
  const long runs = number_of("INDUROP_ROBOT_DIAGRAMS", 40);
  const long first = number_of("INDUROP_ROBOT_SEED", 1);
  long followed = 0;
  long pushed = 0;
  for (long i = first; i < first + runs && !HasFailure(); ++i) {
    SCOPED_TRACE(fmt::format("INDUROP_ROBOT_SEED={}", i));
    AxisDiagram sut(static_cast<unsigned>(i));
    sut.run(4000);
    followed += sut.followed();
    pushed += sut.pushed();
  }
  EXPECT_GT(followed, runs * 100);
  EXPECT_GT(pushed, runs * 20);
}

TEST(StateDiagram, Of_the_group_by_random_commands) {
  const long runs = number_of("INDUROP_ROBOT_DIAGRAMS", 10);
  const long first = number_of("INDUROP_ROBOT_SEED", 1);
  for (long i = first; i < first + runs && !HasFailure(); ++i) {
    SCOPED_TRACE(fmt::format("INDUROP_ROBOT_SEED={}", i));
    GroupDiagram(static_cast<unsigned>(i)).run(3000);
  }
}

}  // namespace
}  // namespace indurop::robot
