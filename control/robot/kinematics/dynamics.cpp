// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/dynamics.h"

#include <algorithm>

namespace indurop::robot {

namespace {

// The motion of a link: its joint, its centre, and the forces on its body.
struct Moving {
  Vec3 direction, point;  // of its joint
  Vec3 centre;
  Vec3 force, moment;  // needed by its body; the moment about its centre
};

}  // namespace

Dynamics::Dynamics(const std::vector<Link>& links, const std::vector<Body>& bodies, const Pose& end,
                   const Friction& friction, const Joints& effort) noexcept
    : count_(std::min({links.size(), bodies.size(), Arm::kMostLinks})),
      end_(end),
      friction_(friction),
      effort_(effort) {
  std::copy_n(links.begin(), count_, links_.begin());
  std::copy_n(bodies.begin(), count_, bodies_.begin());
  last_ = count_ > 0 ? bodies_[count_ - 1] : Body{};
}

void Dynamics::hold(const Body& payload) noexcept {
  if (known()) {
    bodies_[count_ - 1] = payload.mass > 0 ? joined(last_, seen_from(end_, payload)) : last_;
  }
}

Joints Dynamics::friction(const Joints& velocity) const noexcept {
  const auto against = velocity.unaryExpr([](double v) { return v > 0 ? 1.0 : v < 0 ? -1.0 : 0.0; });
  return friction_.damping.cwiseProduct(velocity) + friction_.dry.cwiseProduct(against);
}

// Everything is in the base's frame. Gravity is represented by an upward acceleration of the base.
Joints Dynamics::torques(const Joints& q, const Joints& velocity, const Joints& acceleration,
                         double gravity) const noexcept {
  std::array<Moving, Arm::kMostLinks> moving;
  Mat3 rotation = Mat3::Identity();
  Vec3 shift = Vec3::Zero();
  Vec3 turning = Vec3::Zero();
  Vec3 turning_faster = Vec3::Zero();
  Vec3 reference = Vec3::Zero();  // a point of the present link
  Vec3 faster(0, 0, gravity);     // its acceleration
  for (std::size_t i = 0; i < count_; ++i) {
    const Link& link = links_[i];
    const double place = link.ratio * q[link.axis];
    const double speed = link.ratio * velocity[link.axis];
    const double change = link.ratio * acceleration[link.axis];
    Moving& m = moving[i];
    m.direction = rotation * link.direction;
    m.point = rotation * link.point + shift;
    const Vec3 away = m.point - reference;
    faster += turning_faster.cross(away) + turning.cross(turning.cross(away));
    reference = m.point;
    if (link.kind == AxisKind::Sliding) {
      // The point that is there now belongs to the previous link; the point of the sliding link is used instead.
      faster += 2 * speed * turning.cross(m.direction) + change * m.direction;
      shift += place * m.direction;
    } else {
      turning_faster += change * m.direction + speed * turning.cross(m.direction);
      turning += speed * m.direction;
      const Mat3 turn = turned(link.direction, place);
      shift += rotation * (link.point - turn * link.point);
      rotation = rotation * turn;
    }
    const Body& body = bodies_[i];
    m.centre = rotation * body.centre + shift;
    const Vec3 arm = m.centre - reference;
    m.force = body.mass * (faster + turning_faster.cross(arm) + turning.cross(turning.cross(arm)));
    const auto times_inertia = [&](const Vec3& about) -> Vec3 {
      return rotation * (body.inertia * (rotation.transpose() * about));
    };
    m.moment = times_inertia(turning_faster) + turning.cross(times_inertia(turning));
  }
  Joints result = rotors_.cwiseProduct(acceleration);
  Vec3 force = Vec3::Zero();
  Vec3 moment = Vec3::Zero();  // about the base's origin
  for (std::size_t i = count_; i-- > 0;) {
    const Moving& m = moving[i];
    force += m.force;
    moment += m.moment + m.centre.cross(m.force);
    const double needed =
        links_[i].kind == AxisKind::Sliding ? m.direction.dot(force) : m.direction.dot(moment - m.point.cross(force));
    result[links_[i].axis] += links_[i].ratio * needed;
  }
  return result;
}

}  // namespace indurop::robot
