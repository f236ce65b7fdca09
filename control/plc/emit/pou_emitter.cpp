// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/pou_emitter.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "control/plc/emit/body_parts.h"
#include "control/plc/emit/cpp_text.h"
#include "control/plc/emit/object_emitter.h"
#include "control/plc/emit/statement_emitter.h"
#include "control/plc/emit/watch_emitter.h"

namespace indurop::plc {
namespace {

using ast::Section;

const ast::Initial* initial_of(const Variable& variable) noexcept {
  return variable.declared->initial ? &*variable.declared->initial : nullptr;
}

std::string name_of(const Variable& variable) {
  return cpp_name(std::string_view(variable.name));
}

// Returns "Type name = value;".
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
    if (one.section == Section::InOut && one.type->open) {
      out.line(fmt::format("{} {};{}", cpp_type(*one.type), name_of(one), comment));
    } else if (one.section == Section::InOut) {
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

// Emits locals of the call: VAR_TEMP, and inputs of which only the edge is used.
void locals(const Pou& pou, const BodyParts& parts, TextWriter& out) {
  for (const Variable& one : pou.variables) {
    if (one.section == Section::Temp && !parts.is_local(one)) {
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

std::string cpp_name_of(const Pou& pou) {
  return cpp_name(std::string_view(pou.name));
}

// Emits the lifetime of the call, for pointers to its variables.
void lifetime(const Pou& pou, TextWriter& out) {
  if (pou.points_to_own) {
    out.line("const iec::Lifetime lifetime;");
  }
}

void declare_block(const Pou& pou, TextWriter& out) {
  out.open("struct " + cpp_name_of(pou) + extends(pou));
  members(pou, out);
  declare_methods(pou, out);
  if (pou.tree->kind != ast::Pou::Kind::Class) {
    out.line(fmt::format("void operator()(const iec::Scan& scan){};", pou.is_object ? " override" : ""));
  }
  out.close(";");
}

bool has_lines(const ast::Body& body) {
  return std::any_of(body.begin(), body.end(),
                     [](const ast::Statement& one) { return StatementEmitter::is_line(one); });
}

// Emits the statements, starting where all variables are known.
void code(const Pou& pou, const BodyParts& parts, TextWriter& out, const Probes& probes) {
  if (probes.debug != nullptr) {
    emit_frame(pou, *probes.debug, out);
    if (pou.tree->kind == ast::Pou::Kind::Program && !has_lines(pou.tree->body)) {
      // A debugger can stop in an empty program, too: if a scan had no line, it would wait forever.
      out.line(fmt::format("debugger.line({});", probes.debug->lines.size()));
      probes.debug->lines.push_back({pou.tree->at, &pou});
    }
  }
  StatementEmitter statements(pou, out, probes);
  for (const BodyParts::Part& part : parts.parts()) {
    if (part.alone) {
      out.open("[&]() __attribute__((noinline))");
    }
    for (const Variable* one : part.locals) {
      out.line("[[maybe_unused]] " + declaration(*one));
    }
    statements.list(std::span(pou.tree->body).subspan(part.begin, part.end - part.begin));
    if (part.alone) {
      out.close("();");
    }
  }
}

void define_block(const Pou& pou, TextWriter& out, const Probes& probes) {
  const BodyParts parts(pou, probes.debug == nullptr);
  out.open(fmt::format("inline void {}::operator()([[maybe_unused]] const iec::Scan& scan)", cpp_name_of(pou)));
  lifetime(pou, out);
  locals(pou, parts, out);
  code(pou, parts, out, probes);
  out.close();
}

// Returns "plc::Color Motor::method_PAINT(std::int16_t x)".
std::string head(const Pou& pou) {
  const std::string name = pou.owner == nullptr ? cpp_name_of(pou) : cpp_name_of(*pou.owner) + "::" + method_name(pou);
  return fmt::format("{} {}({})", pou.result != nullptr ? cpp_type(*pou.result) : "void", name, parameters(pou));
}

// Emits functions and methods: their variables are those of the call.
void define_callable(const Pou& pou, TextWriter& out, const Probes& probes) {
  out.open((pou.owner != nullptr ? "inline " : "") + head(pou));
  if (pou.called_unseen) {
    out.line(fmt::format("const iec::Call guard_call(calls_inside, {});", cpp_place(pou.tree->at, pou.title())));
  }
  lifetime(pou, out);
  if (pou.calls_blocks) {
    out.line("const iec::Scan scan{irp::release_ns()};");
  }
  if (pou.result != nullptr) {
    const std::string value = cpp_initial(*pou.result, nullptr);
    out.line(fmt::format("{} {}{};", cpp_type(*pou.result), ExpressionEmitter::result_name(pou),
                         value == "{}" ? value : " = " + value));
  }
  for (const Variable& one : pou.variables) {
    if (one.section == Section::Output) {
      const std::string value = cpp_initial(*one.type, initial_of(one));
      out.line(fmt::format("{} = {};", name_of(one), value));
    } else if (is_own(one) && !one.declared->of_instance &&
               (one.section == Section::Local || one.section == Section::Temp)) {
      out.line(std::string("[[maybe_unused]] ") + (one.declared->is_static ? "static " : "") +
               (one.is_constant ? "const " : "") + declaration(one));
    }
  }
  code(pou, BodyParts(pou, false), out,
       pou.name.starts_with('@') ? Probes{} : probes);  // it is not in any line of the user
  if (pou.result != nullptr) {
    out.line(fmt::format("return {};", ExpressionEmitter::result_name(pou)));
  }
  out.close();
}

}  // namespace

void declare_pou(const Pou& pou, TextWriter& out) {
  if (pou.tree->kind == ast::Pou::Kind::Function) {
    out.line(fmt::format("[[maybe_unused]] {};", head(pou)));
  } else if (pou.tree->kind == ast::Pou::Kind::Interface) {
    emit_interface(pou, out);
  } else if (!pou.is_callable()) {
    declare_block(pou, out);
  }
}

void define_pou(const Pou& pou, TextWriter& out, const Probes& probes) {
  const bool inside = pou.owner != nullptr && pou.owner->tree->kind == ast::Pou::Kind::Interface;
  const bool has_body = !pou.tree->is_abstract && !inside;
  if (pou.is_callable()) {
    if (has_body) {
      out.line();
      define_callable(pou, out, probes);
    }
  } else if (pou.tree->kind != ast::Pou::Kind::Interface && pou.tree->kind != ast::Pou::Kind::Class) {
    out.line();
    define_block(pou, out, probes);
  }
}

}  // namespace indurop::plc
