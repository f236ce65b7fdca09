// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/call_stack.h"

namespace indurop::robot {

void CallStack::reset(int job) noexcept {
  depth_ = 0;
  frames_[0] = {};
  frames_[0].job = job;
}

void CallStack::call(int job, const Variables& variables, int result) noexcept {
  ++depth_;
  frame() = {};
  frame().job = job;
  frame().variables = variables;
  frame().result = result;
}

void CallStack::finish() noexcept {
  const int result = frame().result;
  const double value = frame().value;
  --depth_;
  if (result >= 0) {
    variables()[static_cast<std::size_t>(result)] = value;
  }
}

const Step* CallStack::step_at(int depth) const noexcept {
  const Frame& there = frames_[static_cast<std::size_t>(depth)];
  const auto at = static_cast<std::size_t>(there.step);
  return at < steps_of(there).size() ? &steps_of(there)[at] : nullptr;
}

void CallStack::jump(int step) noexcept {
  Frame& here = frame();
  here.step = step;
  int open = 0;
  for (int i = 0; i < step; ++i) {
    const Op op = steps()[static_cast<std::size_t>(i)].op;
    open += op == Op::Loop ? 1 : op == Op::End ? -1 : 0;
  }
  for (; here.loops < open; ++here.loops) {
    here.left[static_cast<std::size_t>(here.loops)] = 1;
  }
  here.loops = open;
}

void CallStack::begin_loop(const Step& step) noexcept {
  constexpr double kForEver = 0;
  frame().left[static_cast<std::size_t>(frame().loops++)] = step.value > 0 ? step.value : kForEver;
}

void CallStack::end_loop(const Step& step) noexcept {
  Frame& here = frame();
  double& left = here.left[static_cast<std::size_t>(here.loops - 1)];
  const bool for_ever = left == 0;
  left -= for_ever ? 0 : 1;
  if (for_ever || left > 0) {
    here.step = step.index + 1;
  } else {
    --here.loops;
    ++here.step;
  }
}

}  // namespace indurop::robot
