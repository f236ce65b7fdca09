// SPDX-License-Identifier: Apache-2.0
#include "node/replay/replayed_memory.h"

#include <utility>

namespace indurop::node {

void ReplayedMemory::expect(const ModuleMemory& memory, bool recorded) noexcept {
  memory_ = &memory;
  recorded_ = recorded;
}

void ReplayedMemory::expect_process(bool declares, bool recorded) noexcept {
  memory_ = nullptr;
  process_declares_ = declares;
  recorded_ = recorded;
}

bool ReplayedMemory::is_declared() const noexcept {
  return memory_ != nullptr ? memory_->is_whole() || memory_->is_empty() : process_declares_;
}

void ReplayedMemory::take(const recorder::KeyframeRecord& keyframe, const std::string& form) {
  keyframe_run_ = keyframe.run;
  form_ = form;
  bytes_.assign(keyframe.bytes.begin(), keyframe.bytes.end());
}

ReplayedMemory::Next ReplayedMemory::next(std::uint64_t run, bool restarted, bool possible) noexcept {
  missing_ += run - std::exchange(next_run_, run + 1);
  if (run < first_ || !possible) {
    ++missing_;
    return Next::Wait;
  }
  const bool begins_with_keyframe = has_keyframes() && keyframe_run_ == run;
  if ((missing_ == 0 && !(renews_ && begins_with_keyframe)) || restarted || is_empty()) {
    missing_ = 0;
    return Next::Run;
  }
  if (begins_with_keyframe) {
    missing_ = 0;
    renews_ = false;
    return Next::Restore;
  }
  if (has_keyframes()) {
    ++waited_;
    ++missing_;
    return Next::Wait;
  }
  return Next::Doubt;
}

std::string ReplayedMemory::why_none() const {
  if (memory_ != nullptr && !memory_->missing().empty()) {
    return "a keyframe cannot hold " + memory_->missing();
  }
  return is_declared() ? "the recording has no keyframe of it" : "it does not declare what it keeps (INDUROP_STATE)";
}

std::vector<std::string> ReplayedMemory::restore() const {
  return memory_->restore(form_, bytes_);
}

}  // namespace indurop::node
