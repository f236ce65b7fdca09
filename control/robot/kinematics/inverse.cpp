// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/inverse.h"

namespace indurop::robot {

Inverse::Inverse(const Arm& arm)
    : arm_(arm), wrist_(SphericalWrist::of(arm)), postures_(Postures::of(arm)), held_(redundant_axes(arm)) {
  if (!wrist_) {
    parallel_ = ParallelAxes::of(arm);
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
    turned.add(arm_, one.q, one.posture, near);
  }
  const Solution* best = turned.nearest(near, posture);
  return best != nullptr ? Result{Reach::Ok, *best} : Result{Reach::JointLimit, {}};
}

Solutions Inverse::all(const Pose& pose, const Joints& near) const noexcept {
  return solve(pose, near, Gathered::What::All);
}

Solutions Inverse::solve(const Pose& pose, const Joints& near, Gathered::What what) const noexcept {
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

Solutions Inverse::search(const Pose& pose, const Joints& near, const Search& how) const noexcept {
  return closed_form() ? all(pose, near) : search_numerically(arm_, postures_, pose, near, how);
}

Inverse::Result Inverse::reach(const Pose& pose, const Joints& near) const noexcept {
  if (closed_form()) {
    return nearest(pose, near);
  }
  const NumericSolution one = solve_freely(arm_, pose, near);
  return {one.reach, {one.q, postures_ ? postures_->at(arm_, one.q) : std::uint8_t{0}}};
}

Joints Inverse::held_as(const Joints& from, Joints near) const noexcept {
  for (int i = 0; i < arm_.count() && held_ != 0; ++i) {
    if ((held_ >> static_cast<unsigned>(i) & 1U) != 0) {
      near[i] = from[i];
    }
  }
  return near;
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
