// SPDX-License-Identifier: Apache-2.0
#include "control/robot/collision/clearance.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <utility>

#include "control/robot/collision/body_distance.h"

namespace indurop::robot {

namespace {

// Returns the maximum lever of a solid that `of` joints of the chain move, in any position, as seen from what `from`
// joints move: about the axes between them, the nearest one first.
Joints lever_of(const Arm& arm, const Solid& solid, int seen_from, int of) {
  Joints lever = Joints::Zero();
  Vec3 from = solid.place.position;
  double farthest = solid.radius();
  const int step = of > seen_from ? -1 : 1;
  for (int i = of; i != seen_from; i += step) {
    const Link& link = arm.link(std::min(i, i + step));
    const double ratio = std::abs(link.ratio);
    if (link.kind == AxisKind::Sliding) {
      lever[link.axis] += ratio;
      const Axis& axis = arm.axis(link.axis);
      farthest += ratio * std::max(std::abs(axis.lower), std::abs(axis.upper));
      continue;
    }
    const Vec3 on_axis = link.point + (from - link.point).dot(link.direction) * link.direction;
    farthest += (from - on_axis).norm();
    lever[link.axis] += ratio * farthest;
    from = on_axis;
  }
  return lever;
}

void append(std::string& list, const std::string& a, const std::string& b) {
  const std::string pair = a + " - " + b;
  if (list.find(pair) == std::string::npos) {
    list += (list.empty() ? "" : ", ") + pair;
  }
}

std::string plain(const std::string& name) {
  const std::size_t quote = name.find('\'');
  return quote == std::string::npos ? name : name.substr(quote + 1, name.size() - quote - 2);
}

bool same_pair(const std::pair<std::string, std::string>& one, const std::string& a, const std::string& b) {
  return (one.first == a && one.second == b) || (one.first == b && one.second == a);
}

}  // namespace

Clearance::Clearance(const Arm& arm, const Bodies& bodies) : arm_(arm), margin_(bodies.clearance) {
  const int end = arm.chain_length();
  if (end == 0) {
    return;
  }
  for (const LinkBody& link : bodies.links) {
    for (const Solid& solid : link.solids) {
      add("link '" + link.name + "'", {0, link.joint, 0, solid, {}});
    }
  }
  for (const NamedSolid& tool : bodies.tools) {
    Solid solid = tool.solid;
    solid.place = arm.home() * solid.place;
    add("tool '" + tool.name + "'", {0, end, tool.tool, solid, {}});
  }
  first_zone_ = parts_.size();
  for (const NamedSolid& zone : bodies.zones) {
    add("zone '" + zone.name + "'", {0, arm.world_joint(), 0, zone.solid, {}});
  }
  connect(bodies.ignored);
}

void Clearance::add(const std::string& name, const Part& part) {
  const auto found = std::find(names_.begin(), names_.end(), name);
  parts_.push_back(part);
  parts_.back().body = static_cast<int>(found - names_.begin());
  parts_.back().lever = lever_of(arm_, part.solid, arm_.world_joint(), part.joint);
  if (found == names_.end()) {
    names_.push_back(name);
  }
}

// Bodies that are joined by one joint or by none are left out: they touch by design. What stands still in the world is
// the base of the arm and of what turns the workpiece: these are left out only if they touch with all joints at zero.
void Clearance::connect(const std::vector<std::pair<std::string, std::string>>& ignored) {
  std::vector<Solid> solids;
  std::transform(parts_.begin(), parts_.end(), std::back_inserter(solids), [](const Part& part) { return part.solid; });
  Nearest nearest(solids);
  Places places(parts_.size());
  place(Joints::Zero(), places);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    for (std::size_t k = i + 1; k < parts_.size(); ++k) {
      const Part& one = parts_[i];
      const Part& other = parts_[k];
      const int a = static_cast<int>(i);
      const int b = static_cast<int>(k);
      const bool zone = is_zone(b);
      const bool next_to_world = std::max(one.joint, other.joint) == arm_.world_joint();
      const int joined = next_to_world ? 0 : 1;
      const bool apart = zone ? !is_zone(a) && one.joint != other.joint : std::abs(one.joint - other.joint) > joined;
      if (!apart || (one.tool > 0 && other.tool > 0 && one.tool != other.tool)) {
        continue;
      }
      const std::string& first = names_[index(one.body)];
      const std::string& second = names_[index(other.body)];
      if (std::any_of(ignored.begin(), ignored.end(),
                      [&](const auto& pair) { return same_pair(pair, plain(first), plain(second)); })) {
        append(let_touch_, plain(first), plain(second));
      } else if (!zone && nearest.distance(a, b, places[i], places[k]) <= margin_) {
        append(touching_, plain(first), plain(second));
      } else {
        append(checked_, plain(first), plain(second));
        add_pair(a, b);
      }
    }
  }
}

void Clearance::add_pair(int a, int b) {
  if (parts_[index(a)].joint > parts_[index(b)].joint) {
    std::swap(a, b);
  }
  const Part& first = parts_[index(a)];
  const Part& last = parts_[index(b)];
  pairs_.push_back({a, b, std::max(first.tool, last.tool), lever_of(arm_, last.solid, first.joint, last.joint)});
}

void Clearance::frames_in_world(const Joints& q, ChainFrames& frames) const noexcept {
  arm_.frames(q, frames);
  if (arm_.world_joint() == 0) {
    return;
  }
  const ChainFrame world = frames[index(arm_.world_joint())];
  const Mat3 back = world.turn.transpose();
  for (int i = 0; i <= arm_.chain_length(); ++i) {
    ChainFrame& frame = frames[index(i)];
    frame = {back * frame.turn, back * (frame.shift - world.shift)};
  }
}

void Clearance::place(const Joints& q, Places& places) const noexcept {
  ChainFrames frames;
  arm_.frames(q, frames);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    places[i] = placed(parts_[i], frames);
  }
}

PlacedSolid Clearance::placed(const Part& part, const ChainFrames& frames) noexcept {
  const ChainFrame& frame = frames[index(part.joint)];
  return {part.solid.kind, part.solid.half, frame.turn * part.solid.place.position + frame.shift,
          frame.turn * part.solid.place.orientation.toRotationMatrix()};
}

void Clearance::name(int pair, char* to, std::size_t size) const noexcept {
  const Pair& one = pairs_[index(pair)];
  const std::string& b = names_[index(parts_[index(one.b)].body)];
  const std::string& a = names_[index(parts_[index(one.a)].body)];
  std::snprintf(to, size, "%s and %s", b.c_str(), a.c_str());
}

std::string Clearance::text() const {
  std::string text = "kept apart: " + (checked_.empty() ? "none" : checked_);
  text += touching_.empty() ? "" : "; not checked, since they touch with all joints at zero: " + touching_;
  text += let_touch_.empty() ? "" : "; may touch (ignore_collisions): " + let_touch_;
  return text;
}

}  // namespace indurop::robot
