// SPDX-License-Identifier: Apache-2.0
// Hands that push anyhow, also violently, against several arms: with holds, overrides, released switches, changed
// modes, emergency stops, drives that fail and payloads that change. No set point breaks a limit of a joint, neither
// the tip nor the arm's end is faster than 250 mm/s, and neither is in a forbidden zone or outside of the workspace, as
// orocos-kdl places them. INDUROP_ROBOT_HANDS says how many runs, INDUROP_ROBOT_SEED from which one on.
#include <fmt/core.h>

#include <memory>
#include <optional>

#include "guided_cell.h"
#include "limit_judge.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

struct Bounds {
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();
  [[nodiscard]] bool contains(const Vec3& p, double more) const {
    return ((p - lower).array() > -more).all() && ((upper - p).array() > -more).all();
  }
  [[nodiscard]] std::string text() const {
    const Vec3 a = 1000 * lower;
    const Vec3 b = 1000 * upper;
    return fmt::format("{} {} {} {} {} {}", a.x(), a.y(), a.z(), b.x(), b.y(), b.z());
  }
};

class RandomHand {
 public:
  explicit RandomHand(unsigned seed)
      : random_(seed), sut_(any_setup(seed)), judge_(sut_->period, sut_->setup.arm.urdf) {}

  void run() {
    if (!sut_->enable()) {
      ADD_FAILURE() << to_string(sut_->cell.out.error);
      return;
    }
    if (with_tool_) {
      sut_->cell.in.service.tool = 1;
      sut_->cell.ask(Service::SelectTool);
      sut_->run(0.1);
    }
    for (int k = 0; k < 4; ++k) {
      step();
    }
    sut_->press();
    for (int i = 0; i < 5 / sut_->period && !testing::Test::HasFailure(); ++i) {
      if (in(0, 1) < sut_->period / 0.3) {
        push();
      }
      if (in(0, 1) < sut_->period / 0.8) {
        disturb();
      }
      tremble();
      step();
      look();
    }
  }
  double fastest = 0;  // m/s
  double nearest = 1;  // m from the zone
  long guided = 0, stopped = 0;
  long periods = 0;

 private:
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool one_in(int many) { return std::uniform_int_distribution<int>(0, many - 1)(random_) == 0; }
  Vec3 any(double far) { return {in(-far, far), in(-far, far), in(-far, far)}; }

