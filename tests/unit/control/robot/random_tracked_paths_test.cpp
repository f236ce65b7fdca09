// SPDX-License-Identifier: Apache-2.0
// Circles and blended motions on random belts: where the tip is by orocos-kdl, seen from where the product really is,
// is on the circle or near the corner that was asked for, and no set point breaks a limit. INDUROP_ROBOT_BELTS says how
// many runs, INDUROP_ROBOT_SEED from which one on.

#include "random_belts.h"

namespace indurop::robot {
namespace {

using KDL::Vector;

// mm, from a point to the way between two others.
double off_line(const Vector& p, const Vector& from, const Vector& to) {
  const Vector along = to - from;
  const double part = std::clamp(KDL::dot(p - from, along) / KDL::dot(along, along), 0.0, 1.0);
  return (p - from - along * part).Norm();
}

// The circle through three points: its centre is where the planes between them meet.
class Circle {
 public:
  Circle(const Vector& a, const Vector& b, const Vector& c) : normal_((b - a) * (c - a)) {
    const double square = KDL::dot(normal_, normal_);
    const Vector to_centre =
        ((normal_ * (b - a)) * KDL::dot(c - a, c - a) + ((c - a) * normal_) * KDL::dot(b - a, b - a)) / (2 * square);
    centre_ = a + to_centre;
    radius_ = to_centre.Norm();
    normal_ = normal_ / std::sqrt(square);
  }
  [[nodiscard]] double off(const Vector& p) const {
    const double high = KDL::dot(p - centre_, normal_);
    return std::hypot(high, (p - centre_ - normal_ * high).Norm() - radius_);
  }

 private:
  Vector normal_, centre_;
  double radius_ = 0;
};

class RandomPaths : public RandomBelts {
 protected:
  void SetUp() override {
    RandomBelts::SetUp();
    random.seed(static_cast<unsigned>(number_of("INDUROP_ROBOT_SEED", 1)));
  }
  Vector any_place() { return {between(-40, 40), between(-40, 40), between(60, 200)}; }
  // On a product that moves, at a place of it; false: that cannot be.
  bool get_on(Vector& here) {
    if (cell.out.state == GroupState::Moving) {
      give(Service::Halt);
    }
    EXPECT_TRUE(
        until([&] { return cell.out.state == GroupState::Standby || cell.out.state == GroupState::ErrorStop; }));
    if (cell.out.state == GroupState::ErrorStop) {
      EXPECT_TRUE(run(give(Service::GroupReset)));
    }
    EXPECT_TRUE(run(give(Service::DirectAbsolute, {0, 10, -20, 0, 60, 0})));
    EXPECT_TRUE(run(machine(500, 0, 400)));
    const bool turns = one_of(3) == 0;
    choose_belt(turns);
    choose_origin(turns);
    begin_tracking(from, on_it, turns);
    here = any_place();
    return run(product(here[0], here[1], here[2], between(50, 400)));
  }
  // Each set point until the motion has ended; the largest of what `off` says, mm. Negative: it did not end well.
  double watch(const Given& motion, const std::function<double(const Vector&)>& off) {
    double worst = 0;
    EXPECT_TRUE(until([&] {
      if (cell.out.state == GroupState::Moving && cell.out.error == ErrorCode::Ok) {
        worst = std::max(worst, off(tip()));
      }
      return ended(motion);
    }));
    return state(motion) == CommandState::Done ? worst : -1;
  }
  int good = 0, bad = 0;
};

TEST_F(RandomPaths, Circles_are_round_on_the_product) {
  const int runs = number_of("INDUROP_ROBOT_BELTS", 40);
  for (int i = 0; i < runs && !failed; ++i) {
    SCOPED_TRACE(i);
    Vector here;
    if (!get_on(here)) {
      ++bad;
      continue;
    }
    const Vector via = here + Vector(between(-50, 50), between(10, 50), between(-20, 20));
    const Vector to = here + Vector(between(-50, 50), between(-50, -10), between(-20, 20));
    const Given motion = give(Service::CircularAbsolute, {to[0], to[1], to[2], 180, 0, 180}, between(50, 300),
                              BufferMode::Aborting, CoordSystem::Product);
    command(motion).aux = {via[0], via[1], via[2], 180, 0, 180};
    const Circle circle(here, via, to);
    const double worst = watch(motion, [&](const Vector& p) { return circle.off(p); });
    int& count = worst >= 0 ? good : bad;
    ++count;
    if (worst >= 0) {
      EXPECT_LT(worst, 2 * near) << time;
      EXPECT_LT((tip() - to).Norm(), near);
    }
  }
  fmt::print("{} circles on products, {} that could not be\n", good, bad);
  EXPECT_GT(good, 2 * bad);
}

TEST_F(RandomPaths, Blended_motions_keep_to_their_corners) {
  const int runs = number_of("INDUROP_ROBOT_BELTS", 40);
  int turned = 0;
  for (int i = 0; i < runs && !failed; ++i) {
    SCOPED_TRACE(i);
    Vector here;
    if (!get_on(here)) {
      ++bad;
      continue;
    }
    const Vector corner = any_place();
    const Vector to = any_place();
    const double zone = between(5, 30);
    const double speed = between(50, 300);
    product(corner[0], corner[1], corner[2], speed);
    const Given motion = give(Service::LinearAbsolute, {to[0], to[1], to[2], 180, 0, 180}, speed,
                              BufferMode::BlendingPrevious, CoordSystem::Product, zone);
    double nearest = 1e9;
    const double worst = watch(motion, [&](const Vector& p) {
      nearest = std::min(nearest, (p - corner).Norm());
      const double off = std::min(off_line(p, here, corner), off_line(p, corner, to));
      return (p - corner).Norm() < zone + near ? std::max(0.0, off - zone) : off;
    });
    int& count = worst >= 0 ? good : bad;
    ++count;
    if (worst >= 0) {
      EXPECT_LT(worst, near) << time;
      EXPECT_LT((tip() - to).Norm(), near);
      turned += nearest > 0.5 ? 1 : 0;
    }
  }
  fmt::print("{} blended motions on products, {} turned before their corner, {} that could not be\n", good, turned,
             bad);
  EXPECT_GT(good, 2 * bad);
  EXPECT_GT(turned, good / 2);
}

}  // namespace
}  // namespace indurop::robot
