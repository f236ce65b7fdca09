// SPDX-License-Identifier: Apache-2.0
// Requests for cells: which robot goes first, and robots that wait for each other.

#include <algorithm>
#include <span>

#include "control/robot/group/shared_space.h"

namespace indurop::robot {

namespace {

constexpr double kDeadlock = 0.5;  // s, during which robots have to wait for each other: reports are a period old

}  // namespace

SharedSpace::Answer SharedSpace::request(const PathPieces& path) noexcept {
  std::array<const SpaceCells*, PathPieces::kMaxSegments> cells{};
  for (int i = 0; i < path.count; ++i) {
    cells[at(i)] = path.segments[at(i)].cells;
  }
  return request(std::span(cells).first(at(path.count)));
}

SharedSpace::Answer SharedSpace::request(std::span<const SpaceCells* const> cells) noexcept {
  if (!on() || (cells.size() == 1 && cells.front() == granted_)) {
    return Answer::Granted;
  }
  SpaceCells& needed = memory_.front().next;
  needed.fill(0);
  for (const SpaceCells* one : cells) {
    if (one != nullptr) {
      join(needed, *one);
    }
  }
  for (std::size_t i = 0; i < robot_.parts.settings.other_robots.size(); ++i) {
    const SpaceReport* const one = others_[i];
    if (one != nullptr && one->known && one->box != own().box) {
      say("", one->name.view(), " has another cell_box; give all robots of the cell the same");
      return Answer::Mismatch;
    }
    if (one == nullptr || !one->known || !is_free(*one, needed)) {
      return wait_for(i, needed);
    }
  }
  take(needed);
  return Answer::Granted;
}

SharedSpace::Answer SharedSpace::meet(const SpaceCells* cells, std::string_view name) noexcept {
  SpaceReport& report = own();
  const std::size_t count = robot_.parts.settings.other_robots.size();
  granted_ = cells;
  changed_ = true;
  if (met_for_ == 0 && held_) {
    report.sync_since = 0;  // it could not begin
  }
  if (met_for_ > 0 || held_) {
    return wait_for(0, {});  // the robots may still see the last time
  }
  report.sync_since = report.sync_since == 0 ? tick_ : report.sync_since;
  report.sync = name;
  bool all = report.sync_since < tick_;
  for (std::size_t i = 0; i < count; ++i) {
    const SpaceReport* const one = others_[i];
    const bool ready = one != nullptr && one->known && one->sync_since != 0 && one->sync_since != met_[i];
    if (ready && one->sync == name) {
      all = all && one->sync_since < tick_;
      continue;
    }
    const Answer answer = wait_for(i, {});
    if (ready) {
      say("", one->name.view(), " waits at another SYNC: ", one->sync.view());
    }
    return answer;
  }
  if (!all) {
    requested_ = true;
    return Answer::Waits;
  }
  for (std::size_t i = 0; i < count; ++i) {
    met_[i] = others_[i]->sync_since;
  }
  met_for_ = periods(kLag);
  return Answer::Granted;
}

// Returns whether this robot may enter the cells as far as the other one is concerned.
bool SharedSpace::is_free(const SpaceReport& other, const SpaceCells& cells) noexcept {
  if (meets(cells, memory_.front().here, other.held)) {
    return false;
  }
  if (!is_older(other) || !meets(cells, other.wanted)) {
    return true;
  }
  SpaceCells rest = robot_.follower.idle() ? memory_.front().ahead : SpaceCells{};
  arm_.add(robot_.follower.end(), Joints::Zero(), robot_.tool.number(), grid_.slack(), rest);
  return meets(rest, other.wanted);
}

bool SharedSpace::is_older(const SpaceReport& other) const noexcept {
  return other.ticket != 0 && (own().ticket == 0 || other.ticket < own().ticket ||
                               (other.ticket == own().ticket && other.name < own().name));
}

SharedSpace::Answer SharedSpace::wait_for(std::size_t other, const SpaceCells& cells) noexcept {
  SpaceReport& report = own();
  requested_ = true;
  if (report.ticket == 0) {
    report.ticket = 1;
    for (const SpaceReport* one : others_) {
      report.ticket = std::max(report.ticket, one != nullptr ? one->ticket + 1 : 0);
    }
  }
  report.wanted = box_around(cells);
  report.waits_for = std::string_view(name(other));
  report.stands = robot_.follower.idle() && robot_.axes.gates_at_rest() && !held_;
  say("waits for ", report.waits_for.view(), "");
  deadlocked_ = loses_deadlock() ? deadlocked_ + 1 : 0;
  if (deadlocked_ < periods(kDeadlock)) {
    return Answer::Waits;
  }
  deadlocked_ = 0;
  say("this robot and ", report.waits_for.view(), " wait for each other; move one of them away, then resume its job");
  return Answer::Deadlock;
}

// Returns whether robots wait for each other in a circle that contains this robot, and it began to wait last.
bool SharedSpace::loses_deadlock() const noexcept {
  bool last = true;
  const SpaceReport* one = &own();
  for (std::size_t i = 0; i <= kOtherRobots && one != nullptr && one->stands; ++i) {
    if (one->waits_for == own().name) {
      return last;
    }
    one = other(one->waits_for);
    last = last && one != nullptr && is_older(*one);
  }
  return false;
}

}  // namespace indurop::robot
