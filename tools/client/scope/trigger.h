// SPDX-License-Identifier: Apache-2.0
// The trigger of a scope: an expression that becomes true, or one that "rises", "falls" or "changes".

#pragma once

#include <indurop/result.h>

#include <optional>
#include <span>
#include <string_view>

#include "tools/client/scope/formula.h"

namespace indurop::tools {

class Trigger {
 public:
  // "PLC_ROBOT::I0 rises": from 0 to another number. "falls": the reverse. "speed changes". "speed > 100": becomes
  // true. Errors: those of Formula::parse().
  static Result<Trigger, base::Problem> parse(std::string_view text, const FindOperand& find);

  // Evaluates the next sample; returns true if the trigger fires. It never fires at the first sample.
  bool evaluate(std::span<const double> inputs);

 private:
  enum class Edge { Rises, Falls, Changes };
  Trigger(Formula formula, Edge edge) : formula_(std::move(formula)), edge_(edge) {}

  Formula formula_;
  Edge edge_;
  std::optional<double> before_;
};

}  // namespace indurop::tools
