// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/step_values.h"

#include <algorithm>
#include <cstdio>

namespace indurop::robot {

StepValues::Flaw StepValues::number(int formula, Signals& signals, const MotionPort& port,
                                    double& value) const noexcept {
  const Formula& asked = book_.formulas[static_cast<std::size_t>(formula)];
  FormulaInput in = input(signals, port);
  value = asked.value(in);
  return std::isnan(value) ? Flaw{in.flaw, asked.column()} : Flaw{};
}

StepValues::Flaw StepValues::numbers(int first, std::size_t count, Signals& signals, const MotionPort& port,
                                     double* values) const noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    if (const Flaw flaw = number(first + static_cast<int>(i), signals, port, values[i]); !flaw.ok()) {
      return flaw;
    }
  }
  return {};
}

StepValues::Flaw StepValues::setting(const Step& step, Signals& signals, const MotionPort& port,
                                     Step& with) const noexcept {
  with = step;
  if (step.formula < 0) {
    return {};
  }
  double number_of = 0;
  if (const Flaw flaw = number(step.formula, signals, port, number_of); !flaw.ok()) {
    return flaw;
  }
  with.value = number_of * step.value;
  const unsigned column = book_.formulas[static_cast<std::size_t>(step.formula)].column();
  if (step.op == Op::Axis && !std::isfinite(with.value)) {
    return {"an axis cannot stand there", column};
  }
  const bool by_part = step.op == Op::Speed && step.index < 0;
  if (step.op == Op::Speed && !(with.value > 0 && (!by_part || with.value <= 1))) {
    return {"a speed is above 0, and at most 100 %", column};
  }
  if (step.op == Op::Zone && !(with.value >= 0 && with.value <= 1)) {
    return {"a zone is from 0 (stop at the point) to 1000 mm", column};
  }
  if (step.op == Op::Acceleration && !(with.value >= 0.01 && with.value <= 1)) {
    return {"an acceleration is from 1 to 100 % of the full one", column};
  }
  return {};
}

StepValues::Flaw StepValues::text(int index, Signals& signals, const MotionPort& port,
                                  std::span<char> to) const noexcept {
  std::size_t used = 0;
  to[0] = '\0';
  for (const JobText::Part& part : book_.texts[static_cast<std::size_t>(index)].parts) {
    double value = 0;
    if (part.formula >= 0) {
      if (const Flaw flaw = number(part.formula, signals, port, value); !flaw.ok()) {
        return flaw;
      }
    }
    const std::span<char> rest = to.subspan(used);
    const int length = part.formula < 0 ? std::snprintf(rest.data(), rest.size(), "%s", part.text.c_str())
                                        : std::snprintf(rest.data(), rest.size(), "%.10g", value);
    used = std::min(used + static_cast<std::size_t>(std::max(length, 0)), to.size() - 1);
  }
  return {};
}

StepValues::Flaw StepValues::assign(const Step& step, Signals& signals, const MotionPort& port) noexcept {
  const auto index = static_cast<std::size_t>(step.index);
  const bool to_element = step.mid > 0;
  double numbers_of[2] = {};
  if (const Flaw flaw = numbers(step.formula, to_element ? 2 : 1, signals, port, numbers_of); !flaw.ok()) {
    return flaw;
  }
  if (!to_element) {
    jobs_.variables()[index] = numbers_of[0];
    return {};
  }
  const double element = numbers_of[0];
  if (!(element >= 0 && element < step.mid && element == std::floor(element))) {
    return {"an array has no such element; the first one is [0]",
            book_.formulas[static_cast<std::size_t>(step.formula)].column()};
  }
  jobs_.variables()[index + static_cast<std::size_t>(element)] = numbers_of[1];
  return {};
}

StepValues::Flaw StepValues::give_back(const Step& step, Signals& signals, const MotionPort& port) noexcept {
  double value = 0;
  if (step.formula >= 0) {
    if (const Flaw flaw = number(step.formula, signals, port, value); !flaw.ok()) {
      return flaw;
    }
    jobs_.set_value(value);
  }
  jobs_.leave();
  return {};
}

StepValues::Flaw StepValues::compute_place(const Step& step, Signals& signals, const MotionPort& port) noexcept {
  FormulaInput in = input(signals, port);
  Pose pose;
  Quat axes;
  if (!places_.compute(step.mid, in, pose, axes)) {
    return {in.flaw, book_.places[static_cast<std::size_t>(step.mid)].column};
  }
  places_.set(step.index, pose, axes);
  return {};
}

}  // namespace indurop::robot
