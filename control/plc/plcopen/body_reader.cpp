// SPDX-License-Identifier: Apache-2.0
#include "control/plc/plcopen/body_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "control/plc/plcopen/element_reader.h"

namespace indurop::plc::plcopen {
namespace {

using network::Body;

constexpr std::array<std::pair<std::string_view, Body::Language>, 5> kLanguages{{{"ST", Body::Language::St},
                                                                                 {"IL", Body::Language::Il},
                                                                                 {"LD", Body::Language::Ld},
                                                                                 {"FBD", Body::Language::Fbd},
                                                                                 {"SFC", Body::Language::Sfc}}};

void collect_text(const Node& node, std::string& text, Place* at) {
  if (node.text.find_first_not_of(" \t\r\n") != std::string::npos) {
    if (text.empty() && at != nullptr) {
      *at = node.text_at;
    }
    text += (text.empty() ? "" : "\n") + node.text;
  }
  for (const Node& child : node.children) {
    collect_text(child, text, at);
  }
}

}  // namespace

Place within(Place at, const std::string& what) {
  at.within = std::make_shared<const std::string>(what);
  return at;
}

std::string formatted_text(const Node& node, Place* at) {
  std::string text;
  collect_text(node, text, at);
  return text;
}

Body read_body(const Node& body, const std::string& what, Diagnostics& diagnostics) {
  Body read;
  read.at = within(body.at, what);
  read.text_at = read.at;
  for (const Node& node : body.children) {
    if (node.name == "addData" || node.name == "documentation") {
      continue;
    }
    const auto* known = std::find_if(kLanguages.begin(), kLanguages.end(),
                                     [&](const auto& language) { return language.first == node.name; });
    const Place at = within(node.at, what);
    if (known == kLanguages.end()) {
      diagnostics.error(
          at, fmt::format("<{}> is not a language of IEC 61131-3; a body is ST, IL, LD, FBD or SFC", node.name));
    } else if (read.language != Body::Language::None) {
      diagnostics.error(at, "a second body; put the code of all worksheets into one");
    } else {
      read.language = known->second;
      if (read.language == Body::Language::St || read.language == Body::Language::Il) {
        read.text = formatted_text(node, &read.text_at);
        read.text_at.within = at.within;
      } else {
        read.diagram = read_elements(node, what, diagnostics);
      }
    }
  }
  const Node* extension = body.child("addData");
  if (read.language == Body::Language::None && extension != nullptr && !extension->children.empty()) {
    diagnostics.error(
        read.at,
        "the code is in an extension of the editor (a continuous function chart?); write it in ST, IL, LD, "
        "FBD or SFC");
  }
  return read;
}

}  // namespace indurop::plc::plcopen
