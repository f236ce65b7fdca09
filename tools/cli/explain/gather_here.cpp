// SPDX-License-Identifier: Apache-2.0
// Facts from the shared memory of a node of this machine.

#include <algorithm>
#include <limits>
#include <map>

#include "core/rt/clock.h"
#include "history/explain/facts_json.h"
#include "history/explain/kernel_log.h"
#include "history/explain/run_facts.h"
#include "network/mirror/frames/mirror_block.h"
#include "store/operate/item.h"
#include "store/operate/journal.h"
#include "store/tape/follower.h"
#include "store/vars/shm_file.h"
#include "tools/cli/explain/gather.h"

namespace indurop::tools {
namespace {

using explain::Facts;

void add_mirror(const std::string& node, Facts& facts) {
  const auto file = vars::ShmCopy::of(vars::mirror_file(node));
  const mirror::MirrorBlock* block =
      file ? mirror::mirror_block_in({file.value().data(), file.value().size()}) : nullptr;
  if (block != nullptr) {
    explain::add_boards(*block, facts);
  }
}

// Adds which variables are forced, and for how long.
void add_forces(const vars::Store& store, Facts& facts) {
  for (const vars::Force& force : store.forces()) {
    const std::string& name = store.schema().variables[force.variable->schema_index].name;
    for (explain::VariableFact& variable : facts.variables) {
      if (variable.name == name) {
        variable.forced_until_ns =
            force.until == vars::kForever ? std::numeric_limits<std::int64_t>::max() : rt::to_ns(force.until);
      }
    }
  }
}

std::uint32_t index_of(const vars::Store& store, const std::string& variable) {
  const auto* entry = store.find(abi::fnv1a64(variable.data(), variable.size()));
  return entry == nullptr ? std::numeric_limits<std::uint32_t>::max()
                          : static_cast<std::uint32_t>(entry - store.directory().data());
}

// A variable that is too large for the tape, or has another type than at the start of the node, is not on the tape.
void mark_recorded(const std::string& variable, bool recorded, Facts& facts) {
  for (explain::VariableFact& one : facts.variables) {
    one.recorded = one.name == variable && recorded;
  }
}

// Adds changes of the variable and of qualities from the tape.
void add_tape(const std::string& node, const vars::Store& store, const std::string& variable,
              const std::vector<QualityPlace>& places, Facts& facts) {
  auto follower = tape::Follower::open(node, true);
  if (!follower || follower->header().layout_hash != store.header().layout_hash) {
    mark_recorded(variable, false, facts);
    return;
  }
  follower->show_later_variables();
  const std::uint32_t index = index_of(store, variable);
  std::multimap<std::uint32_t, const QualityPlace*> qualities;
  for (const QualityPlace& place : places) {
    qualities.emplace(index_of(store, place.variable), &place);
  }
  tape::Run run;
  bool seen = false;
  for (std::size_t track = 0; track < follower->tracks(); ++track) {
    while (follower->next(track, run)) {
      seen = seen || std::any_of(run.values.begin(), run.values.end(),
                                 [index](const tape::Value& value) { return value.variable == index; });
      const bool known = run.module < facts.modules.size();
      for (const tape::Value& value : run.values) {
        const bool again = value.kind == tape::EntryKind::Again;
        const std::int64_t since = again ? explain::DeviceFact::kSinceBefore : run.tail.end_ns;
        const auto [first, last] = qualities.equal_range(value.variable);
        if (again || value.kind == tape::EntryKind::After) {
          std::for_each(first, last, [&](const auto& one) { one.second->add(since, value.bytes, facts); });
        }
      }
      const bool wrote = std::any_of(run.values.begin(), run.values.end(), [&](const tape::Value& value) {
        return value.variable == index && value.kind == tape::EntryKind::After;
      });
      if (wrote) {
        facts.changes.push_back(
            {variable, known ? facts.modules[run.module].name : "", run.tail.tick, run.tail.end_ns});
      }
    }
  }
  // Of a later one the tape does not tell whether a module has it on its track.
  const bool from_the_start = index < follower->header().variable_count;
  mark_recorded(variable, from_the_start ? follower->variables()[index].taped != 0 : seen, facts);
}

// A quality that the tape does not have has not changed for as long as anything is known.
void add_present_qualities(const vars::Store& store, const std::vector<QualityPlace>& places, Facts& facts) {
  for (const QualityPlace& place : places) {
    const auto item =
        facts.devices[place.device].qualities.empty() ? operate::find(store, place.variable) : base::Problem{};
    if (const auto bytes = item ? operate::read(store, *item) : base::Problem{}; bytes) {
      place.add(explain::DeviceFact::kSinceBefore, *bytes, facts);
    }
  }
}

Facts of_memory(const std::string& node, const RunView& run, bool with_runs, std::int64_t now_ns) {
  const std::int64_t wall_ns = rt::wall_ns();  // at once: reading the rest takes milliseconds
  Facts facts = explain::facts_of(run.block(), run.size(), with_runs);
  if (facts.stop_reason.empty() && !run.node_alive()) {
    facts.stop_reason = "its process died in the middle of its work";
  }
  facts.board = fixed_text(run.block().board);
  add_mirror(node, facts);
  facts.orders = operate::read_orders(node, run.block().started_wall_ns);
  facts.now_ns = now_ns;
  facts.wall_minus_node_ns = facts.is_virtual ? 0 : wall_ns - now_ns;
  if (!facts.is_virtual) {
    explain::add_kernel(node, facts);
  }
  return facts;
}

}  // namespace

std::string facts_text_here(const std::string& node, const RunView& run) {
  const auto store = vars::Store::attach(node, vars::Mode::ReadOnly);
  return explain::facts_text(of_memory(node, run, false, store ? rt::to_ns(store->now()) : run.now_ns()));
}

Facts facts_here(const ChosenRun& chosen, const std::string& variable) {
  const auto store = vars::Store::attach(chosen.node, vars::Mode::ReadOnly);
  Facts facts = of_memory(chosen.node, chosen.run, true, store ? rt::to_ns(store->now()) : chosen.run.now_ns());
  facts.alive = chosen.run.node_alive();
  const std::vector<QualityPlace> places = add_config(fixed_text(chosen.run.block().config_file), facts);
  if (store) {
    add_forces(*store, facts);
    add_tape(chosen.node, *store, variable, places, facts);
    add_present_qualities(*store, places, facts);
  }
  explain::make_sound(facts);
  return facts;
}

}  // namespace indurop::tools
