// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/followed_path.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr double kRounded = 1e-6;  // a lower speed counts as none

}  // namespace

void FollowedPath::clear() noexcept {
  pieces_.count = 0;
  pieces_.blend = {};
  pieces_.in_blend = false;
  state_ = {};
}

void FollowedPath::add(const Segment& segment, const Blend& blend) noexcept {
  const auto i = static_cast<std::size_t>(pieces_.count++);
  pieces_.segments[i] = segment;
  pieces_.blends[i] = blend;
  if (pieces_.count == 1) {
    state_ = {};
  }
}

void FollowedPath::set_way(const ToolWay* way) noexcept {
  if (!empty()) {
    pieces_.segments[static_cast<std::size_t>(pieces_.count - 1)].way_ahead = way;
  }
}

void FollowedPath::replace(const Segment& segment, const LineState& state) noexcept {
  pieces_.segments[0] = segment;
  pieces_.count = 1;
  pieces_.blend = {};
  pieces_.in_blend = false;
  state_ = state;
}

const Segment& FollowedPath::last() const noexcept {
  return pieces_.segments[static_cast<std::size_t>(pieces_.count - 1)];
}

double FollowedPath::piece_end() const noexcept {
  return in_blend() ? blend().length() : segment().length - blend().zone;
}

const LineLimits& FollowedPath::piece_limits() const noexcept {
  return in_blend() ? blend().limits : segment().limits;
}

double FollowedPath::tip_speed() const noexcept {
  return in_blend() ? blend().tip_speed : segment().tip_speed;
}

bool FollowedPath::next_piece() noexcept {
  // Without a blend it has come to rest, except for rounding.
  if (segment().timed || (blend().zone <= 0 && state_.velocity < kRounded)) {
    state_ = {};
  }
  if (!in_blend() && blend().zone > 0) {
    state_.position = 0;
    pieces_.in_blend = true;
    return false;
  }
  // Continue with the next segment, after the blend if there was one.
  state_.position = in_blend() ? blend().zone : 0;
  PathPieces& p = pieces_;
  std::move(p.segments.begin() + 1, p.segments.begin() + p.count, p.segments.begin());
  std::move(p.blends.begin() + 1, p.blends.begin() + p.count, p.blends.begin());
  --p.count;
  p.in_blend = false;
  p.blend = {};
  return true;
}

void FollowedPath::go(double distance) noexcept {
  state_.position += distance;
  for (int pieces = 0; pieces < 4 && pieces_.count > 1 && state_.position > piece_end(); ++pieces) {
    const double beyond = state_.position - piece_end();
    next_piece();
    state_.position += beyond;
  }
}

double FollowedPath::note_passed() noexcept {
  passed_ = {segment().timing.at(state_.position).place, passed_[0]};
  return passed_[0] - passed_[1];
}

Reach FollowedPath::joints_at(double place, const Joints& near, Joints& q) const noexcept {
  return in_blend() ? places_.on(segment(), blend(), pieces_.segments[1], place, near, q)
                    : places_.on(segment(), place, near, q);
}

Reach FollowedPath::joints_ahead(double distance, const Joints& near, Joints& q) const noexcept {
  const double place = state_.position + distance;
  double beyond = place - piece_end();
  if (beyond <= 0 || !is_blended()) {
    return joints_at(place, near, q);
  }
  const Segment& next = pieces_.segments[1];
  if (!in_blend()) {
    if (beyond <= blend().length()) {
      return places_.on(segment(), blend(), next, beyond, near, q);
    }
    beyond -= blend().length();
  }
  return places_.on(next, blend().zone + beyond, near, q);
}

double FollowedPath::smooth_until(double distance) const noexcept {
  constexpr double kPart = 1.0 / 8;  // of a wave, that a polynomial of the fourth degree describes
  if (const Segment& s = segment(); s.wave.on()) {
    return distance + kPart * s.wave.length * (s.timed ? s.stretch : s.length) / s.way;
  }
  if (const Segment& s = segment(); s.joint_path != nullptr) {
    const double here = s.timed ? passed_[0] : state_.position;
    return s.joint_path->smooth_until(here + distance) - here;
  }
  if (!is_blended()) {
    return HUGE_VAL;
  }
  const double end = piece_end() - state_.position;
  if (distance < end) {
    return end;
  }
  return !in_blend() && distance < end + blend().length() ? end + blend().length() : HUGE_VAL;
}

double FollowedPath::left() const noexcept {
  const double here = piece_end() - state_.position;
  if (!is_blended()) {
    return here;
  }
  return here + (in_blend() ? 0 : blend().length()) + pieces_.segments[1].length - blend().zone;
}

PathAhead::Shape FollowedPath::shape_ahead(double distance) const noexcept {
  Shape shape;
  const double place = std::min(state_.position + distance, segment().length);
  const JointState state = segment().joint_timing.at(place, &shape.third);
  shape.value = state.position;
  shape.first = state.velocity;
  shape.second = state.acceleration;
  return shape;
}

Timed FollowedPath::timed_ahead(double distance) const noexcept {
  Timed there = segment().timing.at(state_.position + distance);
  there.place -= passed_[0];
  return there;
}

Reach FollowedPath::joints_on_path(double along, const Joints& near, Joints& q) const noexcept {
  return is_timed() ? places_.on_path(segment(), passed_[0] + along, near, q) : joints_ahead(along, near, q);
}

// By differences of places a little ahead, or back where the path ends.
Reach FollowedPath::motion(const Joints& q, JointState& now) const noexcept {
  now = {q, Joints::Zero(), Joints::Zero()};
  if (empty() || state_.velocity <= 0) {
    return Reach::Ok;
  }
  const double v = state_.velocity;
  const double a = state_.acceleration;
  if (joints_timed()) {
    const JointState path = segment().joint_timing.at(state_.position);
    now = {path.position, v * path.velocity, v * v * path.acceleration + a * path.velocity};
    return Reach::Ok;
  }
  const double size = places_.inverse().closed_form() ? 2e-5 : 1e-3;
  const double step = left() > 3 * size ? size : -size;
  std::array<Joints, 4> f;
  f.fill(q);
  for (std::size_t i = 0; i < f.size(); ++i) {
    if (const Reach reach = joints_ahead(step * static_cast<double>(i), q, f[i]); reach != Reach::Ok) {
      return reach;
    }
  }
  const Joints first = (4 * f[1] - 3 * f[0] - f[2]) / (2 * step);
  const Joints second = (2 * f[0] - 5 * f[1] + 4 * f[2] - f[3]) / (step * step);
  now.velocity = v * first;
  now.acceleration = v * v * second + a * first;
  return Reach::Ok;
}

int FollowedPath::source() const noexcept {
  if (empty()) {
    return 0;
  }
  const Segment& now = segment();
  return now.chain == nullptr ? now.source : now.chain->source_at(now.timed ? passed_[0] : state_.position);
}

PathPlace FollowedPath::place(double to_go) const noexcept {
  if (empty()) {
    return {};
  }
  const Segment& s = segment();
  double part = 0;
  if (is_timed()) {
    part = s.stretch > 0 ? s.timing.at(state_.position).place / s.stretch : 1;
  } else {
    double first = state_.position;
    if (in_blend()) {
      double second = 0;
      blend().parts_at(state_.position, first, second);
      first += s.length;
    }
    part = s.length > 0 ? first / s.length : 1;
  }
  return {s.ticket, part * s.way, (1 - part) * s.way, to_go};
}

}  // namespace indurop::robot
