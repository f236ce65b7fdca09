// SPDX-License-Identifier: Apache-2.0
// The content of the job files with everything that is derived from it, ready to replace what a robot has loaded:
// nothing of it allocates once it exists.

#pragma once

#include <indurop/result.h>

#include <memory>
#include <string>
#include <vector>

#include "control/robot/collision/collision_check.h"
#include "control/robot/files/files.h"
#include "control/robot/kinematics/tool_set.h"
#include "core/base/problem.h"

namespace indurop::robot {

struct Program {
  Program(const Arm& arm, JobBook read, Clearance made);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() = default;

  JobBook book;
  Clearance clearance;
  ToolSet tools;
  // Collision checks of the same bodies: for planning, for the follower, for motions that were not planned, and for
  // their way to rest.
  CollisionCheck planned, followed, unplanned, to_rest;
};

// Reads the job files again. Errors (one line, with the number of further ones): they or the surroundings have errors,
// or the arm's description is no longer `urdf`.
Result<std::unique_ptr<Program>, base::Problem> read_program(const FileNames& names, const std::string& urdf);

}  // namespace indurop::robot
