// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/follower.h"

#include <algorithm>
#include <cmath>

#include "control/robot/kinematics/bisect.h"

namespace indurop::robot {

void Follower::reset(const Joints& q) noexcept {
  if (keeps_) {
    keeps_ = false;
    path_.keep(q_, kept_);
  }
  path_.clear();
  mode_ = mode_ == Mode::Hold ? Mode::Hold : Mode::Run;
  speed_ = 0;
  q_ = q;
  past_.joints.fill(q);
  past_.moved = {};
}

void Follower::add(const Segment& segment, const Blend& blend) noexcept {
  path_.add(segment, blend);
  if (path_.pieces().count == 1) {
    begin_piece();
  } else if (path_.pieces().count == 2) {
    begin_blend();
  }
}

void Follower::keep_path() noexcept {
  keeps_ = true;
  if (idle()) {
    keeps_ = false;
    path_.keep(q_, kept_);
  }
}

void Follower::resume() noexcept {
  reset(kept_.q);
  if (!kept_.known()) {
    return;
  }
  path_.take(kept_);
  if (path_.joints_timed()) {
    path_.segment().tip_speed = joint_motions_.tip_speed_of(path_.segment());
  }
  pace_ = {};
  replan();
}

void Follower::set_override(double part) noexcept {
  part = std::clamp(part, 0.0, 1.0);
  if (part != override_) {
    override_ = part;
    if (mode_ == Mode::Run && !idle()) {
      replan();
    }
  }
}

void Follower::set_hold(bool hold) noexcept {
  const Mode wanted = hold ? Mode::Hold : Mode::Run;
  if (stopping() || mode_ == wanted) {
    return;
  }
  mode_ = wanted;
  if (!idle()) {
    replan();
  }
}

void Follower::stop() noexcept {
  if (stopping()) {
    return;
  }
  mode_ = Mode::Stop;
  if (at_rest()) {
    reset(q_);
    return;
  }
  replan();
}

void Follower::stop_hard(double hardness) noexcept {
  if (mode_ == Mode::HardStop && hardness <= brake_.hardness()) {
    return;
  }
  mode_ = Mode::HardStop;
  brake_.begin(hardness);
  if (at_rest()) {
    reset(q_);
  } else if (brakes_by_profile()) {
    replan();
  }
}

// What can be stopped as hard by a profile needs no search for the hardest braking, which ends a little later.
bool Follower::brakes_by_profile() const noexcept {
  return mode_ == Mode::HardStop && path_.is_straight();
}

double Follower::to_go() const noexcept {
  if (!idle() && path_.segment().timed) {
    return (path_.piece_end() - path_.state().position) / std::max(wanted_pace(), kStill);
  }
  return idle() ? 0 : std::max(0.0, profile_.duration() - time_);
}

double Follower::wanted_pace() const noexcept {
  const double allowed = joint_motions_.pace_for(path_.segment().tip_speed);
  return mode_ == Mode::Run && override_ >= kStill ? std::min(override_, allowed) : 0;
}

// Whether a path is followed by its timing is decided where it begins: at rest, with no blend into the next one.
// It is then followed at the requested pace at once, since the timing itself begins at rest.
void Follower::begin_piece() noexcept {
  Segment& first = path_.segment();
  const LineState& state = path_.state();
  to_end_ = false;
  if (!path_.in_blend() && state.position <= 0 && state.velocity <= 0 && (first.timing.known() || first.together)) {
    if (first.together) {
      first.tip_speed = 0;
      joint_motions_.time(first, wanted_pace());
    } else {
      first.take_timing();
    }
    path_.begin_timing();
    path_.set_state({0, wanted_pace(), 0});
  }
  replan();
}

void Follower::begin_blend() noexcept {
  if (!stopping() && path_.begin_blend()) {
    to_end_ = false;
    replan();
  }
}

// A piece with a timing is planned again in each period.
void Follower::replan() noexcept {
  if (path_.segment().timed) {
    time_ = 0;
    return;
  }
  const LineState& state = path_.state();
  const Blend& blend = path_.blend();
  LineLimits limits = path_.piece_limits();
  Profile next;
  bool to_end = false;
  if (mode_ == Mode::Run && override_ >= kStill) {
    limits.velocity = std::min(limits.velocity * override_, joint_motions_.pace_for(path_.tip_speed()));
    const double exit = path_.in_blend() || blend.zone > 0
                            ? std::min(blend.limits.velocity, joint_motions_.pace_for(blend.tip_speed))
                            : 0;
    next = Profile::to_position(state, path_.piece_end(), exit, limits);
    to_end = !next.overshoots();
  } else {
    limits = brakes_by_profile() ? path_.segment().straight_limits(joint_motions_.limits(), brake_.hardness()) : limits;
    next = Profile::to_velocity(state, 0, limits);
  }
  if (!to_end && !path_.in_blend() && blend.zone > 0 && next.end().position > path_.piece_end()) {
    next = path_.into_blend();
    to_end = true;
    if (next.overshoots() && to_end_) {
      return;  // due to rounding; it is nearly there as planned
    }
  }
  profile_ = next;
  to_end_ = to_end;
  time_ = 0;
}

void Follower::next_piece() noexcept {
  if (path_.next_piece()) {
    begin_blend();
  }
  if (!idle()) {
    begin_piece();
  }
}

double Follower::advance(double seconds) noexcept {
  double moved = 0;
  // Short paths may begin and end within one period; after this many the rest waits for the next period.
  for (int pieces = 0; pieces < 4 && !idle(); ++pieces) {
    const bool timed = path_.segment().timed;
    if (timed) {
      profile_ = pace_of_timing(seconds);
      time_ = 0;
    }
    const double until = time_ + seconds;
    const double end = path_.piece_end();
    double reached = until;
    bool crossed = false;
    if (!timed && to_end_) {
      crossed = until >= profile_.duration();
      reached = crossed ? profile_.duration() : until;
    } else if (profile_.at(until).position >= end) {
      crossed = true;
      reached = bisect({time_, until}, 50, [&](double time) { return profile_.at(time).position < end; }).fails;
    }
    const double from = path_.state().position;
    path_.set_state(profile_.at(reached));
    moved += path_.state().position - from;
    seconds = until - reached;
    time_ = reached;
    if (!crossed) {
      break;
    }
    next_piece();
  }
  return moved;
}

// Distances are counted over all pieces.
void Follower::note_step(double moved) noexcept {
  past_.moved = {moved, past_.moved[0]};
  past_.joints = {q_, past_.joints[0], past_.joints[1]};
}

// The speed of a joint motion with a timing is that of the fastest joint.
void Follower::note_speed(double seconds) noexcept {
  if (!path_.segment().timed) {
    speed_ = path_.state().velocity;
    return;
  }
  double moved = 0;
  if (path_.joints_timed()) {
    const Joints turned = past_.joints[0] - past_.joints[1];
    moved = turned.cwiseAbs().cwiseQuotient(joint_motions_.limits().velocity).maxCoeff();
  } else {
    moved = path_.note_passed();
  }
  const double speed = moved / seconds;
  speed_ = speed;
}

Fault Follower::redirect(const Segment& target) noexcept {
  JointMotions::Beginning from;
  if (path_.motion(q_, from.now) != Reach::Ok) {
    return {ErrorCode::Singular};
  }
  from.moving = !at_rest();
  from.exact = !from.moving || (path_.segment().move == Move::Joint && !path_.in_blend());
  Segment next = target;
  if (const Fault fault = joint_motions_.begin(next, from, wanted_pace()); !fault.ok()) {
    return fault;
  }
  path_.replace(next, {0, next.made_for, 0});
  past_.moved.fill(next.made_for * period_);
  time_ = 0;
  return {};
}

// Returns the further course of the pace of a motion with a timing.
Profile Follower::pace_of_timing(double seconds) noexcept {
  Segment& s = path_.segment();
  const bool joints = s.move == Move::Joint;
  double wanted = wanted_pace();
  if (path_.state().position <= 0 && !s.moving) {
    // Before the motion begins, the pace may jump.
    if (joints && s.made_for != joint_motions_.made_for(wanted)) {
      joint_motions_.time(s, wanted);
    }
    path_.set_state({0, joints ? std::min(wanted, s.fastest) : wanted, 0});
  }
  if (joints) {
    if (s.made_for >= 1 && wanted < 1 && joint_motions_.leave_margin(s, path_.state().position)) {
      path_.set_state({0, 1, 0});
    } else if (s.made_for >= 1) {
      return Profile::coast(path_.state());
    }
    const LineState& state = path_.state();
    if (state.position < s.settled || (wanted == state.velocity && state.acceleration == 0)) {
      return Profile::coast(state);
    }
    wanted = std::min(wanted, s.fastest);
  }
  return pace_.next(path_.state(), wanted, seconds, s.pace_limits);
}

Fault Follower::allowed(const Joints& to, double seconds) const noexcept {
  constexpr double kSlack = 1.05;  // planned limits are exact for joint motions, sampled for the others
  if (const int beyond = places_.arm().goes_beyond(q_, to, 1e-6); beyond >= 0) {
    return {ErrorCode::JointLimit, beyond + 1};
  }
  for (int i = 0; i < kAxes; ++i) {
    if (!(std::abs(to[i] - q_[i]) <= kSlack * seconds * joint_motions_.limits().velocity[i] + 1e-9)) {
      return {ErrorCode::Speed, i + 1};
    }
  }
  return {};
}

Fault Follower::brake(double seconds) noexcept {
  double distance = 0;
  Joints q = q_;
  if (const Reach reach = brake_.next(path_, past_, seconds, distance, q); reach != Reach::Ok) {
    return {reach == Reach::JointLimit ? ErrorCode::JointLimit : ErrorCode::Singular};
  }
  if (const Fault fault = allowed(q, seconds); !fault.ok()) {
    return fault;
  }
  const double before = path_.state().velocity;
  path_.go(distance);
  const double velocity = distance / seconds;
  path_.set_state({path_.state().position, velocity, (velocity - before) / seconds});
  q_ = q;
  note_step(distance);
  note_speed(seconds);
  if (distance <= 0) {
    reset(q_);
  }
  return {};
}

Fault Follower::place(double seconds) noexcept {
  Joints q = q_;
  if (const Reach reach = path_.joints_at(path_.state().position, q_, q); reach != Reach::Ok) {
    return {reach == Reach::JointLimit ? ErrorCode::JointLimit : ErrorCode::Singular};
  }
  const Fault fault = allowed(q, seconds);
  if (fault.ok()) {
    q_ = q;
  }
  return fault;
}

Fault Follower::step(double seconds) noexcept {
  if (idle()) {
    mode_ = stopping() ? Mode::Run : mode_;
    note_step(0);
    return {};
  }
  period_ = seconds;
  if (mode_ == Mode::HardStop && !brakes_by_profile()) {
    return brake(seconds);
  }
  const Joints end = path_.last().to;
  const double moved = advance(seconds);
  if (idle()) {
    const Fault fault = allowed(end, seconds);
    if (fault.ok()) {
      q_ = end;
    }
    if (keeps_) {
      keep_path();  // the motion was about to end anyway: nothing of its path remains
    }
    mode_ = stopping() ? Mode::Run : mode_;
    note_step(moved);
    return fault;
  }
  const Fault fault = place(seconds);
  note_step(moved);
  note_speed(seconds);
  if (stopping() && path_.state().velocity <= 0) {
    reset(q_);
  }
  return fault;
}

}  // namespace indurop::robot
