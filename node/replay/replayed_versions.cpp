// SPDX-License-Identifier: Apache-2.0
#include "node/replay/replayed_versions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <utility>

#include "core/keys/digest.h"
#include "node/exchange/carry.h"
#include "node/modules/kept_versions.h"
#include "store/runtime/host.h"

namespace indurop::node {
namespace {

constexpr std::size_t kDigitsShown = 12;

// In a replay, order and tape do not limit what a version may use.
AllowedAccess all_of(const vars::Store& store) {
  AllowedAccess all;
  for (const vars::DirectoryEntry& entry : store.directory()) {
    all[entry.name_hash] = {true, true};
  }
  return all;
}

std::size_t index_at(const std::vector<recorder::RecordedVersion>& order, std::uint64_t run) {
  const auto after = std::find_if(order.begin(), order.end(), [run](const auto& one) { return one.first_run > run; });
  return after == order.begin() ? 0 : static_cast<std::size_t>(after - order.begin()) - 1;
}

}  // namespace

bool ReplayedVersions::Versions::follows_earlier() const noexcept {
  return std::any_of(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(at),
                     [this](const auto& one) { return one.number == order[at].number; });
}

bool ReplayedVersions::Versions::follows_later(const Version& version) const {
  return std::any_of(order.begin() + static_cast<std::ptrdiff_t>(at), order.end(),
                     [&](const auto& one) { return &by_number.at(one.number) == &version; });
}

ReplayedVersions::ReplayedVersions(const Options& options, const Console& console, const Checked& checked,
                                   const Prepared& prepared, std::vector<ModuleLibrary>& libraries)
    : options_(options), console_(console), checked_(checked), store_(*prepared.store), libraries_(libraries) {}

bool ReplayedVersions::load(const RecordedRuns& recorded, const ReplayedModules& modules) {
  bool ok = true;
  for (const auto& module : modules.all()) {
    const auto& replaced = checked_.replaced;
    const bool has_other_file = std::find(replaced.begin(), replaced.end(), module->index) != replaced.end();
    Versions versions;
    for (const recorder::RecordedVersion& one : recorded.versions()) {
      if (one.module == module->name) {
        versions.order.push_back(one);
      }
    }
    const bool any_came =
        std::any_of(versions.order.begin(), versions.order.end(), [](const auto& one) { return one.exchanged; });
    if (module->runs && any_came && !has_other_file) {
      ok = load(*module, versions, recorded) && ok;
      if (ok && !versions.order.empty()) {
        all_.emplace(module->index, std::move(versions));
      }
    }
  }
  return ok;
}

// A version is wanted if one of its runs is between the ticks that are compared.
bool ReplayedVersions::is_wanted(const Versions& versions, std::size_t index) const noexcept {
  const auto& order = versions.order;
  const bool ends_before = index + 1 < order.size() && order[index + 1].first_tick <= options_.replay.from_tick;
  return !ends_before && order[index].first_tick <= options_.replay.to_tick;
}

// Each file is found and loaded once; of another load of the same file a fresh copy is made when it follows.
bool ReplayedVersions::load(ReplayedModule& module, Versions& versions, const RecordedRuns& recorded) {
  std::map<std::string, const Version*> loaded;  // by digest
  std::set<std::string> missing;
  std::set<std::string> of_other_types;
  for (std::size_t i = 0; i < versions.order.size(); ++i) {
    const recorder::RecordedVersion& one = versions.order[i];
    Version& version = versions.by_number[one.number];
    if (!version.file.empty() || of_other_types.contains(one.digest)) {
      continue;
    }
    if (const auto known = loaded.find(one.digest); known != loaded.end()) {
      version.file = known->second->file;
      version.access = known->second->access;
      continue;
    }
    const auto file =
        find_version_file(recorded.node(), one.digest, {checked_.config.modules[module.index].file, one.file},
                          options_.replay.file.parent_path());
    if (file) {
      version.file = *file;
      switch (load_first(module, version)) {
        case Loading::Failed:
          return false;
        case Loading::ChangesTypes:
          version = {};
          of_other_types.insert(one.digest);
          break;
        case Loading::Done:
          loaded[one.digest] = &version;
          module.version_access.insert(version.access.begin(), version.access.end());
      }
    } else if (is_wanted(versions, i) && missing.insert(one.digest).second) {
      report_missing(module, one);
    }
  }
  return missing.empty();
}

ReplayedVersions::Loading ReplayedVersions::load_first(const ReplayedModule& module, Version& version) {
  ModuleLibrary& configured = libraries_[module.index];
  const AllowedAccess allowed = all_of(store_);
  const std::vector<ConfiguredUses> configured_uses(libraries_.size());
  Candidate candidate = make_candidate({checked_.config, module.index, version.file, store_, allowed, configured,
                                        module.index, true, libraries_, configured_uses});
  if (candidate.errors.empty() && candidate.variables.changes_types()) {
    console_.warning(
        "module {}: {} declares {} in another way than this configuration: the runs of this version are not repeated",
        module.name, version.file.string(), candidate.variables.changed().front().to.name);
    return Loading::ChangesTypes;
  }
  if (candidate.errors.empty() && !candidate.variables.let_appear(store_)) {
    candidate.errors.emplace_back("there is no place for its new variables");
  }
  for (const std::string& error : candidate.errors) {
    console_.error("module {}: {}", module.name, error);
  }
  version.access = std::move(candidate.access);
  version.library = std::move(candidate.library);
  return candidate.errors.empty() ? Loading::Done : Loading::Failed;
}

void ReplayedVersions::report_missing(const ReplayedModule& module, const recorder::RecordedVersion& version) const {
  const std::string where = std::filesystem::absolute(options_.replay.file).parent_path().string();
  if (version.digest.empty()) {
    console_.error(
        "module {}: the recording does not say of which file its version from tick {} on is, because the node had "
        "exchanged many others by then; repeat all runs up to the first exchange with one file: --with {}=FILE",
        module.name, version.first_tick, module.name);
    return;
  }
  const auto there = keys::digest_of_file(version.file);
  console_.error(
      "module {}: the file of its version from tick {} on is missing: {} with the SHA-256 {}{}; put it into the folder "
      "{} under any name that ends in .{}, or repeat the runs up to the first exchange with another one: --with "
      "{}=FILE",
      module.name, version.first_tick, version.file.empty() ? "a file" : version.file, version.digest,
      there ? fmt::format(" (the file that is there now has {})", there->digest) : "", where,
      module.is_process() ? "exe" : "so", module.name);
}

bool ReplayedVersions::begin(const ReplayedModules& modules, Repeater& repeater) {
  std::map<std::uint32_t, std::uint64_t> first_runs;  // by module
  auto recorded = all_.empty() ? Unfit{} : RecordedRuns::open(options_.replay.file, options_.replay.board, store_);
  if (recorded) {
    recorded->seek(modules.begin_ns());
  }
  while (recorded && first_runs.size() < all_.size()) {
    const auto item = recorded->next();
    if (item && !*item) {
      break;
    }
    const auto* const run = item ? std::get_if<RecordedRun>(&**item) : nullptr;  // damage is reported later
    const ReplayedModule* const module = run == nullptr ? nullptr : modules.of_recording(run->words.module);
    if (module != nullptr && follows(*module)) {
      first_runs.emplace(module->index, run->words.tail.number);
    }
  }
  for (auto& [index, versions] : all_) {
    ReplayedModule& module = *modules.all()[index];
    versions.at = index_at(versions.order, first_runs[index]);
    module.lacks_version = versions.current().file.empty();
    if (module.is_process()) {
      if (!module.lacks_version) {
        show_process(module, versions, repeater);
      }
      continue;
    }
    if (!module.lacks_version) {
      // An earlier version of the same file has been loaded instead of it.
      if (versions.current().library.functions().run == nullptr && !load_again(module, versions.current())) {
        return false;
      }
      show(module, versions);
      versions.by_number.erase(0);  // the file of the configuration is not needed
    }
    versions.by_number[versions.held].started = true;  // with all modules
  }
  return true;
}

// The module's code is that of this version from now on.
void ReplayedVersions::show(ReplayedModule& module, Versions& versions) {
  Version& version = versions.current();
  versions.by_number[versions.held].library = std::exchange(libraries_[module.index], ModuleLibrary());
  libraries_[module.index] = std::exchange(version.library, ModuleLibrary());
  versions.held = versions.order[versions.at].number;
  module.state.task.run = libraries_[module.index].functions().run;
  module.use(version.access, store_);
}

bool ReplayedVersions::prepare(ReplayedModule& module, const recorder::RunWords& run, Repeater& repeater) {
  const auto found = all_.find(module.index);
  if (found == all_.end()) {
    return true;
  }
  Versions& versions = found->second;
  const std::size_t before = std::exchange(versions.at, index_at(versions.order, run.tail.number));
  if (versions.at == before) {
    return true;
  }
  return module.is_process() ? exchange_process(module, versions, run, repeater)
                             : exchange(module, versions, run, repeater);
}

// Where a run failed, the version that follows goes on with what was kept before it.
void ReplayedVersions::prepare_return(const ReplayedModule& module, const recorder::RunWords& run) {
  const auto found = all_.find(module.index);
  if (found == all_.end() || !run.faulted || module.lacks_version || module.is_process()) {
    return;
  }
  Versions& versions = found->second;
  const std::size_t next = index_at(versions.order, run.tail.number + 1);
  if (next != versions.at) {
    const ModuleLibrary& library = versions.by_number[versions.order[next].number].library;
    versions.carried = carry(module, library.memory());
    versions.carried->exact = versions.carried->in_tick && !module.restores;
  }
}

ReplayedVersions::Carried ReplayedVersions::carry(const ReplayedModule& module, const ModuleMemory& to) const {
  const ModuleMemory& from = libraries_[module.index].memory();
  const Carry carry = plan_carry(from, to, most_in_tick(checked_.config.modules[module.index].period.count()));
  const operate::ReloadPlan& plan = carry.plan;
  Carried carried{true, !carry.between_runs, plan.with_state,
                  plan.with_state && plan.added.empty() && plan.changed.empty()};
  for (const scheduler::Exchange::Pair& pair : carry.pairs) {
    std::memcpy(pair.new_place, pair.old_place, pair.bytes);
  }
  if (carry.between_runs && plan.with_state) {
    std::vector<std::byte> saved(from.most());
    const std::size_t bytes = from.save(saved);
    (void)to.restore(from.form(), {reinterpret_cast<const std::uint8_t*>(saved.data()), bytes});
    carried.exact = bytes > 0;
  }
  return carried;
}

bool ReplayedVersions::load_again(const ReplayedModule& module, Version& version) const {
  runtime::set_current_module(module.index);
  auto loaded = version.library.load(version.file, true);
  runtime::set_current_module(runtime::kNoModule);
  for (const std::string& text : runtime::take_binding_errors()) {
    loaded = base::Problem{text};
  }
  if (!loaded) {
    console_.error("module {}: {}: {}", module.name, version.file.string(), loaded.error().text);
  }
  version.started = false;
  return loaded.ok();
}

bool ReplayedVersions::exchange(ReplayedModule& module, Versions& versions, const recorder::RunWords& run,
                                Repeater& repeater) {
  const bool knew = !module.lacks_version;
  const recorder::RecordedVersion& recorded = versions.order[versions.at];
  Version& to = versions.current();
  module.lacks_version = to.file.empty();
  if (module.lacks_version || recorded.number == versions.held) {
    module.kept.doubt();
    return true;
  }
  if (to.library.functions().run == nullptr && !load_again(module, to)) {
    return false;
  }
  if (run.anew) {
    repeater.stop_for_exchange(module);
  } else if (!to.started && !repeater.start_apart(module, to.library)) {
    return false;
  }
  to.started = true;
  if (!run.anew) {
    note_carried(module, versions, knew);
  }
  Version& from = versions.by_number[versions.held];
  from.is_unsound = module.has_faulted();
  from.is_known = knew && module.knowledge == Knowledge::Certain && module.next_number == run.tail.number;
  show(module, versions);
  if (from.is_unsound) {
    repeater.resume(module);
  }
  if (!versions.follows_later(from)) {
    retire(module, from, repeater);
  }
  console_.info("module {}: from tick {} on it is the version of {} ({})", module.name, run.tail.tick, to.file.string(),
                recorded.digest.substr(0, kDigitsShown));
  return true;
}

// What the version that follows keeps is known if it is new, if it was known when it was left, or if it is all carried.
void ReplayedVersions::note_carried(ReplayedModule& module, Versions& versions, bool knew) const {
  const Version& to = versions.current();
  const Carried carried = versions.carried ? *versions.carried : carry(module, to.library.memory());
  versions.carried.reset();
  const bool own_is_known = !versions.follows_earlier() || to.is_known;
  if (!knew || !carried.exact || !(own_is_known || carried.whole)) {
    module.kept.doubt();
  } else if (!carried.with_state) {
    module.begins_again = true;
  }
}

void ReplayedVersions::retire(const ReplayedModule& module, Version& version, Repeater& repeater) const {
  if (version.is_unsound) {
    version.library.abandon();
  } else if (version.started) {
    repeater.stop_apart(module, version.library);
  }
  version.started = false;
  version.library = ModuleLibrary();
}

void ReplayedVersions::end(const ReplayedModules& modules, Repeater& repeater) {
  for (auto& [index, versions] : all_) {
    for (auto& [number, version] : versions.by_number) {
      if (number != versions.held) {
        retire(*modules.all()[index], version, repeater);
      }
    }
  }
}

}  // namespace indurop::node
