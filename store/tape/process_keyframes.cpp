// SPDX-License-Identifier: Apache-2.0
#include "store/tape/process_keyframes.h"

#include <array>

namespace indurop::tape {

std::string process_keyframe_file(const std::string& node, std::uint32_t module) {
  return vars::keyframe_file(node) + "." + std::to_string(module);
}

Result<ProcessKeyframes> ProcessKeyframes::create(const std::string& node, std::uint32_t module, std::int32_t node_pid,
                                                  const Plan& plan) {
  const std::array plans{KeyframePlan{module, plan.most, plan.form}};
  const auto prepare = [](std::byte* more) { reinterpret_cast<KeyframeRequestWords*>(more)->wake.init(true); };
  auto writer = KeyframeWriter::create(
      KeyframeFile{process_keyframe_file(node, module), node_pid, sizeof(KeyframeRequestWords), prepare}, plans);
  return writer ? Result<ProcessKeyframes>(ProcessKeyframes(std::move(writer).value())) : writer.error();
}

Result<ProcessKeyframes> ProcessKeyframes::open(const std::string& node, std::uint32_t module, std::int32_t node_pid) {
  auto writer = KeyframeWriter::open({process_keyframe_file(node, module), node_pid, sizeof(KeyframeRequestWords)});
  return writer ? Result<ProcessKeyframes>(ProcessKeyframes(std::move(writer).value())) : writer.error();
}

KeyframeRequestWords& ProcessKeyframes::words() const noexcept {
  return *reinterpret_cast<KeyframeRequestWords*>(writer_.more());
}

}  // namespace indurop::tape
