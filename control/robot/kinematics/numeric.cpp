// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/numeric.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr int kSteps = 100;
constexpr double kNear = 1e-14;    // metres and radians: iteration continues down to this, since jerk shows the rest
constexpr double kEnough = 1e-10;  // the same, if another step brings no improvement
constexpr double kGood = 1e-7;     // the same, for a place on a path
constexpr double kExact = 1e-9;    // for a solution of the search
constexpr double kClose = 1e-3;    // worth more steps

using Square = Eigen::Matrix<double, kAxes, kAxes>;

double error_of(const Arm& arm, const Pose& pose, const Joints& q, Twist& twist) noexcept {
  twist = difference(arm.forward(q), pose);
  return twist.squaredNorm();
}

Joints within_limits(const Arm& arm, Joints q) noexcept {
  for (int i = 0; i < arm.count(); ++i) {
    const Axis& a = arm.axis(i);
    q[i] = a.endless ? q[i] : std::clamp(q[i], a.lower, a.upper);
  }
  return q;
}

// A step of half a turn would leave the range in which the linear model is valid.
Joints shortened(const Joints& change) noexcept {
  return change * std::min(1.0, 0.5 / std::max(change.lpNorm<Eigen::Infinity>(), 1e-300));
}

Jacobian moving(const Arm& arm, const Joints& q, Held held) noexcept {
  Jacobian j = arm.jacobian(q);
  for (int i = 0; i < arm.count(); ++i) {
    if (holds(held, i)) {
      j.col(i).setZero();
    }
  }
  return j;
}

struct Descent {
  int steps = kSteps;
  bool limited = true;  // stays within the limits in every step
  Held held = 0;
  bool around = false;  // axes at a limit that a step would pass leave it to the others
};

Joints damped_step(const Jacobian& j, const Twist& twist, double damping) noexcept {
  Square normal = j.transpose() * j;
  normal.diagonal().array() += damping;
  return shortened(normal.ldlt().solve(j.transpose() * twist));
}

// Axes that are at a limit and that the step would move beyond it.
Held stopped_by(const Arm& arm, const Joints& q, const Joints& step) noexcept {
  Held stopped = 0;
  for (int i = 0; i < arm.count(); ++i) {
    const Axis& a = arm.axis(i);
    if (!a.endless && ((q[i] <= a.lower && step[i] < 0) || (q[i] >= a.upper && step[i] > 0))) {
      stopped |= 1U << static_cast<unsigned>(i);
    }
  }
  return stopped;
}

// Damped least squares. Returns the square of the remaining error.
double descend(const Arm& arm, const Pose& pose, const Descent& how, Joints& q) noexcept {
  const auto allowed = [&](const Joints& there) { return how.limited ? within_limits(arm, there) : there; };
  q = allowed(q);
  Twist twist;
  double error = error_of(arm, pose, q, twist);
  double damping = 1e-3;
  for (int step = 0; step < how.steps && error > kNear * kNear && damping < 1e6; ++step) {
    Joints change = damped_step(moving(arm, q, how.held), twist, damping);
    Held held = how.held;
    for (Held stopped = how.around ? stopped_by(arm, q, change) : 0; stopped != 0;
         stopped = stopped_by(arm, q, change)) {
      held |= stopped;
      change = damped_step(moving(arm, q, held), twist, damping);
    }
    const Joints tried = allowed(q + change);
    Twist left;
    const double found = error_of(arm, pose, tried, left);
    if (found < error) {
      q = tried;
      error = found;
      twist = left;
      damping = std::max(damping / 5, 1e-12);
    } else if (error < kEnough * kEnough) {
      break;
    } else {
      damping *= 4;
    }
  }
  return error;
}

// Those of the redundant axes that slide or move the workpiece: they are never moved for the sake of limits.
Held unmoved_axes(const Arm& arm) noexcept {
  Held held = redundant_axes(arm);
  for (int i = 0; i < arm.count(); ++i) {
    held &= arm.axis(i).slides() || arm.moves_workpiece(i) ? ~0U : ~(1U << static_cast<unsigned>(i));
  }
  return held;
}

// How much each axis is too close to a limit: positive if it has to rise, negative if it has to fall.
Joints crowding(const Arm& arm, const Joints& q) noexcept {
  Joints push = Joints::Zero();
  for (int i = 0; i < arm.count(); ++i) {
    const Axis& a = arm.axis(i);
    if (!a.slides() && !a.endless && !arm.moves_workpiece(i)) {
      push[i] = std::max(0.0, a.lower + kElbowRoom - q[i]) - std::max(0.0, q[i] - a.upper + kElbowRoom);
    }
  }
  return push;
}

