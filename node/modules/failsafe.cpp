// SPDX-License-Identifier: Apache-2.0
#include "node/modules/failsafe.h"

#include "core/schema/place_index.h"
#include "scheduler/run_block_setup.h"

namespace indurop::node {

FailSafe::FailSafe(vars::Store& store, const config::Config& config) : store_(store) {
  writes_.reserve(config.modules.size() + scheduler::kSpareModules);
  for (const config::Module& module : config.modules) {
    add(module);
  }
}

void FailSafe::add(const config::Module& module) {
  std::vector<Write>& writes = writes_.emplace_back();
  const schema::PlaceIndex index(store_.schema());
  for (const config::FailSafe& declared : module.failsafe) {
    const auto place = index.find(declared.variable, schema::NearestName::Skip);
    if (!place) {
      continue;
    }
    const vars::DirectoryEntry* const entry = store_.find(place.value().variable->name_hash());
    if (entry == nullptr) {
      continue;
    }
    Write write{*entry, place.value().offset, {}};
    write.bytes.resize(place.value().type.size());
    if (schema::parse_value(place.value().type, declared.value, write.bytes)) {
      writes.push_back(std::move(write));
    }
  }
}

void FailSafe::apply(std::size_t module) noexcept {
  for (const Write& write : writes_[module]) {
    (void)store_.write(write.variable, write.offset, write.bytes);  // a lock held too long is counted as lost write
  }
}

void FailSafe::apply_except(std::size_t module, const std::function<bool(std::uint64_t)>& is_written_by_others) {
  for (const Write& write : writes_[module]) {
    if (!is_written_by_others(write.variable.name_hash)) {
      (void)store_.write(write.variable, write.offset, write.bytes);
    }
  }
}

}  // namespace indurop::node
