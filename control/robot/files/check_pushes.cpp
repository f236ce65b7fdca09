// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/check_pushes.h"

#include <cmath>
#include <sstream>

#include "control/robot/kinematics/settings.h"

namespace indurop::robot {

std::vector<base::Diagnostic> check_pushes(const JobBook& book, const ArmModel& model,
                                           const std::vector<double>& rated) {
  std::vector<base::Diagnostic> errors;
  if (!model.dynamics.known() || rated.empty()) {
    return errors;
  }
  for (const Job& job : book.jobs) {
    for (const Step& step : job.steps) {
      if (step.op != Op::Push) {
        continue;
      }
      const PushWay& way = book.pushes[static_cast<std::size_t>(step.slot)].way;
      const double effort = model.dynamics.effort()[way.axis];
      const double most = effort > 0 ? effort : of_axes(rated)[way.axis];
      if (most > 0 && std::abs(way.torque) > most) {
        std::ostringstream text;
        text << "axis " << way.axis + 1 << " pushes with at most " << most
             << (model.arm.axis(way.axis).slides() ? " N" : " Nm")
             << (effort > 0 ? " (<limit effort> of the URDF)" : " (property rated_torque)");
        errors.push_back({base::Diagnostic::Severity::Error, job.file, {static_cast<int>(step.line), 1}, text.str()});
      }
    }
  }
  return errors;
}

}  // namespace indurop::robot
