// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/shared_space.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace indurop::robot {

SharedSpace::SharedSpace(const Robot& robot) : robot_(robot), arm_(robot.tool.places().clearance(), grid_) {
  const Settings& settings = robot.parts.settings;
  if (settings.other_robots.empty()) {
    return;
  }
  grid_ = CellGrid(settings.cell_box, settings.base_in_cell);
  memory_.resize(1);
  own().name = std::string_view(settings.name);
  std::copy_n(settings.cell_box.begin(), own().box.size(), own().box.begin());
}

const SpaceReport* SharedSpace::other(std::string_view name) const noexcept {
  const auto* const found = std::find_if(others_.begin(), others_.end(), [&](const SpaceReport* one) {
    return one != nullptr && one->known && one->name == name;
  });
  return found != others_.end() ? *found : nullptr;
}

void SharedSpace::say(const char* before, std::string_view name, const char* after, std::string_view end) noexcept {
  std::snprintf(text_, sizeof text_, "%s%.*s%s%.*s", before, static_cast<int>(name.size()), name.data(), after,
                static_cast<int>(end.size()), end.data());
}

bool SharedSpace::sense(const Others& others, std::uint64_t tick, bool held) noexcept {
  if (!on()) {
    return false;
  }
  others_ = others;
  tick_ = tick + 1;
  held_ = held;
  bool intruded = false;
  for (std::size_t i = 0; i < others_.size(); ++i) {
    if (others_[i] == nullptr || !others_[i]->known) {
      continue;
    }
    const SpaceReport& one = *others_[i];
    // One that came into the cells of several robots names the last of them.
    if (seen_[i] && one.intrusions != intrusions_[i] &&
        (one.intruded == own().name || meets(own().held, SpaceCells{}, one.held))) {
      intruded = true;
      say("", one.name.view(), " has come into the way of this robot");
    }
    seen_[i] = true;
    intrusions_[i] = one.intrusions;
  }
  return intruded;
}

SpaceCells* SharedSpace::cells_for_plan(const PlanningDesk& desk) noexcept {
  if (!on()) {
    return nullptr;
  }
  const auto leads = [](const PathPieces& path, const SpaceCells* cells) {
    return std::any_of(path.segments.begin(), path.segments.begin() + path.count,
                       [&](const Segment& segment) { return segment.cells == cells; });
  };
  for (SpaceCells& cells : memory_.front().plans) {
    const bool followed = std::find(motions_.begin(), motions_.end(), &cells) != motions_.end();
    if (!followed && !desk.uses(&cells) && !leads(robot_.follower.path().pieces(), &cells) &&
        !leads(robot_.follower.kept_path().pieces, &cells) &&
        std::none_of(left_.begin(), left_.end(), [&](const KeptPath& path) { return leads(path.pieces, &cells); })) {
      return &cells;
    }
  }
  return nullptr;
}

// Returns whether the set points are on a motion that was granted.
bool SharedSpace::is_granted(bool off_path) const noexcept {
  const GroupStates& states = robot_.states;
  const PathPieces& path = robot_.follower.path().pieces();
  const bool on_path = states.moving() || (states.stopping() && states.on_path());
  return on_path && !off_path && path.count > 0 && !robot_.axes.any_busy() && !robot_.axes.any_displaced() &&
         std::all_of(path.segments.begin(), path.segments.begin() + path.count,
                     [](const Segment& segment) { return segment.cells != nullptr; });
}

SharedSpace::Way SharedSpace::way() const noexcept {
  Way way;
  way.known = robot_.axes.all_homed();
  way.tool = robot_.tool.number();
  way.more = grid_.slack();
  way.places[0] = lags_ == 0 ? robot_.axes.measured() : robot_.axes.passed();
  way.places[1] = robot_.axes.passed();
  way.places[2] = robot_.commanded();
  constexpr std::size_t kBefore = 2;
  std::array<Profile, kAxes> stops;
  const double longest = robot_.axes.stops(stops);
  for (std::size_t k = kBefore + 1; k < Way::kPlaces; ++k) {
    const double time = longest * static_cast<double>(k - kBefore) / static_cast<double>(Way::kPlaces - 1 - kBefore);
    way.places[k] = robot_.commanded();
    for (int i = 0; i < robot_.count(); ++i) {
      way.places[k][i] = stops[at(i)].at(time).position;
    }
  }
  return way;
}

// Returns whether `ahead` contains the cells of a way: if its places are near the known ones, it is, too.
bool SharedSpace::covers(const Way& way) const noexcept {
  for (std::size_t i = 0; i < way.places.size(); ++i) {
    if (arm_.most_moved((way.places[i] - way_.places[i]).cwiseAbs(), way.tool) > way_.more / 2) {
      return false;
    }
  }
  return way_.known && way.known && way_.tool == way.tool;
}

