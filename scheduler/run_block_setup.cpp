// SPDX-License-Identifier: Apache-2.0
#include "scheduler/run_block_setup.h"

#include <cstring>

#include "core/rt/copy_text.h"

namespace indurop::scheduler {
namespace {

constexpr std::uint32_t kSlotLogEntries = 8192;
constexpr std::uint32_t kOverrunEntries = 256;
constexpr std::uint32_t kModuleMessages = 64;
constexpr std::uint32_t kNodeMessages = 256;

struct Offsets {
  std::size_t modules = 0;
  std::size_t slots = 0;
  std::size_t rings = 0;
  std::size_t slot_log = 0;
  std::size_t overrun_log = 0;
  std::size_t messages = 0;
  std::size_t properties = 0;
  std::size_t total = 0;
};

constexpr std::size_t kLine = 64;
std::size_t round_up(std::size_t size) noexcept {
  return (size + kLine - 1) / kLine * kLine;
}

std::size_t property_bytes(const ModuleSetup& module) noexcept {
  std::size_t bytes = 0;
  for (const auto& [name, value] : module.properties) {
    bytes += name.size() + value.size() + 2;
  }
  return bytes;
}

Offsets offsets_of(const RunBlockSetup& setup) {
  const std::size_t n = setup.modules.size() + kSpareModules;
  Offsets at;
  at.modules = round_up(sizeof(RunBlock));
  at.slots = round_up(at.modules + n * sizeof(ModuleRecord));
  at.rings = round_up(at.slots + n * sizeof(ProcessSlot));
  at.slot_log = round_up(at.rings + (n + 1) * sizeof(MessageRing));
  at.overrun_log = round_up(at.slot_log + kSlotLogEntries * sizeof(SlotEntry));
  at.messages = round_up(at.overrun_log + kOverrunEntries * sizeof(OverrunEntry));
  at.properties = round_up(at.messages + (n * kModuleMessages + kNodeMessages) * sizeof(MessageEntry));
  at.total = at.properties + kSpareModules * kSpareProperties;
  for (const ModuleSetup& module : setup.modules) {
    at.total += property_bytes(module);
  }
  return at;
}

void fill_record(ModuleRecord& record, const ModuleSetup& module) {
  rt::copy_text(record.name, module.name);
  rt::copy_text(record.file, module.file);
  record.type = module.type;
  record.operation = module.operation;
  record.overrun_policy = module.overrun;
  record.priority = module.priority;
  record.core = module.core;
  record.period_ns = module.period_ns;
  record.offset_ns = module.offset_ns;
  record.deadline_ns = module.deadline_ns;
  record.budget_ns = module.budget_ns;
}

void write_properties(RunBlock& block, ModuleRecord& record, const ModuleSetup& module) {
  record.property_size = static_cast<std::uint32_t>(property_bytes(module));
  char* to = block.at<char>(record.property_offset);
  for (const auto& [name, value] : module.properties) {
    for (const std::string& text : {name, value}) {
      std::memcpy(to, text.c_str(), text.size() + 1);
      to += text.size() + 1;
    }
  }
}

void init_ring(MessageRing& ring, std::size_t offset, std::uint32_t capacity) noexcept {
  ring.capacity = capacity;  // zeroed entries are an empty ring
  ring.entries_offset = offset;
}

}  // namespace

std::size_t run_block_size(const RunBlockSetup& setup) {
  return offsets_of(setup).total;
}

void init_run_block(RunBlock& block, const RunBlockSetup& setup) {
  const Offsets at = offsets_of(setup);
  const std::size_t n = setup.modules.size() + kSpareModules;
  block.abi = kRunAbi;
  block.module_count = static_cast<std::uint32_t>(setup.modules.size());
  block.module_capacity = static_cast<std::uint32_t>(n);
  block.total_size = at.total;
  rt::copy_text(block.node_name, setup.node_name);
  rt::copy_text(block.config_file, setup.config_file);
  rt::copy_text(block.board, setup.board);
  rt::copy_text(block.plant_file, setup.plant_file);
  rt::copy_text(block.deployment, setup.deployment);
  block.basic_period_ns = setup.basic_period_ns;
  block.macro_period_ns = setup.macro_period_ns;
  block.slot_count = setup.slot_count;
  rt::copy_text(block.schedule_files[1], setup.config_file);
  block.schedule.store(1, std::memory_order_relaxed);
  block.modules_offset = at.modules;
  block.slots_offset = at.slots;
  block.rings_offset = at.rings;
  block.slot_log_offset = at.slot_log;
  block.slot_log_capacity = kSlotLogEntries;
  block.overrun_log_offset = at.overrun_log;
  block.overrun_log_capacity = kOverrunEntries;
  std::size_t properties = at.properties;
  for (std::size_t i = 0; i < n; ++i) {
    ModuleRecord& record = block.modules()[i];
    record.property_offset = static_cast<std::uint32_t>(properties);
    if (i < setup.modules.size()) {
      fill_record(record, setup.modules[i]);
      write_properties(block, record, setup.modules[i]);
      properties += record.property_size;
    } else {
      properties += kSpareProperties;
    }
    ProcessSlot& slot = block.process_slots()[i];
    slot.wake.init(true);
    slot.turn.init(true);
    slot.recall.init(true);
    slot.module.store(static_cast<std::uint32_t>(i), std::memory_order_relaxed);
    init_ring(block.rings()[i], at.messages + i * kModuleMessages * sizeof(MessageEntry), kModuleMessages);
  }
  init_ring(block.rings()[n], at.messages + n * kModuleMessages * sizeof(MessageEntry), kNodeMessages);
  block.magic.store(kRunMagic, std::memory_order_release);
}

std::optional<std::uint32_t> add_module(RunBlock& block, const ModuleSetup& setup) {
  const std::uint32_t index = block.module_count;
  if (index == block.module_capacity || property_bytes(setup) > kSpareProperties) {
    return std::nullopt;
  }
  ModuleRecord& record = block.modules()[index];
  fill_record(record, setup);
  write_properties(block, record, setup);
  record.state = ModuleState::Stopped;
  record.ended = true;
  block.module_count.store(index + 1, std::memory_order_release);
  return index;
}

}  // namespace indurop::scheduler
