// SPDX-License-Identifier: Apache-2.0
#include "node/parts/board_routes.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace indurop::node {
namespace {

constexpr std::int64_t kTimeoutNs = 1'000'000'000;

std::uint32_t index_of(const std::string& module, const config::Config& config) {
  return static_cast<std::uint32_t>(
      std::find_if(config.modules.begin(), config.modules.end(),
                   [&module](const config::Module& known) { return known.name == module; }) -
      config.modules.begin());
}

std::vector<std::uint32_t> writers_of(const std::string& variable, const BoardRoutes::Modules& modules) {
  std::vector<std::uint32_t> writers;
  const auto use = std::find_if(modules.check.uses.begin(), modules.check.uses.end(),
                                [&](const config::VariableUse& known) { return known.name == variable; });
  if (use != modules.check.uses.end()) {
    for (const std::string& name : use->writers) {
      writers.push_back(index_of(name, modules.config));
    }
    std::sort(writers.begin(), writers.end());
  }
  return writers;
}

// Returns true for a module that the schedule which follows adds.
bool is_added(std::uint32_t module, const BoardRoutes::Modules& modules) {
  const config::Module& one = modules.config.modules[module];
  return modules.engine.band_of(module) == nullptr && one.type == scheduler::ModuleType::Thread &&
         one.operation != scheduler::Operation::NonReal;
}

std::set<std::string> owners_of(const std::string& variable, const std::vector<mirror::Incoming>& incoming) {
  std::set<std::string> owners;
  for (const mirror::Incoming& in : incoming) {
    if (in.variable == variable) {
      owners.insert(in.owner);
    }
  }
  return owners;
}

const mirror::Outgoing* find_outgoing(const mirror::Routes& routes, const std::string& variable) {
  const auto found = std::find_if(routes.outgoing.begin(), routes.outgoing.end(),
                                  [&variable](const mirror::Outgoing& out) { return out.variable == variable; });
  return found == routes.outgoing.end() ? nullptr : &*found;
}

}  // namespace

// Index of the group that writes the variable; -1: any process may write it at any time. The first `fixed` groups stay
// as they are.
int BoardRoutes::group_of(const std::string& variable, const Modules& modules, std::size_t fixed) {
  const std::vector<std::uint32_t> writers = writers_of(variable, modules);
  if (writers.empty()) {
    return -1;
  }
  const scheduler::Band* const band = modules.engine.band_of(writers.front());
  const bool alone = std::all_of(writers.begin(), writers.end(),
                                 [&](std::uint32_t module) { return modules.engine.band_of(module) == band; });
  const bool added = writers.size() == 1 && is_added(writers.front(), modules);
  if (!added && (!alone || band == nullptr)) {
    return -1;
  }
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    Group& group = groups_[i];
    const bool has_all = std::includes(group.modules.begin(), group.modules.end(), writers.begin(), writers.end());
    if (has_all || (i >= fixed && band != nullptr && group.band == band)) {
      std::vector<std::uint32_t> all;
      std::set_union(group.modules.begin(), group.modules.end(), writers.begin(), writers.end(),
                     std::back_inserter(all));
      group.modules = std::move(all);
      return static_cast<int>(i);
    }
  }
  const std::int64_t period =
      band != nullptr ? band->plan().period_ns : modules.config.modules[writers.front()].period.count();
  // A module in a process of its own does not wake the mirror when it is done.
  groups_.push_back({band, writers, band == nullptr || band->plan().kind != scheduler::BandKind::Process,
                     std::max(kTimeoutNs, 2 * period)});
  return static_cast<int>(groups_.size() - 1);
}

void BoardRoutes::name(std::vector<mirror::Outgoing>& outgoing, const Modules& modules) {
  const std::size_t fixed = groups_.size();
  for (mirror::Outgoing& out : outgoing) {
    out.writers = group_of(out.variable, modules, fixed);
  }
  for (std::size_t i = fixed; i < groups_.size(); ++i) {
    now_.writers.push_back(
        {[&engine = modules.engine, members = groups_[i].modules] { return engine.activity_of(members); },
         groups_[i].notifies, groups_[i].patience_ns});
  }
}

const mirror::Routes& BoardRoutes::name_writers(const Modules& modules) {
  name(now_.outgoing, modules);
  return now_;
}

bool BoardRoutes::sends(const std::string& variable) const {
  return find_outgoing(now_, variable) != nullptr;
}

std::string BoardRoutes::difference(const mirror::Routes& next, const Standing& standing) const {
  for (const mirror::Outgoing& out : next.outgoing) {
    const mirror::Outgoing* const known = find_outgoing(now_, out.variable);
    if (known != nullptr && (known->every_ns != out.every_ns || known->best_effort != out.best_effort)) {
      return fmt::format("variable {} would be sent to other boards in another way", out.variable);
    }
    if (!owners_of(out.variable, now_.incoming).empty()) {
      return fmt::format("variable {} is read from another board, and would be sent to others", out.variable);
    }
  }
  for (const mirror::Incoming& in : now_.incoming) {
    if (owners_of(in.variable, next.incoming) != owners_of(in.variable, now_.incoming) &&
        standing.will_be_used(in.variable)) {
      return fmt::format("variable {} would not be read from board {} any more", in.variable, in.owner);
    }
  }
  for (const mirror::Incoming& in : next.incoming) {
    if (!owners_of(in.variable, now_.incoming).empty()) {
      continue;  // from the same boards
    }
    const bool was_read = owners_of(in.variable, first_.incoming) == owners_of(in.variable, next.incoming);
    if (standing.is_used(in.variable) || (standing.is_first(in.variable) && !was_read)) {
      return fmt::format("variable {} would be read from board {}, and is one of this board now", in.variable,
                         in.owner);
    }
  }
  return "";
}

const mirror::Routes& BoardRoutes::extend(const mirror::Routes& next, const Modules& modules) {
  std::vector<mirror::Outgoing> added;
  std::copy_if(next.outgoing.begin(), next.outgoing.end(), std::back_inserter(added),
               [this](const mirror::Outgoing& out) { return find_outgoing(now_, out.variable) == nullptr; });
  name(added, modules);
  now_.outgoing.insert(now_.outgoing.end(), added.begin(), added.end());
  before_ = now_.incoming;
  next_ = next.incoming;
  for (const mirror::Incoming& in : next.incoming) {
    if (!owners_of(in.variable, before_).contains(in.owner)) {
      now_.incoming.push_back(in);
    }
  }
  return now_;
}

const mirror::Routes& BoardRoutes::settle(bool keeps_next) {
  now_.incoming = keeps_next ? *std::move(next_) : std::move(before_);
  next_.reset();
  before_.clear();
  return now_;
}

}  // namespace indurop::node
