// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/check_splines.h"

namespace indurop::robot {

std::vector<base::Diagnostic> check_splines(const JobBook& book, const Inverse& inverse) {
  std::vector<base::Diagnostic> errors;
  for (const Job& job : book.jobs) {
    for (const Step& step : job.steps) {
      if (step.op != Op::Move || step.move != Move::Spline || step.index < 0 || !inverse.closed_form()) {
        continue;
      }
      const Point& point = book.points[static_cast<std::size_t>(step.index)];
      if (!point.target.is_pose || book.is_computed(point)) {
        continue;
      }
      const Solutions found = inverse.all(point.target.pose, Joints::Zero());
      if (found.count == 0) {
        errors.push_back({base::Diagnostic::Severity::Error,
                          job.file,
                          {static_cast<int>(step.line), 1},
                          "the spline cannot pass point '" + point.name +
                              "': the arm cannot hold its tool like that there" +
                              (found.reach == Reach::JointLimit ? " within the limits of its joints" : "") +
                              "; give it a nearer position or another orientation"});
      }
    }
  }
  return errors;
}

}  // namespace indurop::robot
