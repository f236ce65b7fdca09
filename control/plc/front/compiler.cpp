// SPDX-License-Identifier: Apache-2.0
#include "control/plc/front/compiler.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "control/plc/emit/glb_emitter.h"
#include "control/plc/emit/module_emitter.h"
#include "control/plc/front/check_files.h"
#include "glb2idl/compiler.h"

namespace indurop::plc {
namespace {

std::string file_names(const std::vector<std::string>& files) {
  std::string out;
  for (const std::string& one : files) {
    out += (out.empty() ? "" : ", ") + std::filesystem::path(one).filename().string();
  }
  return out;
}

// Checks the emitted .glb as its users will; its errors refer to the variables of the program.
void check_glb(const std::string& name, const GlbFile& glb, const std::vector<std::string>& others,
               const glb2idl::FileReader& read_other, Diagnostics& diagnostics) {
  const std::string own = name + ".glb";
  const glb2idl::FileReader read = [&](const std::string& path) {
    return path == own ? glb2idl::ReadResult{glb.text, own, ""} : read_other(path);
  };
  std::vector<std::string> inputs = others;
  inputs.push_back(own);
  for (const base::Diagnostic& one : glb2idl::compile(inputs, read).diagnostics) {
    const auto line = static_cast<std::size_t>(one.place.line);
    const bool known = one.file == own && line > 0 && line <= glb.places.size();
    diagnostics.error(known ? glb.places[line - 1] : Place{}, fmt::format("as a shared variable: {}", one.text));
  }
}

class Compiler {
 public:
  Compiler(const CompileOptions& options, const glb2idl::FileReader& read) : options_(options), read_(read) {
    out_.name = module_name(options);
  }

  Compiled run() {
    if (!is_module_name(out_.name)) {
      diagnostics_.error(
          {}, fmt::format("'{}' names the module and its variables, use letters, digits and '_'", out_.name));
    } else {
      translate();
    }
    out_.ok = !diagnostics_.failed();
    const std::vector<base::Diagnostic> found = diagnostics_.list();
    out_.diagnostics.insert(out_.diagnostics.end(), found.begin(), found.end());
    return std::move(out_);
  }

 private:
  void translate() {
    const std::shared_ptr<const Program> program =
        check_files(options_, out_.name, read_, diagnostics_, out_.diagnostics);
    if (diagnostics_.failed() || program == nullptr) {
      return;
    }
    out_.dialect = program->project.dialect;
    const std::string sources = file_names(options_.files);
    const GlbFile glb = emit_glb(*program, sources, options_.show_locals, options_.watch);
    check_glb(out_.name, glb, options_.glb_files, read_, diagnostics_);
    out_.glb = glb.text;
    for (const TaskPlan& task : program->tasks) {
      ModuleText module;
      module.name = module_of(*program, task, out_.name);
      CoverageTable coverage;
      const Probes probes{options_.debug ? &module.debug : nullptr, options_.coverage ? &coverage : nullptr};
      module.cpp = emit_module(*program, task, {module.name, sources, options_.show_locals, options_.watch, probes});
      module.period_ns = task.periodic ? task.interval_ns : 0;
      module.priority = task.priority;
      out_.modules.push_back(std::move(module));
    }
    if (options_.debug) {
      out_.program = program;
    }
  }

  const CompileOptions& options_;
  const glb2idl::FileReader& read_;
  Compiled out_;
  Diagnostics diagnostics_;
};

std::string duration(std::int64_t ns) {
  for (const auto& [unit, size] : {std::pair("s", std::int64_t{1'000'000'000}),
                                   std::pair("ms", std::int64_t{1'000'000}), std::pair("us", std::int64_t{1'000})}) {
    if (ns % size == 0) {
      return fmt::format("{}{}", ns / size, unit);
    }
  }
  return fmt::format("{}", ns);
}

}  // namespace

Compiled compile(const CompileOptions& options, const glb2idl::FileReader& read) {
  return Compiler(options, read).run();
}

std::string module_xml(const std::vector<ModuleText>& modules, const std::string& folder) {
  std::string out;
  for (const ModuleText& one : modules) {
    out += fmt::format(
        "  <module>\n"
        "    <filename>{}/{}.so</filename>\n"
        "    <moduletype>thread</moduletype>\n"
        "    <operationtype>{}</operationtype>\n"
        "{}"
        "    <priority>{}</priority>\n"
        "  </module>\n",
        folder, one.name, one.period_ns > 0 ? "periodic" : "sporadic",
        fmt::format("    <{0}>{1}</{0}>\n", one.period_ns > 0 ? "period" : "deadline",
                    duration(one.period_ns > 0 ? one.period_ns : kDefaultIntervalNs)),
        one.priority);
  }
  return out;
}

}  // namespace indurop::plc
