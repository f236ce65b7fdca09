// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/follower.h"

#include <algorithm>
#include <cmath>

#include "control/robot/kinematics/bisect.h"

namespace indurop::robot {

namespace {

constexpr double kRounded = 1e-6;  // a lower speed counts as none

}  // namespace

void Follower::reset(const Joints& q) noexcept {
  if (keep_) {
    put_aside();
  }
  count_ = 0;
  blend_ = {};
  in_blend_ = false;
  mode_ = mode_ == Mode::Hold ? Mode::Hold : Mode::Run;
  state_ = {};
  speed_ = acceleration_ = 0;
  q_ = q;
  past_.joints.fill(q);
  past_.moved = {};
}

void Follower::add(const Segment& segment, const Blend& blend) noexcept {
  const auto i = static_cast<std::size_t>(count_++);
  segments_[i] = segment;
  blends_[i] = blend;
  if (count_ == 1) {
    state_ = {};
    begin_piece();
  } else if (count_ == 2) {
    try_blend();
  }
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
  }
}

double Follower::to_go() const noexcept {
  if (!idle() && segment(0).timed) {
    return (piece_end() - state_.position) / std::max(wanted_pace(), kStill);
  }
  return idle() ? 0 : std::max(0.0, profile_.duration() - time_);
}

double Follower::wanted_pace() const noexcept {
  return mode_ == Mode::Run && override_ >= kStill ? std::min(override_, pace_for(segment(0).tip_speed)) : 0;
}

// Returns the pace at which the tip keeps its speed limit.
double Follower::pace_for(double tip_speed) const noexcept {
  return tip_speed > tip_limit_ ? tip_limit_ / tip_speed : 1;
}

int Follower::source() const noexcept {
  if (idle()) {
    return 0;
  }
  const Segment& now = segment(0);
  return now.chain == nullptr ? now.source : now.chain->source_at(now.timed ? passed_[0] : state_.position);
}

double Follower::piece_end() const noexcept {
  return in_blend_ ? blend_.length() : segment(0).length - blend_.zone;
}

const LineLimits& Follower::piece_limits() const noexcept {
  return in_blend_ ? blend_.limits : segment(0).limits;
}

// Whether a path is followed by its timing is decided where it begins: at rest, with no blend into the next one.
// It is then followed at the requested pace at once, since the timing itself begins at rest.
void Follower::begin_piece() noexcept {
  Segment& first = segments_[0];
  to_end_ = false;
  if (!in_blend_ && state_.position <= 0 && state_.velocity <= 0 && (first.timing.known() || first.together)) {
    if (first.together) {
      first.tip_speed = 0;
      make_joint_timing(first, {first.from, Joints::Zero(), Joints::Zero()}, most_, wanted_pace());
    } else {
      first.take_timing();
    }
    passed_.fill(0);
    state_ = {0, wanted_pace(), 0};
  }
  replan();
}

// A piece with a timing is planned again in each period.
void Follower::replan() noexcept {
  if (segment(0).timed) {
    time_ = 0;
    return;
  }
  LineLimits limits = piece_limits();
  Profile next;
  bool to_end = false;
  if (mode_ == Mode::Run && override_ >= kStill) {
    const double most = pace_for(in_blend_ ? blend_.tip_speed : segment(0).tip_speed);
    limits.velocity = std::min(limits.velocity * override_, most);
    const double exit = in_blend_ || blend_.zone > 0 ? std::min(blend_.limits.velocity, pace_for(blend_.tip_speed)) : 0;
    next = Profile::to_position(state_, piece_end(), exit, limits);
    to_end = !next.overshoots();
  } else {
    next = Profile::to_velocity(state_, 0, limits);
  }
  if (!to_end && !in_blend_ && blend_.zone > 0 && next.end().position > piece_end()) {
    next = into_blend();
    to_end = true;
    if (next.overshoots() && to_end_) {
      return;  // due to rounding; it is nearly there as planned
    }
  }
  profile_ = next;
  to_end_ = to_end;
  time_ = 0;
}

// Returns the time at which the end of the present piece is passed; it is between these two times.
double Follower::crossing(double from, double to) const noexcept {
  const double end = piece_end();
  return bisect({from, to}, 50, [&](double time) { return profile_.at(time).position < end; }).fails;
}

void Follower::next_piece() noexcept {
  // Without a blend it has come to rest, except for rounding.
  if (segment(0).timed || (blend_.zone <= 0 && state_.velocity < kRounded)) {
    state_ = {};
  }
  if (in_blend_ || blend_.zone <= 0) {
    // Continue with the next segment, after the blend if there was one.
    state_.position = in_blend_ ? blend_.zone : 0;
    std::move(segments_.begin() + 1, segments_.begin() + count_, segments_.begin());
    std::move(blends_.begin() + 1, blends_.begin() + count_, blends_.begin());
    --count_;
    in_blend_ = false;
    blend_ = {};
    if (count_ >= 2) {
      try_blend();
    }
  } else {
    state_.position = 0;
    in_blend_ = true;
  }
  if (count_ > 0 && mode_ != Mode::HardStop) {
    begin_piece();
  }
}

