// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/constants.h"

#include <indurop/robot/controller.h>

#include <cmath>

namespace indurop::robot {

namespace {

class NoSignals final : public Signals {
 public:
  double read(std::size_t) noexcept override { return 0; }
  void write(std::size_t, double) noexcept override {}
};

bool is_constant(const Formula& formula) noexcept {
  const Reads& reads = formula.reads();
  return formula.size() > 0 && formula.fits() && !reads.variables && !reads.places && !reads.world();
}

// `flaw` says why there is no value.
double value_of(const Formula& formula, const char*& flaw) {
  NoSignals none;
  FormulaInput in{{}, none};
  const double value = formula.value(in);
  flaw = in.flaw;
  return value;
}

}  // namespace

std::optional<double> constant_of(const Formula& formula) {
  if (!is_constant(formula)) {
    return std::nullopt;
  }
  const char* flaw = nullptr;
  const double value = value_of(formula, flaw);
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

void check_constant(const Formula& formula, const JobToken& at, JobLine& line) {
  const char* flaw = nullptr;
  if (!line.failed() && is_constant(formula) && std::isnan(value_of(formula, flaw))) {
    line.error(at, flaw);
  }
}

}  // namespace indurop::robot
