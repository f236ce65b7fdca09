// SPDX-License-Identifier: Apache-2.0
// TRY and RECOVER: their lines, and the handling of an error between them.

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "control/robot/job/parser.h"
#include "control/robot/job/runner.h"

namespace indurop::robot {

void JobParser::try_block() {
  const std::size_t start = job().steps.size();
  add(Op::Try);
  blocks_.push_back({"TRY", line_, start, start, {}, -1, 1, false});
}

void JobParser::recover() {
  if (blocks_.empty() || std::string_view(blocks_.back().word) != "TRY" || blocks_.back().has_else) {
    error(tokens_[0], "RECOVER without TRY");
    return;
  }
  constexpr const char* kNumber = "ERROR";
  const int known = variable_called(kNumber);
  const int number = known >= 0 ? known : new_variable({JobToken::Kind::Word, kNumber, 0, tokens_[0].column});
  Block& block = blocks_.back();
  block.has_else = true;
  block.pending = kNone;
  block.ends.push_back(job().steps.size());
  add(Op::EndTry);
  auto& steps = job().steps;
  for (std::size_t i = block.start + 1; i < steps.size(); ++i) {
    steps[i].guard = steps[i].guard < 0 ? static_cast<int>(block.start) : steps[i].guard;
  }
  steps[block.start].index = static_cast<int>(steps.size());
  steps[block.start].mid = number;
  add(Op::Recover);
}

// The innermost TRY applies, also one around a CALL, but not one of an interrupted job.
bool JobRunner::recover(Fault fault, const char* why, int source, std::uint32_t ticket) noexcept {
  if (!running() || serving_ == Serving::Leaving || serving_ == Serving::Returning) {
    return false;
  }
  const int last = serving_ == Serving::Runs ? interrupted_.depth + 1 : 0;
  for (int depth = depth_; depth >= last; --depth) {
    const Frame& here = frames_[static_cast<std::size_t>(depth)];
    const auto& steps = job_of(here.job).steps;
    const auto at = static_cast<std::size_t>(here.step);
    if (at >= steps.size() || steps[at].guard < 0) {
      continue;
    }
    describe(why, source);
    for (Trigger& each : triggers_) {
      each.waits = each.waits && each.ticket < ticket;
    }
    depth_ = depth;
    const Step& guard = steps[static_cast<std::size_t>(steps[at].guard)];
    frame().variables[static_cast<std::size_t>(guard.mid)] = static_cast<double>(fault.code);
    jump(guard.index);
    state_ = JobState::Runs;
    waited_ = 0;
    return true;
  }
  return false;
}

// Adds file and line: of the motion `source`, or of the present step.
void JobRunner::describe(const char* why, int source) noexcept {
  const int job = source > 0 ? source >> kLineBits : frame().job;
  line_ = source > 0 ? line_of(source) : line_;
  line_job_ = job;
  const std::string& file = job_of(job).file;
  const char* name = file.c_str() + (file.find_last_of('/') + 1);
  std::snprintf(message_, sizeof message_, "%.80s:%u: %s", name, line_, why);
}

void JobRunner::refuse(Fault fault, const char* why) noexcept {
  constexpr std::uint32_t kNone = ~0U;  // all commanded motions are possible
  if (!recover(fault, why, 0, kNone)) {
    fail(fault, why, 0);
  }
}

}  // namespace indurop::robot
