// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/module_emitter.h"

#include <fmt/format.h>

#include <indurop/detail/abi.h>

#include <algorithm>

#include "control/plc/check/starts.h"
#include "control/plc/emit/access_emitter.h"
#include "control/plc/emit/cpp_text.h"
#include "control/plc/emit/exchange_emitter.h"
#include "control/plc/emit/kept_emitter.h"
#include "control/plc/emit/object_emitter.h"
#include "control/plc/emit/pou_emitter.h"
#include "control/plc/emit/task_use.h"
#include "control/plc/emit/text_writer.h"
#include "control/plc/emit/watch_emitter.h"

namespace indurop::plc {
namespace {

class ModuleEmitter {
 public:
  ModuleEmitter(const Program& program, const TaskPlan& task, const ModuleOptions& options)
      : program_(program), task_(task), options_(options), use_(use_of(program, task, options.show_locals)) {
    for (const Global& global : program.globals) {  // in text order
      if (use_.globals.contains(&global)) {
        globals_.push_back(&global);
      }
    }
    find_start();
  }

  std::string run() {
    out_.line("// Written by indurop plc from " + comment_text(options_.sources) + ": change that, not this.");
    if (program_.types.has_aliases()) {
      out_.line("#pragma GCC optimize(\"no-strict-aliasing\")  // pointers lead to values of other types");
    }
    includes();
    out_.line("namespace {");
    out_.line("namespace iec = indurop::iec;");
    out_.line();
    types();
    image();
    if (options_.probes.coverage != nullptr) {
      out_.line("extern iec::Coverage plc_coverage;");
    }
    out_.line("namespace plc {");
    private_globals(Global::Kind::Fixed);
    for (const Pou* pou : use_.pous) {
      declare_pou(*pou, out_);
    }
    private_globals(Global::Kind::Private);
    if (std::any_of(use_.pous.begin(), use_.pous.end(), [](const Pou* one) { return one->called_unseen; })) {
      out_.line("int calls_inside = 0;  // of methods, where a call may lead to itself");
    }
    if (options_.watch || options_.probes.debug != nullptr) {
      emit_watched(use_.pous, out_);
    }
    if (options_.probes.debug != nullptr) {
      out_.line("extern iec::Debugger debugger;");
    }
    for (const Pou* pou : use_.pous) {
      define_pou(*pou, out_, options_.probes);
    }
    out_.line("}  // namespace plc");
    out_.line();
    instances();
    if (options_.watch) {
      emit_watch(task_, program_.space, out_);
    }
    debugger();
    coverage();
    emit_exchange(use_, globals_, out_);
    define_start();
    scan();
    out_.line("}  // namespace");
    out_.line();
    entry();
    return out_.text();
  }

 private:
  void includes() {
    out_.line("#include <indurop/indurop.h>");
    out_.line("#include <indurop/plc/keep.h>");
    out_.line("#include <indurop/plc/library.h>");
    out_.line("#include <indurop/plc/program.h>");
    if (options_.watch) {
      out_.line("#include <indurop/plc/watch.h>");
    }
    if (options_.probes.debug != nullptr) {
      out_.line("#include <indurop/plc/debug.h>");
    }
    if (options_.probes.coverage != nullptr) {
      out_.line("#include <indurop/plc/coverage.h>");
    }
    out_.line("#define INDUROP_LEAF ::indurop::iec::SharedNumber");
    out_.line("#include <indurop/generated.h>");
    out_.line();
    out_.line("#include <array>");
    out_.line("#include <cstdint>");
    out_.line("#include <limits>");
    out_.line();
  }

  // Declares targets of pointers in advance; they may be defined later.
  void announce() {
    for (const Type* type : program_.named_types) {
      if (type->shared_name.empty() && type->kind == Type::Kind::Struct) {
        out_.line(fmt::format("struct {};", cpp_name(std::string_view(type->name))));
      }
    }
    for (const Pou& pou : program_.pous) {
      if (pou.type != nullptr) {
        out_.line(fmt::format("struct {};", cpp_name(std::string_view(pou.name))));
      }
    }
  }

  void types() {
    out_.line("namespace plc {");
    if (program_.types.has_pointers() || program_.has_objects) {
      announce();
    }
    for (const Type* type : program_.named_types) {
      if (!type->shared_name.empty()) {
        continue;
      }
      const std::string name = cpp_name(std::string_view(type->name));
      if (type->kind == Type::Kind::Enum) {
        out_.open(fmt::format("enum class {} : {}", name, cpp_type(of(type->elementary))));
        for (const EnumItem& item : type->items) {
          out_.line(fmt::format("{} = {},", cpp_name(std::string_view(item.name)), item.value));
        }
        out_.close(";");
      } else if (type->kind == Type::Kind::Struct) {
        structure(*type, name);
      }
    }
    out_.line("}  // namespace plc");
    out_.line();
  }

