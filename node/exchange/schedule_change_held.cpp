// SPDX-License-Identifier: Apache-2.0
// A schedule that follows for a deployment: it is prepared, waits until the tick of all boards is named, and gives way
// to the one before if the deployment is given up.
#include <algorithm>

#include "node/exchange/schedule_change.h"

namespace indurop::node {
namespace {

constexpr const char* kChangeGivenUp = "the change was given up";

bool writes(const config::ModuleFacts& facts, const std::string& variable) {
  const auto access = facts.file.access.find(abi::fnv1a64(variable.data(), variable.size()));
  return access != facts.file.access.end() && access->second.writes;
}

}  // namespace

MacroGrid ScheduleChange::grid() const {
  return common_grid(grid_, grid_, parts_.run.basic_period_ns);
}

MacroGrid ScheduleChange::common_with_next() const {
  return held_.changes ? common_grid(grid_, next_grid_, parts_.run.basic_period_ns) : grid();
}

void ScheduleChange::hold(const std::string& manifest, bool compares) {
  held_ = {};
  held_.on = true;
  held_.before = parts_.config.file.string();
  report_ = {};
  plan_ = {};
  check({manifest, false, compares});
}

void ScheduleChange::release() {
  held_ = {};
  plan_ = {};
}

bool ScheduleChange::is_prepared() const noexcept {
  return step_ == Step::Ready || step_ == Step::Idle || !held_.failure.empty();
}

// Who writes what is sent stays as it is; what is sent and read may be more.
void ScheduleChange::compare_routes() {
  const vars::Store& store = parts_.store;
  const auto find = [&store](const std::string& name) { return store.find(abi::fnv1a64(name.data(), name.size())); };
  const BoardRoutes::Standing standing{
      [this](const std::string& name) {
        return std::any_of(parts_.libraries.begin(), parts_.libraries.end(), [&name](const ModuleLibrary& library) {
          return library.uses().contains(abi::fnv1a64(name.data(), name.size()));
        });
      },
      [&](const std::string& name) {
        const vars::DirectoryEntry* const entry = find(name);
        return entry != nullptr && entry->offset < store.header().total_size;
      },
      [this](const std::string& name) {
        return std::any_of(next_.check.uses.begin(), next_.check.uses.end(), [&name](const config::VariableUse& use) {
          return use.name == name && !(use.readers.empty() && use.writers.empty());
        });
      }};
  const mirror::Routes& next = next_.mirror->routes;
  if (std::string difference = parts_.routes.difference(next, standing); !difference.empty()) {
    plan_.restarts.push_back(std::move(difference));
  }
  for (const std::uint32_t place : plan_.added) {
    const config::Module& module = next_.config.modules[place];
    const std::uint32_t index = plan_.indices[place];
    if (index != SchedulePlan::kNoModule && runs_file(record(index), module.file)) {
      continue;  // it was there before
    }
    const auto sent = std::find_if(next.outgoing.begin(), next.outgoing.end(), [&](const mirror::Outgoing& out) {
      return parts_.routes.sends(out.variable) && writes(next_.check.facts[place], out.variable);
    });
    if (sent != next.outgoing.end()) {
      plan_.restarts.push_back(fmt::format("module {} is added and writes variable {}, which other boards read",
                                           module.name, sent->variable));
    }
  }
}

// Only a request with the configuration of a board of a plant has routes.
void ScheduleChange::open_routes() {
  if (next_.mirror) {
    parts_.mirror.follow(parts_.routes.extend(next_.mirror->routes, {parts_.config, next_.check, parts_.engine}));
  }
}

void ScheduleChange::settle_routes(bool keeps_next) {
  if (parts_.routes.is_extended()) {
    parts_.mirror.follow(parts_.routes.settle(keeps_next));
  }
}

void ScheduleChange::enter(std::uint64_t tick) {
  if (step_ != Step::Ready) {
    return;  // nothing changes, or it has failed
  }
  if (!arrivals_.enter()) {
    fail(arrivals_.failure());
  } else if (parts_.engine.change_at({tick, 1, tick})) {
    step_ = Step::Waiting;
  } else {
    fail(fmt::format("it missed the tick of the change, {}: it was in tick {} when the order came", tick,
                     parts_.run.tick.load()));
  }
}

void ScheduleChange::go_back() {
  if (!held_.on || held_.given_up) {
    return;
  }
  held_.given_up = true;
  if (step_ == Step::Ready) {
    fail(kChangeGivenUp);
  } else {
    follow_held();
  }
}

// Returns true if the preparation has ended with this.
bool ScheduleChange::is_given_up() {
  if (!held_.given_up || request_.back) {
    return false;
  }
  fail(kChangeGivenUp);
  return true;
}

// The way back is a change like the others, but waits for no other board.
void ScheduleChange::follow_held() {
  if (step_ == Step::Idle && held_.given_up && held_.counts && !request_.back) {
    check({held_.before, true, false});
  }
}

}  // namespace indurop::node
