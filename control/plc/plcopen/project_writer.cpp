// SPDX-License-Identifier: Apache-2.0
#include "control/plc/plcopen/project_writer.h"

#include <fmt/format.h>

#include <algorithm>

#include "control/plc/check/task_checker.h"
#include "control/plc/plcopen/declaration_writer.h"
#include "control/plc/plcopen/diagram_writer.h"
#include "control/plc/plcopen/extensions.h"
#include "control/plc/plcopen/outside.h"
#include "control/plc/print/expression_text.h"

namespace indurop::plc::plcopen {
namespace {

const char* type_of(ast::Pou::Kind kind) noexcept {
  return kind == ast::Pou::Kind::Program ? "program" : kind == ast::Pou::Kind::Function ? "function" : "functionBlock";
}

class ProjectWriter {
 public:
  ProjectWriter(const Document& document, const WriteOptions& options, Diagnostics& diagnostics)
      : document_(document), options_(options), diagnostics_(diagnostics), declarations_(out_, diagnostics) {}

  std::string run() {
    out_.open("project",
              {{"xmlns", "http://www.plcopen.org/xml/tc6_0201"}, {"xmlns:xhtml", "http://www.w3.org/1999/xhtml"}});
    headers();
    out_.open("types");
    out_.open("dataTypes");
    for (const ast::TypeDeclaration& one : document_.project.types) {
      declarations_.type(one);
    }
    out_.close();
    out_.open("pous");
    for (const PouDocument& one : document_.pous) {
      pou(one);
    }
    out_.close();
    out_.close();
    out_.open("instances");
    out_.open("configurations");
    configurations();
    out_.close();
    out_.close();
    out_.close();
    return out_.take();
  }

 private:
  void headers() {
    out_.leaf("fileHeader", {{"companyName", ""},
                             {"productName", "InduRoP"},
                             {"productVersion", "1"},
                             {"creationDateTime", options_.created}});
    out_.open("contentHeader", {{"name", options_.name}, {"modificationDateTime", options_.created}});
    out_.open("coordinateInfo");
    for (const char* language : {"fbd", "ld", "sfc"}) {
      out_.open(language);
      out_.leaf("scaling", {{"x", "10"}, {"y", "10"}});
      out_.close();
    }
    out_.close();
    if (document_.project.dialect == Dialect::Codesys) {  // identifies its rules when the file is read again
      out_.open("addDataInfo");
      out_.leaf(
          "info",
          {{"name", std::string(kExtensionsOfCodesys)}, {"version", "1.0"}, {"vendor", "http://www.3s-software.com"}});
      out_.close();
    }
    out_.close();
  }

  void refuse(const Place& at, const char* what) {
    diagnostics_.error(at,
                       fmt::format("{} is not part of PLCopen XML 2.01; only programs without it are exported", what));
  }

  bool is_known(const PouDocument& one) {
    const ast::Pou& pou = one.pou;
    const std::size_t before = diagnostics_.errors();
    if (!pou.scope.space.empty() || !pou.scope.uses.empty()) {
      refuse(pou.at, pou.scope.space.empty() ? "USING" : "NAMESPACE");
    }
    if (pou.kind == ast::Pou::Kind::Class || pou.kind == ast::Pou::Kind::Interface) {
      refuse(pou.at, pou.kind == ast::Pou::Kind::Class ? "CLASS" : "INTERFACE");
    } else if (!pou.bases.empty() || !pou.interfaces.empty()) {
      refuse(pou.at, pou.bases.empty() ? "IMPLEMENTS" : "EXTENDS");
    } else if (!pou.methods.empty()) {
      refuse(pou.methods.front().at, pou.methods.front().accessor == ast::Accessor::None ? "METHOD" : "PROPERTY");
    } else if (!one.methods.empty()) {
      const ast::Pou& method = one.methods.front().pou;
      refuse(method.at, method.accessor == ast::Accessor::None ? "METHOD" : "PROPERTY");
    } else if (pou.is_abstract || pou.is_final) {
      refuse(pou.at, pou.is_final ? "FINAL" : "ABSTRACT");
    }
    return diagnostics_.errors() == before;
  }

