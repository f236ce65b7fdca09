// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/watch_emitter.h"

#include <fmt/format.h>

#include "control/plc/emit/cpp_text.h"
#include "control/plc/emit/expression_emitter.h"
#include "control/plc/emit/task_use.h"
#include "control/plc/emit/watch_layout.h"
#include "control/plc/library/standard.h"

namespace indurop::plc {
namespace {

std::string watched_name_of(const Pou& pou) {
  return cpp_name(std::string_view(pou.name));
}

class Emitter {
 public:
  explicit Emitter(TextWriter& out, std::string to = "out") : out_(out), to_(std::move(to)) {}

  // Same order as watch_layout().
  void pou(const Pou& pou) {
    out_.open(fmt::format("[[maybe_unused]] void show([[maybe_unused]] iec::Watch& out, [[maybe_unused]] const {}& x)",
                          watched_name_of(pou)));
    if (pou.base != nullptr) {
      out_.line(fmt::format("show(out, static_cast<const {}&>(x));", watched_name_of(*pou.base)));
    }
    std::vector<const Variable*> row;  // adjacent variables
    for (const Variable& one : pou.variables) {
      const bool fits = is_watched(one) && is_number(*one.type);
      if (!row.empty() && is_member(one) && !(fits && packed_size(*one.type) == packed_size(*row.back()->type))) {
        end(row);
      }
      if (fits) {
        row.push_back(&one);
      } else if (is_watched(one)) {
        value(name_in_x(one), *one.type);
      }
      if (one.declared->edge != ast::Edge::None) {
        end(row);  // the previous value is between them
      }
    }
    end(row);
    out_.close();
  }

  void value(const std::string& expression, const Type& type) {
    if (type.kind == Type::Kind::Array && type.element->kind > Type::Kind::Enum) {
      elements(expression, type);
    } else if (type.kind == Type::Kind::Struct) {
      for (const Field& field : type.fields) {
        value(expression + "." + field.member(), *field.type);
      }
    } else if (type.kind == Type::Kind::Block && type.pou != nullptr) {
      out_.line(fmt::format("plc::show({}, {});", to_, expression));
    } else if (type.kind == Type::Kind::Block) {
      library(expression, *type.block);
    } else {
      out_.line(fmt::format("{}.put({});", to_, expression));
    }
  }

 private:
  static std::string name_in_x(const Variable& variable) { return "x." + cpp_name(std::string_view(variable.name)); }
  static bool is_number(const Type& type) { return type.kind == Type::Kind::Elementary && !type.is_text(); }
  // Returns whether it is a member of the struct of its instance.
  static bool is_member(const Variable& variable) {
    return variable.section != ast::Section::External && variable.section != ast::Section::Temp &&
           variable.global == nullptr && !variable.is_constant && !variable.declared->is_static;
  }

  // Writes adjacent variables at once: thousands one by one would take g++ longer than the program.
  void end(std::vector<const Variable*>& row) {
    constexpr std::size_t kFew = 3;
    if (row.size() > kFew) {
      out_.line(fmt::format("{}.put_row(x, {}, {});", to_, name_in_x(*row.front()),
                            row.size() * packed_size(*row.front()->type)));
    } else {
      for (const Variable* one : row) {
        value(name_in_x(*one), *one->type);
      }
    }
    row.clear();
  }

  void elements(const std::string& expression, const Type& array) {
    std::string inner = expression;
    for (std::size_t i = 0; i < array.dimensions.size(); ++i) {
      const std::string one = fmt::format("one_{}", ++loops_);
      out_.open(fmt::format("for (const auto& {} : {})", one, inner));
      inner = one;
    }
    value(inner, *array.element);
    for (std::size_t i = 0; i < array.dimensions.size(); ++i) {
      out_.close();
    }
  }

  void library(const std::string& expression, const LibraryBlock& block) {
    for (const auto* pins : {&block.inputs, &block.outputs}) {
      for (const LibraryParameter& pin : *pins) {
        const auto* known = std::get_if<Elementary>(&pin.type);
        if (known != nullptr && !is_text(*known)) {
          out_.line(fmt::format("{}.put({}.{});", to_, expression, pin.cpp));
        }
      }
    }
  }

  TextWriter& out_;
  std::string to_;
  int loops_ = 0;
};

}  // namespace

void emit_watched(const std::vector<const Pou*>& pous, TextWriter& out) {
  for (const Pou* one : pous) {
    if (one->tree->kind == ast::Pou::Kind::Program || one->is_block()) {
      out.line();
      Emitter(out).pou(*one);
    }
  }
}

void emit_frame(const Pou& pou, DebugTable& table, TextWriter& out) {
  DebugTable::Frame frame{&pou, frame_layout(pou)};
  out.open("const auto debug_show = [&]([[maybe_unused]] iec::Watch& debug_out)");
  if (const Pou* holder = holder_of(pou)) {
    out.line(fmt::format("plc::show(debug_out, static_cast<const plc::{}&>(*this));", watched_name_of(*holder)));
  }
  Emitter emitter(out, "debug_out");
  for (const Variable* one : variables_of_call(pou)) {
    const std::string name = cpp_name(std::string_view(one->name));
    emitter.value(one->section == ast::Section::InOut && !pou.is_callable() ? "(*" + name + ")" : name, *one->type);
  }
  if (is_result_watchable(pou)) {
    emitter.value(ExpressionEmitter::result_name(pou), *pou.result);
  }
  out.close(";");
  out.line(fmt::format("const iec::DebugFrame debug_frame(debugger, {}, {}, debug_show);", table.frames.size(),
                       frame.layout.bytes));
  table.frames.push_back(std::move(frame));
}

void emit_globals(const std::vector<const Global*>& globals, DebugTable& table, TextWriter& out) {
  table.globals = globals_layout(globals);
  out.open("void debug_globals([[maybe_unused]] iec::Watch& debug_out)");
  Emitter emitter(out, "debug_out");
  for (const Global* one : globals) {
    if (is_global_watchable(*one)) {
      emitter.value((one->kind == Global::Kind::Private ? "plc::" : "shared.") + cpp_name(*one), *one->type);
    }
  }
  out.close();
  out.line();
}

void emit_watch(const TaskPlan& task, const std::string& space, TextWriter& out) {
  out.open("void watch()");
  for (const TaskProgram& one : task.programs) {
    const WatchLayout layout = watch_layout(one);
    out.line(fmt::format(
        "iec::tell<INDUROP_TYPEOF(::{}::{})::tag_type>({}U, [](iec::Watch& out) {{ plc::show(out, {}); }});", space,
        layout.variable, layout.mark, instance_of(one)));
  }
  out.close();
  out.line();
}

}  // namespace indurop::plc