  std::unique_ptr<GuidedCell> any_setup(unsigned seed) {
    static constexpr double kPeriods[] = {0.002, 0.004, 0.01};
    GuidedCell::Setup setup = GuidedCell::of_cell();
    if (seed % 3 == 1) {
      setup.arm = heavy_arm(random_, {3 + static_cast<int>(seed / 3 % 5), seed % 2 == 0, 0});
      setup.rated.assign(static_cast<std::size_t>(setup.arm.count), 400);
    }
    setup.period = kPeriods[seed % 7 % 3];
    setup.seed = seed;
    with_tool_ = !one_in(4);
    if (setup.arm.count == 6 && seed % 3 != 1) {
      const std::string link = "<link name=\"link_j5\">";
      const std::string ball =
          fmt::format("<collision><geometry><sphere radius=\"{}\"/></geometry></collision>", kBall);
      setup.arm.urdf.insert(setup.arm.urdf.find(link) + link.size(), ball);
      has_ball_ = true;
    }
    tool_ = with_tool_ ? KDL::Frame(KDL::Vector(0, in(-0.2, 0.2), in(0, 0.3))) : KDL::Frame::Identity();
    const Vec3 start = Vec3::Map(end_of(setup, Joints::Zero()).data);
    zone_.emplace();
    const Vec3 middle = start + any(0.2);
    zone_->lower = middle - Vec3(in(0.02, 0.2), in(0.02, 0.2), in(0.02, 0.2));
    zone_->upper = middle + Vec3(in(0.02, 0.2), in(0.02, 0.2), in(0.02, 0.2));
    if (!with_tool_ || zone_->contains(start, 0.05) || (has_ball_ && apart(ball_of(setup)) < kBall + 0.02)) {
      zone_.reset();
    }
    box_ = {start - Vec3(in(0.05, 0.6), in(0.05, 0.6), in(0.05, 0.6)),
            start + Vec3(in(0.05, 0.6), in(0.05, 0.6), in(0.05, 0.6))};
    setup.job = fmt::format("TOOL long = POSE 0 {} {} RPY 0 0 0\n", 1000 * tool_.p.y(), 1000 * tool_.p.z());
    setup.job += zone_ ? "KEEPOUT zone = BOX " + zone_->text() + "\n" : "";
    setup.workspace = {1000 * box_.lower.x(), 1000 * box_.lower.y(), 1000 * box_.lower.z(),
                       1000 * box_.upper.x(), 1000 * box_.upper.y(), 1000 * box_.upper.z()};
    return std::make_unique<GuidedCell>(std::move(setup));
  }
  [[nodiscard]] KDL::Vector end_of(const GuidedCell::Setup& setup, const Joints& q) const {
    KDL::ChainFkSolverPos_recursive solver(setup.arm.chain);
    KDL::JntArray joints(static_cast<unsigned>(setup.arm.count));
    joints.data = q.head(setup.arm.count);
    KDL::Frame frame;
    solver.JntToCart(joints, frame);
    return (frame * tool_).p;
  }
  // The ball of the fifth link, and how far a place is from the zone.
  static Vec3 ball_of(const GuidedCell::Setup& setup) {
    KDL::ChainFkSolverPos_recursive solver(setup.arm.chain);
    KDL::Frame frame;
    solver.JntToCart(KDL::JntArray(static_cast<unsigned>(setup.arm.count)), frame, 5);
    return Vec3::Map(frame.p.data);
  }
  [[nodiscard]] double apart(const Vec3& place) const {
    return (zone_->lower - place).cwiseMax(place - zone_->upper).cwiseMax(Vec3::Zero()).norm();
  }
  void push() {
    const double strong = one_in(6) ? 600 : one_in(3) ? 250 : 80;
    pushed_ = one_in(5) ? Vec3(Vec3::Zero()) : any(strong);
    turned_ = one_in(2) ? Vec3(Vec3::Zero()) : any(strong / 5);
    tremble();
  }
  void tremble() {
    sut_->force = pushed_ + 0.05 * pushed_.norm() * any(1);
    sut_->moment = turned_ + 0.05 * turned_.norm() * any(1);
  }
  void disturb() {
    Inputs& inputs = sut_->cell.in;
    switch (std::uniform_int_distribution<int>(0, 11)(random_)) {
      case 0:
        inputs.hold = !inputs.hold;
        break;
      case 1:
        inputs.speed_override = one_in(2) ? 100 : in(0, 100);
        break;
      case 2:
        inputs.mode.enabled = !inputs.mode.enabled;
        break;
      case 3:
        inputs.mode.mode = one_in(3) ? OperatingMode::Automatic : OperatingMode::Manual;
        break;
      case 4:
        inputs.emergency = one_in(2);
        break;
      case 5:
        inputs.drives[std::uniform_int_distribution<std::size_t>(0, at(sut_->count() - 1))(random_)].status =
            one_in(2) ? Cell::kFault : Cell::kSwitchOnDisabled;
        break;
      case 6:
        sut_->held = {in(0, 4), any(0.1), Mat3::Zero()};
        break;
      case 7:
        sut_->stale = !sut_->stale;
        break;
      default:
        come_back();
    }
  }
  // What ends guiding is undone, and it begins again.
  void come_back() {
    Inputs& inputs = sut_->cell.in;
    inputs.hold = false;
    inputs.mode = {OperatingMode::Manual, true, 0};
    inputs.emergency = false;
    sut_->stale = false;
    sut_->held = {};
    pushed_.setZero();
    turned_.setZero();
    tremble();
    sut_->press(false);
    const auto wait = [&](double seconds) {
      for (int i = 0; i < seconds / sut_->period && !testing::Test::HasFailure(); ++i) {
        step();
        look();
      }
    };
    wait(0.3);
    if (sut_->cell.out.state != GroupState::Standby) {
      sut_->cell.ask(Service::GroupReset);
      wait(0.2);
      sut_->cell.ask(Service::GroupEnable);
      wait(0.4);
    }
    sut_->press();
    wait(0.5);
  }
  void step() {
    sut_->step();
    broken_ = judge_.look(sut_->cell, kEmergency);
  }
  void look() {
    ++periods;
    guided += sut_->cell.out.guided ? 1 : 0;
    stopped += sut_->cell.out.state == GroupState::ErrorStop ? 1 : 0;
    EXPECT_EQ(broken_, "");
    // Where drives follow; one without power stays where it is.
    Joints q = sut_->commanded();
    const KDL::Frame end = sut_->place(q);
    const Vec3 tip = Vec3::Map((end * tool_).p.data);
    const Vec3 flange = Vec3::Map(end.p.data);
    if (known_) {
      const double speed = std::max((tip - tip_).norm(), (flange - flange_).norm()) / sut_->period;
      const bool manual = sut_->cell.out.mode == OperatingMode::Manual;
      EXPECT_LE(speed, manual ? 0.25 : 10) << to_string(sut_->cell.out.error);
      fastest = std::max(fastest, speed);
    }
    tip_ = tip;
    flange_ = flange;
    known_ = true;
    if (zone_) {
      EXPECT_FALSE(zone_->contains(tip, 0))
          << to_string(sut_->cell.out.error) << " in period " << periods << (with_tool_ ? " with a tool" : "")
          << ", guided " << sut_->cell.out.guided;
      nearest = std::min(nearest, apart(tip));
      if (has_ball_) {
        const double room = apart(Vec3::Map(sut_->place(q, 5).p.data)) - kBall;
        EXPECT_GT(room, 0) << to_string(sut_->cell.out.error);
        nearest = std::min(nearest, room);
      }
    }
    EXPECT_TRUE(box_.contains(tip, 1e-3)) << to_string(sut_->cell.out.error);
  }

