// SPDX-License-Identifier: Apache-2.0
// The pairs of bodies of an arm that must stay clear of each other, and a lower bound of their distance for given joint
// positions. Created once, when the task is loaded.

#pragma once

#include <string>
#include <vector>

#include "control/robot/collision/bodies.h"
#include "control/robot/kinematics/arm.h"

namespace indurop::robot {

class Clearance {
 public:
  // One solid of the arm, of a tool or of a zone.
  struct Part {
    int body = 0;   // index of its name
    int joint = 0;  // number of moving joints of the chain that move it
    int tool = 0;   // only while this tool is held; 0: always
    Solid solid;    // in the base's frame, joints at zero
    // m that a point of it moves at most, seen from the world, when an axis moves by 1 rad (or m).
    Joints lever = Joints::Zero();
  };
  struct Pair {
    int a = 0, b = 0;  // parts; the joints between them are those of `b` after `a`
    int tool = 0;
    // m that a point of one moves at most, seen from the other, when an axis moves by 1 rad (or m).
    Joints lever = Joints::Zero();
  };
  using Places = std::vector<PlacedSolid>;

  Clearance() = default;
  Clearance(const Arm& arm, const Bodies& bodies);

  // Returns whether there are bodies that could touch.
  [[nodiscard]] bool known() const noexcept { return !pairs_.empty(); }
  [[nodiscard]] const std::vector<Part>& parts() const noexcept { return parts_; }
  [[nodiscard]] const std::vector<Pair>& pairs() const noexcept { return pairs_; }
  // m; anything nearer counts as touching.
  [[nodiscard]] double margin() const noexcept { return margin_; }

  // Returns whether a part belongs to the arm or to a tool, not to a zone.
  [[nodiscard]] bool is_of_arm(std::size_t part) const noexcept { return part < first_zone_; }
  // Computes the frames of the arm's joints, seen from the world, and where a part is. Real-time safe, like all
  // functions below.
  void frames_in_world(const Joints& q, ChainFrames& frames) const noexcept;
  [[nodiscard]] static PlacedSolid placed(const Part& part, const ChainFrames& frames) noexcept;
  // Computes where the parts are. `places` has one entry for each.
  void place(const Joints& q, Places& places) const noexcept;
  // Returns a lower bound of the distance between the two, less the margin, in m.
  [[nodiscard]] double least(const Pair& pair, const Places& places) const noexcept {
    return least_distance(places[index(pair.a)], places[index(pair.b)]) - margin_;
  }
  [[nodiscard]] bool counts(const Pair& pair, int tool) const noexcept { return pair.tool == 0 || pair.tool == tool; }
  // Writes the names of a pair: "'forearm' and zone 'table'".
  void name(int pair, char* to, std::size_t size) const noexcept;
  // Describes in words which pairs are checked and which are not. Not real-time safe.
  [[nodiscard]] std::string text() const;

 private:
  static std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }
  void add(const std::string& name, const Part& part);
  void connect(const std::vector<std::pair<std::string, std::string>>& ignored);
  void add_pair(int a, int b);
  [[nodiscard]] bool is_zone(int part) const noexcept { return index(part) >= first_zone_; }

  Arm arm_{Arm::Axes{}, Pose{}, 0};
  double margin_ = 0;
  std::vector<std::string> names_;
  std::vector<Part> parts_;
  std::vector<Pair> pairs_;
  std::size_t first_zone_ = 0;
  std::string checked_, touching_, let_touch_;
};

}  // namespace indurop::robot
