// SPDX-License-Identifier: Apache-2.0
// What the job files say, with all that is made of it, ready to take the place of what a robot has: nothing of it
// allocates once it is there.

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "robot/clear_way.h"
#include "robot/files.h"
#include "robot/tool_set.h"

namespace indurop::robot {

struct Program {
  Program(const Arm& arm, JobBook read, Clearance made);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() = default;

  JobBook book;
  Clearance clearance;
  ToolSet tools;
  // Of the same bodies: for planning, for the follower, for what nobody planned, and its way to rest.
  ClearWay planned, followed, unplanned, to_rest;
};

// Reads the job files anew. Null, and why in `error` (one line, and how many others there are), if they or the
// surroundings have errors, or if the arm's description is not `urdf` any more.
std::unique_ptr<Program> read_program(const FileNames& names, const std::string& urdf, std::string& error);

}  // namespace indurop::robot
