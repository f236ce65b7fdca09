// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/read_bodies.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "control/robot/collision/collision_check.h"
#include "control/robot/kinematics/tool_set.h"

namespace indurop::robot {

namespace {

using Diagnostics = std::vector<base::Diagnostic>;
using Severity = base::Diagnostic::Severity;

constexpr double kTip = 0.0005;  // m around the tip of a tool that has no body

bool known(const std::string& name, const ArmModel& model, const JobBook& book) {
  const auto same = [&](const auto& each) { return each.name == name; };
  return std::find(model.links.begin(), model.links.end(), name) != model.links.end() ||
         std::any_of(book.tools.begin(), book.tools.end(), same) ||
         std::any_of(book.keepouts.begin(), book.keepouts.end(), same);
}

// Parses "link1 link3, link1 link4"
void take_ignored(const std::string& text, const ArmModel& model, const JobBook& book, Bodies& bodies,
                  Diagnostics& found) {
  std::istringstream pairs(text);
  for (std::string pair; std::getline(pairs, pair, ',');) {
    std::istringstream words(pair);
    std::string a;
    std::string b;
    std::string more;
    words >> a >> b;
    if (a.empty()) {
      continue;
    }
    std::string wrong;
    if (b.empty() || words >> more) {
      wrong =
          "write two names of links, tools or zones, and a comma before the next two: upper_arm wrist, forearm table";
    } else if (!known(a, model, book) || !known(b, model, book)) {
      wrong = "there is no link, tool or zone '" + (known(a, model, book) ? b : a) + "'";
    }
    if (!wrong.empty()) {
      found.push_back({Severity::Error, "property ignore_collisions", {}, wrong});
    }
    bodies.ignored.emplace_back(a, b);
  }
}

void take_tools(const JobBook& book, Bodies& bodies) {
  for (std::size_t i = 1; i < book.tools.size(); ++i) {
    const Tool& tool = book.tools[i];
    const int number = static_cast<int>(i);
    bool any = false;
    for (const BodyLine& body : book.bodies) {
      if (body.tool == number) {
        bodies.tools.push_back({tool.name, body.solid, number});
        any = true;
      }
    }
    if (!any) {
      bodies.tools.push_back({tool.name, Solid::ball(kTip, tool.tip), number});
    }
  }
}

void tell(const ArmModel& model, const JobBook& book, const std::string& urdf, const Clearance& clearance,
          Diagnostics& found) {
  const bool asked = !book.keepouts.empty() || !book.bodies.empty();
  if (model.arm.chain_length() == 0) {
    if (asked || !model.bodies.empty()) {
      found.push_back({Severity::Warning, urdf, {1, 1}, "collisions of a delta are not checked"});
    }
  } else if (model.bodies.empty() && asked) {
    found.push_back(
        {Severity::Warning,
         urdf,
         {1, 1},
         "no link has a body (<collision> with a <box>, <cylinder> or <sphere>): only tools are kept out of "
         "zones, not the arm"});
  } else if (model.bodies.empty()) {
    found.push_back({Severity::Note, urdf, {1, 1}, "no link has a body (<collision>): collisions are not checked"});
  }
  if (clearance.known()) {
    found.push_back({Severity::Note, urdf, {1, 1}, clearance.text()});
  }
}

// The pair that would touch there; empty if it is clear.
std::string touched(const Clearance& clearance, CollisionCheck& way, const Joints& q, int tool) {
  way.begin(q, tool);
  if (way.pair() < 0) {
    return "";
  }
  char name[120];
  clearance.name(way.pair(), name, sizeof name);
  return name;
}

}  // namespace

ReadBodies read_bodies(const ArmModel& model, const JobBook& book, const std::string& urdf, const std::string& ignored,
                       double clearance) {
  ReadBodies read;
  Bodies bodies;
  bodies.clearance = clearance / 1000;
  bodies.links = model.bodies;
  for (const BodyLine& zone : book.keepouts) {
    Solid solid = zone.solid;
    if (zone.frame >= 0) {
      solid.place = book.frames[static_cast<std::size_t>(zone.frame)].pose * solid.place;
    }
    bodies.zones.push_back({zone.name, solid, -1});
  }
  take_tools(book, bodies);
  take_ignored(ignored, model, book, bodies, read.found);
  read.clearance = Clearance(model.arm, bodies);
  tell(model, book, urdf, read.clearance, read.found);
  return read;
}

Diagnostics check_room(const Arm& arm, const Clearance& clearance, const std::string& urdf) {
  constexpr int kPlaces = 500;
  constexpr int kMany = 25;  // of 100
  std::map<std::string, std::set<int>> touching;
  Clearance::Places places(clearance.parts().size());
  for (int i = 0; i < kPlaces; ++i) {
    clearance.place(arm.spread(i), places);
    for (std::size_t k = 0; k < clearance.pairs().size(); ++k) {
      const Clearance::Pair& pair = clearance.pairs()[k];
      if (pair.tool == 0 && clearance.least(pair, places) <= 0) {
        char name[120];
        clearance.name(static_cast<int>(k), name, sizeof name);
        touching[name].insert(i);
      }
    }
  }
  Diagnostics warnings;
  for (const auto& [name, where] : touching) {
    if (const int percent = static_cast<int>(where.size()) * 100 / kPlaces; percent > kMany) {
      warnings.push_back(
          {Severity::Warning,
           urdf,
           {1, 1},
           name + " are too near to each other at " + std::to_string(percent) +
               " % of all places of the axes; bodies that fit closer, or a smaller clearance, leave more "
               "room, and ignore_collisions names what may touch"});
    }
  }
  return warnings;
}

// The tool at a point is known only when the job runs: collisions that every tool would have are reported now.
Diagnostics check_clear(const JobBook& book, const Arm& arm, const Clearance& clearance) {
  Diagnostics warnings;
  if (!clearance.known()) {
    return warnings;
  }
  const ToolSet tools(arm, book.tips());
  CollisionCheck way(clearance, true);
  for (const Point& point : book.points) {
    const Target& target = point.target;
    std::string what;
    bool possible = false;
    for (int tool = 0; tool < tools.count() && !possible; ++tool) {
      if (!target.is_pose) {
        what = touched(clearance, way, target.joints, tool);
        possible = what.empty();
      } else if (tools.inverse(tool).closed_form() && target.held == 0 &&
                 !tools.inverse(tool).leaves_workpiece_open(0)) {
        const Solutions all = tools.inverse(tool).all(target.pose, target.joints);
        for (int i = 0; i < all.count && !possible; ++i) {
          what = touched(clearance, way, all.list[static_cast<std::size_t>(i)].q, tool);
          possible = what.empty();
        }
      } else {
        possible = true;
      }
    }
    if (!possible && !what.empty()) {
      warnings.push_back({Severity::Warning, point.file, point.place,
                          "point '" + point.name + "': " + what + " are too near to each other there"});
    }
  }
  return warnings;
}

}  // namespace indurop::robot
