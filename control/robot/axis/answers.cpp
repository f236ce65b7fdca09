// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/answers.h"

namespace indurop::robot {

void AxisAnswers::finish(AxisOwner& owner, ErrorCode code) noexcept {
  if (!owner.any() && code == ErrorCode::Ok) {
    return;
  }
  if (owner.is_request()) {
    std::uint32_t& number = code == ErrorCode::Ok ? report_.done : report_.aborted;
    number = report_.acknowledged;
  } else if (owner.is_command() && owner.ticket == holder_ && code == ErrorCode::Ok) {
    table_->holds(owner.ticket);
  } else if (owner.is_command()) {
    holder_ = owner.ticket == holder_ ? AxisOwner::kNone : holder_;
    table_->end(owner.ticket, code);
  }
  owner = {};
  // The reason for ErrorStop stays known.
  const bool keeps = code == ErrorCode::Aborted || (code == ErrorCode::Ok && state_ == AxisState::ErrorStop);
  report_.error = keeps ? report_.error : code;
}

void AxisAnswers::answer(int ticket, AxisService service, ErrorCode code) noexcept {
  AxisOwner owner{ticket, service};
  finish(owner, code);
}

void AxisAnswers::active(int ticket) noexcept {
  if (ticket >= 0) {
    table_->active(ticket);
  }
}

void AxisAnswers::forget_error() noexcept {
  report_.error = state_ == AxisState::ErrorStop ? report_.error : ErrorCode::Ok;
}

}  // namespace indurop::robot
