// SPDX-License-Identifier: Apache-2.0
#include "node/replay/comparison.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "core/schema/carry.h"
#include "history/recording/cdr.h"

namespace indurop::node {

namespace {

// Returns the number or text of a struct or an array that differs first, and its position. Padding between the parts of
// a value does not count.
std::pair<schema::Part, std::size_t> first_different_part(const schema::Variable& variable,
                                                          const std::vector<std::uint8_t>& was,
                                                          const std::vector<std::uint8_t>& is) {
  schema::Schema alone;
  alone.variables.push_back(variable);
  for (std::size_t i = 0; i < is.size(); ++i) {
    if (was[i] == is[i]) {
      continue;
    }
    const schema::Part part = schema::part_at(variable, static_cast<std::uint32_t>(i));
    const auto place = schema::find_place(alone, part.name);
    if (place && i >= place->offset && i < place->offset + part.type.size()) {
      return {part, place->offset};
    }
  }
  return {{variable.name, variable.type}, 0};
}

}  // namespace

bool Comparison::open_output(const std::filesystem::path& path, const std::string& of,
                             std::int64_t real_minus_node_ns) {
  auto output = ReplayOutput::create(path, of);
  if (!output) {
    console_.error("{}", output.error().text);
    return false;
  }
  output_ = std::move(output).value();
  real_minus_node_ns_ = real_minus_node_ns;
  return true;
}

void Comparison::close_output() {
  if (auto closed = output_ ? output_->close(differing_) : Result<void, base::Problem>(); !closed) {
    console_.error("{}", closed.error().text);
    output_failed_ = true;
  }
}

void Comparison::write_output(const KnownValue& known, const std::vector<std::uint8_t>& cdr, std::int64_t end_ns) {
  if (!output_) {
    return;
  }
  if (auto written = output_->take(known.variable, declaration_of(known), cdr, end_ns + real_minus_node_ns_);
      !written) {
    console_.error("{}", written.error().text);
    output_failed_ = true;
    output_.reset();
  }
}

void Comparison::compare(ReplayedModule& module, const recorder::RunWords& run) {
  module.disturbed_runs += module.disturbed ? 1U : 0U;
  const bool faulted = module.has_faulted();
  if (faulted != run.faulted) {
    module.apart = true;
    module.apart_tick = run.tail.tick;
    ++differences_;
    if (module.keeps_own) {
      return;
    }
    console_.error("tick {}: module {} {} in the recording and {} now{}", run.tail.tick, module.state.record->name,
                   run.faulted ? "faulted" : "did not fault", faulted ? "faults" : "does not",
                   faulted ? fmt::format(": {}", module.state.record->last_fault) : "");
    return;
  }
  module.faulted_alike = module.faulted_alike || faulted;
  if (faulted) {
    return;  // its outputs were those of an incomplete run, followed by its fail-safe values
  }
  for (KnownValue& known : module.known) {
    if (known.written && known.has_value && !known.only_viewed) {
      compare(module, known, run);
    }
  }
}

const schema::Variable& Comparison::declaration_of(const KnownValue& known) const {
  return known.former != nullptr ? *known.former : variable_at(store_, known.variable);
}

// Reads the value that is compared, as the recording declares the variable: parts that this does not have in common
// with the present declaration are equal. Returns false if a part of it is no value of the recorded type.
bool Comparison::read_now(const KnownValue& known) {
  const vars::DirectoryEntry& entry = store_.directory()[known.variable];
  now_.resize(entry.value_size);
  if (!store_.read(entry, 0, now_).ok()) {
    now_ = known.bytes;
    return true;
  }
  if (known.former == nullptr) {
    return true;
  }
  const schema::Variable& variable = variable_at(store_, known.variable);
  std::vector<std::uint8_t> as_then = known.bytes;
  const bool fits = schema::carry_what_fits(variable.name, {variable.type, variable.unit}, now_,
                                            {known.former->type, known.former->unit}, as_then)
                        .empty();
  now_ = std::move(as_then);
  return fits;
}

void Comparison::compare(const ReplayedModule& module, KnownValue& known, const recorder::RunWords& run) {
  const vars::DirectoryEntry& entry = store_.directory()[known.variable];
  const schema::Variable& variable = declaration_of(known);
  if (!forced_then_.empty() && forced_then_.any(variable.name, run.tail.start_ns, run.tail.end_ns)) {
    ++forced_[variable.name];
    write_output(known, known.cdr, run.tail.end_ns);
    (void)store_.write(entry, 0, as_declared_now(store_, known.variable, known.former, known.bytes));
    return;
  }
  ++values_;
  known.ever_compared = true;
  known.compared += module.disturbed ? 0U : 1U;
  const bool fits = read_now(known);
  // Padding between the parts of a value may differ.
  const bool is_same = now_ == known.bytes || (recording::to_cdr(variable.type, now_, cdr_).ok() && cdr_ == known.cdr);
  if (fits && is_same) {
    write_output(known, known.cdr, run.tail.end_ns);
    return;
  }
  write_output(known, module.disturbed || is_same ? known.cdr : cdr_, run.tail.end_ns);
  note_difference(module, known, run.tail.tick, fits);
  if (!module.keeps_own) {
    (void)store_.write(entry, 0, known.bytes);  // the next run begins with the recorded value
  }
}

// `fits`: false: a part is no value of the recorded type, so its distance is no number.
void Comparison::note_difference(const ReplayedModule& module, KnownValue& known, std::uint64_t tick, bool fits) {
  const schema::Variable& variable = declaration_of(known);
  if (module.keeps_own) {
    const Distance now =
        fits ? distance(variable, known.bytes, now_) : Distance{std::numeric_limits<double>::infinity(), variable.name};
    known.farthest =
        known.differing + known.unclear == 0 || now.largest > known.farthest.largest ? now : known.farthest;
  }
  if (module.disturbed || module.doubtful) {
    ++known.unclear;
    ++unclear_;
    return;
  }
  if (differences_++ == 0 && !module.keeps_own) {
    console_.error("tick {}, module {}: {} was {} in the recording and is {} now", tick, module.name, variable.name,
                   schema::format_value(variable.type, known.bytes), schema::format_value(variable.type, now_));
  }
  ++differing_[variable.name];
  if (known.differing++ == 0) {
    known.first_tick = tick;
    if (!fits) {
      const schema::Variable& present = variable_at(store_, known.variable);
      now_.resize(present.type.size());
      (void)store_.read(store_.directory()[known.variable], 0, now_);
      known.first_place = variable.name;
      known.first_was = schema::format_value(variable.type, known.bytes);
      known.first_is = schema::format_value(present.type, now_);
      return;
    }
    const auto [part, offset] = first_different_part(variable, known.bytes, now_);
    known.first_place = part.name;
    known.first_was = schema::format_value(part.type, std::span(known.bytes).subspan(offset, part.type.size()));
    known.first_is = schema::format_value(part.type, std::span(now_).subspan(offset, part.type.size()));
  }
}

}  // namespace indurop::node
