// SPDX-License-Identifier: Apache-2.0
#include "plc/plcopen/document.h"

#include <fmt/format.h>

#include <optional>

#include "plc/plcopen/body_reader.h"
#include "plc/plcopen/declarations.h"
#include "plc/plcopen/instances.h"

namespace indurop::plc::plcopen {
namespace {

constexpr std::string_view kGlobalsOfCodesys = "http://www.3s-software.com/plcopenxml/globalvars";

std::optional<ast::Pou::Kind> kind_named(std::string_view name) {
  if (name == "program") {
    return ast::Pou::Kind::Program;
  }
  if (name == "function") {
    return ast::Pou::Kind::Function;
  }
  return name == "functionBlock" ? std::optional(ast::Pou::Kind::FunctionBlock) : std::nullopt;
}

class Reader {
 public:
  explicit Reader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  Document read(const Node& root) {
    if (root.name != "project") {
      diagnostics_.error(root.at, fmt::format("<{}> is no PLCopen project; export the program as PLCopen XML (TC6), "
                                              "whose root is <project>",
                                              root.name));
      return {};
    }
    if (const Node* types = root.child("types")) {
      if (const Node* list = types->child("dataTypes")) {
        read_data_types(*list, document_.project.types, diagnostics_);
      }
      if (const Node* list = types->child("pous")) {
        pous(*list);
      }
    }
    if (const Node* instances = root.child("instances")) {
      read_instances(*instances, document_.project.configurations, diagnostics_);
    }
    if (const Node* extensions = root.child("addData")) {
      extended_globals(*extensions);
    }
    if (document_.pous.empty() && !diagnostics_.failed()) {
      diagnostics_.error(root.at, "this project has no program, function or function block");
    }
    return std::move(document_);
  }

 private:
  void pous(const Node& list) {
    for (const Node& node : list.children) {
      if (node.name == "pou") {
        pou(node);
      }
    }
  }

  void pou(const Node& node) {
    PouDocument made;
    made.pou.name = std::string(node.attribute("name"));
    const std::string what = "POU " + made.pou.name;
    made.pou.at = within(node.at, what);
    const auto kind = kind_named(node.attribute("pouType"));
    if (made.pou.name.empty() || !kind) {
      diagnostics_.error(made.pou.at, "a <pou> has a name and a pouType: program, function or functionBlock");
      return;
    }
    made.pou.kind = *kind;
    if (const Node* documentation = node.child("documentation")) {
      made.pou.comment = formatted_text(*documentation);
    }
    if (const Node* interface = node.child("interface")) {
      read_interface(*interface, what, made.pou, diagnostics_);
    }
    if (const Node* body = node.child("body")) {
      made.body = read_body(*body, what, diagnostics_);
    }
    made.body.at = made.body.at.line == 0 ? made.pou.at : made.body.at;
    named(node, "actions", "action", what, made.actions);
    named(node, "transitions", "transition", what, made.transitions);
    document_.pous.push_back(std::move(made));
  }

  void named(const Node& pou, const char* list_name, const char* word, const std::string& what,
             std::vector<NamedBody>& into) {
    const Node* list = pou.child(list_name);
    for (const Node& node : children_of(list)) {
      if (node.name != word) {
        continue;
      }
      NamedBody made;
      made.name = std::string(node.attribute("name"));
      const std::string where = fmt::format("{}, {} {}", what, word, made.name);
      made.at = within(node.at, where);
      const Node* body = node.child("body");
      if (made.name.empty() || body == nullptr) {
        diagnostics_.error(made.at, fmt::format("this {} lacks its {}", word, made.name.empty() ? "name" : "<body>"));
        continue;
      }
      made.body = read_body(*body, where, diagnostics_);
      into.push_back(std::move(made));
    }
  }

  // CODESYS keeps its lists of globals in an extension of the format.
  void extended_globals(const Node& extensions) {
    for (const Node& data : extensions.children) {
      if (data.attribute("name") != kGlobalsOfCodesys) {
        continue;
      }
      for (const Node& list : data.children) {
        read_variables(list, ast::Section::Global, "globals " + std::string(list.attribute("name")),
                       document_.project.globals, diagnostics_);
      }
    }
  }

  Diagnostics& diagnostics_;
  Document document_;
};

}  // namespace

Document read_document(std::string_view bytes, const std::string& name, Diagnostics& diagnostics) {
  const auto root = read_xml(bytes, std::make_shared<const std::string>(name), diagnostics);
  return root ? Reader(diagnostics).read(*root) : Document{};
}

}  // namespace indurop::plc::plcopen
