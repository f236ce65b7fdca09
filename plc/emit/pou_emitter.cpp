// SPDX-License-Identifier: Apache-2.0
#include "plc/emit/pou_emitter.h"

#include <fmt/format.h>

#include "plc/emit/cpp_text.h"
#include "plc/emit/statement_emitter.h"

namespace indurop::plc {
namespace {

using ast::Section;

const ast::Initial* initial_of(const Variable& variable) noexcept {
  return variable.declared->initial ? &*variable.declared->initial : nullptr;
}

std::string name_of(const Variable& variable) {
  return cpp_name(std::string_view(variable.name));
}

// "Type name = value;"
std::string declaration(const Variable& variable) {
  const std::string value = cpp_initial(*variable.type, initial_of(variable));
  return value == "{}" ? fmt::format("{} {}{{}};", cpp_type(*variable.type), name_of(variable))
                       : fmt::format("{} {} = {};", cpp_type(*variable.type), name_of(variable), value);
}

bool is_own(const Variable& variable) noexcept {
  return variable.section != Section::External && variable.global == nullptr;
}

void members(const Pou& pou, TextWriter& out) {
  for (const Variable& one : pou.variables) {
    if (!is_own(one) || one.section == Section::Temp) {
      continue;
    }
    const std::string comment =
        one.declared->comment.empty() ? std::string() : "  // " + comment_text(one.declared->comment);
    if (one.section == Section::InOut) {
      out.line(fmt::format("{}* {} = nullptr;{}", cpp_type(*one.type), name_of(one), comment));
    } else if (one.is_constant && one.section == Section::Local) {
      out.line("static inline const " + declaration(one) + comment);
    } else if (one.declared->is_static) {
      out.line("static inline " + declaration(one) + comment);
    } else {
      out.line(declaration(one) + comment);
    }
    if (one.declared->edge != ast::Edge::None) {
      out.line(fmt::format("bool {}_before = {};", name_of(one),
                           one.declared->edge == ast::Edge::Rising ? "false" : "true"));
    }
  }
}

// Locals of the call: VAR_TEMP, and inputs of which only the edge counts.
void locals(const Pou& pou, TextWriter& out) {
  for (const Variable& one : pou.variables) {
    if (one.section == Section::Temp) {
      out.line("[[maybe_unused]] " + declaration(one));
    }
    if (one.declared->edge != ast::Edge::None) {
      const bool rising = one.declared->edge == ast::Edge::Rising;
      out.line(fmt::format("[[maybe_unused]] const bool {0}_edge = {1}{0} && {2}{0}_before;", name_of(one),
                           rising ? "" : "!", rising ? "!" : ""));
      out.line(fmt::format("{0}_before = {0};", name_of(one)));
    }
  }
}

void emit_block(const Pou& pou, TextWriter& out) {
  out.open(fmt::format("struct {}", cpp_name(std::string_view(pou.name))));
  members(pou, out);
  out.line();
  out.open("void operator()([[maybe_unused]] const iec::Scan& scan)");
  locals(pou, out);
  StatementEmitter(pou, out).list(pou.tree->body);
  out.close();
  out.close(";");
}

void emit_function(const Pou& pou, TextWriter& out) {
  std::string parameters;
  for (const Variable& one : pou.variables) {
    const bool by_value = one.section == Section::Input;
    if (by_value || one.section == Section::InOut || one.section == Section::Output) {
      parameters += fmt::format("{}[[maybe_unused]] {}{} {}", parameters.empty() ? "" : ", ", cpp_type(*one.type),
                                by_value ? "" : "&", name_of(one));
    }
  }
  out.open(fmt::format("[[maybe_unused]] {} {}({})", pou.result != nullptr ? cpp_type(*pou.result) : "void",
                       cpp_name(std::string_view(pou.name)), parameters));
  if (pou.result != nullptr) {
    const std::string value = cpp_initial(*pou.result, nullptr);
    out.line(fmt::format("{} {}{};", cpp_type(*pou.result), ExpressionEmitter::result_name(pou),
                         value == "{}" ? value : " = " + value));
  }
  for (const Variable& one : pou.variables) {
    if (one.section == Section::Output) {
      out.line(fmt::format("{} = {};", name_of(one), cpp_initial(*one.type, initial_of(one))));
    } else if (is_own(one) && (one.section == Section::Local || one.section == Section::Temp)) {
      out.line(std::string("[[maybe_unused]] ") + (one.declared->is_static ? "static " : "") +
               (one.is_constant ? "const " : "") + declaration(one));
    }
  }
  StatementEmitter(pou, out).list(pou.tree->body);
  if (pou.result != nullptr) {
    out.line(fmt::format("return {};", ExpressionEmitter::result_name(pou)));
  }
  out.close();
}

}  // namespace

void emit_pou(const Pou& pou, TextWriter& out) {
  if (pou.tree->kind == ast::Pou::Kind::Function) {
    emit_function(pou, out);
  } else {
    emit_block(pou, out);
  }
}

}  // namespace indurop::plc
