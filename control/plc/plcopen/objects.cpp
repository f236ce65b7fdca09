// SPDX-License-Identifier: Apache-2.0
#include "control/plc/plcopen/objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "control/plc/plcopen/body_reader.h"
#include "control/plc/plcopen/declarations.h"

namespace indurop::plc::plcopen {
namespace {

// Reads "A, B".
void names(const Node& node, std::vector<ast::NameAt>& to) {
  std::string text = node.text;
  std::replace(text.begin(), text.end(), ',', ' ');
  constexpr std::string_view kBlank = " \t\r\n";
  for (std::size_t at = text.find_first_not_of(kBlank); at != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(kBlank, at), text.size());
    to.push_back({node.text_at, text.substr(at, end - at)});
    at = text.find_first_not_of(kBlank, end);
  }
}

void inheritance(const Node& node, ast::Pou& pou) {
  for (const Node& one : node.children) {
    if (one.name == "Extends") {
      names(one, pou.bases);
    } else if (one.name == "Implements") {
      names(one, pou.interfaces);
    }
  }
}

void modifiers(const Node& node, ast::Pou& pou) {
  const auto has = [&](std::string_view word) { return node.attribute(word) == "true"; };
  if (has("Private")) {
    pou.access = ast::Access::Private;
  } else if (has("Protected")) {
    pou.access = ast::Access::Protected;
  } else {
    pou.access = has("Internal") ? ast::Access::Internal : ast::Access::Public;
  }
  pou.is_abstract = pou.is_abstract || has("Abstract");
  pou.is_final = pou.is_final || has("Final");
}

class ObjectReader {
 public:
  ObjectReader(std::string what, PouDocument& into, Diagnostics& diagnostics)
      : what_(std::move(what)), into_(into), diagnostics_(diagnostics) {}

  void read(const Node& node) {
    if (const Node* interface = node.child("interface")) {
      extensions(*interface, into_.pou);
    }
    for (const Node& data : children_of(node.child("addData"))) {
      for (const Node& part : data.children) {
        this->part(part);
      }
    }
    for (const char* list : {"Methods", "Properties"}) {  // of an <Interface>
      for (const Node& part : children_of(node.child(list))) {
        this->part(part);
      }
    }
  }

 private:
  void part(const Node& part) {
    if (part.name == "Method") {
      method(part);
    } else if (part.name == "Property") {
      property(part);
    } else if (part.name == "Inheritance") {
      inheritance(part, into_.pou);
    } else if (part.name == "AccessModifiers") {
      modifiers(part, into_.pou);
    }
  }

  static void extensions(const Node& interface, ast::Pou& pou) {
    for (const Node& data : children_of(interface.child("addData"))) {
      for (const Node& part : data.children) {
        if (part.name == "Inheritance") {
          inheritance(part, pou);
        } else if (part.name == "AccessModifiers") {
          modifiers(part, pou);
        }
      }
    }
  }

  PouDocument begin(const Node& node, const std::string& where) {
    PouDocument made;
    made.pou.kind = ast::Pou::Kind::Method;
    made.pou.name = std::string(node.attribute("name"));
    made.pou.at = within(node.at, where);
    if (const Node* interface = node.child("interface")) {
      read_interface(*interface, where, made.pou, diagnostics_);
      extensions(*interface, made.pou);
    }
    return made;
  }

  void code(const Node& node, const std::string& where, PouDocument& to) {
    if (const Node* body = node.child("body")) {
      to.code.body = read_body(*body, where, diagnostics_);
    }
    to.code.body.at = to.code.body.at.line == 0 ? to.pou.at : to.code.body.at;
  }

  void method(const Node& node) {
    const std::string where = fmt::format("{}, method {}", what_, node.attribute("name"));
    PouDocument made = begin(node, where);
    code(node, where, made);
    into_.methods.push_back(std::move(made));
  }

  // The value assigned to a property has its name in SET.
  void property(const Node& node) {
    const std::string where = fmt::format("{}, property {}", what_, node.attribute("name"));
    const PouDocument form = begin(node, where);
    if (!form.pou.result) {
      diagnostics_.error(form.pou.at, "a property has a <returnType>");
      return;
    }
    const std::size_t before = into_.methods.size();
    for (const auto& [word, which] :
         {std::pair("GetAccessor", ast::Accessor::Get), std::pair("SetAccessor", ast::Accessor::Set)}) {
      if (const Node* accessor = node.child(word)) {
        accessor_of(form, which, accessor, where);
      }
    }
    if (into_.methods.size() == before) {  // of an interface
      accessor_of(form, ast::Accessor::Get, nullptr, where);
      accessor_of(form, ast::Accessor::Set, nullptr, where);
    }
  }

  void accessor_of(const PouDocument& form, ast::Accessor which, const Node* node, const std::string& where) {
    PouDocument made;
    made.pou = form.pou;
    made.pou.accessor = which;
    if (which == ast::Accessor::Set) {
      ast::Variable value;
      value.section = ast::Section::Input;
      value.at = made.pou.at;
      value.name = made.pou.name;
      value.type = *made.pou.result;
      made.pou.variables.push_back(std::move(value));
      made.pou.result.reset();
    }
    const Node* interface = node == nullptr ? nullptr : node->child("interface");
    if (interface != nullptr) {
      read_interface(*interface, where, made.pou, diagnostics_);
      extensions(*interface, made.pou);
    }
    if (node != nullptr) {
      code(*node, where, made);
    }
    into_.methods.push_back(std::move(made));
  }

  std::string what_;
  PouDocument& into_;
  Diagnostics& diagnostics_;
};

}  // namespace

void read_object(const Node& node, const std::string& what, PouDocument& into, Diagnostics& diagnostics) {
  ObjectReader(what, into, diagnostics).read(node);
}

PouDocument read_interface_object(const Node& node, Diagnostics& diagnostics) {
  PouDocument made;
  made.pou.kind = ast::Pou::Kind::Interface;
  made.pou.name = std::string(node.attribute("name"));
  const std::string what = "INTERFACE " + made.pou.name;
  made.pou.at = within(node.at, what);
  read_object(node, what, made, diagnostics);
  return made;
}

}  // namespace indurop::plc::plcopen
