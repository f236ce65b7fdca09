// SPDX-License-Identifier: Apache-2.0
// Determines which runs of a recording can be repeated: those with recorded inputs. A recording may contain only chosen
// variables, begin in the middle, or miss runs.

#include <algorithm>
#include <vector>

#include "history/recording/cdr.h"
#include "node/replay/replay.h"

namespace indurop::node {

bool Replay::knows_inputs(const Module& module) noexcept {
  return std::all_of(module.known.begin(), module.known.end(),
                     [](const Known& known) { return !known.read || known.has_value; });
}

// Values recorded before may have changed since.
void Replay::forget(Module& module) noexcept {
  for (Known& known : module.known) {
    known.has_value = known.has_value && known.recorded_run == module.seen;
  }
}

// A value that is recorded for the first time, and as unchanged, was present from the first run of the recording on: it
// is known from the beginning. Reads until all values are known, at worst to the end.
void Replay::look_ahead() {
  struct Runs {
    bool any = false;
    bool gap = false;
    std::uint64_t next = 0;
  };
  std::vector<Runs> runs(modules_.size());
  std::size_t unrecorded = 0;
  for (const auto& module : modules_) {
    unrecorded += module->runs ? module->known.size() : 0;
  }
  auto recorded = RecordedRuns::open(options_.replay.file, options_.replay.board, *prepared_.store);
  while (recorded && unrecorded > 0) {
    auto item = recorded->next();
    if (!item) {
      continue;  // known when it is replayed
    }
    if (!*item) {
      break;
    }
    if (const auto* run = std::get_if<RecordedRun>(&**item); run != nullptr) {
      if (const std::uint32_t index = configured(run->words.module); index != kNoSuchModule) {
        Runs& of = runs[index];
        of.gap = of.gap || (of.any && run->words.tail.number != of.next);
        of.any = true;
        of.next = run->words.tail.number + 1;
      }
    } else if (const auto* value = std::get_if<RecordedValue>(&**item); value != nullptr) {
      const std::uint32_t index = configured(value->words.module);
      unrecorded -= index != kNoSuchModule && learn_early(*value, *modules_[index], runs[index].gap) ? 1U : 0U;
    }
  }
  for (std::size_t i = 0; i < modules_.size(); ++i) {
    if (runs[i].any) {
      leave_out_if_unknown(*modules_[i], checked_.config.modules[i].name);
    }
  }
}

// Each module begins at its last keyframe that comes before the first run that is wanted.
void Replay::find_keyframes_to_begin_at() {
  if (options_.replay.from_tick == 0) {
    return;
  }
  auto recorded = RecordedRuns::open(options_.replay.file, options_.replay.board, *prepared_.store);
  std::vector<std::uint64_t> newest(modules_.size(), 0);  // number of the run that begins with it
  while (recorded) {
    auto item = recorded->next();
    if (!item) {
      continue;  // known when it is replayed
    }
    if (!*item) {
      break;
    }
    if (const auto* keyframe = std::get_if<RecordedKeyframe>(&**item); keyframe != nullptr) {
      if (const std::uint32_t index = configured(keyframe->module); index != kNoSuchModule) {
        newest[index] = keyframe->words.run;
      }
    } else if (const auto* run = std::get_if<RecordedRun>(&**item); run != nullptr) {
      const std::uint32_t index = configured(run->words.module);
      if (index != kNoSuchModule && run->words.tail.number == newest[index] &&
          run->words.tail.tick <= options_.replay.from_tick) {
        modules_[index]->kept.begin_at(newest[index]);
      }
    }
  }
}

// Returns true if the value is recorded for the first time.
bool Replay::learn_early(const RecordedValue& value, Module& module, bool after_a_gap) const {
  const auto place = module.place.find(value.variable);
  if (!module.runs || value.words.kind == tape::EntryKind::Run || place == module.place.end() ||
      module.known[place->second].ever_recorded) {
    return false;
  }
  Known& known = module.known[place->second];
  known.ever_recorded = true;
  if (value.words.kind == tape::EntryKind::Again && !after_a_gap) {
    known.bytes.resize(prepared_.store->directory()[value.variable].value_size);
    known.has_value = recording::from_cdr(variable(value.variable).type, value.cdr, known.bytes).ok();
    known.cdr.assign(value.cdr.begin(), value.cdr.end());
  }
  return true;
}

void Replay::leave_out_if_unknown(Module& module, const std::string& name) {
  for (const Known& known : module.known) {
    if (module.runs && known.read && !known.ever_recorded) {
      module.unknown_inputs += (module.unknown_inputs.empty() ? "" : ", ") + variable(known.variable).name;
    }
  }
  if (!module.unknown_inputs.empty()) {
    module.runs = false;
    console_.warning(
        "module {} does not run: the recording has no values of its inputs ({}); its outputs are taken from "
        "the recording",
        name, module.unknown_inputs);
  }
}

}  // namespace indurop::node
