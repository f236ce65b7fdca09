// SPDX-License-Identifier: Apache-2.0
// Explains why one run ended when it did: how long the module itself and each other one had the core between its
// release and its end, compared with its other runs. Pure.

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "history/explain/answer.h"
#include "history/explain/facts.h"
#include "history/explain/timeline.h"

namespace indurop::explain {

class Lateness {
 public:
  explicit Lateness(const Facts& facts) : facts_(facts) {}

  [[nodiscard]] Answer explain(const RunFact& run, int depth = 0) const;
  // Returns Machine if the kernel's counters, for the threads of this core that a run of the module depends on, account
  // for at least half of `so_much_ns` in this time; AllIsWell if the kernel counted nothing of it.
  [[nodiscard]] Answer machine(Span span, std::int32_t core, const ModuleFact& module, std::int64_t so_much_ns) const;

 private:
  // Additional core time compared with other runs, and its module.
  struct Excess {
    std::uint32_t module = kNoModule;
    bool own = false;  // the run itself, not another run of its module
    std::int64_t more_ns = 0;
    std::int64_t whole_ns = 0;
  };
  struct Compared {
    std::vector<Excess> all;   // largest first
    std::int64_t more_ns = 0;  // increase of the response time
    std::size_t others = 0;    // number of runs it was compared with
  };

  struct Waited {
    std::int64_t whole_ns = 0;
    std::int64_t for_others_ns = 0;
    std::int64_t stolen_ns = 0;
    std::uint64_t pages = 0;
  };

  [[nodiscard]] Waited waited(Span span, std::int32_t core, const ModuleFact& module) const;
  [[nodiscard]] const std::string& name(std::uint32_t module) const { return facts_.modules[module].name; }
  using Key = std::pair<std::uint32_t, bool>;  // module, own
  [[nodiscard]] std::map<Key, std::int64_t> shares_of(const Timeline& timeline, const RunFact& run) const;
  [[nodiscard]] Compared compare(const RunFact& run) const;
  [[nodiscard]] std::vector<const RunFact*> neighbours(const RunFact& run) const;
  [[nodiscard]] Answer blame(const RunFact& run, const Compared& compared, int depth) const;
  [[nodiscard]] Answer blame_itself(const RunFact& run, const Excess& own) const;
  [[nodiscard]] Answer blame_other(const RunFact& run, const Excess& other, int depth) const;
  [[nodiscard]] Answer blame_gap(const RunFact& run, const Excess& gap, int depth) const;
  [[nodiscard]] bool waits_for(const ModuleFact& module, const std::string& other) const;
  [[nodiscard]] std::string figures(const RunFact& run) const;
  [[nodiscard]] std::vector<std::string> list(const Compared& compared) const;

  const Facts& facts_;
};

}  // namespace indurop::explain
