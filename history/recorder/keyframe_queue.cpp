// SPDX-License-Identifier: Apache-2.0
#include "history/recorder/keyframe_queue.h"

#include <utility>

#include "store/tape/process_keyframes.h"

namespace indurop::recorder {

void KeyframeQueue::follow(const std::shared_ptr<tape::KeyframeFollower>& follower,
                           const std::function<bool(std::uint32_t)>& wanted) {
  for (std::size_t i = 0; i < follower->modules(); ++i) {
    const tape::KeyframeFollower::Module& module = follower->module(i);
    if (wanted(module.module)) {
      Waiting& waiting = waiting_[module.module];
      waiting.form = module.form;
      waiting.follower = follower;
      waiting.index = i;
    }
  }
}

void KeyframeQueue::read(const std::string& node, const tape::TapeHeader& tape,
                         const std::vector<std::uint32_t>& modules, const std::function<bool(std::uint32_t)>& wanted) {
  if (!sought_ && tape.order.load(std::memory_order_acquire) > 0) {
    sought_ = true;
    if (auto opened = tape::KeyframeFollower::open(node, tape); opened) {
      follow(std::make_shared<tape::KeyframeFollower>(std::move(opened).value()), wanted);
    }
  }
  for (const std::uint32_t module : sought_ ? modules : std::vector<std::uint32_t>()) {
    const auto known = waiting_.find(module);
    if (known != waiting_.end() && !known->second.follower->is_replaced()) {
      continue;
    }
    if (auto opened = tape::KeyframeFollower::open_file(tape::process_keyframe_file(node, module), tape); opened) {
      follow(std::make_shared<tape::KeyframeFollower>(std::move(opened).value()), wanted);
    }
  }
  tape::Keyframe keyframe;
  for (auto& [module, waiting] : waiting_) {
    while (waiting.follower->next(waiting.index, keyframe)) {
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
  return waiting_.at(module).form;
}

void KeyframeQueue::begin_file() {
  for (auto& [module, waiting] : waiting_) {
    waiting.channels.clear();
  }
}

}  // namespace indurop::recorder
