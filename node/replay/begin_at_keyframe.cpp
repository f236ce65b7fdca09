// SPDX-License-Identifier: Apache-2.0
// Reads the recording before a replay of a late part: the keyframe at which each module begins.

#include <vector>

#include "node/replay/replayed_modules.h"

namespace indurop::node {

// Each module begins at its last keyframe that comes before the first run that is wanted.
void ReplayedModules::find_keyframes_to_begin_at() {
  if (options_.replay.from_tick == 0) {
    return;
  }
  auto recorded = RecordedRuns::open(options_.replay.file, options_.replay.board, store_);
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
      if (const ReplayedModule* module = of_recording(keyframe->module); module != nullptr) {
        newest[module->index] = keyframe->words.run;
      }
    } else if (const auto* run = std::get_if<RecordedRun>(&**item); run != nullptr) {
      ReplayedModule* const module = of_recording(run->words.module);
      if (module != nullptr && run->words.tail.number == newest[module->index] &&
          run->words.tail.tick <= options_.replay.from_tick) {
        module->kept.begin_at(newest[module->index]);
      }
    }
  }
}

}  // namespace indurop::node
