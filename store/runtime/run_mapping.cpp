// SPDX-License-Identifier: Apache-2.0

#include "store/runtime/run_mapping.h"

#include <utility>

#include "store/vars/process.h"

namespace indurop::runtime {

namespace {

using scheduler::RunBlock;

template <class T>
bool fits(std::uint64_t offset, std::uint64_t count, std::uint64_t size) noexcept {
  return offset % alignof(T) == 0 && offset <= size && count * sizeof(T) <= size - offset;
}

bool is_sound(const RunBlock& run, std::uint64_t size) noexcept {
  const std::uint64_t count = run.module_capacity;
  if (run.total_size > size || run.module_count > count ||
      !fits<scheduler::ModuleRecord>(run.modules_offset, count, size) ||
      !fits<scheduler::ProcessSlot>(run.slots_offset, count, size) ||
      !fits<scheduler::MessageRing>(run.rings_offset, count + 1, size)) {
    return false;
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto& record = run.modules()[i];
    if (!fits<char>(record.property_offset, record.property_size, size)) {
      return false;
    }
  }
  for (std::uint64_t i = 0; i <= count; ++i) {
    const auto& ring = run.rings()[i];
    if (!fits<scheduler::MessageEntry>(ring.entries_offset, ring.capacity, size)) {
      return false;
    }
  }
  return true;
}

}  // namespace

Result<RunMapping> RunMapping::open(const std::string& node) {
  auto file = vars::ShmFile::open(vars::run_file(node), vars::Mode::ReadWrite);
  if (!file) {
    return file.error();
  }
  if (file->size() < sizeof(RunBlock)) {
    return Error{Errc::Corrupt, 0, "open the node's run block"};
  }
  RunMapping mapping(std::move(file).value());
  const RunBlock& run = mapping.block();
  const std::uint64_t magic = run.magic.load(std::memory_order_acquire);
  if (magic != scheduler::kRunMagic) {
    return Error{magic == 0 ? Errc::Busy : Errc::Corrupt, 0, "open the node's run block"};
  }
  if (run.abi != scheduler::kRunAbi) {
    return Error{Errc::VersionMismatch, 0, "open the node's run block"};
  }
  if (!is_sound(run, mapping.file_.size())) {
    return Error{Errc::Corrupt, 0, "open the node's run block"};
  }
  return mapping;
}

bool RunMapping::node_alive() const noexcept {
  return vars::process_alive(block().node_pid.load(std::memory_order_acquire), block().node_start_time);
}

bool is_ending(const RunBlock& run) noexcept {
  return run.state.load(std::memory_order_acquire) >= scheduler::NodeState::Stopping;
}

}  // namespace indurop::runtime
