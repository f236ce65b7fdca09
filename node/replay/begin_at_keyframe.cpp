// SPDX-License-Identifier: Apache-2.0
// A replay of a late part: the keyframe at which each module begins, and the values from before. Only the chunks of the
// recording that have them are read.

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "history/recording/cdr.h"
#include "node/replay/replayed_modules.h"

namespace indurop::node {
namespace {

constexpr std::uint64_t kKeyframesEachNs = 1'000'000'000;  // there are two keyframes a second

}  // namespace

// Each module begins at its last keyframe that comes before the first run that is wanted. If there are none that near,
// they are searched for further back.
void ReplayedModules::find_keyframes_to_begin_at() {
  const std::uint64_t from = options_.replay.from_tick;
  auto recorded = from == 0 ? Unfit{} : RecordedRuns::open(options_.replay.file, options_.replay.board, store_);
  if (!recorded) {
    return;  // reported when it is replayed
  }
  const auto [first_ns, last_ns] = recorded->span_ns();
  const std::uint64_t from_ns = recorded->time_of_tick(from).value_or(last_ns);
  std::uint64_t begin_ns = from_ns;
  std::vector<std::optional<Begin>> begins;
  const auto is_known = [&](const auto& module) {
    return !module->runs || !module->kept.has_keyframes() || begins[module->index].has_value();
  };
  for (std::uint64_t back = kKeyframesEachNs; begin_ns > first_ns; back *= 4) {
    begin_ns = from_ns - std::min(back, from_ns - first_ns);
    begins = keyframes_between(*recorded, begin_ns, from_ns + kKeyframesEachNs);
    if (std::all_of(modules_.begin(), modules_.end(), is_known)) {
      break;
    }
  }
  begins.resize(modules_.size());
  std::uint64_t earliest_ns = from_ns;
  for (const auto& module : modules_) {
    if (const auto& begin = begins[module->index]; begin) {
      module->kept.begin_at(begin->run);
      earliest_ns = module->runs ? std::min(earliest_ns, begin->time_ns) : earliest_ns;
    }
  }
  const bool is_late = std::all_of(modules_.begin(), modules_.end(), [&](const auto& module) {
    return !module->runs || begins[module->index].has_value() || module->kept.is_empty();
  });
  if (is_late && recorded->is_without_gaps() && earliest_ns > first_ns) {
    begin_ns_ = earliest_ns;
    find_earlier_values(*recorded);
  }
}

// Returns the last keyframe of each module before the wanted ticks, as far as it lies between these log times.
std::vector<std::optional<ReplayedModules::Begin>> ReplayedModules::keyframes_between(RecordedRuns& recorded,
                                                                                      std::uint64_t begin_ns,
                                                                                      std::uint64_t end_ns) const {
  std::vector<std::optional<Begin>> begins(modules_.size());
  std::vector<std::optional<Begin>> newest(modules_.size());
  recorded.seek(begin_ns);
  for (;;) {
    const auto item = recorded.next();
    if (!item) {
      continue;  // reported when it is replayed
    }
    if (!*item || recorded.time_ns() > end_ns) {
      return begins;
    }
    if (const auto* keyframe = std::get_if<RecordedKeyframe>(&**item); keyframe != nullptr) {
      if (const ReplayedModule* module = of_recording(keyframe->module); module != nullptr) {
        newest[module->index] = {keyframe->words.run, recorded.time_ns()};
      }
    } else if (const auto* run = std::get_if<RecordedRun>(&**item); run != nullptr) {
      const ReplayedModule* const module = of_recording(run->words.module);
      const bool begins_here = module != nullptr && newest[module->index] &&
                               newest[module->index]->run == run->words.tail.number &&
                               run->words.tail.tick <= options_.replay.from_tick;
      if (begins_here) {
        begins[module->index] = newest[module->index];
      }
    }
  }
}

// What the modules know, and what the store holds, when the replay begins.
void ReplayedModules::find_earlier_values(const RecordedRuns& recorded) {
  std::set<RecordedRuns::VariableOf> wanted;
  for (std::uint32_t i = 0; i < store_.directory().size(); ++i) {
    wanted.insert({i, RecordedRuns::kAnyModule});
  }
  for (std::uint32_t i = 0; i < of_recording_.size(); ++i) {
    if (of_recording_[i] != nullptr && of_recording_[i]->runs) {
      for (const KnownValue& known : of_recording_[i]->known) {
        wanted.insert({known.variable, i});
      }
    }
  }
  earlier_ = recorded.values_before(begin_ns_, wanted);
  for (const RecordedRuns::EarlierValue& value : earlier_) {
    if (ReplayedModule* const module = of_recording(value.module); module != nullptr) {
      module->known[module->place.at(value.variable)].ever_recorded = true;
    }
  }
}

void ReplayedModules::begin_late() {
  for (RecordedRuns::EarlierValue& value : std::exchange(earlier_, {})) {
    const vars::DirectoryEntry& entry = store_.directory()[value.variable];
    std::vector<std::uint8_t> bytes(entry.value_size);
    if (!recording::from_cdr(variable_at(store_, value.variable).type, value.cdr, bytes)) {
      continue;  // as if it was not recorded
    }
    ReplayedModule* const module = of_recording(value.module);
    if (module == nullptr) {
      (void)store_.write(entry, 0, bytes);
      continue;
    }
    KnownValue& known = module->known[module->place.at(value.variable)];
    known.has_value = true;
    known.cdr = std::move(value.cdr);
    known.bytes = std::move(bytes);
  }
}

}  // namespace indurop::node
