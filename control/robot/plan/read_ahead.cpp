// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/read_ahead.h"

#include <utility>

namespace indurop::robot {

namespace {

constexpr int kPerPeriod = 16;      // lines that are checked
constexpr std::size_t kLiving = 6;  // chains: one being built, one being planned, and those being followed

}  // namespace

ReadAhead::ReadAhead(const Places& places, const ToolLimits& tool)
    : places_(places),
      tool_(tool),
      commands_(Chain::kMaxLines),
      chains_(kLiving),
      splines_(kLiving),
      joint_paths_(kLiving) {}

void ReadAhead::clear() noexcept {
  count_ = scanned_ = single_ = given_ = 0;
}

void ReadAhead::swap(ReadAhead& other) noexcept {
  commands_.swap(other.commands_);
  std::swap(first_, other.first_);
  std::swap(count_, other.count_);
  std::swap(scanned_, other.scanned_);
  std::swap(single_, other.single_);
  std::swap(given_, other.given_);
  std::swap(closed_, other.closed_);
  chains_.swap(other.chains_);
  std::swap(chain_, other.chain_);
  splines_.swap(other.splines_);
  std::swap(spline_, other.spline_);
  joint_paths_.swap(other.joint_paths_);
  std::swap(joint_path_, other.joint_path_);
}

const MoveCommand& ReadAhead::command(int i) const noexcept {
  return commands_[static_cast<std::size_t>(first_ + i) % commands_.size()];
}

bool ReadAhead::has_room() const noexcept {
  if (count_ + given_ >= Chain::kMaxLines) {
    return false;
  }
  if (count_ < kAhead) {
    return true;
  }
  const MoveCommand& last = command(count_ - 1);
  const bool goes_on = ((last.move == Move::Line || last.move == Move::Circle) && last.zone > 0) ||
                       (last.move == Move::Spline && last.more);
  return goes_on;
}

void ReadAhead::add(const MoveCommand& command) noexcept {
  commands_[static_cast<std::size_t>(first_ + count_++) % commands_.size()] = command;
}

const MoveCommand& ReadAhead::take() noexcept {
  const MoveCommand& taken = command(0);
  first_ = (first_ + 1) % Chain::kMaxLines;
  --count_;
  return taken;
}

bool ReadAhead::belongs(const MoveCommand& command) const noexcept {
  return (command.move == Move::Line || command.move == Move::Circle) && !command.alone && command.target.held == 0 &&
         command.speed > 0 && command.speed <= 1 && command.acceleration == this->command(0).acceleration;
}

void ReadAhead::begin_scan(const Joints& from) noexcept {
  chains_[chain_].begin(places_.arm().forward(from), gentler(tool_, command(0).acceleration));
  closed_ = false;
}

void ReadAhead::scan() noexcept {
  Chain& chain = chains_[chain_];
  for (int i = 0; i < kPerPeriod && !closed_ && scanned_ < count_; ++i) {
    const MoveCommand& line = command(scanned_);
    const bool bent = line.move == Move::Circle;
    const Chain::Line piece{pose_of(line.target),
                            line.zone,
                            line.speed,
                            line.tool_speed,
                            line.source,
                            bent,
                            bent ? pose_of(line.mid).position : Vec3(Vec3::Zero())};
    if (!belongs(line) || !chain.takes(piece)) {
      closed_ = true;
      return;
    }
    chain.add(piece);
    ++scanned_;
    closed_ = line.zone <= 0 || chain.full();
  }
}

Pose ReadAhead::pose_of(const Target& target) const noexcept {
  return target.is_pose ? target.pose : places_.arm().forward(target.joints);
}

// The first point of the spline is at the front.
ReadAhead::Next ReadAhead::next_spline(const Joints& from) noexcept {
  int points = 1;
  while (points < count_ && command(points - 1).more) {
    ++points;
  }
  if (command(points - 1).more) {
    return {};  // the other points are still to come
  }
  Spline& spline = splines_[spline_];
  const double acceleration = command(0).acceleration;
  spline.begin(places_.arm().forward(from), gentler(tool_, acceleration));
  for (int i = 0; i < points && spline.count() < Spline::kMaxPoints; ++i) {
    const MoveCommand& point = command(i);
    spline.add({pose_of(point.target), point.speed, point.tool_speed, point.source});
  }
  first_ = (first_ + points - 1) % Chain::kMaxLines;
  count_ -= points - 1;
  const MoveCommand& last = take();
  if (spline.count() == 0) {
    return {nullptr, &last};  // it is already there
  }
  spline.finish();
  spline_ = (spline_ + 1) % splines_.size();
  return {&spline, nullptr, last.ticket, acceleration, nullptr, nullptr, last.wave};
}

// The scanned lines are a chain, and stay where they are until it is known how they are followed.
ReadAhead::Next ReadAhead::next_chain() noexcept {
  Chain& chain = chains_[chain_];
  chain.finish();
  chain_ = (chain_ + 1) % chains_.size();
  const MoveCommand& first = command(0);
  first_ = (first_ + scanned_) % Chain::kMaxLines;
  count_ -= scanned_;
  given_ = scanned_;
  scanned_ = 0;
  return {&chain, &first, 0, first.acceleration, &chain};
}

ReadAhead::Next ReadAhead::next_single() noexcept {
  const MoveCommand& taken = take();
  const bool chain = count_ > 1 && single_ == 0 && command(0).zone > 0 && belongs(command(0)) && belongs(command(1));
  const bool leads = count_ > 0 && command(0).move != Move::Spline && command(0).move != Move::Free && !chain;
  Next next{nullptr, &taken, 0, 1, nullptr, leads ? &command(0) : nullptr};
  if (taken.move == Move::Free) {
    next.joint_path = &joint_paths_[joint_path_];
    joint_path_ = (joint_path_ + 1) % joint_paths_.size();
  }
  return next;
}

void ReadAhead::parted() noexcept {
  if (given_ == 0) {
    return;
  }
  single_ = given_ - 1;
  first_ = (first_ + Chain::kMaxLines - single_) % Chain::kMaxLines;
  count_ += single_;
  given_ = 0;
  for (int i = 0; i + 1 < single_; ++i) {
    commands_[static_cast<std::size_t>(first_ + i) % commands_.size()].zone = 0;
  }
}

ReadAhead::Next ReadAhead::next(const Joints& from, bool more) noexcept {
  if (empty()) {
    return {};
  }
  if (single_ == 0 && scanned_ == 0 && command(0).move == Move::Spline) {
    return next_spline(from);
  }
  if (single_ == 0 && scanned_ == 0) {
    begin_scan(from);
  }
  if (single_ == 0) {
    scan();
    if (!closed_ && (scanned_ < count_ || more)) {
      return {};
    }
    if (chains_[chain_].count() > 1) {
      return next_chain();
    }
    single_ = scanned_ > 0 ? scanned_ : 1;
    scanned_ = 0;
  }
  if (command(0).zone > 0 && count_ == 1 && more) {
    return {};
  }
  --single_;
  return next_single();
}

}  // namespace indurop::robot
