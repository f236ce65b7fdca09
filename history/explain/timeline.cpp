// SPDX-License-Identifier: Apache-2.0
#include "history/explain/timeline.h"

#include <algorithm>

namespace indurop::explain {

Timeline::Timeline(const Facts& facts, std::int32_t core) {
  for (const RunFact& run : facts.runs) {
    if (run.module < facts.modules.size() && facts.modules[run.module].core == core) {
      runs_.push_back(&run);
      longest_ns_ = std::max(longest_ns_, run.end_ns - run.start_ns);
    }
  }
  std::stable_sort(runs_.begin(), runs_.end(),
                   [](const RunFact* a, const RunFact* b) { return a->start_ns < b->start_ns; });
}

// At every instant the core belongs to the run that began last of those that have not ended.
Shares Timeline::shares(Span span) const {
  Shares out;
  std::vector<std::int64_t> edges{span.from_ns, span.to_ns};
  std::vector<const RunFact*> some;
  const auto begin = std::lower_bound(runs_.begin(), runs_.end(), span.from_ns - longest_ns_,
                                      [](const RunFact* run, std::int64_t time) { return run->start_ns < time; });
  for (auto run = begin; run != runs_.end() && (*run)->start_ns < span.to_ns; ++run) {
    if ((*run)->end_ns > span.from_ns) {
      some.push_back(*run);
      edges.push_back(std::clamp((*run)->start_ns, span.from_ns, span.to_ns));
      edges.push_back(std::clamp((*run)->end_ns, span.from_ns, span.to_ns));
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const Span piece{edges[i], edges[i + 1]};
    const RunFact* inner = nullptr;
    for (const RunFact* run : some) {
      if (run->start_ns <= piece.from_ns && run->end_ns >= piece.to_ns) {
        inner = run;
      }
    }
    if (piece.length() > 0) {
      out[inner != nullptr ? inner->module : kNoModule] += piece.length();
    }
  }
  return out;
}

const RunFact* Timeline::at(std::int64_t time_ns) const {
  const RunFact* inner = nullptr;
  for (const RunFact* run : runs_) {
    if (run->start_ns > time_ns) {
      break;
    }
    if (run->end_ns > time_ns) {
      inner = run;
    }
  }
  return inner;
}

}  // namespace indurop::explain
