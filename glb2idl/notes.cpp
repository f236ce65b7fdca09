// SPDX-License-Identifier: Apache-2.0
// Converts annotations to values.

#include "glb2idl/notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "core/base/nearest.h"
#include "glb2idl/alarm_note.h"
#include "glb2idl/initial.h"
#include "glb2idl/text.h"

namespace indurop::glb2idl {
namespace {

struct Rule {
  std::string_view name;
  std::size_t arguments;
  bool on_fields;
  std::string_view usage;
};
constexpr std::size_t kSome = 99;  // read_alarm() checks the number itself
constexpr std::array<Rule, 9> kRules{{{"unit", 1, true, "@unit(\"mm\")"},
                                      {"range", 2, true, "@range(0, 180)"},
                                      {"desc", 1, true, "@desc(\"what it is\")"},
                                      {"retain", 0, false, "@retain"},
                                      {"view", 0, false, "@view"},
                                      {"optional", 0, false, "@optional"},
                                      {"maxage", 1, false, "@maxage(10ms)"},
                                      {"fallback", 1, false, "@fallback(0)"},
                                      {"alarm", kSome, true, "@alarm(\"what is wrong\", high, 500ms)"}}};

bool is_number(const schema::Type& type) noexcept {
  using schema::Base;
  return type.base != Base::Bool && type.base != Base::Text && type.base != Base::Enum && type.base != Base::Struct;
}

class Reader {
 public:
  Reader(Context& context, const schema::Type& type, NoteTarget target, Notes& notes)
      : context_(context), type_(type), target_(target), notes_(notes) {}

  // A declarator's own alarms replace those before all declarators.
  void begin_list() {
    seen_.clear();
    inherited_alarms_ = true;
  }

  void read(const ast::Annotation& annotation) {
    const Rule* rule = nullptr;
    std::vector<std::string> known;
    for (const Rule& one : kRules) {
      known.emplace_back(one.name);
      rule = one.name == annotation.name.text ? &one : rule;
    }
    if (rule == nullptr) {
      const std::string near = base::nearest(annotation.name.text, known);
      context_.error(annotation.at, near.empty() ? fmt::format("there is no annotation '@{}', known are @{}",
                                                               annotation.name.text, join_names(known, ", @"))
                                                 : fmt::format("there is no annotation '@{}', did you mean '@{}'?",
                                                               annotation.name.text, near));
    } else if (rule->arguments != kSome && annotation.arguments.size() != rule->arguments) {
      const auto count = rule->arguments == 0   ? std::string("no value")
                         : rule->arguments == 1 ? "one value"
                                                : "two values";
      context_.error(annotation.at, fmt::format("@{} takes {}, write {}", rule->name, count, rule->usage));
    } else if (rule->arguments != kSome && !seen_.insert(rule->name).second) {
      context_.error(annotation.at, fmt::format("@{} is given twice, remove one", rule->name));
    } else if (is_allowed(*rule, annotation)) {
      apply(*rule, annotation);
    }
  }

 private:
  bool is_allowed(const Rule& rule, const ast::Annotation& annotation) {
    const bool good =
        target_ == NoteTarget::Variable || rule.name == "desc" || (target_ == NoteTarget::Field && rule.on_fields);
    if (!good) {
      const char* where = rule.on_fields ? "a variable or a field" : "a whole variable";
      context_.error(annotation.at, fmt::format("@{} belongs to {}, remove it here", rule.name, where));
      return false;
    }
    if ((rule.name == "unit" || rule.name == "range") && !is_number(type_)) {
      context_.error(annotation.at,
                     fmt::format("@{} belongs to numbers, {} is none{}", rule.name, schema::display_name(type_),
                                 type_.base == schema::Base::Struct ? ": write it at its fields" : ", remove it"));
      return false;
    }
    return true;
  }