void SharedSpace::stamp(const Way& way) noexcept {
  SpaceCells& cells = memory_.front().next;
  cells.fill(way.known ? 0 : ~std::uint64_t{0});  // an arm of unknown position may be anywhere
  for (std::size_t i = 0; way.known && i + 1 < way.places.size(); ++i) {
    arm_.add_way(way.places[i], way.places[i + 1], way.tool, way.more, cells);
  }
}

// Follows the arm with the cells ahead of it. While it brakes next to cells of another robot, and until it has moved
// away from them, they are computed as tightly as possible.
bool SharedSpace::follow(bool off_path, bool forced) noexcept {
  Memory& memory = memory_.front();
  if (is_granted(off_path)) {
    lags_ = periods(kLag);
    if (way_.known) {
      join(memory.recent, memory.ahead);
      way_.known = false;
      memory.ahead.fill(0);
      changed_ = true;
    }
    return true;
  }
  Way now = way();
  if (covers(now)) {
    return true;
  }
  // Stopping does not help an arm at rest that has got another tool, or was pushed: its job may go on, and wait.
  forced = forced || (robot_.axes.gates_at_rest() && now.places[2] == now.places[1]);
  stamp(now);
  bool enters = enters_others(false);
  if (enters && now.known && (forced || (way_.known && way_.more <= 0))) {
    now.more = 0;
    stamp(now);
    enters = enters_others(false);
  }
  if (enters && !forced) {
    return false;
  }
  static_cast<void>(enters && enters_others(true));
  memory.ahead = memory.next;
  way_ = now;
  take(memory.ahead);
  return true;
}

// Returns whether the next cells are some of others; text() says whose.
bool SharedSpace::enters_others(bool counts) noexcept {
  Memory& memory = memory_.front();
  bool enters = false;
  for (const SpaceReport* one : others_) {
    if (one != nullptr && one->known && meets(memory.next, memory.here, one->held)) {
      say("the arm would come into the way of ", one->name.view(), "");
      enters = true;
      if (counts && memory.own.known) {
        memory.own.intruded = one->name;
        ++memory.own.intrusions;
      }
    }
  }
  return enters;
}

// Motions that were followed and are no longer.
void SharedSpace::note_motions() noexcept {
  const PathPieces& path = robot_.follower.path().pieces();
  std::array<const SpaceCells*, PathPieces::kMaxSegments> now{};
  for (int i = 0; i < path.count; ++i) {
    now[at(i)] = path.segments[at(i)].cells;
  }
  for (const SpaceCells* before : motions_) {
    if (before != nullptr && std::find(now.begin(), now.end(), before) == now.end()) {
      join(memory_.front().recent, *before);
    }
  }
  changed_ = changed_ || now != motions_;
  motions_ = now;
}

// Cells of motions that have ended are held for one to two times the lag.
void SharedSpace::age() noexcept {
  Memory& memory = memory_.front();
  if (--age_ > 0) {
    return;
  }
  age_ = periods(kLag);
  memory.older = memory.recent;
  memory.recent.fill(0);
  changed_ = true;
}

void SharedSpace::take(const SpaceCells& cells) noexcept {
  join(memory_.front().here, cells);
  join(own().held, cells);
  changed_ = true;
}

void SharedSpace::hold() noexcept {
  Memory& memory = memory_.front();
  memory.here = memory.ahead;
  for (const SpaceCells* motion : motions_) {
    if (motion != nullptr) {
      join(memory.here, *motion);
    }
  }
  if (granted_ != nullptr) {
    join(memory.here, *granted_);
  }
  SpaceCells& held = memory.own.held;
  held = memory.here;
  join(held, memory.recent);
  join(held, memory.older);
}

void SharedSpace::step(bool off_path) noexcept {
  if (!on()) {
    return;
  }
  static_cast<void>(follow(off_path, true));
  lags_ = std::max(lags_ - 1, 0);
  note_motions();
  age();
  if (!requested_ && granted_ != nullptr) {
    granted_ = nullptr;
    changed_ = true;
  }
  met_for_ = std::max(met_for_ - 1, 0);
  if (!requested_ && met_for_ == 0) {
    own().sync_since = 0;
    own().sync = string<32>();
  }
  if (changed_) {
    hold();
    changed_ = false;
  }
  SpaceReport& report = own();
  report.known = true;
  if (!requested_ && report.ticket != 0) {
    report.ticket = 0;
    report.waits_for = string<32>();
    report.stands = false;
    report.wanted = {};
    deadlocked_ = 0;
  }
  requested_ = false;
  others_ = {};
}

}  // namespace indurop::robot
