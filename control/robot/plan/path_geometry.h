// SPDX-License-Identifier: Apache-2.0
// The geometry of a commanded motion: its target, the circle through three points, its length, and the limits set by
// the tool and the command.

#pragma once

#include "control/robot/kinematics/errors.h"
#include "control/robot/plan/draft.h"

namespace indurop::robot {

// Makes the path of a command that starts where the draft's segment does, at rest. A path without length is 0 long.
// Real-time safe, like all functions of this file. Errors: Value, Unreachable, JointLimit, Circle.
Fault make_path(const Places& places, const MoveCommand& command, Draft& draft) noexcept;
// Finds where the joints may be at the end of a free motion: first the place that a joint motion would go to, then, for
// a pose that any posture may have, its other solutions, nearer ones first. Errors: Value, Unreachable, JointLimit.
Fault find_goals(const Places& places, const MoveCommand& command, Draft& draft, Solutions& goals) noexcept;
// Makes the path of a free motion, which is not changed until it has ended; 0 long if it is there already.
void make_path(const Places& places, const MoveCommand& command, const JointPath& path, Draft& draft) noexcept;
// Returns the length of the arc through three places, in m; 0 if they are on one line.
[[nodiscard]] double arc_way(const Vec3& start, const Vec3& mid, const Vec3& end) noexcept;
// Makes the path of a chain, which is not changed until the motion has ended. Errors: Value.
Fault make_path(const ToolPath& chain, Draft& draft) noexcept;

}  // namespace indurop::robot
