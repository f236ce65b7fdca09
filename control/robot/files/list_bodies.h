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
struct ListedBodies {
  std::vector<std::string> frames;       // work frames, by name
  std::vector<ListedBody> zones, tools;  // none if there is a problem
  std::string problem;                   // the first error of the files, as a zone in a frame that jobs compute
};
ListedBodies list_bodies(const FileNames& names);

}  // namespace indurop::robot
