// SPDX-License-Identifier: Apache-2.0
#include "node/replay/replayed_modules.h"

#include <algorithm>
#include <utility>

#include "config/check/determinism.h"
#include "history/recording/cdr.h"
#include "node/exchange/candidate.h"

namespace indurop::node {
namespace {

using scheduler::ModuleType;
using scheduler::Operation;

bool names(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

schema::Access access_in(const std::map<std::uint64_t, schema::Access>& all, std::uint64_t hash) {
  const auto found = all.find(hash);
  return found == all.end() ? schema::Access{} : found->second;
}

// Returns why the module is not run again; empty: it is.
// `alone`: next to the node of the recording, which has the devices.
std::string reason_to_leave_out(const config::Module& module, const std::vector<std::string>& imports, bool alone) {
  if (module.operation == Operation::NonReal) {
    return "it runs in the background";
  }
  if (module.signal != 0) {
    return "it does not say when a run ends";
  }
  if (module.type == ModuleType::Process && !alone) {
    return "";
  }
  return config::talks_to_others(imports) ? "it speaks to devices or the network" : "";
}

}  // namespace

ReplayedModules::ReplayedModules(const Options& options, const Console& console, const Checked& checked,
                                 const Prepared& prepared, const Loaded& loaded)
    : options_(options), console_(console), checked_(checked), store_(*prepared.store), libraries_(loaded.libraries) {
  for (const config::Module& configured : checked.config.modules) {
    auto module = std::make_unique<ReplayedModule>();
    module->index = static_cast<std::uint32_t>(modules_.size());
    module->name = configured.name;
    modules_.push_back(std::move(module));
  }
  for (const scheduler::Task& task : loaded.tasks) {
    scheduler::TaskState& state = modules_[task.index]->state;
    state.task = task;
    state.task.condition = Condition{};  // it was true in the recording
    state.record = &prepared.run().modules()[task.index];
    state.slot = &prepared.run().process_slots()[task.index];
  }
}

ReplayedModule* ReplayedModules::of_recording(std::uint32_t recorded) const noexcept {
  return is_recorded(recorded) ? of_recording_[recorded] : nullptr;
}

void ReplayedModules::compare_with_node(const std::string& node, std::size_t alone) {
  const config::ModuleFacts& facts = checked_.check.facts[alone];
  others_ = other_declarations(node, uses_of(facts), facts.schema->variables);
}

const schema::Variable& ReplayedModules::recorded_declaration(std::uint32_t index) const {
  const schema::Variable* const former = former_of(others_.former, store_.directory()[index].name_hash);
  return former != nullptr ? *former : variable_at(store_, index);
}

void ReplayedModules::choose(const RecordedRuns& recorded) {
  match(recorded);
  for (const auto& module : modules_) {
    const config::Module& configured = checked_.config.modules[module->index];
    const bool is_wanted = checked_.alone.value_or(module->index) == module->index;
    const std::string reason = names(recorded.modules(), module->name)
                                   ? reason_to_leave_out(configured, checked_.check.facts[module->index].file.imports,
                                                         checked_.alone.has_value())
                                   : "it is not in the recording";
    module->runs = reason.empty() && is_wanted;
    module->why_not = reason;
    if (const bool any = recorded.has_keyframes(module->name); configured.type == ModuleType::Process) {
      module->kept.expect_process(names(checked_.check.facts[module->index].file.exports, "indurop_module_state"), any);
    } else {
      module->kept.expect(libraries_[module->index].memory(), any);
    }
    if (!reason.empty() && is_wanted && checked_.alone) {
      console_.error("module {} cannot be repeated alone: {}", module->name, reason);
    } else if (!module->runs && is_wanted) {
      console_.info("module {} does not run: {}; what it wrote comes from the recording", module->name, reason);
    }
  }
}

void ReplayedModules::find_begin() {
  find_variables();
  find_keyframes_to_begin_at();
}

bool ReplayedModules::look_ahead() {
  learn_early_values();
  const bool any = std::any_of(modules_.begin(), modules_.end(), [](const auto& module) { return module->runs; });
  if (!any) {
    console_.error("no module of {} can run again", options_.replay.file.string());
  }
  return any;
}

void ReplayedModules::match(const RecordedRuns& recorded) {
  for (const std::string& name : recorded.modules()) {
    const auto found =
        std::find_if(modules_.begin(), modules_.end(), [&](const auto& module) { return module->name == name; });
    of_recording_.push_back(found == modules_.end() ? nullptr : found->get());
    if (found == modules_.end()) {
      console_.warning("module {} of the recording is not in this configuration: its runs are not repeated", name);
    }
  }
}

void ReplayedModules::find_variables() {
  for (const config::VariableUse& use : checked_.check.uses) {
    const auto* entry = store_.find(abi::fnv1a64(use.name.data(), use.name.size()));
    const bool is_new = entry == nullptr || others_.appearing.contains(entry->name_hash);
    for (std::size_t i = 0; !is_new && i < modules_.size(); ++i) {
      const auto& replaced = checked_.replaced;
      const bool has_other_file = std::find(replaced.begin(), replaced.end(), i) != replaced.end();
      KnownValue known;
      known.former = former_of(others_.former, entry->name_hash);
      known.variable = static_cast<std::uint32_t>(entry - store_.directory().data());
      known.read = names(use.readers, modules_[i]->name);
      known.written = names(use.writers, modules_[i]->name);
      if (known.read || known.written) {
        const schema::Access code = access_in(checked_.check.facts[i].file.access, entry->name_hash);
        known.always_read = known.read && !code.reads;
        known.always_written = known.written && !code.writes;
        known.only_viewed = has_other_file && variable_at(store_, known.variable).view;
        modules_[i]->place[known.variable] = modules_[i]->known.size();
        modules_[i]->known.push_back(std::move(known));
      }
    }
  }
  for (const auto& module : modules_) {
    for (const auto& [hash, access] : module->version_access) {
      const auto* entry = access.reads || access.writes ? store_.find(hash) : nullptr;
      KnownValue known;
      known.variable = entry == nullptr ? 0 : static_cast<std::uint32_t>(entry - store_.directory().data());
      if (entry != nullptr && !module->place.contains(known.variable)) {
        module->place[known.variable] = module->known.size();
        module->known.push_back(std::move(known));
      }
    }
  }
}

void ReplayedModules::write_first_outputs(const ReplayedModule& module) {
  for (const KnownValue& known : module.known) {
    const bool is_shared = std::any_of(modules_.begin(), modules_.end(), [&](const auto& other) {
      const auto place = other->place.find(known.variable);
      return other.get() != &module && place != other->place.end() && other->known[place->second].written;
    });
    if (known.written && known.has_value && !is_shared) {
      (void)store_.write(store_.directory()[known.variable], 0, known.bytes);
    }
  }
}

bool ReplayedModules::take(const RecordedValue& value) {
  const vars::DirectoryEntry& entry = store_.directory()[value.variable];
  const schema::Variable& variable = recorded_declaration(value.variable);
  const schema::Variable* const former = former_of(others_.former, entry.name_hash);
  std::vector<std::uint8_t> bytes(variable.type.size());
  if (!recording::from_cdr(variable.type, value.cdr, bytes)) {
    console_.error("a value of {} in the recording is damaged", variable.name);
    return false;
  }
  const bool first = value.words.kind == tape::EntryKind::Run;
  const bool of_run = !first && value.words.module != recorder::kOthers;
  ReplayedModule* const module = of_run ? of_recording(value.words.module) : nullptr;
  if (checked_.alone && !first && (module == nullptr || module->index != *checked_.alone)) {
    return true;  // its own track has all that it reads
  }
  if (module == nullptr || !module->runs) {
    (void)store_.write(entry, 0, as_declared_now(store_, value.variable, former, bytes));
    return true;
  }
  const auto place = module->place.find(value.variable);
  const bool used = place != module->place.end();
  if (value.words.kind == tape::EntryKind::After && !(used && module->known[place->second].written)) {
    module->not_written.insert(variable.name);
  }
  if (!used) {
    return true;  // the changed module no longer uses it
  }
  if (value.words.kind == tape::EntryKind::Before) {
    KnownValue& known = module->known[place->second];
    known.has_value = true;
    known.foreign = true;
    known.recorded_run = module->seen;
    known.cdr.assign(value.cdr.begin(), value.cdr.end());
    known.bytes = std::move(bytes);
  } else {
    module->outputs.push_back(
        {place->second, value.words.kind, {value.cdr.begin(), value.cdr.end()}, std::move(bytes)});
  }
  return true;
}

}  // namespace indurop::node