// Moves the elbow of an arm at a pose until no axis is closer to a limit than kElbowRoom, or as far as this helps. The
// direction is the part of crowding() that does not move the tool, in the null space of the Jacobian.
void leave_limits(const Arm& arm, const Pose& pose, Held held, Joints& q) noexcept {
  constexpr int kMostMoves = 40;
  constexpr double kFirst = 0.2;    // rad
  constexpr double kFinest = 1e-3;  // rad
  double size = kFirst;
  Joints push = crowding(arm, q);
  for (int move = 0; move < kMostMoves && size > kFinest && push.squaredNorm() > 0; ++move) {
    const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, kAxes, 6>> qr(moving(arm, q, held).transpose());
    const Square directions = qr.householderQ();
    const auto still = directions.rightCols(kAxes - qr.rank());
    const Joints way = still * (still.transpose() * push);
    if (way.norm() < 1e-3 * push.norm()) {
      return;
    }
    Joints tried = q + way * (size / way.norm());
    const bool reached = descend(arm, pose, {kSteps, true, held}, tried) < kExact * kExact;
    const Joints left = crowding(arm, tried);
    if (reached && left.squaredNorm() < push.squaredNorm()) {
      q = tried;
      push = left;
    } else {
      size /= 2;
    }
  }
}

// The change of the axes that reaches the position and, as far as the position leaves them free, turns the tool to the
// orientation. The axes are divided by orthogonal directions: those that move the tool's point and those that do not.
// Without that, rounding would show as jerk where the orientation is not reached.
Joints change_for(const Jacobian& j, const Twist& twist) noexcept {
  constexpr double kDamping = 1e-6;
  constexpr double kMissing = 1e-9;  // part of the strongest direction: below it, the arm cannot move there
  Eigen::ColPivHouseholderQR<Eigen::Matrix<double, kAxes, 3>> qr(j.topRows<3>().transpose());
  qr.setThreshold(kMissing);
  const auto rank = static_cast<int>(qr.rank());
  const Square directions = qr.householderQ();
  Joints change = Joints::Zero();
  const Vec3 place = qr.colsPermutation().transpose() * twist.head<3>();
  for (int i = 0; i < rank; ++i) {
    change[i] = (place[i] - qr.matrixQR().col(i).head(i).dot(change.head(i))) / qr.matrixQR()(i, i);
  }
  change = directions * change;
  Eigen::Matrix<double, 3, kAxes> turning = j.bottomRows<3>() * directions;
  turning.leftCols(rank).setZero();
  Square normal = turning.transpose() * turning;
  normal.diagonal().array() += kDamping;
  const Vec3 turn = twist.tail<3>() - j.bottomRows<3>() * change;
  return change + directions * normal.ldlt().solve(turning.transpose() * turn);
}

// The result of an iteration that reaches the position first: the squares of the remaining errors, and whether it came
// to an end. Where it does not, the closest orientation is about to be that of another posture, or a limit is in the
// way.
struct PlaceFirst {
  double place = 0, turn = 0;
  bool settled = false;
};

// Reaches the position exactly, and among all joint angles for it those with the orientation closest to the requested
// one.
PlaceFirst place_first(const Arm& arm, const Pose& pose, Joints& q) noexcept {
  constexpr int kMostSteps = 40;
  constexpr double kStill = 1e-12;
  constexpr double kSettled = 1e-11;
  Twist twist;
  double moved = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    error_of(arm, pose, q, twist);
    const Joints change = shortened(change_for(arm.jacobian(q), twist));
    q = within_limits(arm, q + change);
    moved = change.norm();
    if (moved < kStill) {
      break;
    }
  }
  error_of(arm, pose, q, twist);
  return {twist.head<3>().squaredNorm(), twist.tail<3>().squaredNorm(), moved < kSettled};
}

// Shifts each angle by the full turns that bring it nearest to `near`; returns false if that is beyond the limits.
bool turn_back(const Arm& arm, const Joints& near, Joints& q) noexcept {
  for (int i = 0; i < arm.count(); ++i) {
    const auto angle = turn_nearest(arm.axis(i), q[i], near[i]);
    if (!angle) {
      return false;
    }
    q[i] = *angle;
  }
  return true;
}

