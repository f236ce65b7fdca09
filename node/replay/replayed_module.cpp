// SPDX-License-Identifier: Apache-2.0
#include "node/replay/replayed_module.h"

#include <algorithm>
#include <utility>

#include "core/schema/carry.h"

namespace indurop::node {

const schema::Variable& variable_at(const vars::Store& store, std::uint32_t index) {
  return store.schema().variables[store.directory()[index].schema_index];
}

std::vector<std::uint8_t> as_declared_now(const vars::Store& store, std::uint32_t index, const schema::Variable* former,
                                          const std::vector<std::uint8_t>& bytes) {
  if (former == nullptr) {
    return bytes;
  }
  const vars::DirectoryEntry& entry = store.directory()[index];
  const schema::Variable& variable = variable_at(store, index);
  std::vector<std::uint8_t> now(entry.value_size);
  (void)store.read(entry, 0, now);
  (void)schema::carry_what_fits(variable.name, {former->type, former->unit}, bytes, {variable.type, variable.unit},
                                now);
  return now;
}

namespace {

void write_known(vars::Store& store, const KnownValue& one) {
  const vars::DirectoryEntry& entry = store.directory()[one.variable];
  std::vector<std::uint8_t> now(entry.value_size);
  if (!one.has_value || !store.read(entry, 0, now).ok()) {
    return;
  }
  const std::vector<std::uint8_t> next = as_declared_now(store, one.variable, one.former, one.bytes);
  if (now != next) {
    (void)store.write(entry, 0, next);
  }
}

}  // namespace

bool ReplayedModule::has_faulted() const noexcept {
  return died || state.record->state.load() == scheduler::ModuleState::Faulted;
}

std::vector<tape::ReplayedAnswer> ReplayedModule::replayed_answers() const {
  std::vector<tape::ReplayedAnswer> all;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    all.push_back({codes[i], answers[i]});
  }
  return all;
}

bool ReplayedModule::knows_inputs() const noexcept {
  return std::all_of(known.begin(), known.end(), [](const KnownValue& one) { return !one.read || one.has_value; });
}

void ReplayedModule::forget_older_values() noexcept {
  for (KnownValue& one : known) {
    one.has_value = one.has_value && one.recorded_run == seen;
  }
}

void ReplayedModule::use(const std::map<std::uint64_t, schema::Access>& access, const vars::Store& store) {
  for (KnownValue& one : known) {
    const auto by_code = access.find(store.directory()[one.variable].name_hash);
    one.read = one.always_read || (by_code != access.end() && by_code->second.reads);
    one.written = one.always_written || (by_code != access.end() && by_code->second.writes);
  }
}

void ReplayedModule::write_inputs(vars::Store& store) const {
  for (const KnownValue& one : known) {
    const bool is_own = keeps_own && one.written;
    if (is_own ? one.foreign : one.read) {
      write_known(store, one);
    }
  }
}

void ReplayedModule::write_outputs(vars::Store& store) const {
  for (const KnownValue& one : known) {
    if (one.written) {
      write_known(store, one);
    }
  }
}

void ReplayedModule::begin_with_recorded() noexcept {
  for (KnownValue& one : known) {
    one.foreign = true;
  }
  doubtful = false;
}

void ReplayedModule::note_knowledge(ReplayedMemory::Next next, bool restarted) noexcept {
  switch (next) {
    case ReplayedMemory::Next::Wait:
      knowledge = Knowledge::None;
      return;
    case ReplayedMemory::Next::Doubt:
      knowledge = Knowledge::Doubtful;
      return;
    case ReplayedMemory::Next::Restore:
      knowledge = Knowledge::Certain;
      return;
    case ReplayedMemory::Next::Run:
      const bool is_new = knowledge == Knowledge::None || restarted || kept.is_empty();
      knowledge = is_new ? Knowledge::Certain : knowledge;
  }
}

// What it keeps may differ from now on, and so may what it writes: until the next keyframe, that proves nothing.
void ReplayedModule::note_disturbance() noexcept {
  if (disturbed && kept.is_empty()) {
    begin_with_recorded();
  } else if (disturbed) {
    doubtful = true;
    (void)kept.renew();
  }
}

void ReplayedModule::take_outputs() {
  disturbed = false;
  for (RecordedOutput& output : outputs) {
    KnownValue& one = known[output.place];
    one.has_value = true;
    one.recorded_run = seen;
    one.cdr = std::move(output.cdr);
    one.bytes = std::move(output.bytes);
    disturbed = disturbed || output.kind == tape::EntryKind::During;
  }
  for (KnownValue& one : known) {
    one.foreign = false;
  }
  outputs.clear();
  clock.clear();
  codes.clear();
  answers.clear();
}

}  // namespace indurop::node
