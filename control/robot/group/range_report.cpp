// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/range_report.h"

#include "control/robot/group/fault_text.h"

namespace indurop::robot {

void RangeReport::step() noexcept {
  const int count = robot_.count();
  for (int i = 0; i < count + robot_.singles.count(); ++i) {
    const bool of_arm = i < count;
    const AxisControl& a = of_arm ? robot_.axes[i] : robot_.singles[i - count];
    const bool meets = a.error() == ErrorCode::JointLimit;
    if (meets && !met_[at(i)] && !robot_.states.moving() && !robot_.states.to_error()) {
      FaultText why;
      name_axis({ErrorCode::JointLimit, i + 1}, of_arm ? robot_.parts.arm.axis(i) : robot_.parts.singles[at(i - count)],
                why);
      robot_.job.set_message(why);
    }
    met_[at(i)] = meets;
  }
}

}  // namespace indurop::robot