  void apply(const Rule& rule, const ast::Annotation& annotation) {
    if (rule.name == "unit") {
      read_text(annotation.arguments[0], notes_.unit);
    } else if (rule.name == "desc") {
      read_text(annotation.arguments[0], notes_.description);
    } else if (rule.name == "range") {
      read_range(annotation);
    } else if (rule.name == "retain") {
      notes_.retain = true;
    } else if (rule.name == "view") {
      notes_.view = true;
    } else if (rule.name == "optional") {
      notes_.optional = true;
    } else if (rule.name == "alarm") {
      if (std::exchange(inherited_alarms_, false)) {
        notes_.alarms.clear();
      }
      if (auto alarm = read_alarm(context_, annotation, type_)) {
        add_alarm(annotation, std::move(*alarm));
      }
    } else if (rule.name == "fallback") {
      notes_.fallback = &annotation.arguments[0];
    } else if (!annotation.arguments[0].value) {
      context_.error(annotation.at, "expected a time, write @maxage(10ms)");
    } else {
      notes_.maxage_ns = read_duration(context_, *annotation.arguments[0].value, "@maxage").value_or(0);
    }
  }

  void add_alarm(const ast::Annotation& annotation, schema::Alarm alarm) {
    const bool twice = std::any_of(notes_.alarms.begin(), notes_.alarms.end(), [&](const schema::Alarm& one) {
      return one.comparison == alarm.comparison && one.limit == alarm.limit;
    });
    if (twice) {
      context_.error(annotation.at, "there is an alarm of this condition already, remove one");
    } else {
      notes_.alarms.push_back(std::move(alarm));
    }
  }

  void read_text(const ast::Initializer& from, std::string& to) {
    const auto value = from.value ? context_.evaluate(*from.value) : std::nullopt;
    if (value && value->kind == Value::Kind::Text) {
      to = comment_line(value->text);
    } else if (value || !from.value) {
      context_.error(from.at, "expected a text in quotes");
    }
  }

  void read_range(const ast::Annotation& annotation) {
    std::array<double, 2> ends{};
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const ast::Initializer& from = annotation.arguments[i];
      auto value = from.value ? context_.evaluate(*from.value) : std::nullopt;
      if (!value) {
        if (!from.value) {
          context_.error(from.at, "expected a number, write @range(0, 180)");
        }
        return;
      }
      schema::Type element;
      element.base = type_.base;
      if (const auto why = convert(*value, element)) {
        context_.error(from.at, *why);
        return;
      }
      ends[i] = value->as_double();
    }
    if (ends[0] > ends[1]) {
      context_.error(annotation.at, "the smaller end of a range comes first, exchange the two");
      return;
    }
    notes_.range = schema::Range{ends[0], ends[1]};
  }

  Context& context_;
  const schema::Type& type_;
  NoteTarget target_;
  Notes& notes_;
  std::set<std::string_view> seen_;
  bool inherited_alarms_ = true;  // alarms before all declarators are replaced by the first own one
};

}  // namespace

Notes read_notes(Context& context, const std::vector<ast::Annotation>& leading, const std::vector<ast::Annotation>& own,
                 const schema::Type& type, NoteTarget target, std::string comment) {
  Notes notes;
  notes.description = std::move(comment);
  Reader reader(context, type, target, notes);
  for (const auto* list : {&leading, &own}) {
    reader.begin_list();
    for (const ast::Annotation& annotation : *list) {
      reader.read(annotation);
    }
  }
  return notes;
}

std::optional<std::int64_t> read_duration(Context& context, const ast::Expression& expression, std::string_view what) {
  const auto value = context.evaluate(expression);
  if (!value) {
    return std::nullopt;
  }
  if (value->kind != Value::Kind::Duration) {
    context.error(expression.at, fmt::format("{} needs a time with its unit: ns, us, ms or s, such as 10ms", what));
    return std::nullopt;
  }
  if (value->integer <= 0) {
    context.error(expression.at, fmt::format("{} must be longer than 0, such as 10ms, or left out", what));
    return std::nullopt;
  }
  return static_cast<std::int64_t>(value->integer);
}

}  // namespace indurop::glb2idl