bool known(const Arm& arm, const Solutions& found, const Joints& q) noexcept {
  constexpr double kSame = 1e-4;  // rad
  for (int i = 0; i < found.count; ++i) {
    const Joints away = found.list[static_cast<std::size_t>(i)].q - q;
    double most = 0;
    for (int a = 0; a < arm.count(); ++a) {
      most = std::max(most, std::abs(arm.axis(a).slides() ? away[a] : std::remainder(away[a], 2 * kPi)));
    }
    if (most < kSame) {
      return true;
    }
  }
  return false;
}

// Iterates from q, which is near to a solution. Returns the square of the remaining error of the orientation; infinite
// if the position (with six or more axes: the pose) is not reached.
double missed(const Arm& arm, const Pose& pose, const Search& how, Joints& q) noexcept {
  if (arm.count() >= 6) {
    return descend(arm, pose, {kSteps, true, how.held}, q) < kExact * kExact ? 0 : HUGE_VAL;
  }
  const PlaceFirst found = place_first(arm, pose, q);
  return found.place < kExact * kExact ? found.turn : HUGE_VAL;
}

}  // namespace

NumericSolution solve_numerically(const Arm& arm, const Pose& pose, const Joints& near) noexcept {
  Joints q = near;
  double error = 0;
  if (arm.count() < 6) {
    const PlaceFirst found = place_first(arm, pose, q);
    error = found.settled ? found.place : HUGE_VAL;
  } else {
    error = descend(arm, pose, {kSteps, true, redundant_axes(arm)}, q);
  }
  const bool at_limit = arm.beyond_limits(q, -1e-9) >= 0;
  const Reach missed = at_limit ? Reach::JointLimit : Reach::OutOfReach;
  return {error < kGood * kGood ? Reach::Ok : missed, q};
}

double room_of(const Arm& arm, const Joints& q) noexcept {
  double room = HUGE_VAL;
  for (int i = 0; i < arm.count(); ++i) {
    const Axis& a = arm.axis(i);
    if (!a.slides() && !a.endless && !arm.moves_workpiece(i)) {
      room = std::min({room, q[i] - a.lower, a.upper - q[i]});
    }
  }
  return room;
}

NumericSolution solve_freely(const Arm& arm, const Pose& pose, const Joints& near) noexcept {
  const NumericSolution held = solve_numerically(arm, pose, near);
  const Held unmoved = unmoved_axes(arm);
  if (unmoved == redundant_axes(arm) || (held.reach == Reach::Ok && room_of(arm, held.q) >= kElbowRoom)) {
    return held;
  }
  NumericSolution free{Reach::Ok, held.reach == Reach::Ok ? held.q : near};
  if (held.reach != Reach::Ok && descend(arm, pose, {kSteps, true, unmoved, true}, free.q) >= kExact * kExact) {
    // Steps that are cut off at a limit may end there although the pose is reached beyond or around it.
    free.q = near;
    const bool reached = descend(arm, pose, {kSteps, false, unmoved}, free.q) < kExact * kExact;
    if (!reached || !turn_back(arm, near, free.q)) {
      return held;
    }
  }
  leave_limits(arm, pose, unmoved, free.q);
  return free;
}

Solutions search_numerically(const Arm& arm, const std::optional<Postures>& postures, const Pose& pose,
                             const Joints& near, const Search& how) noexcept {
  constexpr int kFew = 40;  // steps: a start value that leads nowhere shows it early
  const double close = std::max(kClose, arm.count() < 6 ? 2 * how.turned : 0.0);
  Solutions found;
  bool exact = false;  // an exact solution was found; errors caused by a limit are then ignored
  for (int i = 0; i < how.least || (found.count == 0 && i < how.most); ++i) {
    Joints q = i == 0 ? near : arm.spread(i);
    for (int a = 0; a < arm.count(); ++a) {
      q[a] = holds(how.held, a) ? near[a] : q[a];
    }
    // An iteration that leaves the limits often returns into them a turn later, and one along a limit may lead round
    // it.
    if (descend(arm, pose, {kFew, i % 2 == 0, how.held}, q) > close * close) {
      continue;
    }
    if (!turn_back(arm, near, q)) {
      found.reach = found.count > 0 ? Reach::Ok : Reach::JointLimit;
      continue;
    }
    const double left = missed(arm, pose, how, q);
    const bool good = left < kExact * kExact;
    if (!(left < how.turned * how.turned) || (exact && !good) || known(arm, found, q)) {
      continue;
    }
    found.count = good && !exact ? 0 : found.count;
    exact = good;
    found.add(arm, q, postures ? postures->at(arm, q) : std::uint8_t{0}, near);
  }
  return found;
}

}  // namespace indurop::robot
