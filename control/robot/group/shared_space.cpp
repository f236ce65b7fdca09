// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/shared_space.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace indurop::robot {

namespace {

constexpr double kLag = 0.25;      // s, by which drives are behind their set points at most
constexpr double kDeadlock = 0.5;  // s, during which robots have to wait for each other: reports are a period old

}  // namespace

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

const std::string& SharedSpace::name(std::size_t other) const noexcept {
  return robot_.parts.settings.other_robots[other];
}

const SpaceReport* SharedSpace::other(std::string_view name) const noexcept {
  const auto found = std::find_if(others_.begin(), others_.end(), [&](const SpaceReport* one) {
    return one != nullptr && one->known && one->name == name;
  });
  return found != others_.end() ? *found : nullptr;
}

void SharedSpace::say(const char* before, std::string_view name, const char* after, std::string_view end) noexcept {
  std::snprintf(text_, sizeof text_, "%s%.*s%s%.*s", before, static_cast<int>(name.size()), name.data(), after,
                static_cast<int>(end.size()), end.data());
}

int SharedSpace::periods(double seconds) const noexcept {
  return static_cast<int>(std::ceil(seconds / robot_.period));
}

bool SharedSpace::sense(const Others& others, std::uint64_t tick) noexcept {
  if (!on()) {
    return false;
  }
  others_ = others;
  tick_ = tick + 1;
  bool intruded = false;
  for (std::size_t i = 0; i < others_.size(); ++i) {
    if (others_[i] == nullptr || !others_[i]->known) {
      continue;
    }
    const SpaceReport& one = *others_[i];
    if (seen_[i] && one.intrusions != intrusions_[i] && one.intruded == own().name) {
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
    if (!followed && !desk.uses(&cells) && !leads(robot_.follower.pieces(), &cells) &&
        !leads(robot_.follower.kept_path().pieces, &cells) && !leads(*shelf_, &cells)) {
      return &cells;
    }
  }
  return nullptr;
}

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
  SpaceCells& none = memory_.front().next;
  none.fill(0);
  if (met_for_ > 0) {
    return wait_for(0, none);  // the robots may still see the last time
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
    const Answer answer = wait_for(i, none);
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
  SpaceCells& rest = memory_.front().rest;
  rest.fill(0);
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
  report.stands = robot_.follower.idle() && robot_.axes.gates_at_rest();
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

// Returns whether the set points are on a motion that was granted.
bool SharedSpace::is_granted(bool off_path) const noexcept {
  const GroupStates& states = robot_.states;
  const PathPieces& path = robot_.follower.pieces();
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
  stamp(now);
  bool enters = enters_others();
  if (enters && now.known && (forced || (way_.known && way_.more <= 0))) {
    now.more = 0;
    stamp(now);
    enters = enters_others();
  }
  if (enters && !forced) {
    return false;
  }
  if (enters) {
    intrude();
  }
  memory.ahead = memory.next;
  way_ = now;
  take(memory.ahead);
  return true;
}

bool SharedSpace::enters_others() noexcept {
  const Memory& memory = memory_.front();
  for (const SpaceReport* one : others_) {
    if (one != nullptr && one->known && meets(memory.next, memory.here, one->held)) {
      say("the arm would come into the way of ", one->name.view(), "");
      return true;
    }
  }
  return false;
}

void SharedSpace::intrude() noexcept {
  Memory& memory = memory_.front();
  for (const SpaceReport* one : others_) {
    if (one != nullptr && one->known && memory.own.known && meets(memory.next, memory.here, one->held)) {
      memory.own.intruded = one->name;
      ++memory.own.intrusions;
    }
  }
}

// Motions that were followed and are no longer.
void SharedSpace::note_motions() noexcept {
  const PathPieces& path = robot_.follower.pieces();
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
