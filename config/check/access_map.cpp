// SPDX-License-Identifier: Apache-2.0
#include "config/check/access_map.h"

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "config/check/io_access.h"
#include "core/schema/place_index.h"

namespace indurop::config {
namespace {

constexpr std::string_view kChannel = "_ZN7channel";
constexpr std::string_view kChannelRead = "_ZN7channel4read";
constexpr std::string_view kChannelWrite = "_ZN7channel5write";
constexpr std::string_view kChannelEither = "_ZN7channel6detail6access";

bool imports(const schema::ModuleFile& file, std::string_view prefix) {
  return std::any_of(file.imports.begin(), file.imports.end(),
                     [prefix](const std::string& name) { return name.starts_with(prefix); });
}

class Builder {
 public:
  explicit Builder(CheckContext& context) : context_(context), index_(context.result.schema) {
    for (const schema::Variable& variable : context.result.schema.variables) {
      by_hash_.emplace(variable.name_hash(), &variable);
    }
  }

  AccessMap build() {
    for (const std::size_t i : execution_order(context_.result)) {
      const Module& module = context_.config.modules[i];
      from_code(i);
      from_names(i, module.reads, module.places.reads, true);
      from_names(i, module.writes, module.places.writes, false);
      from_io(i);
      note_unknown(i);
      check_failsafe(module);
    }
    return std::move(map_);
  }

 private:
  void add(std::size_t module, const schema::Variable& variable, bool reads) {
    VariableAccess& access = map_.variables[variable.name];
    access.variable = &variable;
    auto& list = reads ? access.readers : access.writers;
    if (list.empty() || list.back() != module) {
      list.push_back(module);
    }
  }

  void from_code(std::size_t module) {
    for (const auto& [hash, access] : context_.result.facts[module].file.access) {
      const auto found = by_hash_.find(hash);
      if (found == by_hash_.end()) {
        continue;  // its description was unreadable, which has been reported
      }
      if (access.reads) {
        add(module, *found->second, true);
      }
      if (access.writes) {
        add(module, *found->second, false);
      }
    }
  }

  void from_names(std::size_t module, const std::vector<std::string>& names,
                  const std::vector<base::SourcePlace>& places, bool reads) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto place = find(names[i]);
      if (place) {
        add(module, *place.value().variable, reads);
      } else {
        context_.report.error(places[i], std::string(reads ? "<read>: " : "<write>: ") + place.error().message);
      }
    }
  }

  // Nearest names are searched for as long as errors are shown.
  [[nodiscard]] Result<schema::Place, schema::Failure> find(const std::string& name) const {
    return index_.find(name, context_.report.full() ? schema::NearestName::Skip : schema::NearestName::Search);
  }

  void from_io(std::size_t module) {
    if (!is_io_module(context_.result.facts[module].file)) {
      return;
    }
    const IoAccess access = io_access_of(context_.config.modules[module], context_);
    for (const schema::Variable* variable : access.reads) {
      add(module, *variable, true);
    }
    for (const schema::Variable* variable : access.writes) {
      add(module, *variable, false);
    }
  }

  void note_unknown(std::size_t module) {
    const schema::ModuleFile& file = context_.result.facts[module].file;
    const Module& m = context_.config.modules[module];
    if (!imports(file, kChannel) || !m.reads.empty() || !m.writes.empty()) {
      return;
    }
    const bool either = imports(file, kChannelEither);
    const bool reads = either || imports(file, kChannelRead);
    const bool writes = either || imports(file, kChannelWrite);
    if (reads) {
      map_.unknown_readers.push_back(module);
    }
    if (writes) {
      map_.unknown_writers.push_back(module);
    }
    if (reads || writes) {
      context_.report.note(m.places.file,
                           m.name +
                               (reads && writes ? " reads and writes"
                                : reads         ? " reads"
                                                : " writes") +
                               " variables by name (channel), which cannot be seen in its file; name them in "
                               "<access><read>...</read><write>...</write></access>");
    }
  }

  void check_failsafe(const Module& module) {
    for (const FailSafe& safe : module.failsafe) {
      const auto place = find(safe.variable);
      if (!place) {
        context_.report.error(safe.place, "<failsafe>: " + place.error().message);
        continue;
      }
      constexpr double kUnlimited = std::numeric_limits<double>::infinity();
      const schema::Range range = place->range.value_or(schema::Range{-kUnlimited, kUnlimited});
      std::vector<std::uint8_t> bytes(place->type.size());
      auto valid = schema::parse_value(place->type, safe.value, bytes);
      if (valid) {
        valid = schema::check_range(range, place->type, bytes);
      }
      if (!valid) {
        context_.report.error(safe.place, "<failsafe>: " + valid.error().message);
      }
    }
  }

  CheckContext& context_;
  schema::PlaceIndex index_;
  std::unordered_map<std::uint64_t, const schema::Variable*> by_hash_;
  AccessMap map_;
};

}  // namespace

std::vector<std::size_t> execution_order(const CheckResult& result) {
  std::vector<std::size_t> order;
  for (const std::uint32_t item : result.table.order) {
    order.push_back(result.periodic[item]);
  }
  if (order.empty()) {  // there is no table because the periods are wrong
    order = result.periodic;
  }
  order.insert(order.end(), result.sporadic.begin(), result.sporadic.end());
  order.insert(order.end(), result.non_real.begin(), result.non_real.end());
  return order;
}

AccessMap make_access_map(CheckContext& context) {
  return Builder(context).build();
}

}  // namespace indurop::config
