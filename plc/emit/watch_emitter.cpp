// SPDX-License-Identifier: Apache-2.0
#include "plc/emit/watch_emitter.h"

#include <fmt/format.h>

#include "plc/emit/cpp_text.h"
#include "plc/emit/expression_emitter.h"
#include "plc/emit/task_use.h"
#include "plc/emit/watch_layout.h"
#include "plc/library/standard.h"

namespace indurop::plc {
namespace {

std::string name_of(const Pou& pou) {
  return cpp_name(std::string_view(pou.name));
}

class Emitter {
 public:
  explicit Emitter(TextWriter& out, std::string to = "out") : out_(out), to_(std::move(to)) {}

  // In the order of watch_layout().
  void pou(const Pou& pou) {
    out_.open(fmt::format("[[maybe_unused]] void show([[maybe_unused]] iec::Watch& out, [[maybe_unused]] const {}& x)",
                          name_of(pou)));
    if (pou.base != nullptr) {
      out_.line(fmt::format("show(out, static_cast<const {}&>(x));", name_of(*pou.base)));
    }
    for (const Variable& one : pou.variables) {
      if (is_watched(one)) {
        value("x." + cpp_name(std::string_view(one.name)), *one.type);
      }
    }
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
        if (known != nullptr && *known != Elementary::String) {
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
    out.line(fmt::format("plc::show(debug_out, static_cast<const plc::{}&>(*this));", name_of(*holder)));
  }
  Emitter emitter(out, "debug_out");
  for (const Variable* one : variables_of_call(pou)) {
    const std::string name = cpp_name(std::string_view(one->name));
    emitter.value(one->section == ast::Section::InOut && !pou.is_callable() ? "(*" + name + ")" : name, *one->type);
  }
  if (is_result_told(pou)) {
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
    if (is_global_told(*one)) {
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
    out.open("");
    out.line(fmt::format("static std::array<std::uint8_t, {}> bytes{{}};", layout.bytes));
    out.line("iec::Watch out(bytes.data());");
    out.line(fmt::format("out.put(std::uint64_t{{{}U}});", layout.mark));
    out.line(fmt::format("plc::show(out, {});", instance_of(one)));
    out.line(fmt::format("::{}::{} = bytes;", space, layout.variable));
    out.close();
  }
  out.close();
  out.line();
}

}  // namespace indurop::plc
