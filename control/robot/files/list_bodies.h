// SPDX-License-Identifier: Apache-2.0
// Lists what the files of a robot say of its surroundings, for tools that show it. Not real-time safe.

#pragma once

#include <array>
#include <string>
#include <vector>

namespace indurop::robot {

struct FileNames;

// A zone, in the frame of the base; or part of a tool, in the frame of the arm's end.
struct ListedBody {
  std::string name;                     // of the zone or of the tool
  std::string kind;                     // "box", "cylinder" (along z) or "ball"
  std::array<double, 3> size{};         // mm, along x, y and z
  std::array<double, 3> position{};     // mm, of its middle
  std::array<double, 3> orientation{};  // deg, roll pitch yaw
  int tool = 0;                         // in the order of the files, from 1; 0: of a zone
};
// A work frame, in the frame of the base.
struct ListedFrame {
  struct Place {
    std::string name;
    std::array<double, 3> position{};  // mm, in the frame of the base
  };
  std::string name;
  std::array<double, 3> position{};     // mm
  std::array<double, 3> orientation{};  // deg, roll pitch yaw
  bool computed = false;                // jobs compute it: this is where the files declare it
  std::vector<Place> points{};          // that are declared in it
};
// A belt or a table that jobs track (TRACK).
struct ListedBelt {
  int number = 1;      // as in TRACK
  bool turns = false;  // a table
  std::string along;   // frame along whose x axis, or about whose z axis, it moves
  std::string part;    // frame that moves with it
  double length = 0;   // mm that were taught of it; 0: not known
};
struct ListedBodies {
  std::vector<std::string> frames;       // work frames, by name
  std::vector<ListedFrame> work_frames;  // none if there is a problem, as of the next ones
  std::vector<ListedBelt> belts;
  std::vector<ListedBody> zones, tools;  // none if there is a problem
  std::string problem;                   // the first error of the files, as a zone in a frame that jobs compute
};
ListedBodies list_bodies(const FileNames& names);

}  // namespace indurop::robot
