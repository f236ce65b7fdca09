// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/axis_word.h"

#include <cmath>
#include <string>

namespace indurop::robot {

int axis_number(JobLine& line, const ArmShape& shape, Held given) {
  double number = 0;
  if (!(line.numbers(1, &number, "the number of an axis") && number >= 1 && number <= shape.axes &&
        number == std::floor(number))) {
    line.error(line.before(), "axes have the numbers 1 to " + std::to_string(shape.axes));
    return -1;
  }
  const int axis = static_cast<int>(number) - 1;
  if (holds(given, axis)) {
    line.error(line.before(),
               "this line already says where axis " + std::to_string(axis + 1) + " is; leave one of them out");
    return -1;
  }
  return axis;
}

}  // namespace indurop::robot
