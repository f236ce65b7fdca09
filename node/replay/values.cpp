// SPDX-License-Identifier: Apache-2.0
// The recorded inputs and outputs of runs, compared with the outputs of the repeated runs.

#include <fmt/format.h>

#include "history/recording/cdr.h"
#include "node/replay/replay.h"

namespace indurop::node {

using scheduler::ModuleState;

namespace {

// Returns the number or text of a struct or an array that differs first, and its position. Padding between the parts of
// a value does not count.
std::pair<schema::Part, std::size_t> first_different_part(const schema::Variable& variable,
                                                          const std::vector<std::uint8_t>& was,
                                                          const std::vector<std::uint8_t>& is) {
  schema::Schema alone;
  alone.variables.push_back(variable);
  for (std::size_t i = 0; i < is.size(); ++i) {
    std::string message;
    const schema::Part part = schema::part_at(variable, static_cast<std::uint32_t>(i));
    const auto place =
        was[i] == is[i] ? Result<schema::Place>(Error{Errc::NotFound}) : schema::find_place(alone, part.name, message);
    if (place && i >= place->offset && i < place->offset + part.type.size()) {
      return {part, place->offset};
    }
  }
  return {{variable.name, variable.type}, 0};
}

}  // namespace

// Adds a value to the known ones of its module. A first value goes to the store. Returns false if it is damaged.
bool Replay::take(const RecordedValue& value) {
  vars::Store& store = *prepared_.store;
  const vars::DirectoryEntry& entry = store.directory()[value.variable];
  std::vector<std::uint8_t> bytes(entry.value_size);
  if (!recording::from_cdr(variable(value.variable).type, value.cdr, bytes)) {
    console_.error("a value of {} in the recording is damaged", variable(value.variable).name);
    return false;
  }
  if (value.words.kind == tape::EntryKind::Run || value.words.module == recorder::kOthers) {
    (void)store.write(entry, 0, bytes);
    return true;
  }
  const std::uint32_t index = configured(value.words.module);
  if (index == kNoSuchModule || !modules_[index]->runs) {
    (void)store.write(entry, 0, bytes);
    return true;
  }
  Module& module = *modules_[index];
  const auto place = module.place.find(value.variable);
  if (place == module.place.end()) {
    return true;  // the changed module no longer uses it
  }
  if (value.words.kind == tape::EntryKind::Before) {
    Known& known = module.known[place->second];
    known.has_value = true;
    known.recorded_run = module.seen;
    known.cdr.assign(value.cdr.begin(), value.cdr.end());
    known.bytes = std::move(bytes);
  } else {
    module.left.push_back({place->second, value.words.kind, {value.cdr.begin(), value.cdr.end()}, std::move(bytes)});
  }
  return true;
}

void Replay::give_inputs(Module& module) {
  vars::Store& store = *prepared_.store;
  for (const Known& known : module.known) {
    const vars::DirectoryEntry& entry = store.directory()[known.variable];
    std::vector<std::uint8_t> now(entry.value_size);
    if (known.read && known.has_value && store.read(entry, 0, now).ok() && now != known.bytes) {
      (void)store.write(entry, 0, known.bytes);
    }
  }
}

void Replay::take_recorded_outputs(Module& module) {
  module.disturbed = false;
  for (Left& left : module.left) {
    Known& known = module.known[left.place];
    known.has_value = true;
    known.recorded_run = module.seen;
    known.cdr = std::move(left.cdr);
    known.bytes = std::move(left.bytes);
    module.disturbed = module.disturbed || left.kind == tape::EntryKind::During;
  }
  module.left.clear();
}

void Replay::compare(Module& module, std::uint32_t index, const recorder::RunWords& run) {
  module.disturbed_runs += module.disturbed ? 1U : 0U;
  const bool faulted = module.died || module.state.record->state.load() == ModuleState::Faulted;
  if (faulted != run.faulted) {
    module.apart = true;
    ++differences_;
    console_.error("tick {}: module {} {} in the recording and {} now{}", run.tail.tick, module.state.record->name,
                   run.faulted ? "faulted" : "did not fault", faulted ? "faults" : "does not",
                   faulted ? fmt::format(": {}", module.state.record->last_fault) : "");
    return;
  }
  module.faulted_alike = module.faulted_alike || faulted;
  if (faulted) {
    return;  // its outputs were those of an incomplete run, followed by its fail-safe values
  }
  vars::Store& store = *prepared_.store;
  std::vector<std::uint8_t> now;
  std::vector<std::uint8_t> cdr;
  for (Known& known : module.known) {
    if (!known.written || !known.has_value) {
      continue;
    }
    const vars::DirectoryEntry& entry = store.directory()[known.variable];
    const std::string& name = variable(known.variable).name;
    if (!forced_then_.empty() && forced_then_.any(name, run.tail.start_ns, run.tail.end_ns)) {
      ++forced_[name];
      write_output(known.variable, known.cdr, run.tail.end_ns);
      (void)store.write(entry, 0, known.bytes);
      continue;
    }
    now.resize(entry.value_size);
    ++values_;
    known.ever_compared = true;
    known.compared += module.disturbed ? 0U : 1U;
    // Padding between the parts of a value may differ.
    if (!store.read(entry, 0, now).ok() || now == known.bytes ||
        (recording::to_cdr(variable(known.variable).type, now, cdr).ok() && cdr == known.cdr)) {
      write_output(known.variable, known.cdr, run.tail.end_ns);
      continue;
    }
    write_output(known.variable, module.disturbed ? known.cdr : cdr, run.tail.end_ns);
    differs(module, index, known, run.tail.tick, now);
  }
}

void Replay::write_output(std::uint32_t index, const std::vector<std::uint8_t>& cdr, std::int64_t end_ns) {
  if (!output_) {
    return;
  }
  if (auto written = output_->take(index, variable(index), cdr, end_ns + real_minus_node_ns_); !written) {
    console_.error("{}", written.error().text);
    output_failed_ = true;
    output_.reset();
  }
}

void Replay::close_output() {
  std::map<std::string, std::uint64_t> differing;
  for (const auto& module : modules_) {
    for (const Known& known : module->known) {
      if (known.differing > 0) {
        differing[variable(known.variable).name] += known.differing;
      }
    }
  }
  if (auto closed = output_ ? output_->close(differing) : Result<void, base::Problem>(); !closed) {
    console_.error("{}", closed.error().text);
    output_failed_ = true;
  }
}

void Replay::differs(Module& module, std::uint32_t index, Known& known, std::uint64_t tick,
                     const std::vector<std::uint8_t>& now) {
  const schema::Variable& differing = variable(known.variable);
  if (module.disturbed) {
    ++unclear_;
  } else {
    if (differences_++ == 0) {
      console_.error("tick {}, module {}: {} was {} in the recording and is {} now", tick,
                     checked_.config.modules[index].name, differing.name,
                     schema::format_value(differing.type, known.bytes), schema::format_value(differing.type, now));
    }
    if (known.differing++ == 0) {
      known.first_tick = tick;
      const auto [part, offset] = first_different_part(differing, known.bytes, now);
      known.first_place = part.name;
      known.first_was = schema::format_value(part.type, std::span(known.bytes).subspan(offset, part.type.size()));
      known.first_is = schema::format_value(part.type, std::span(now).subspan(offset, part.type.size()));
    }
  }
  // The next run begins with the recorded value.
  (void)prepared_.store->write(prepared_.store->directory()[known.variable], 0, known.bytes);
}

}  // namespace indurop::node
