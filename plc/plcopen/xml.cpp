// SPDX-License-Identifier: Apache-2.0
#include "plc/plcopen/xml.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>

#include "plc/plcopen/xml_places.h"

namespace indurop::plc::plcopen {
namespace {

std::string local_name(const char* name) {
  const std::string_view whole(name);
  const std::size_t colon = whole.find(':');
  return std::string(colon == std::string_view::npos ? whole : whole.substr(colon + 1));
}

// Copies the library's tree. Its elements come in the order of the start tags, so the places are taken one by one.
class Copier {
 public:
  Copier(const std::vector<TagPlace>& places, std::shared_ptr<const std::string> file)
      : places_(places), file_(std::move(file)) {}

  Node copy(const tinyxml2::XMLElement& from) {
    Node node;
    node.name = local_name(from.Name());
    node.at = {file_, static_cast<std::uint32_t>(std::max(0, from.GetLineNum())), 0, nullptr};
    node.text_at = node.at;
    if (next_ < places_.size()) {
      const TagPlace& place = places_[next_++];
      node.at = {file_, place.line, place.column, nullptr};
      node.text_at = place.text_line == 0 ? node.at : Place{file_, place.text_line, place.text_column, nullptr};
    }
    for (const auto* a = from.FirstAttribute(); a != nullptr; a = a->Next()) {
      node.attributes.push_back({local_name(a->Name()), a->Value()});
    }
    for (const auto* child = from.FirstChild(); child != nullptr; child = child->NextSibling()) {
      if (const auto* text = child->ToText()) {
        node.text += text->Value();
      } else if (const auto* element = child->ToElement()) {
        node.children.push_back(copy(*element));
      }
    }
    return node;
  }

 private:
  const std::vector<TagPlace>& places_;
  std::shared_ptr<const std::string> file_;
  std::size_t next_ = 0;
};

std::string problem_of_bytes(std::string_view bytes) {
  if (bytes.size() > kMaxXmlSize) {
    return fmt::format("the file is larger than {} MB; is it a PLC program?", kMaxXmlSize / 1024 / 1024);
  }
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    return "the file is encoded as UTF-16; save it as UTF-8";
  }
  if (bytes.find('\0') != std::string_view::npos) {
    return "the file holds zero bytes; it is no XML text";
  }
  if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    return "the file is empty; a PLCopen file is a <project> with types and instances";
  }
  return {};
}

}  // namespace

std::string_view Node::attribute(std::string_view wanted) const noexcept {
  for (const Attribute& each : attributes) {
    if (each.name == wanted) {
      return each.value;
    }
  }
  return {};
}

bool Node::has(std::string_view wanted) const noexcept {
  return std::any_of(attributes.begin(), attributes.end(), [&](const Attribute& each) { return each.name == wanted; });
}

const Node* Node::child(std::string_view wanted) const noexcept {
  for (const Node& each : children) {
    if (each.name == wanted) {
      return &each;
    }
  }
  return nullptr;
}

const std::vector<Node>& children_of(const Node* node) noexcept {
  static const std::vector<Node> kNone;
  return node == nullptr ? kNone : node->children;
}

std::optional<Node> read_xml(std::string_view bytes, const std::shared_ptr<const std::string>& file,
                             Diagnostics& diagnostics) {
  const auto report = [&](std::uint32_t line, std::uint32_t column, std::string text) {
    diagnostics.error({file, line, column, nullptr}, std::move(text));
  };
  if (bytes.starts_with("\xEF\xBB\xBF")) {
    bytes.remove_prefix(3);
  }
  if (std::string problem = problem_of_bytes(bytes); !problem.empty()) {
    report(0, 0, std::move(problem));
    return std::nullopt;
  }
  const TagPlaces places = find_tags(bytes);
  if (places.depth > kMaxXmlDepth) {
    report(places.deepest_line, 0,
           fmt::format("elements are nested deeper than {} levels; no PLC program needs that", kMaxXmlDepth));
    return std::nullopt;
  }
  const auto document = std::make_unique<tinyxml2::XMLDocument>();
  if (document->Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS || document->RootElement() == nullptr) {
    if (!places.open.empty()) {
      report(places.open_line, 0,
             fmt::format("<{0}> is never closed; add </{0}>, or is the file cut off?", places.open));
    } else {
      report(
          static_cast<std::uint32_t>(std::max(0, document->ErrorLineNum())), 0,
          fmt::format("not well-formed XML ({}); check the tags and quotes around this line", document->ErrorName()));
    }
    return std::nullopt;
  }
  return Copier(places.tags, file).copy(*document->RootElement());
}

}  // namespace indurop::plc::plcopen
