// SPDX-License-Identifier: Apache-2.0
#include "control/robot/collision/collision_check.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace indurop::robot {

namespace {

constexpr double kFinest = 2e-4;       // m, the smallest step that has to be proved; anything nearer counts as touching
constexpr double kWayRounding = 1e-7;  // m
// m, the longest step of touching bodies, for exact checks and in the tick.
constexpr double kComeApart = 2e-3;
constexpr double kComeApartSoon = 2e-2;

}  // namespace

CollisionCheck::CollisionCheck(const Clearance& clearance, bool exact)
    : clearance_(clearance),
      rooms_(clearance.pairs().size()),
      next_(clearance.pairs().size()),
      here_(clearance.parts().size()),
      there_(clearance.parts().size()),
      apart_(exact ? kComeApart : kComeApartSoon) {
  if (exact && clearance.known()) {
    std::vector<Solid> solids;
    std::transform(clearance.parts().begin(), clearance.parts().end(), std::back_inserter(solids),
                   [](const Clearance::Part& part) { return part.solid; });
    nearest_ = std::make_unique<Nearest>(solids);
  }
}

double CollisionCheck::measure(std::size_t pair, const Clearance::Places& places) noexcept {
  const Clearance::Pair& one = clearance_.pairs()[pair];
  if (nearest_ == nullptr) {
    return least(pair, places);
  }
  const auto a = static_cast<std::size_t>(one.a);
  const auto b = static_cast<std::size_t>(one.b);
  return nearest_->distance(one.a, one.b, places[a], places[b]) - clearance_.margin() - more_;
}

void CollisionCheck::swap(CollisionCheck& other) noexcept {
  std::swap(nearest_, other.nearest_);
  std::swap(rooms_, other.rooms_);
  std::swap(next_, other.next_);
  std::swap(here_, other.here_);
  std::swap(there_, other.there_);
  here_placed_ = false;
  pair_ = -1;
}

void CollisionCheck::take(const CollisionCheck& other) noexcept {
  rooms_ = other.rooms_;
  here_ = other.here_;
  here_placed_ = other.here_placed_;
  at_ = other.at_;
}

void CollisionCheck::begin(const Joints& from, int tool, double more) noexcept {
  at_ = from;
  more_ = more;
  pair_ = -1;
  here_placed_ = true;
  clearance_.place(from, here_);
  for (std::size_t i = 0; i < rooms_.size(); ++i) {
    const Clearance::Pair& pair = clearance_.pairs()[i];
    Room& room = rooms_[i];
    room = {0, clearance_.counts(pair, tool), false};
    if (!room.counts) {
      continue;
    }
    room.left = least(i, here_);
    if (room.left <= kFinest && nearest_ != nullptr) {
      room.left = measure(i, here_);
    }
    room.inside = room.left <= kFinest;
    pair_ = room.inside && pair_ < 0 ? static_cast<int>(i) : pair_;
  }
}

CollisionCheck::Step CollisionCheck::next(const Joints& to, const Joints& moved) noexcept {
  bool placed = false;
  for (std::size_t i = 0; i < rooms_.size(); ++i) {
    next_[i] = rooms_[i];
    if (!rooms_[i].counts) {
      continue;
    }
    const double most = clearance_.pairs()[i].lever.dot(moved);
    if (!rooms_[i].inside && most < rooms_[i].left) {
      next_[i].left = rooms_[i].left - most;
      continue;
    }
    if (const Step step = look(i, most, placed, to); step != Step::Clear) {
      pair_ = static_cast<int>(i);
      return step;
    }
  }
  rooms_.swap(next_);
  here_.swap(there_);
  here_placed_ = placed;
  at_ = to;
  return Step::Clear;
}

// Checks a pair whose known distance does not suffice for this step.
CollisionCheck::Step CollisionCheck::look(std::size_t pair, double most, bool& placed, const Joints& to) noexcept {
  if (!placed) {
    clearance_.place(to, there_);
    placed = true;
  }
  if (rooms_[pair].inside) {
    return come_apart(pair, most);
  }
  Room& next = next_[pair];
  next.left = least(pair, there_);
  if (next.left > 0 && most < rooms_[pair].left + next.left) {
    return Step::Clear;
  }
  next.left = measure(pair, there_);
  if (next.left <= 0) {
    return Step::Touches;
  }
  if (most < rooms_[pair].left + next.left) {
    return Step::Clear;
  }
  if (!here_placed_) {
    clearance_.place(at_, here_);
    here_placed_ = true;
  }
  rooms_[pair].left = std::max(rooms_[pair].left, measure(pair, here_));
  if (most < rooms_[pair].left + next.left) {
    return Step::Clear;
  }
  return most < kFinest ? Step::Touches : Step::Shorter;
}

CollisionCheck::Step CollisionCheck::come_apart(std::size_t pair, double most) noexcept {
  if (most > apart_) {
    return Step::Shorter;
  }
  Room& next = next_[pair];
  next.left = measure(pair, there_);
  next.inside = next.left <= kFinest;
  return next.left < rooms_[pair].left - kWayRounding ? Step::Touches : Step::Clear;
}

Joints moved_by(const Joints& from, const Joints& middle, const Joints& to) noexcept {
  return (middle - from).cwiseAbs() + (to - middle).cwiseAbs() + (from - 2 * middle + to).cwiseAbs() / 2;
}

}  // namespace indurop::robot
