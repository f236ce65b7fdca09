// SPDX-License-Identifier: Apache-2.0

#include "test_node.h"

#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "core/schema/elf.h"
#include "store/vars/process.h"

namespace {

// A node named "local" may be running on this machine; these programs have nothing to do with it. The priority is one
// that is reserved, because a generated header looks for its node at 101.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wprio-ctor-dtor"
[[gnu::constructor(100)]] void keep_away_from_others() {
  ::setenv("INDUROP_NODE", "rttest-none", 0);
}
#pragma GCC diagnostic pop

int g_nodes = 0;

}  // namespace

namespace indurop::testing {

schema::Schema sample_schema() {
  const auto self = schema::read_module_file("/proc/self/exe");
  if (!self) {
    throw std::runtime_error(self.error().where);
  }
  return schema::from_json(self.value().schema_json).value();
}

std::string TestNode::next_name() {
  return "rttest-" + std::to_string(::getpid()) + "-" + std::to_string(g_nodes);
}

TestNode::TestNode(const std::vector<TestModule>& modules, const schema::Schema& schema, std::uint32_t ring_capacity)
    : ring_capacity_(ring_capacity) {
  name_ = next_name();
  ++g_nodes;
  restart(schema, modules);
}

TestNode::~TestNode() {
  store_.reset();
  run_.reset();
  for (const std::string& file : {vars::block_file(name_), vars::run_file(name_), vars::lock_file(name_)}) {
    (void)vars::remove_shm_file(file);
  }
}

void TestNode::restart(const schema::Schema& schema, const std::vector<TestModule>& modules) {
  auto store = vars::Store::create(name_, schema);
  if (!store) {
    throw std::runtime_error(store.error().where);
  }
  store_ = std::make_unique<vars::Store>(std::move(store).value());
  make_run(modules);
}

void TestNode::make_run(const std::vector<TestModule>& modules) {
  using namespace scheduler;
  const auto count = static_cast<std::uint32_t>(modules.size());
  std::uint64_t at = sizeof(RunBlock);
  const auto reserve = [&at](std::uint64_t bytes) {
    const std::uint64_t offset = (at + 63) / 64 * 64;
    at = offset + bytes;
    return offset;
  };
  const std::uint64_t records = reserve(count * sizeof(ModuleRecord));
  const std::uint64_t slots = reserve(count * sizeof(ProcessSlot));
  const std::uint64_t rings = reserve((count + 1) * sizeof(MessageRing));
  const std::uint64_t entries = reserve((count + 1) * ring_capacity_ * sizeof(MessageEntry));
  const std::uint64_t properties = reserve(4096);
  auto file = vars::RunFile::create(name_, at);
  if (!file) {
    throw std::runtime_error(file.error().where);
  }
  run_ = std::make_unique<vars::RunFile>(std::move(file).value());
  RunBlock& block = run();
  block.abi = kRunAbi;
  block.module_count = count;
  block.module_capacity = count;
  block.total_size = at;
  std::strncpy(block.node_name, name_.c_str(), sizeof block.node_name - 1);
  block.node_pid = ::getpid();
  block.node_start_time = vars::process_start_time(::getpid());
  block.state = NodeState::Running;
  block.basic_period_ns = 1'000'000;
  block.modules_offset = records;
  block.slots_offset = slots;
  block.rings_offset = rings;
  auto text = static_cast<std::uint32_t>(properties);
  for (std::uint32_t i = 0; i <= count; ++i) {
    block.rings()[i].capacity = ring_capacity_;
    block.rings()[i].entries_offset = entries + i * std::uint64_t{ring_capacity_} * sizeof(MessageEntry);
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    ModuleRecord& record = block.modules()[i];
    std::strncpy(record.name, modules[i].name.c_str(), sizeof record.name - 1);
    std::strncpy(record.file, modules[i].file.c_str(), sizeof record.file - 1);
    record.type = modules[i].type;
    record.period_ns = modules[i].period_ns;
    record.core = -1;
    record.property_offset = text;
    for (const auto& [name, value] : modules[i].properties) {
      for (const std::string& part : {name, value}) {
        std::memcpy(block.at<char>(text), part.c_str(), part.size() + 1);
        text += static_cast<std::uint32_t>(part.size()) + 1;
      }
    }
    record.property_size = text - record.property_offset;
    block.process_slots()[i].wake.init(true);
    block.process_slots()[i].turn.init(true);
    block.process_slots()[i].recall.init(true);
    block.process_slots()[i].module = i;
  }
  block.magic.store(kRunMagic, std::memory_order_release);
}

void TestNode::release(std::size_t index, std::uint64_t tick, std::int64_t grid_ns) noexcept {
  scheduler::ProcessSlot& at = slot(index);
  at.release_tick = tick;
  at.release_ns = grid_ns;
  at.released.fetch_add(1);
  at.wake.wake();
}

}  // namespace indurop::testing