  void pou(const PouDocument& one) {
    if (!is_known(one)) {
      return;
    }
    out_.open("pou", {{"name", one.pou.name}, {"pouType", type_of(one.pou.kind)}});
    declarations_.interface(one.pou);
    named("actions", "action", one.code.actions);
    named("transitions", "transition", one.code.transitions);
    body(one.code.body);
    if (!one.pou.comment.empty()) {
      out_.formatted("documentation", one.pou.comment);
    }
    out_.close();
  }

  void named(const char* list, const char* tag, const std::vector<network::NamedBody>& bodies) {
    if (bodies.empty()) {
      return;
    }
    out_.open(list);
    for (const network::NamedBody& one : bodies) {
      out_.open(tag, {{"name", one.name}});
      body(one.body);
      out_.close();
    }
    out_.close();
  }

  void body(const network::Body& of) {
    out_.open("body");
    write_body(of, out_);
    out_.close();
  }

  void configurations() {
    const Project& project = document_.project;
    if (project.configurations.empty()) {
      configuration(default_configuration());
      return;
    }
    for (const Configuration& one : project.configurations) {
      configuration(one);
    }
  }

  [[nodiscard]] Configuration default_configuration() const {
    Configuration made;
    made.name = "config";
    Resource& resource = made.resources.emplace_back();
    resource.name = "resource1";
    Task task;
    task.name = "task0";
    task.interval_ns = kDefaultIntervalNs;
    task.priority = 1;
    for (const PouDocument& one : document_.pous) {
      if (one.pou.kind == ast::Pou::Kind::Program) {
        ProgramInstance& instance = resource.programs.emplace_back();
        instance.name = one.pou.name;
        instance.type = one.pou.name;
        instance.task = task.name;
      }
    }
    if (!resource.programs.empty()) {
      resource.tasks.push_back(std::move(task));
    }
    return made;
  }

  // The first configuration contains the globals that are in none.
  void configuration(const Configuration& of) {
    out_.open("configuration", {{"name", of.name}});
    int number = 0;
    for (const Resource& one : of.resources) {
      resource(one, ++number);
    }
    if (!globals_written_) {
      globals_written_ = true;
      for (const std::string& list : document_.project.global_lists) {
        out_.leaf("globalVars", {{"name", list}});
      }
      declarations_.globals(document_.project.globals);
    }
    declarations_.globals(of.globals);
    if (!outside_written_) {
      outside_written_ = true;
      write_outside(document_.project, out_, declarations_, diagnostics_);
    }
    out_.close();
  }

  void resource(const Resource& of, int number) {
    out_.open("resource", {{"name", of.name.empty() ? fmt::format("resource{}", number) : of.name}});
    for (std::size_t i = 0; i < of.tasks.size(); ++i) {
      const Task& one = of.tasks[i];
      XmlWriter::Attributes attributes{{"name", one.name}};
      if (!one.single.empty()) {
        attributes.emplace_back("single", one.single);
      }
      if (one.interval_ns) {
        attributes.emplace_back("interval", duration_text(*one.interval_ns));
      }
      attributes.emplace_back("priority", std::to_string(one.priority.value_or(++tasks_)));
      out_.open("task", attributes);
      programs(of, one.name);
      out_.close();
    }
    declarations_.globals(of.globals);
    programs(of, "");
    out_.close();
  }

  void programs(const Resource& of, const std::string& task) {
    for (const ProgramInstance& one : of.programs) {
      if (same_name(one.task, task)) {
        out_.leaf("pouInstance", {{"name", one.name}, {"typeName", one.type}});
        if (!one.connections.empty()) {
          diagnostics_.error(one.connections.front().at,
                             "connections of a program are not part of PLCopen XML, use "
                             "VAR_EXTERNAL in the program");
        }
      }
    }
  }

  const Document& document_;
  const WriteOptions& options_;
  Diagnostics& diagnostics_;
  XmlWriter out_;
  DeclarationWriter declarations_;
  bool globals_written_ = false;
  bool outside_written_ = false;
  int tasks_ = 0;
};

}  // namespace

std::string write_project(const Document& document, const WriteOptions& options, Diagnostics& diagnostics) {
  return ProjectWriter(document, options, diagnostics).run();
}

}  // namespace indurop::plc::plcopen
