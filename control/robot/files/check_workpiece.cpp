// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/check_workpiece.h"

namespace indurop::robot {

std::vector<base::Diagnostic> check_workpiece(const JobBook& book, const Arm& arm,
                                              const std::vector<double>& workspace) {
  std::vector<base::Diagnostic> errors;
  if (arm.world_joint() == 0) {
    return errors;
  }
  const auto add = [&errors](const std::string& file, base::SourcePlace place, const std::string& text) {
    errors.push_back({base::Diagnostic::Severity::Error, file, place, text});
  };
  if (!workspace.empty()) {
    add("property workspace", {},
        "it cannot be used with axes that move the workpiece (<workpiece> of the URDF); use a zone (KEEPOUT)");
  }
  for (const Job& job : book.jobs) {
    for (const Step& step : job.steps) {
      if (step.op == Op::Track && step.index >= 0) {
        add(job.file, {static_cast<int>(step.line), 1},
            "TRACK cannot be used with axes that move the workpiece (<workpiece> of the URDF)");
      }
    }
  }
  return errors;
}

}  // namespace indurop::robot
