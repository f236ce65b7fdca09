// SPDX-License-Identifier: Apache-2.0
#include "tools/client/scope/channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/text.h"
#include "core/schema/leaf.h"
#include "tools/client/values/variables.h"

namespace indurop::tools {
namespace {

using base::Problem;
using schema::Base;

bool is_name(std::string_view text) {
  return !text.empty() &&
         text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_:.[]") ==
             std::string_view::npos &&
         (text.front() < '0' || text.front() > '9');
}

class Planner {
 public:
  explicit Planner(const schema::Schema& schema) : schema_(schema) {}

  Result<void, Problem> channel(std::string_view whole) {
    const std::string_view text = base::trimmed(whole);
    if (is_name(text)) {
      const auto place = place_of(text);
      return place ? add_place(text, *place) : Result<void, Problem>(place.error());
    }
    if (is_glob(text) && text.find(' ') == std::string_view::npos && text.find('(') == std::string_view::npos) {
      return add_glob(text);
    }
    // Finds the first '=' that is not part of a comparison.
    const std::size_t sign = text.find_first_of("=<>!");
    const bool named = sign != std::string_view::npos && text[sign] == '=' && text.substr(sign, 2) != "==";
    return add_formula(base::trimmed(named ? text.substr(0, sign) : text),
                       base::trimmed(named ? text.substr(sign + 1) : text));
  }

  Result<void, Problem> trigger(std::string_view text) {
    auto trigger = Trigger::parse(text, [this](std::string_view name) { return operand(name); });
    if (!trigger) {
      return Problem{"trigger: " + trigger.error().text};
    }
    plan_.trigger = std::move(trigger).value();
    return {};
  }

  ScopePlan take() && { return std::move(plan_); }

 private:
  Result<schema::Place, Problem> place_of(std::string_view name) const {
    auto place = schema::find_place(schema_, name);
    if (!place) {
      return Problem{place.error().message};
    }
    return std::move(place).value();
  }

  std::size_t input(const schema::Variable& variable, std::uint32_t offset, Base base) {
    const auto index = static_cast<std::uint32_t>(&variable - schema_.variables.data());
    const auto found = std::find_if(plan_.inputs.begin(), plan_.inputs.end(), [&](const ScopeInput& one) {
      return one.variable == index && one.offset == offset && one.base == base;
    });
    if (found != plan_.inputs.end()) {
      return static_cast<std::size_t>(found - plan_.inputs.begin());
    }
    plan_.inputs.push_back({index, offset, base});
    return plan_.inputs.size() - 1;
  }

  Result<Operand, Problem> operand(std::string_view name) {
    const auto place = place_of(name);
    if (!place) {
      return place.error();
    }
    const schema::Type& type = place->type;
    if (!type.dims.empty() || type.base == Base::Struct || type.base == Base::Text) {
      return Problem{fmt::format("'{}' is {}: an expression needs a number of it", name, schema::display_name(type))};
    }
    Operand out;
    out.index = input(*place->variable, place->offset, type.base);
    out.unit = place->unit;
    if (type.base == Base::Enum) {
      const schema::Variable& variable = *place->variable;
      // The place is a local copy; the part of the schema remains valid.
      out.enumerators = enumerators_at(variable.type, place->offset);
    }
    return out;
  }

  static const std::vector<schema::Enumerator>* enumerators_at(const schema::Type& type, std::uint64_t offset) {
    const schema::Type* at = &type;
    while (at->base == Base::Struct) {
      offset %= std::max<std::uint32_t>(at->element_size, 1);
      const auto field = std::find_if(at->fields.begin(), at->fields.end(), [&](const schema::Field& one) {
        return offset >= one.offset && offset < one.offset + one.type.size();
      });
      if (field == at->fields.end()) {
        return nullptr;
      }
      offset -= field->offset;
      at = &field->type;
    }
    return &at->enumerators;
  }

  Result<void, Problem> add(ScopeChannel channel) {
    lines_ += channel.lines.size();
    if (lines_ > kMostScopeLines) {
      return Problem{fmt::format("more than {} lines; name fewer variables, or elements of them", kMostScopeLines)};
    }
    plan_.channels.push_back(std::move(channel));
    return {};
  }

