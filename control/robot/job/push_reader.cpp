// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/push_reader.h"

#include <cmath>
#include <string>

namespace indurop::robot {

namespace {

constexpr const char* kExample = "; PUSH AXIS 3 TORQUE 20 Nm SPEED 10 deg/s TIMEOUT 5s";

}  // namespace

// Parses "PUSH AXIS 3 TORQUE -20 Nm SPEED 10 deg/s RAMP 50 FOR 0.5s TIMEOUT 5s STAY", "PUSH AXIS 3 FORCE 80 N SPEED 20
// mm/s UNTIL I4"
void PushReader::push() {
  draft_.add(Op::Push);
  JobPush push;
  axis(push);
  if (!line_.failed()) {
    torque(push);
  }
  if (!line_.failed()) {
    speed(push);
  }
  if (!line_.failed()) {
    ramp(push);
  }
  if (!line_.failed()) {
    ends(push);
  }
  draft_.last().slot = static_cast<int>(draft_.book().pushes.size());
  draft_.book().pushes.push_back(push);
}

void PushReader::axis(JobPush& push) {
  if (!line_.accept("AXIS")) {
    line_.error(line_.peek(), "expected AXIS and its number, found " + JobLine::shown(line_.peek()) + kExample);
    return;
  }
  const JobToken number = line_.peek();
  double axis = 0;
  if (!line_.numbers(1, &axis, "the number of the axis")) {
    return;
  }
  if (!(axis >= 1 && axis <= shape_.axes && axis == std::floor(axis))) {
    line_.error(number, "the arm has axes 1 to " + std::to_string(shape_.axes));
    return;
  }
  push.way.axis = static_cast<int>(axis) - 1;
}

void PushReader::torque(JobPush& push) {
  const char* const word = slides(push) ? "FORCE" : "TORQUE";
  const char* const unit = slides(push) ? "N" : "Nm";
  if (!line_.accept(word)) {
    line_.error(line_.peek(), std::string("expected ") + word + " and a number of " + unit + ", since axis " +
                                  std::to_string(push.way.axis + 1) + (slides(push) ? " slides" : " turns") +
                                  ", found " + JobLine::shown(line_.peek()));
    return;
  }
  if (line_.numbers(1, &push.way.torque, unit) && !line_.accept(unit)) {
    line_.error(line_.peek(), std::string("expected ") + unit + ", found " + JobLine::shown(line_.peek()));
  }
}

void PushReader::speed(JobPush& push) {
  const char* const unit = slides(push) ? "mm/s" : "deg/s";
  if (!line_.accept("SPEED")) {
    line_.error(line_.peek(), "expected SPEED, which the axis does not exceed where nothing is in its way, found " +
                                  JobLine::shown(line_.peek()) + kExample);
    return;
  }
  const JobToken number = line_.peek();
  if (!line_.numbers(1, &push.way.speed, "the speed of the axis")) {
    return;
  }
  if (!(push.way.speed >= 0.001)) {
    line_.error(number, "the speed of an axis that pushes is at least 0.001");
  } else if (!line_.accept_unit(unit)) {
    line_.error(line_.peek(), std::string("expected ") + unit + ", found " + JobLine::shown(line_.peek()));
  }
}

void PushReader::ramp(JobPush& push) {
  if (!line_.accept("RAMP")) {
    return;
  }
  const char* const unit = slides(push) ? "N/s" : "Nm/s";
  const JobToken number = line_.peek();
  if (!line_.numbers(1, &push.way.ramp, "how fast the torque grows")) {
    return;
  }
  if (!(push.way.ramp > 0)) {
    line_.error(number, "a torque grows by more than 0 in a second; without RAMP as fast as it may");
  } else if (!line_.accept_unit(unit)) {
    line_.error(line_.peek(), std::string("expected ") + unit + ", found " + JobLine::shown(line_.peek()));
  }
}

// `end`: the condition or the time that ends it, or TIMEOUT if there is neither.
void PushReader::in_time(const JobPush& push, const JobToken& end) {
  if (line_.failed() || !(push.timeout > 0)) {
    return;
  }
  const double grows = push.way.ramp > 0 ? std::abs(push.way.torque) / push.way.ramp : 0;
  if (push.until >= 0 && draft_.is_never(push.until)) {
    line_.error(end, "this is never true, so the PUSH always fails at its TIMEOUT");
  } else if (push.until < 0 && push.hold >= push.timeout) {
    line_.error(end, "the axis is to push for as long as its TIMEOUT or longer, so it always fails");
  } else if (push.until < 0 && push.hold + grows >= push.timeout) {
    line_.error(end, "with this RAMP the whole torque comes too late for its TIMEOUT, so it always fails");
  }
}

// What ends it, and whether the axis returns.
void PushReader::ends(JobPush& push) {
  const JobToken end = line_.after();
  if (line_.accept("UNTIL")) {
    push.until = expressions_.read("the condition that ends it");
  } else if (line_.accept("FOR")) {
    line_.duration(push.hold);
  }
  if (!line_.failed() && line_.accept("TIMEOUT")) {
    line_.duration(push.timeout);
    in_time(push, end);
  }
  push.stays = !line_.failed() && line_.accept("STAY");
}

}  // namespace indurop::robot