  std::mt19937 random_;
  static constexpr double kBall = 0.07;  // m, radius
  bool with_tool_ = false;
  bool has_ball_ = false;
  KDL::Frame tool_;
  std::optional<Bounds> zone_;
  Bounds box_;
  std::unique_ptr<GuidedCell> sut_;
  Judge judge_;
  std::string broken_;
  Vec3 pushed_ = Vec3::Zero(), turned_ = Vec3::Zero();
  Vec3 tip_ = Vec3::Zero(), flange_ = Vec3::Zero();
  bool known_ = false;
};

TEST(Random_hands, Break_no_limit_whatever_they_do) {
  const int runs = number_of("INDUROP_ROBOT_HANDS", 20);
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  long guided = 0;
  long periods = 0;
  double fastest = 0;
  double nearest = 1;
  for (int i = first; i < first + runs && !HasFailure(); ++i) {
    SCOPED_TRACE(fmt::format("INDUROP_ROBOT_SEED={}", i));
    RandomHand sut(static_cast<unsigned>(i));
    sut.run();
    guided += sut.guided;
    periods += sut.periods;
    fastest = std::max(fastest, sut.fastest);
    nearest = std::min(nearest, sut.nearest);
  }
  fmt::print("guided in {} of {} periods; at most {:.1f} mm/s, at least {:.1f} mm from a zone\n", guided, periods,
             1000 * fastest, 1000 * nearest);
  EXPECT_GT(guided, periods / 10);
}

}  // namespace
}  // namespace indurop::robot