  const Type& of(Elementary type) const { return *program_.types.elementary(type); }

  // copy_fields() supports every struct that has the same field names.
  void structure(const Type& type, const std::string& name) {
    if (type.overlaps) {
      std::string parts;
      for (const Field& field : type.fields) {
        parts += (parts.empty() ? "" : ", ") + cpp_type(*field.type);
      }
      out_.line(fmt::format("struct {} : iec::Overlap<{}> {{}};", name, parts));
      return;
    }
    out_.open("struct " + name);
    std::string fields;
    for (const Field& field : type.fields) {
      const std::string& member = field.member();
      out_.line(fmt::format("{} {}{{}};", cpp_type(*field.type), member));
      fields += fmt::format(" iec::copy_value(to.{0}, from.{0});", member);
    }
    out_.line(fmt::format("friend bool operator==(const {0}&, const {0}&) = default;", name));
    out_.close(";");
    out_.line(fmt::format("template <class From> void copy_fields({}& to, const From& from) {{{} }}", name, fields));
    out_.line(fmt::format("template <class To> void copy_fields(To& to, const {}& from) {{{} }}", name, fields));
  }

  void image() {
    const bool any = std::any_of(globals_.begin(), globals_.end(), [](const Global* one) { return in_image(*one); });
    if (any) {
      out_.line("// What the program sees of the shared variables during a scan.");
      out_.open("struct Image");
      for (const Global* global : globals_) {
        if (in_image(*global)) {
          out_.line(fmt::format("{} {}{{}};", cpp_type(*global->type), cpp_name(*global)));
        }
      }
      out_.close(";");
      out_.line("Image shared;");
      out_.line("Image before;");
      out_.line();
    }
  }

  void private_globals(Global::Kind kind) {
    for (const Global* global : globals_) {
      if (global->kind == kind) {
        out_.line(fmt::format("{}{} {} = {};", global->kind == Global::Kind::Fixed ? "[[maybe_unused]] const " : "",
                              cpp_type(*global->type), cpp_name(*global), cpp_initial(*global->type, global->initial)));
      }
    }
  }

  void instances() {
    for (const TaskProgram& one : task_.programs) {
      if (one.pou->instance == nullptr) {
        out_.line(fmt::format("plc::{} {};", cpp_name(std::string_view(one.pou->name)), instance_of(one)));
      }
    }
    for (const SharedLocal& one : use_.locals) {
      if (!one.input && !is_copied_by_table(*one.type)) {
        out_.line(fmt::format("{} before_{}{{}};", cpp_type(*one.type), one.name));
      }
    }
    out_.line();
  }

  void debugger() {
    if (options_.probes.debug == nullptr) {
      return;
    }
    DebugTable& table = *options_.probes.debug;
    emit_globals(globals_, table, out_);
    std::string text;
    for (const DebugTable::Line& one : table.lines) {
      text += to_string(one.at) + one.pou->title() + "\n";
    }
    for (const DebugTable::Frame& one : table.frames) {
      for (const WatchedVariable& variable : one.layout.variables) {
        text += variable.path + to_string(*variable.type) + "\n";
      }
    }
    table.mark = abi::fnv1a64(text.data(), text.size());
    out_.line(fmt::format("iec::Debugger plc::debugger{{{}, {}U}};", quote(options_.name), table.mark));
    out_.line();
  }

  void coverage() {
    if (options_.probes.coverage == nullptr) {
      return;
    }
    const CoverageTable& table = *options_.probes.coverage;
    const std::string text = to_text(table);
    out_.line("constexpr char coverage_text[] =");
    for (std::size_t from = 0; from < text.size();) {
      const std::size_t end = text.find('\n', from) + 1;
      out_.line("    " + quote(text.substr(from, end - from)));
      from = end;
    }
    out_.line(
        fmt::format("    \"\";\niec::Coverage plc_coverage{{{}, {}, {{coverage_text, sizeof coverage_text - 1}}}};",
                    quote(options_.name), table.counters));
    out_.line();
  }

