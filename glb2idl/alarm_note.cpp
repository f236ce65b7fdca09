// SPDX-License-Identifier: Apache-2.0
#include "glb2idl/alarm_note.h"

#include <fmt/format.h>

#include <cstddef>
#include <span>
#include <utility>

#include "glb2idl/initial.h"
#include "glb2idl/notes.h"
#include "glb2idl/text.h"

namespace indurop::glb2idl {
namespace {

constexpr const char* kUsage =
    "write @alarm(\"what is wrong\", high, 500ms) or @alarm(value > 80, \"too hot\", high, 2s)";

std::optional<schema::Comparison> comparison_of(const ast::Expression& condition) {
  if (condition.kind != ast::Expression::Kind::Binary || condition.operands.size() != 2) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i <= static_cast<std::size_t>(schema::Comparison::GreaterEqual); ++i) {
    const auto one = static_cast<schema::Comparison>(i);
    if (condition.spelling == schema::symbol_of(one)) {
      return one;
    }
  }
  return std::nullopt;
}

bool is_word(const ast::Expression& expression) {
  return expression.kind == ast::Expression::Kind::Path && expression.path.parts.size() == 1;
}

bool is_limit(schema::Comparison comparison) {
  return comparison != schema::Comparison::Equal && comparison != schema::Comparison::NotEqual;
}

class AlarmReader {
 public:
  AlarmReader(Context& context, const schema::Type& type) : context_(context), element_(type) { element_.dims.clear(); }

  std::optional<schema::Alarm> read(const ast::Annotation& annotation) {
    std::span<const ast::Initializer> rest(annotation.arguments);
    for (const ast::Initializer& one : rest) {
      if (!one.value) {
        return fail(one.at, fmt::format("expected one value, {}", kUsage));
      }
    }
    if (element_.base == schema::Base::Struct || element_.base == schema::Base::Text) {
      return fail(annotation.at, fmt::format("@alarm belongs to a bool, a number or an enum, {} is none{}",
                                             schema::display_name(element_),
                                             element_.base == schema::Base::Struct ? ": write it at its fields" : ""));
    }
    if (!rest.empty() && rest[0].value->kind == ast::Expression::Kind::Binary) {
      if (!read_condition(*rest[0].value)) {
        return std::nullopt;
      }
      rest = rest.subspan(1);
    } else if (element_.base != schema::Base::Bool) {
      return fail(annotation.at, "an alarm of a number needs a condition, write @alarm(value > 80, \"too hot\", high)");
    }
    if (rest.empty() || !read_text(*rest[0].value)) {
      return rest.empty() ? fail(annotation.at, fmt::format("the alarm's text is missing, {}", kUsage)) : std::nullopt;
    }
    return read_options(rest.subspan(1)) ? std::optional(std::move(alarm_)) : std::nullopt;
  }

 private:
  std::optional<schema::Alarm> fail(Span at, std::string text) {
    context_.error(at, std::move(text));
    return std::nullopt;
  }

  bool read_condition(const ast::Expression& condition) {
    const auto comparison = comparison_of(condition);
    if (!comparison || !is_word(condition.operands[0]) || condition.operands[0].path.parts[0] != "value") {
      context_.error(condition.at, "a condition compares the value with a constant, such as value > 80");
      return false;
    }
    if (is_limit(*comparison) && (element_.base == schema::Base::Bool || element_.base == schema::Base::Enum)) {
      context_.error(condition.at, fmt::format("{} is compared with == or !=", schema::display_name(element_)));
      return false;
    }
    auto limit = context_.evaluate(condition.operands[1]);
    if (!limit) {
      return false;
    }
    if (const auto why = convert(*limit, element_)) {
      context_.error(condition.operands[1].at, *why);
      return false;
    }
    alarm_.comparison = *comparison;
    alarm_.limit = limit->as_double();
    return true;
  }

  bool read_text(const ast::Expression& expression) {
    const auto text = context_.evaluate(expression);
    if (text && (text->kind != Value::Kind::Text || text->text.empty())) {
      context_.error(expression.at, fmt::format("expected the alarm's text in quotes, {}", kUsage));
      return false;
    }
    alarm_.text = text ? comment_line(text->text) : std::string();
    return text.has_value();
  }

  // Reads priority, delay and deadband in this order; each may be left out.
  bool read_options(std::span<const ast::Initializer> rest) {
    int last = 0;
    for (const ast::Initializer& one : rest) {
      const int order = read_option(*one.value);
      if (order == 0) {
        return false;
      }
      if (order <= last) {
        context_.error(one.at, "after the text come priority, delay and deadband, in this order, each once");
        return false;
      }
      last = order;
    }
    return true;
  }

  // Returns 1 for a priority, 2 for a delay, 3 for a deadband, 0 after a message.
  int read_option(const ast::Expression& expression) {
    if (is_word(expression)) {
      if (const auto priority = schema::priority_of(expression.path.parts[0])) {
        alarm_.priority = *priority;
        return 1;
      }
    }
    const auto value = context_.evaluate(expression);
    if (!value) {
      return 0;
    }
    if (value->kind == Value::Kind::Duration) {
      const auto delay = read_duration(context_, expression, "a delay");
      alarm_.delay_ns = delay.value_or(0);
      return delay ? 2 : 0;
    }
    if (!value->is_number() || value->kind == Value::Kind::Bool) {
      context_.error(expression.at, "a priority is critical, high, medium or low");
      return 0;
    }
    if (!is_limit(alarm_.comparison) || value->as_double() < 0) {
      context_.error(expression.at, "a deadband is a number of at least 0, of an alarm with a limit: value > 80");
      return 0;
    }
    alarm_.deadband = value->as_double();
    return 3;
  }

  Context& context_;
  schema::Type element_;
  schema::Alarm alarm_;
};

}  // namespace

std::optional<schema::Alarm> read_alarm(Context& context, const ast::Annotation& annotation, const schema::Type& type) {
  return AlarmReader(context, type).read(annotation);
}

}  // namespace indurop::glb2idl
