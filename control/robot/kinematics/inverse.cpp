// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/inverse.h"

namespace indurop::robot {

Inverse::Inverse(const Arm& arm)
    : arm_(arm),
      serial_(arm.in_world()),
      wrist_(SphericalWrist::of(serial_)),
      postures_(Postures::of(serial_)),
      held_(redundant_axes(arm)),
      workpiece_(workpiece_axes(arm)) {
  if (!wrist_) {
    parallel_ = ParallelAxes::of(serial_);
  }
}

Inverse::Result Inverse::nearest(const Pose& pose, const Joints& near,
                                 std::optional<std::uint8_t> posture) const noexcept {
  // A solution requested by its posture may be any of them.
  const Solutions found = solve(pose, near, posture ? Gathered::What::All : Gathered::What::Nearest);
  if (const Solution* best = found.nearest(near, posture)) {
    return {Reach::Ok, *best};
  }
  // Reachable, but not in this posture?
  return {found.count > 0 ? Reach::JointLimit : found.reach, {}};
}

Inverse::Result Inverse::nearest(const Solutions& known, const Joints& near,
                                 std::optional<std::uint8_t> posture) const noexcept {
  Solutions turned;
  for (int i = 0; i < known.count; ++i) {
    const Solution& one = known.list[static_cast<std::size_t>(i)];
    turned.add(arm_, one.q, one.posture, with_axes(workpiece_, one.q, near));  // which keep their turns
  }
  const Solution* best = turned.nearest(near, posture);
  return best != nullptr ? Result{Reach::Ok, *best} : Result{Reach::JointLimit, {}};
}

Solutions Inverse::all(const Pose& pose, const Joints& near) const noexcept {
  return solve(pose, near, Gathered::What::All);
}

Solutions Inverse::solve(const Pose& pose, const Joints& near, Gathered::What what) const noexcept {
  if (workpiece_ != 0 && closed_form()) {
    return solve_in_world(pose, near, what);
  }
  if (wrist_) {
    return wrist_->solve(arm_, pose, near, what);
  }
  if (parallel_) {
    return parallel_->solve(arm_, pose, near, what);
  }
  const NumericSolution one = solve_numerically(arm_, pose, near);
  Solutions found;
  found.reach = one.reach;
  found.count = one.reach == Reach::Ok ? 1 : 0;
  found.list[0] = {one.q, postures_ ? postures_->at(arm_, one.q) : std::uint8_t{0}};
  return found;
}

// The workpiece stands where it does in `near`.
Solutions Inverse::solve_in_world(const Pose& pose, const Joints& near, Gathered::What what) const noexcept {
  const ChainFrame world = arm_.world(near);
  const Mat3 back = world.turn.transpose();
  const Pose there{back * (pose.position - world.shift), (Quat(back) * pose.orientation).normalized()};
  Solutions found = wrist_ ? wrist_->solve(serial_, there, near, what) : parallel_->solve(serial_, there, near, what);
  for (int i = 0; i < found.count; ++i) {
    Joints& q = found.list[static_cast<std::size_t>(i)].q;
    q = with_axes(workpiece_, near, q);
  }
  return found;
}

Solutions Inverse::search(const Pose& pose, const Joints& near, const Search& how) const noexcept {
  return closed_form() && !leaves_workpiece_open(how.held) ? all(pose, near)
                                                           : search_numerically(arm_, postures_, pose, near, how);
}

Inverse::Result Inverse::reach(const Pose& pose, const Joints& near) const noexcept {
  if (closed_form()) {
    return nearest(pose, near);
  }
  const NumericSolution one = solve_freely(arm_, pose, near);
  return {one.reach, {one.q, postures_ ? postures_->at(arm_, one.q) : std::uint8_t{0}}};
}

std::optional<std::uint8_t> Inverse::posture_at(const Joints& q) const noexcept {
  return postures_ ? std::optional(postures_->at(arm_, q)) : std::nullopt;
}

const char* Inverse::kind() const noexcept {
  if (wrist_) {
    return "spherical wrist, inverse kinematics in closed form";
  }
  if (parallel_) {
    return "three of them parallel, inverse kinematics in closed form";
  }
  return "inverse kinematics step by step";
}

}  // namespace indurop::robot