double Follower::advance(double seconds) noexcept {
  double moved = 0;
  // Short paths may begin and end within one period; after this many the rest waits for the next period.
  for (int pieces = 0; pieces < 4 && count_ > 0; ++pieces) {
    const bool timed = segment(0).timed;
    if (timed) {
      profile_ = pace_of_timing(seconds);
      time_ = 0;
    }
    const double until = time_ + seconds;
    const bool running = !timed && to_end_;
    double reached = until;
    bool crossed = false;
    if (running) {
      crossed = until >= profile_.duration();
      reached = crossed ? profile_.duration() : until;
    } else if (profile_.at(until).position >= piece_end()) {
      crossed = true;
      reached = crossing(time_, until);
    }
    const double from = state_.position;
    state_ = profile_.at(reached);
    moved += state_.position - from;
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
void Follower::note(double moved) noexcept {
  past_.moved = {moved, past_.moved[0]};
  past_.joints = {q_, past_.joints[0], past_.joints[1]};
}

Reach Follower::joints_on_piece(double place, const Joints& near, Joints& q) const noexcept {
  return in_blend_ ? places_.on(segment(0), blend_, segment(1), place, near, q)
                   : places_.on(segment(0), place, near, q);
}

Reach Follower::joints_ahead(double distance, const Joints& near, Joints& q) const noexcept {
  const double place = state_.position + distance;
  double beyond = place - piece_end();
  if (beyond <= 0 || count_ < 2 || (blend_.zone <= 0 && !in_blend_)) {
    return joints_on_piece(place, near, q);
  }
  if (!in_blend_) {
    if (beyond <= blend_.length()) {
      return places_.on(segment(0), blend_, segment(1), beyond, near, q);
    }
    beyond -= blend_.length();
  }
  return places_.on(segment(1), blend_.zone + beyond, near, q);
}

// Returns the distance to where a blend begins or ends.
double Follower::smooth_until(double distance) const noexcept {
  if (count_ < 2 || (blend_.zone <= 0 && !in_blend_)) {
    return HUGE_VAL;
  }
  const double end = piece_end() - state_.position;
  if (distance < end) {
    return end;
  }
  return !in_blend_ && distance < end + blend_.length() ? end + blend_.length() : HUGE_VAL;
}

double Follower::left() const noexcept {
  const double here = piece_end() - state_.position;
  if (count_ < 2 || (blend_.zone <= 0 && !in_blend_)) {
    return here;
  }
  return here + (in_blend_ ? 0 : blend_.length()) + segment(1).length - blend_.zone;
}

// Moves along the path, over the ends of pieces.
void Follower::go(double distance) noexcept {
  state_.position += distance;
  for (int pieces = 0; pieces < 4 && count_ > 1 && state_.position > piece_end(); ++pieces) {
    const double beyond = state_.position - piece_end();
    next_piece();
    state_.position += beyond;
  }
}

Fault Follower::allowed(const Joints& from, const Joints& to, double seconds) const noexcept {
  constexpr double kSlack = 1.05;  // planned limits are exact for joint motions, sampled for the others
  if (const int beyond = places_.arm().goes_beyond(from, to, 1e-6); beyond >= 0) {
    return {ErrorCode::JointLimit, beyond + 1};
  }
  for (int i = 0; i < kAxes; ++i) {
    if (!(std::abs(to[i] - from[i]) <= kSlack * seconds * most_.velocity[i] + 1e-9)) {
      return {ErrorCode::Speed, i + 1};
    }
  }
  return {};
}

Fault Follower::brake(double seconds) noexcept {
  double distance = 0;
  Joints q = q_;
  if (const Reach reach = brake_.next(*this, past_, seconds, distance, q); reach != Reach::Ok) {
    return {reach == Reach::JointLimit ? ErrorCode::JointLimit : ErrorCode::Singular};
  }
  const Fault fault = allowed(q_, q, seconds);
  if (!fault.ok()) {
    return fault;
  }
  const double before = state_.velocity;
  go(distance);
  state_.velocity = distance / seconds;
  state_.acceleration = (state_.velocity - before) / seconds;
  q_ = q;
  note(distance);
  note_place(seconds);
  if (distance <= 0) {
    reset(q_);
  }
  return {};
}

Fault Follower::place(double seconds) noexcept {
  Joints q = q_;
  if (const Reach reach = joints_on_piece(state_.position, q_, q); reach != Reach::Ok) {
    return {reach == Reach::JointLimit ? ErrorCode::JointLimit : ErrorCode::Singular};
  }
  const Fault fault = allowed(q_, q, seconds);
  if (fault.ok()) {
    q_ = q;
  }
  return fault;
}

Fault Follower::step(double seconds) noexcept {
  if (idle()) {
    mode_ = stopping() ? Mode::Run : mode_;
    note(0);
    return {};
  }
  period_ = seconds;
  if (mode_ == Mode::HardStop) {
    return brake(seconds);
  }
  const Joints end = segment(count_ - 1).to;
  const double moved = advance(seconds);
  if (count_ == 0) {
    const Fault fault = allowed(q_, end, seconds);
    if (fault.ok()) {
      q_ = end;
    }
    mode_ = mode_ == Mode::Stop ? Mode::Run : mode_;
    note(moved);
    return fault;
  }
  const Fault fault = place(seconds);
  note(moved);
  note_place(seconds);
  if (mode_ == Mode::Stop && state_.velocity <= 0) {
    reset(q_);
  }
  return fault;
}

}  // namespace indurop::robot
