// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/running_node.h"

#include <cstring>
#include <utility>

namespace indurop::deploy {

using scheduler::RunBlock;

std::optional<vars::RunFile> open_running_node(const std::string& board) {
  auto file = vars::RunFile::open(board, vars::Mode::ReadWrite, scheduler::kRunMagic, sizeof(RunBlock));
  const auto* const block = file ? static_cast<const RunBlock*>(file.value().data()) : nullptr;
  if (block == nullptr || block->abi != scheduler::kRunAbi || block->total_size > file.value().size() ||
      block->state.load() != scheduler::NodeState::Running) {
    return std::nullopt;
  }
  return std::move(file).value();
}

RunBlock& run_block(const vars::RunFile& file) noexcept {
  return *static_cast<RunBlock*>(file.data());
}

scheduler::ModuleRecord* find_module_record(RunBlock& run, const std::string& name) {
  for (std::uint32_t i = 0; i < run.module_count; ++i) {
    if (name == run.modules()[i].name) {
      return &run.modules()[i];
    }
  }
  return nullptr;
}

std::string describe_unwritten(const Error& error) {
  return std::string("the folder of the node cannot be written: ") + std::strerror(error.sys_errno);
}

}  // namespace indurop::deploy
