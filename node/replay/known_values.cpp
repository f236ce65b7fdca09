// SPDX-License-Identifier: Apache-2.0
// Reads the recording before the replay: which values are known from its beginning on.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "history/recording/cdr.h"
#include "node/replay/replayed_modules.h"

namespace indurop::node {

// A value that is recorded for the first time, and as unchanged, was present from the first run of the recording on: it
// is known from the beginning. Reads from where the replay begins until all values are known, at worst to the end.
void ReplayedModules::learn_early_values() {
  struct Runs {
    bool any = false;
    bool gap = false;
    bool lacks = false;  // it reads a variable that the recording does not have
    std::uint64_t next = 0;
  };
  std::vector<Runs> runs(modules_.size());
  auto recorded = RecordedRuns::open(options_.replay.file, options_.replay.board, store_, others_.former);
  if (!recorded) {
    return;  // reported when it is replayed
  }
  recorded->seek(begin_ns_);
  const auto may_follow = [&](const KnownValue& known) {
    return !known.ever_recorded && recorded->has_values_of(known.variable);
  };
  std::ptrdiff_t unrecorded = 0;
  std::ptrdiff_t unseen = 0;  // modules that lack an input, and may have no runs in the recording
  for (const auto& module : modules_) {
    const bool lacks = module->runs && std::any_of(module->known.begin(), module->known.end(), [&](const auto& known) {
                         return known.read && !known.ever_recorded && !may_follow(known);
                       });
    runs[module->index].lacks = lacks;
    unseen += lacks ? 1 : 0;
    unrecorded += module->runs ? std::count_if(module->known.begin(), module->known.end(), may_follow) : 0;
  }
  while (unrecorded > 0 || unseen > 0) {
    auto item = recorded->next();
    if (!item) {
      continue;  // known when it is replayed
    }
    if (!*item) {
      break;
    }
    if (const auto* run = std::get_if<RecordedRun>(&**item); run != nullptr) {
      if (const ReplayedModule* module = of_recording(run->words.module); module != nullptr) {
        Runs& of = runs[module->index];
        unseen -= of.lacks && !of.any ? 1 : 0;
        of.gap = of.gap || (of.any && run->words.tail.number != of.next);
        of.any = true;
        of.next = run->words.tail.number + 1;
      }
    } else if (const auto* value = std::get_if<RecordedValue>(&**item); value != nullptr) {
      ReplayedModule* const module = of_recording(value->words.module);
      unrecorded -= module != nullptr && learn_early(*value, *module, runs[module->index].gap) ? 1 : 0;
    }
  }
  for (const auto& module : modules_) {
    if (runs[module->index].any) {
      leave_out_if_unknown(*module);
    }
  }
}

// Returns true if the value is recorded for the first time.
bool ReplayedModules::learn_early(const RecordedValue& value, ReplayedModule& module, bool after_a_gap) const {
  const auto place = module.place.find(value.variable);
  if (!module.runs || value.words.kind == tape::EntryKind::Run || place == module.place.end() ||
      module.known[place->second].ever_recorded) {
    return false;
  }
  KnownValue& known = module.known[place->second];
  known.ever_recorded = true;
  if (value.words.kind == tape::EntryKind::Again && !after_a_gap) {
    const schema::Variable& variable = recorded_declaration(value.variable);
    known.bytes.resize(variable.type.size());
    known.has_value = recording::from_cdr(variable.type, value.cdr, known.bytes).ok();
    known.cdr.assign(value.cdr.begin(), value.cdr.end());
  }
  return true;
}

void ReplayedModules::leave_out_if_unknown(ReplayedModule& module) const {
  for (const KnownValue& known : module.known) {
    if (module.runs && known.read && !known.ever_recorded) {
      module.unknown_inputs += (module.unknown_inputs.empty() ? "" : ", ") + variable_at(store_, known.variable).name;
    }
  }
  if (!module.unknown_inputs.empty()) {
    module.runs = false;
    module.why_not = "the recording has no values of its inputs (" + module.unknown_inputs + ")";
    console_.warning(
        "module {} does not run: the recording has no values of its inputs ({}); its outputs are taken from "
        "the recording",
        module.name, module.unknown_inputs);
  }
}

}  // namespace indurop::node
