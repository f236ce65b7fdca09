// SPDX-License-Identifier: Apache-2.0
#include "store/tape/process_keyframes.h"

#include <array>
#include <filesystem>
#include <system_error>

namespace indurop::tape {

std::string process_keyframe_file(const std::string& node, std::uint32_t module) {
  return vars::keyframe_file(node) + "." + std::to_string(module);
}

namespace {

std::string file_of(const std::string& node, std::uint32_t module, ProcessKeyframes::Of of) {
  return process_keyframe_file(node, module) + (of == ProcessKeyframes::Of::Next ? ".next" : "");
}

}  // namespace

Result<ProcessKeyframes> ProcessKeyframes::create(const std::string& node, std::uint32_t module, std::int32_t node_pid,
                                                  const Plan& plan) {
  const std::array plans{KeyframePlan{module, plan.most, plan.form}};
  const auto prepare = [](std::byte* more) { reinterpret_cast<KeyframeRequestWords*>(more)->wake.init(true); };
  auto writer = KeyframeWriter::create(
      KeyframeFile{file_of(node, module, Of::Next), node_pid, sizeof(KeyframeRequestWords), prepare}, plans);
  return writer ? Result<ProcessKeyframes>(ProcessKeyframes(std::move(writer).value())) : writer.error();
}

Status ProcessKeyframes::set_running(const std::string& node, std::uint32_t module) {
  const std::filesystem::path folder(vars::kShmDirectory);
  std::error_code error;
  std::filesystem::rename(folder / file_of(node, module, Of::Next), folder / file_of(node, module, Of::Running), error);
  return error ? Status(Error{Errc::System, error.value(), "rename keyframes"}) : Status();
}

void ProcessKeyframes::remove(const std::string& node, std::uint32_t module, Of of) {
  (void)vars::remove_shm_file(file_of(node, module, of));
}

Result<ProcessKeyframes> ProcessKeyframes::open(const std::string& node, std::uint32_t module, std::int32_t node_pid,
                                                Of of) {
  auto writer = KeyframeWriter::open({file_of(node, module, of), node_pid, sizeof(KeyframeRequestWords)});
  return writer ? Result<ProcessKeyframes>(ProcessKeyframes(std::move(writer).value())) : writer.error();
}

KeyframeRequestWords& ProcessKeyframes::words() const noexcept {
  return *reinterpret_cast<KeyframeRequestWords*>(writer_.more());
}

}  // namespace indurop::tape
