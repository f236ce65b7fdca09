// SPDX-License-Identifier: Apache-2.0
// Exchanges of process modules in a replay: the process of the version that runs ends, and one of the next version
// begins with what the process kept that followed in the recording.

#include <utility>

#include "node/exchange/carry.h"
#include "node/exchange/version_text.h"
#include "node/replay/replayed_versions.h"

namespace indurop::node {

void ReplayedVersions::show_process(ReplayedModule& module, Versions& versions, Repeater& repeater) const {
  repeater.set_program(module, versions.current().file);
  versions.held = versions.order[versions.at].number;
  module.use(versions.current().access, store_);
}

// That is what it kept itself, if it has run before, and what it took over from the one before it: after a crash, and
// if that one does not declare what it keeps, nothing.
bool ReplayedVersions::exchange_process(ReplayedModule& module, Versions& versions, const recorder::RunWords& run,
                                        Repeater& repeater) const {
  const recorder::RecordedVersion& recorded = versions.order[versions.at];
  Version& to = versions.current();
  const bool knew = !std::exchange(module.lacks_version, to.file.empty());
  if (module.lacks_version || recorded.number == versions.held) {
    module.kept.doubt();
    return true;
  }
  Version& from = versions.by_number[versions.held];
  from.is_known = knew && module.knowledge == Knowledge::Certain && module.next_number == run.tail.number;
  from.kept = repeater.state_of(module);
  show_process(module, versions, repeater);
  if (!repeater.restart(module)) {
    return false;
  }
  module.continues = true;
  bool exact = true;
  if (versions.follows_earlier()) {
    exact = to.is_known && to.kept;
    if (to.kept) {
      repeater.put_back(module, *to.kept);
    }
  }
  if (run.anew) {
    module.begins_again = exact;
  } else {
    exact = take_over(module, from, exact, repeater);
  }
  if (!exact) {
    module.kept.doubt();
  }
  console_.info("module {}: from tick {} on it is the version of {} ({})", module.name, run.tail.tick, to.file.string(),
                short_digest(recorded.digest));
  return true;
}

// Returns true if the process keeps what that of the recording kept; `own_is_exact`: before this, it did.
bool ReplayedVersions::take_over(const ReplayedModule& module, const Version& from, bool own_is_exact,
                                 Repeater& repeater) {
  const auto own = repeater.state_of(module);
  if (!from.kept || !own) {
    return false;
  }
  repeater.put_back(module, *from.kept);
  const operate::ReloadPlan plan = plan_carry(from.kept->form, own->form).plan;
  return from.is_known && (own_is_exact || (plan.added.empty() && plan.changed.empty()));
}

}  // namespace indurop::node