  // Collects what runs before the first scan: the start of globals, then that of programs.
  void find_start() {
    const auto program = [&](const Pou& pou, const std::string& instance) {
      if (const Pou* method = find_method(pou, kStart)) {
        start_.push_back(instance + "." + method_name(*method) + "();");
      }
    };
    for (const Global* global : globals_) {
      if (const auto function = program_.starts.find(global); function != program_.starts.end()) {
        start_.push_back("plc::" + cpp_name(std::string_view(function->second->name)) + "();");
      }
      const Pou* pou = global->kind == Global::Kind::Private ? global->type->pou : nullptr;
      const bool runs = std::any_of(task_.programs.begin(), task_.programs.end(),
                                    [&](const TaskProgram& one) { return one.pou->instance == global; });
      if (pou != nullptr && pou->tree->kind == ast::Pou::Kind::Program && !runs) {
        program(*pou, "plc::" + cpp_name(*global));
      }
    }
    for (const TaskProgram& one : task_.programs) {
      program(*one.pou, instance_of(one));
    }
  }

  void define_start() {
    if (start_.empty()) {
      return;
    }
    out_.line("// Before the first scan: FB_Init, and initial values that are computed.");
    out_.line("bool start_done = false;");
    out_.open("void start()");
    out_.line("if (start_done) { return; }");
    out_.line("start_done = true;");
    own_.emplace_back("start_done");
    for (const std::string& one : start_) {
      out_.line(one);
    }
    out_.close();
    out_.line();
  }

  [[nodiscard]] bool is_gated() const noexcept { return task_.single != nullptr && task_.periodic; }

  void run_programs() {
    const bool debug = options_.probes.debug != nullptr;
    if (debug) {
      out_.open("try");
    }
    const bool gated = is_gated();
    if (gated) {
      out_.line(fmt::format("const bool single = shared.{0} != 0;", cpp_name(*task_.single)));
      out_.line("const bool runs = !single || !single_before;  // periodic while SINGLE is FALSE, once when it rises");
      out_.line("single_before = single;");
      out_.open("if (runs)");
    }
    for (const TaskProgram& one : task_.programs) {
      call_program(program_, task_, one, out_);
    }
    if (gated) {
      out_.close();
    }
    if (debug) {
      out_.reopen("catch (const std::exception& fault)");
      out_.line("plc::debugger.fault(fault.what());");
      out_.line("throw;");
      out_.close();
    }
  }

  // Written outside of the namespaces of shared variables, one of which may be named plc.
  void scan() {
    if (is_gated()) {
      out_.line("bool single_before = false;");
      own_.emplace_back("single_before");
    }
    out_.line("// One scan: all variables it sees are from its beginning, what it changed is there at its end.");
    out_.open("void one_scan()");
    out_.line("const iec::Scan scan{irp::release_ns()};");
    out_.line("read_shared();");
    if (!use_.restored.empty()) {
      out_.line("restore(scan);");
    }
    if (options_.probes.debug != nullptr) {
      out_.line(
          fmt::format("plc::debugger.begin(scan.time_ns, {}, &debug_globals);", options_.probes.debug->globals.bytes));
    }
    if (!start_.empty()) {
      out_.line("start();");
    }
    run_programs();
    out_.line("write_shared();");
    if (options_.watch) {
      out_.line("watch();");
    }
    out_.close();
  }

  void entry() {
    out_.line("void POU_PROGRAM() { one_scan(); }");
    out_.line("void run() { POU_PROGRAM(); }");
    out_.line();
    if (!task_.periodic) {
      condition();
    }
    if (!use_.restored.empty()) {
      own_.emplace_back("restore_done");
    }
    emit_kept(task_, use_, globals_, own_, out_);
    out_.line(fmt::format("INDUROP_MODULE(run = &::run, {}name = {})",
                          task_.periodic ? "" : "condition = &::condition, ", quote(options_.name)));
  }

  void condition() {
    out_.line("// SINGLE: the event is its rising edge.");
    out_.line("static bool event_before = false;");
    own_.emplace_back("event_before");
    out_.open("bool condition()");
    out_.line(fmt::format("const bool now = {}.get() != 0;", proxy_of(*task_.single)));
    out_.line("const bool rises = now && !event_before;");
    out_.line("event_before = now;");
    out_.line("return rises;");
    out_.close();
    out_.line();
  }

  const Program& program_;
  const TaskPlan& task_;
  const ModuleOptions& options_;
  TaskUse use_;
  std::vector<const Global*> globals_;
  std::vector<std::string> start_;
  std::vector<std::string> own_;  // variables of the module that are none of the program
  TextWriter out_;
};

}  // namespace

std::string emit_module(const Program& program, const TaskPlan& task, const ModuleOptions& options) {
  return ModuleEmitter(program, task, options).run();
}

}  // namespace indurop::plc
