// SPDX-License-Identifier: Apache-2.0
#include "core/base/xml.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include <tinyxml2.h>

namespace indurop::base {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

std::string_view without_mark(std::string_view xml) {
  return xml.starts_with("\xEF\xBB\xBF") ? xml.substr(3) : xml;
}

// Returns a mistake that is visible before the first tag is searched for.
std::optional<XmlMistake> mistake_of_bytes(std::string_view bytes, const XmlRules& rules) {
  if (bytes.size() > rules.max_bytes) {
    return XmlMistake{{},
                      "the file is larger than " + std::to_string(rules.max_bytes / 1024 / 1024) + " MB; no " +
                          rules.purpose + " needs that, is it the right file?"};
  }
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF") || bytes.starts_with(std::string_view("<\0", 2)) ||
      bytes.starts_with(std::string_view("\0<", 2))) {
    return XmlMistake{{1, 1}, "the file is encoded as UTF-16; save it as UTF-8"};
  }
  if (rules.tolerant && bytes.find('\0') != std::string_view::npos) {
    return XmlMistake{{}, "the file holds zero bytes; it is not XML text"};
  }
  if (without_mark(bytes).find_first_not_of(kSpace) == std::string_view::npos) {
    return XmlMistake{{1, 1}, std::string("the file is empty; a ") + rules.name + " is " + rules.form};
  }
  return std::nullopt;
}

// Copies the library's tree. Its elements come in the order of the start tags, so the places are used one by one.
class Copier {
 public:
  Copier(const XmlPlaces& places, bool keep_space) : places_(places), keep_space_(keep_space) {}

  Element copy(const tinyxml2::XMLElement& from) {
    Element element;
    element.name = from.Name();
    element.place = {std::max(0, from.GetLineNum()), 0};
    const TagPlaces* tag = next_ < places_.tags.size() ? &places_.tags[next_++] : nullptr;
    if (tag != nullptr) {
      element.place = tag->place;
    }
    element.text_place = tag != nullptr && tag->text.line != 0 ? tag->text : element.place;
    std::size_t index = 0;
    for (const auto* a = from.FirstAttribute(); a != nullptr; a = a->Next(), ++index) {
      const bool known = tag != nullptr && index < tag->attributes.size();
      element.attributes.push_back({a->Name(), text(a->Value()), known ? tag->attributes[index].place : element.place,
                                    known ? tag->attributes[index].value : element.place});
    }
    for (const auto* node = from.FirstChild(); node != nullptr; node = node->NextSibling()) {
      if (const auto* part = node->ToText()) {
        element.text += part->Value();
      } else if (const auto* child = node->ToElement()) {
        element.children.push_back(copy(*child));
      }
    }
    element.text = text(std::move(element.text));
    return element;
  }

 private:
  [[nodiscard]] std::string text(std::string value) const {
    return keep_space_ ? std::move(value) : std::string(trimmed(value));
  }

  static std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kSpace);
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(kSpace) - first + 1);
  }

  const XmlPlaces& places_;
  bool keep_space_;
  std::size_t next_ = 0;
};

// Returns where the text of a line begins: the library reports no columns.
SourcePlace begin_of_line(std::string_view xml, int line) {
  std::size_t begin = 0;
  for (int passed = 1; passed < line; ++passed) {
    begin = std::min(xml.find('\n', begin), xml.size() - 1) + 1;
  }
  const std::size_t text = std::min(xml.find_first_not_of(" \t", begin), xml.size());
  return {line, static_cast<int>(text - begin) + 1};
}

XmlMistake mistake_of_library(const tinyxml2::XMLDocument& document, const XmlPlaces& places, std::string_view xml,
                              const XmlRules& rules) {
  if (places.unclosed) {
    const TagPlaces& tag = places.tags[*places.unclosed];
    const std::string name(tag.name);
    return {tag.place, "<" + name + "> is never closed; add </" + name + ">, or is the file cut off?"};
  }
  if (places.tags.empty()) {
    return {{1, 1}, std::string("there is no tag in this file; a ") + rules.name + " is " + rules.form};
  }
  return {begin_of_line(xml, std::max(1, document.ErrorLineNum())),
          "not well-formed XML; check the tags and quotes around this line"};
}

}  // namespace

std::optional<Element> read_xml(std::string_view bytes, const XmlRules& rules, std::vector<XmlMistake>& mistakes) {
  if (auto mistake = mistake_of_bytes(bytes, rules)) {
    mistakes.push_back(std::move(*mistake));
    return std::nullopt;
  }
  const std::string_view xml = without_mark(bytes);
  XmlPlaces places = find_places(xml, rules);
  if (!places.mistakes.empty()) {
    std::move(places.mistakes.begin(), places.mistakes.end(), std::back_inserter(mistakes));
    return std::nullopt;
  }
  const auto document = std::make_unique<tinyxml2::XMLDocument>();
  if (document->Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS || document->RootElement() == nullptr) {
    mistakes.push_back(mistake_of_library(*document, places, xml, rules));
    return std::nullopt;
  }
  return Copier(places, rules.tolerant).copy(*document->RootElement());
}

std::string xml_root_name(std::string_view bytes, const XmlRules& rules) {
  if (bytes.size() > rules.max_bytes) {
    return {};
  }
  const XmlPlaces places = find_places(without_mark(bytes), rules);
  return places.tags.empty() ? std::string{} : std::string(places.tags.front().name);
}

}  // namespace indurop::base