  // A struct becomes a channel for each of its fields.
  Result<void, Problem> add_place(std::string_view name, const schema::Place& place) {
    if (place.type.base == Base::Struct) {
      return add_struct(name, place);
    }
    if (place.type.base == Base::Text) {
      return Problem{fmt::format("'{}' is text, which has no picture; see indurop watch", name)};
    }
    ScopeChannel channel;
    channel.name = name;
    channel.unit = place.unit;
    channel.yes_no = place.type.base == Base::Bool;
    for (const schema::Enumerator& each : place.type.enumerators) {
      if (each.value >= 0 && each.value < static_cast<std::int64_t>(kMostScopeLines)) {
        channel.words.resize(std::max(channel.words.size(), static_cast<std::size_t>(each.value) + 1));
        channel.words[static_cast<std::size_t>(each.value)] = each.name;
      }
    }
    add_elements(std::string(name), place, 0, place.offset, channel);
    return add(std::move(channel));
  }

  void add_elements(const std::string& name, const schema::Place& place, std::size_t dim, std::uint64_t offset,
                    ScopeChannel& channel) {
    if (channel.lines.size() > kMostScopeLines) {
      return;
    }
    if (dim < place.type.dims.size()) {
      for (std::uint32_t i = 0; i < place.type.dims[dim] && channel.lines.size() <= kMostScopeLines; ++i) {
        add_elements(fmt::format("{}[{}]", name, i), place, dim + 1, offset + i * schema::stride_of(place.type, dim),
                     channel);
      }
      return;
    }
    Operand operand;
    operand.index = input(*place.variable, static_cast<std::uint32_t>(offset), place.type.base);
    operand.unit = place.unit;
    channel.lines.push_back({name, Formula::of(operand)});
  }

  Result<void, Problem> add_struct(std::string_view name, const schema::Place& place) {
    const std::vector<std::uint32_t>& dims = place.type.dims;
    if (!dims.empty()) {
      for (std::uint32_t i = 0; i < dims.front(); ++i) {
        if (auto added = channel(fmt::format("{}[{}]", name, i)); !added) {
          return added;
        }
      }
      return {};
    }
    for (const schema::Field& field : place.type.fields) {
      if (field.type.base == Base::Text) {
        continue;
      }
      if (auto added = channel(fmt::format("{}.{}", name, field.name)); !added) {
        return added;
      }
    }
    return {};
  }

  Result<void, Problem> add_glob(std::string_view glob) {
    bool any = false;
    for (const schema::Variable& variable : schema_.variables) {
      if (variable.type.base == Base::Text || !schema::glob_match(glob, variable.name)) {
        continue;
      }
      any = true;
      if (auto added = channel(variable.name); !added) {
        return added;
      }
    }
    return any ? Result<void, Problem>() : Problem{fmt::format("no variable with numbers matches '{}'", glob)};
  }

  Result<void, Problem> add_formula(std::string_view name, std::string_view text) {
    auto formula = Formula::parse(text, [this](std::string_view operand_name) { return operand(operand_name); });
    if (!formula) {
      return std::move(formula).error();
    }
    ScopeChannel channel;
    channel.name = name;
    channel.unit = formula->unit();
    channel.lines.push_back({std::string(name), std::move(formula).value()});
    return add(std::move(channel));
  }

  const schema::Schema& schema_;
  ScopePlan plan_;
  std::size_t lines_ = 0;
};

}  // namespace

double number_of(const ScopeInput& input, const std::uint8_t* bytes) noexcept {
  return schema::as_number<double>(input.base, bytes + input.offset).value_or(0);
}

Result<ScopePlan, Problem> plan_scope(const schema::Schema& schema, const std::vector<std::string>& texts,
                                      std::string_view trigger) {
  Planner planner(schema);
  for (const std::string& text : texts) {
    if (auto added = planner.channel(text); !added) {
      return std::move(added).error();
    }
  }
  if (!trigger.empty()) {
    if (auto added = planner.trigger(trigger); !added) {
      return std::move(added).error();
    }
  }
  return std::move(planner).take();
}

}  // namespace indurop::tools
