// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/pushing.h"

namespace indurop::robot {

StepValues::Flaw Pushing::run(const Step& step, double seconds, int source, Signals& signals, MotionPort& port,
                              bool& done) noexcept {
  const JobPush& push = book_.pushes[static_cast<std::size_t>(step.slot)];
  StepValues::Flaw flaw;
  switch (phase_) {
    case Phase::None:
      flaw = begin(push, port);
      break;
    case Phase::Pushes:
      flaw = this->push(push, seconds, signals, port);
      break;
    case Phase::Ends:
      flaw = port.settled() ? end(push, source, port) : flaw;
      break;
    case Phase::Returns:
      phase_ = port.settled() ? Phase::None : phase_;
      break;
  }
  done = flaw.ok() && phase_ == Phase::None;
  return flaw;
}

void Pushing::resume() noexcept {
  again_ = phase_ == Phase::Pushes || phase_ == Phase::Ends;
  phase_ = again_ ? Phase::None : phase_;
}

StepValues::Flaw Pushing::begin(const JobPush& push, MotionPort& port) noexcept {
  from_ = again_ ? from_ : port.commanded();
  again_ = false;
  passed_ = reached_ = 0;
  why_ = nullptr;
  if (const Fault fault = port.push(push.way); !fault.ok()) {
    return {to_string(fault.code)};
  }
  places_.set_found({});
  phase_ = Phase::Pushes;
  return {};
}

StepValues::Flaw Pushing::push(const JobPush& push, double seconds, Signals& signals, MotionPort& port) noexcept {
  const PushState now = port.pushing();
  if (!now.error.ok()) {
    return fail(now.error.code == ErrorCode::Speed
                    ? "the axis got faster than the SPEED of its PUSH: the obstacle gave way, or something pushes it"
                    : to_string(now.error.code),
                port);
  }
  passed_ += seconds;
  reached_ = now.reached ? reached_ + seconds : 0;
  double met = now.reached && reached_ >= push.hold ? 1 : 0;
  if (push.until >= 0) {
    if (const auto flaw = values_.number(push.until, signals, port, met); !flaw.ok()) {
      port.end_push();
      phase_ = Phase::None;
      return flaw;
    }
  }
  if (met != 0) {
    const Joints at = port.measured();
    places_.set_found({true, at, port.tip_at(at)});
    port.end_push();
    phase_ = Phase::Ends;
  } else if (push.timeout > 0 && passed_ >= push.timeout) {
    return fail("the axis has pushed in vain for the time of its TIMEOUT", port);
  }
  return {};
}

// What failed is said when the axis is at rest, where the job may continue after RECOVER.
StepValues::Flaw Pushing::fail(const char* why, MotionPort& port) noexcept {
  port.end_push();
  why_ = why;
  phase_ = Phase::Ends;
  return {};
}

StepValues::Flaw Pushing::end(const JobPush& push, int source, MotionPort& port) noexcept {
  phase_ = Phase::None;
  if (why_ != nullptr) {
    return {why_};
  }
  if (!push.stays) {
    MoveCommand back;
    back.target.joints = from_;
    back.straight = true;
    back.speed = port.pushing().pace;
    back.source = source;
    static_cast<void>(port.move(back));
    phase_ = Phase::Returns;
  }
  return {};
}

}  // namespace indurop::robot
