// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/riding.h"

namespace indurop::robot {

bool Riding::is_in_frame(int point) const noexcept {
  return point >= 0 && book_.points[static_cast<std::size_t>(point)].frame ==
                           book_.computed[static_cast<std::size_t>(computed_)].index;
}

void Riding::skip(const Step& step) noexcept {
  if (step.op == Op::Track) {
    skipped_ = step.index >= 0;
  }
}

StepValues::Flaw Riding::run(const Step& step, const JobPlaces& places, MotionPort& port, bool& done) noexcept {
  skipped_ = false;
  if (step.index < 0) {
    done = end(port);
    return {};
  }
  if (on()) {
    return {"TRACK is on already; end it with TRACK OFF before"};
  }
  const ComputedPlace& frame = book_.computed[static_cast<std::size_t>(step.index)];
  const BeltWay way{static_cast<int>(step.value), step.slot == 1, places.frame(step.mid), places.frame(frame.index)};
  if (const Fault fault = port.track(way); !fault.ok()) {
    return {"the belt has no position: its reader has to write MC_BELT in each period, for 0.4 s"};
  }
  computed_ = step.index;
  done = true;
  return {};
}

bool Riding::end(MotionPort& port) noexcept {
  ErrorCode error = ErrorCode::Ok;
  if (!on()) {
    return true;
  }
  if (!port.ride(false, error)) {
    return false;
  }
  port.release_product();
  reset();
  return true;
}

StepValues::Flaw Riding::prepare(const Step& motion, JobPlaces& places, MotionPort& port, bool& ready) noexcept {
  ready = true;
  if (skipped_) {
    return {"a job cannot begin between TRACK and TRACK OFF; begin at the line of the TRACK"};
  }
  if (!on()) {
    return {};
  }
  const bool wanted = is_in_frame(motion.index);
  if (wanted && (is_of_joints(motion.move) || (motion.move == Move::Circle && !is_in_frame(motion.mid)))) {
    return {"lines, circles and splines follow a frame that moves, with all their points in it"};
  }
  const MotionExtras* const extras = book_.extras_of(motion);
  if (wanted && extras != nullptr && extras->until >= 0) {
    return {"UNTIL cannot end a motion on a frame that moves; wait for the condition there, or leave it before"};
  }
  if (rides_ && motion.index < 0) {
    return {"HERE, FOUND and BACK do not move with the frame; go to a point in it, or end it with TRACK OFF before"};
  }
  if (!port.settled()) {
    ready = wanted == rides_;
    return {};
  }
  if (!wanted && !rides_) {
    return {};
  }
  ErrorCode error = ErrorCode::Ok;
  ready = port.ride(wanted, error);
  if (error != ErrorCode::Ok) {
    return {to_string(error)};
  }
  if (ready) {
    rides_ = wanted;
  }
  if (rides_) {
    places.set(computed_, port.product(), port.product().orientation);
  }
  return {};
}

}  // namespace indurop::robot
