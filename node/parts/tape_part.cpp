// SPDX-License-Identifier: Apache-2.0
#include "node/parts/tape_part.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "core/base/duration.h"
#include "store/tape/plan.h"

namespace indurop::node {
namespace {

constexpr std::int64_t kReachNs = 2'000'000'000;  // a black box that covers less is of little use
constexpr std::uint64_t kMegabyte = 1'000'000;

// Modules of the schedule with recorded runs: a process woken by a signal does not report when its run has ended.
std::map<std::string, tape::ModuleAccess> scheduled(const config::Config& config, std::int64_t basic_period_ns) {
  std::map<std::string, tape::ModuleAccess> modules;
  for (std::uint32_t i = 0; i < config.modules.size(); ++i) {
    const config::Module& module = config.modules[i];
    if (module.operation != scheduler::Operation::NonReal && module.signal == 0) {
      const bool periodic = module.operation == scheduler::Operation::Periodic;
      modules[module.name] = {i, periodic ? module.period.count() : basic_period_ns, {}, {}};
    }
  }
  return modules;
}

}  // namespace

Result<std::unique_ptr<tape::Tape>> make_tape(const Options& options, const Checked& checked,
                                              std::int64_t basic_period_ns, const vars::Store& store,
                                              const Console& console) {
  if (options.tape_megabytes == 0) {
    (void)vars::remove_shm_file(vars::tape_file(options.node));  // left by an earlier run
    return std::unique_ptr<tape::Tape>();
  }
  auto modules = scheduled(checked.config, basic_period_ns);
  const auto directory = store.directory();
  for (const config::VariableUse& use : checked.check.uses) {
    const vars::DirectoryEntry* entry = store.find(abi::fnv1a64(use.name.data(), use.name.size()));
    if (entry == nullptr) {
      continue;
    }
    const auto index = static_cast<std::uint32_t>(entry - directory.data());
    const auto note = [&](const std::vector<std::string>& users, std::vector<std::uint32_t> tape::ModuleAccess::*list) {
      for (const std::string& user : users) {
        if (const auto known = modules.find(user); known != modules.end()) {
          (known->second.*list).push_back(index);
        }
      }
    };
    note(use.readers, &tape::ModuleAccess::reads);
    note(use.writers, &tape::ModuleAccess::writes);
  }
  std::vector<tape::ModuleAccess> accesses;
  for (auto& [name, access] : modules) {
    accesses.push_back(std::move(access));
  }
  const auto plan = tape::plan_tape(accesses, directory, basic_period_ns, kReachNs, options.tape_megabytes * kMegabyte);
  if (plan.reach_ns < kReachNs && !options.simulation.on) {
    console.info("the tape holds at least the last {}; two seconds need --tape {}",
                 base::format_duration(std::chrono::milliseconds(plan.reach_ns / 1'000'000)),
                 (plan.bytes_wanted + kMegabyte - 1) / kMegabyte);
  }
  return tape::Tape::create(options.node, store, plan, checked.config.modules.size());
}

}  // namespace indurop::node
