// SPDX-License-Identifier: Apache-2.0
#include "control/plc/plcopen/document.h"

#include <fmt/format.h>

#include <optional>

#include "control/plc/plcopen/body_reader.h"
#include "control/plc/plcopen/declarations.h"
#include "control/plc/plcopen/extensions.h"
#include "control/plc/plcopen/instances.h"
#include "control/plc/plcopen/objects.h"
#include "control/plc/plcopen/outside.h"

namespace indurop::plc::plcopen {
namespace {

std::optional<ast::Pou::Kind> kind_named(std::string_view name) {
  if (name == "program") {
    return ast::Pou::Kind::Program;
  }
  if (name == "function") {
    return ast::Pou::Kind::Function;
  }
  return name == "functionBlock" ? std::optional(ast::Pou::Kind::FunctionBlock) : std::nullopt;
}

class ProjectElementReader {
 public:
  explicit ProjectElementReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  Document read(const Node& root) {
    if (root.name != "project") {
      diagnostics_.error(root.at, fmt::format("<{}> is not a PLCopen project; export the program as PLCopen XML (TC6), "
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
      read_instances(*instances, document_.project, diagnostics_);
    }
    if (const Node* instances = root.child("instances")) {
      extensions_below(*instances);
    }
    extensions(root);
    const Project& project = document_.project;
    if (document_.pous.empty() && project.types.empty() && project.globals.empty() && !diagnostics_.failed()) {
      diagnostics_.error(root.at, "this project has no program, function, function block, type or global variable");
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
    read_object(node, what, made, diagnostics_);
    if (const Node* documentation = node.child("documentation")) {
      made.pou.comment = formatted_text(*documentation);
    }
    if (const Node* interface = node.child("interface")) {
      read_interface(*interface, what, made.pou, diagnostics_);
      if (const Node* accesses = interface->child("accessVars");
          made.pou.kind == ast::Pou::Kind::Program && accesses != nullptr) {
        read_accesses(*accesses, made.pou.name, what, document_.project.accesses, diagnostics_);
      }
    }
    if (const Node* body = node.child("body")) {
      made.code.body = read_body(*body, what, diagnostics_);
    }
    made.code.body.at = made.code.body.at.line == 0 ? made.pou.at : made.code.body.at;
    named(node, "actions", "action", what, made.code.actions);
    named(node, "transitions", "transition", what, made.code.transitions);
    document_.pous.push_back(std::move(made));
  }

  void named(const Node& pou, const char* list_name, const char* word, const std::string& what,
             std::vector<network::NamedBody>& into) {
    const Node* list = pou.child(list_name);
    for (const Node& node : children_of(list)) {
      if (node.name != word) {
        continue;
      }
      network::NamedBody made;
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

  // Reads extensions of configurations and resources of a whole project; lists of globals have names in CODESYS.
  void extensions_below(const Node& node) {
    for (const Node& child : node.children) {
      if (child.name == "globalVars" && child.has("name")) {
        document_.project.global_lists.emplace_back(child.attribute("name"));
      }
      if (child.name == "configurations" || child.name == "configuration" || child.name == "resource") {
        extensions(child);
        extensions_below(child);
      }
    }
  }

  // Reads lists of globals, and items below an application, which CODESYS and TwinCAT store in extensions of the
  // format.
  void extensions(const Node& node) {
    for (const Node& data : children_of(node.child("addData"))) {
      if (!data.attribute("name").starts_with(kExtensionsOfCodesys)) {
        continue;
      }
      for (const Node& part : data.children) {
        if (part.name == "globalVars") {
          globals(part);
        } else if (part.name == "pou") {
          pou(part);
        } else if (part.name == "Interface") {
          document_.pous.push_back(read_interface_object(part, diagnostics_));
        } else if (part.name == "dataType") {
          read_data_type(part, document_.project.types, diagnostics_);
        } else if (part.name == "resource") {
          read_application(part, document_.project, diagnostics_);
          extensions(part);
          extensions_below(part);
        }
      }
    }
  }

  // A list of variables with different attributes contains one list for each kind.
  void globals(const Node& list) {
    for (const Node& data : children_of(list.child("addData"))) {
      if (const Node* mixed = data.child("MixedAttrsVarList")) {
        for (const Node& part : mixed->children) {
          globals(part);
        }
        return;
      }
    }
    document_.project.global_lists.emplace_back(list.attribute("name"));
    read_variables(list, ast::Section::Global, "globals " + document_.project.global_lists.back(),
                   document_.project.globals, diagnostics_);
  }

  Diagnostics& diagnostics_;
  Document document_;
};

}  // namespace

Document read_document(std::string_view bytes, const std::string& name, Diagnostics& diagnostics) {
  auto root = read_xml(bytes, std::make_shared<const std::string>(name), diagnostics);
  if (!root) {
    return {};
  }
  if (bytes.find(kExtensionsOfCodesys) == std::string_view::npos) {
    quote_texts(*root);
  }
  Document document = ProjectElementReader(diagnostics).read(*root);
  if (bytes.find(kExtensionsOfCodesys) != std::string_view::npos) {
    document.project.dialect = Dialect::Codesys;
  }
  return document;
}

}  // namespace indurop::plc::plcopen
