// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/check_calls.h"

#include <algorithm>

namespace indurop::robot {

namespace {

// Returns whether the step may branch: after it, the next step is not certain.
bool parts_ways(Op op) noexcept {
  return op == Op::If || op == Op::Unless || op == Op::Goto || op == Op::Return || op == Op::Raise || op == Op::Try ||
         op == Op::Again;
}

// Returns the calls that every run of the job reaches.
std::vector<const Step*> certain_calls(const Job& job) {
  std::vector<const Step*> calls;
  for (const Step& step : job.steps) {
    if (parts_ways(step.op)) {
      break;
    }
    if (step.op == Op::Call && step.index >= 0) {
      calls.push_back(&step);
    }
  }
  return calls;
}

// Returns whether every run of `from` reaches job `to`.
bool comes_to(const JobBook& book, int from, int to, std::vector<bool>& seen) {
  if (from == to) {
    return true;
  }
  if (seen[static_cast<std::size_t>(from)]) {
    return false;
  }
  seen[static_cast<std::size_t>(from)] = true;
  const auto calls = certain_calls(book.jobs[static_cast<std::size_t>(from)]);
  return std::any_of(calls.begin(), calls.end(),
                     [&](const Step* call) { return comes_to(book, call->index, to, seen); });
}

}  // namespace

std::vector<base::Diagnostic> check_calls(const JobBook& book) {
  std::vector<base::Diagnostic> warnings;
  for (int i = 0; i < static_cast<int>(book.jobs.size()); ++i) {
    const Job& job = book.jobs[static_cast<std::size_t>(i)];
    for (const Step* call : certain_calls(job)) {
      std::vector<bool> seen(book.jobs.size());
      if (comes_to(book, call->index, i, seen)) {
        const bool itself = call->index == i;
        warnings.push_back({base::Diagnostic::Severity::Warning,
                            job.file,
                            {static_cast<int>(call->line), 1},
                            "job '" + job.name + "' " + (itself ? "calls itself" : "comes back here by this call") +
                                " whatever happens, and never ends; use LOOP, or call it under a condition"});
        break;
      }
    }
  }
  return warnings;
}

}  // namespace indurop::robot
