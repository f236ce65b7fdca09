// SPDX-License-Identifier: Apache-2.0
#include "history/recorder/keyframe_queue.h"

#include <utility>

namespace indurop::recorder {

void KeyframeQueue::read(const std::string& node, const tape::TapeHeader& tape,
                         const std::function<bool(std::uint32_t)>& wanted) {
  if (!sought_ && tape.order.load(std::memory_order_acquire) > 0) {
    sought_ = true;
    if (auto opened = tape::KeyframeFollower::open(node, tape); opened) {
      follower_.emplace(std::move(opened).value());
    }
    for (std::size_t i = 0; follower_ && i < follower_->modules(); ++i) {
      if (const std::uint32_t module = follower_->module(i).module; wanted(module)) {
        waiting_[module].index = i;
      }
    }
  }
  tape::Keyframe keyframe;
  for (auto& [module, waiting] : waiting_) {
    while (follower_->next(waiting.index, keyframe)) {
      waiting.keyframes.push_back(keyframe);
    }
  }
}

const tape::Keyframe* KeyframeQueue::of(std::uint32_t module, std::uint64_t run) {
  const auto found = waiting_.find(module);
  if (found == waiting_.end()) {
    return nullptr;
  }
  auto& keyframes = found->second.keyframes;
  while (!keyframes.empty() && keyframes.front().head.run < run) {
    keyframes.pop_front();
  }
  return keyframes.empty() || keyframes.front().head.run != run ? nullptr : &keyframes.front();
}

const std::string& KeyframeQueue::form(std::uint32_t module) const {
  return follower_->module(waiting_.at(module).index).form;
}

void KeyframeQueue::begin_file() {
  for (auto& [module, waiting] : waiting_) {
    waiting.channel = 0;
  }
}

}  // namespace indurop::recorder
