// SPDX-License-Identifier: Apache-2.0
#include "control/plc/plcopen/outside.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "control/plc/plcopen/body_reader.h"
#include "control/plc/plcopen/type_reader.h"
#include "control/plc/print/expression_text.h"
#include "control/plc/st/parser.h"

namespace indurop::plc::plcopen {
namespace {

std::string named(const std::string& what, std::string_view variable) {
  return fmt::format("{}, variable {}", what, variable);
}

// Reads instancePathAndName; the part before an address is ignored.
std::optional<ast::Expression> path_of(const Node& node, const Place& at, Diagnostics& diagnostics) {
  std::string_view text = node.attribute("instancePathAndName");
  if (const std::size_t address = text.find('%'); address != std::string_view::npos) {
    text.remove_prefix(address);
  }
  if (text.empty()) {
    diagnostics.error(at, "the attribute instancePathAndName says which variable is meant, add it");
    return std::nullopt;
  }
  return st::parse_expression({text, at}, diagnostics);
}

// Returns the names of a.b.c; empty with an error.
std::vector<std::string> names_of(const ast::Expression& path, const Place& at, Diagnostics& diagnostics) {
  std::vector<std::string> out;
  const ast::Expression* one = &path;
  for (; one->kind == ast::Expression::Kind::Member; one = &one->operands.front()) {
    out.push_back(one->name);
  }
  if (one->kind != ast::Expression::Kind::Name) {
    diagnostics.error(at, "instancePathAndName has the form resource.program.instance.variable");
    return {};
  }
  out.push_back(one->name);
  std::reverse(out.begin(), out.end());
  return out;
}

}  // namespace

void read_accesses(const Node& list, const std::string& program, const std::string& what, std::vector<Access>& into,
                   Diagnostics& diagnostics) {
  for (const Node& node : list.children) {
    if (node.name != "accessVariable") {
      continue;
    }
    Access made;
    made.name = std::string(node.attribute("alias"));
    made.program = program;
    const std::string whole = named(what, made.name);
    made.at = within(node.at, whole);
    made.writable = node.attribute("direction") == "readWrite";
    const Node* type = node.child("type");
    if (made.name.empty() || type == nullptr) {
      diagnostics.error(made.at, "an <accessVariable> has an alias and a <type>");
      continue;
    }
    auto to = path_of(node, made.at, diagnostics);
    auto spec = read_type(*type, whole, diagnostics);
    if (to && spec) {
      made.to = std::move(*to);
      made.type = std::move(*spec);
      into.push_back(std::move(made));
    }
  }
}

void read_configured(const Node& list, const std::string& what, std::vector<Configured>& into,
                     Diagnostics& diagnostics) {
  for (const Node& node : list.children) {
    if (node.name != "configVariable") {
      continue;
    }
    Configured made;
    const std::string whole = named(what, node.attribute("instancePathAndName"));
    made.at = within(node.at, whole);
    const auto path = path_of(node, made.at, diagnostics);
    made.path = path ? names_of(*path, made.at, diagnostics) : std::vector<std::string>{};
    const Node* type = node.child("type");
    auto spec = type != nullptr ? read_type(*type, whole, diagnostics) : std::nullopt;
    if (type == nullptr) {
      diagnostics.error(made.at, "a <configVariable> has a <type>");
    }
    if (made.path.empty() || !spec) {
      continue;
    }
    made.type = std::move(*spec);
    made.initial = read_initial(node, whole, diagnostics);
    if (const std::string_view address = node.attribute("address"); !address.empty()) {
      const auto direct = st::parse_expression({address, made.at}, diagnostics);
      if (direct && direct->kind == ast::Expression::Kind::Direct) {
        made.address = direct->address;
      }
    }
    into.push_back(std::move(made));
  }
}

namespace {

void write_accesses(const std::vector<Access>& accesses, XmlWriter& out, DeclarationWriter& declarations,
                    Diagnostics& diagnostics) {
  if (accesses.empty()) {
    return;
  }
  out.open("accessVars");
  for (const Access& one : accesses) {
    if (!one.program.empty()) {
      diagnostics.error(one.at, "VAR_ACCESS of a PROGRAM is not written, declare it in the CONFIGURATION");
    }
    out.open("accessVariable", {{"alias", one.name},
                                {"instancePathAndName", expression_text(one.to)},
                                {"direction", one.writable ? "readWrite" : "readOnly"}});
    declarations.typed(one.type, nullptr);
    out.close();
  }
  out.close();
}

}  // namespace

void write_outside(const Project& project, XmlWriter& out, DeclarationWriter& declarations, Diagnostics& diagnostics) {
  write_accesses(project.accesses, out, declarations, diagnostics);
  if (project.configured.empty()) {
    return;
  }
  out.open("configVars");
  for (const Configured& one : project.configured) {
    std::string path;
    for (const std::string& name : one.path) {
      path += (path.empty() ? "" : ".") + name;
    }
    XmlWriter::Attributes attributes{{"instancePathAndName", path}};
    if (one.address) {
      attributes.emplace_back("address", ast::to_string(*one.address));
    }
    out.open("configVariable", attributes);
    declarations.typed(one.type, one.initial ? &*one.initial : nullptr);
    out.close();
  }
  out.close();
}

}  // namespace indurop::plc::plcopen
