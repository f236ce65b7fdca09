// SPDX-License-Identifier: Apache-2.0
#include "config/xml/element_rules.h"

#include <algorithm>

#include "config/xml/values.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

// Editors add these attributes to find the schema; they have no meaning for InduRoP.
bool is_schema_attribute(const std::string& name) {
  return name == "xmlns" || name.starts_with("xmlns:") || name.starts_with("xsi:");
}

void unknown_attribute(const base::Element& element, const base::Attribute& a, const std::vector<std::string>& known,
                       base::Diagnostics& report) {
  report.error(a.place, "unknown attribute " + base::in_quotes(a.name) + " of <" + element.name + ">" +
                            (known.empty() ? "; it has none, remove it" : base::suggestion(a.name, known)));
}

std::string enumerate_or(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  }
  return text;
}

}  // namespace

bool is_known(const base::Element& child, const base::Element& container, const std::vector<std::string>& known,
              base::Diagnostics& report) {
  if (std::find(known.begin(), known.end(), child.name) != known.end()) {
    return true;
  }
  report.error(child.place, "unknown element " + base::in_quotes("<" + child.name + ">") + " in <" + container.name +
                                ">" + base::suggestion(child.name, known));
  return false;
}

bool is_first(const base::Element& child, const std::string& container, FirstPlaces& places,
              base::Diagnostics& report) {
  const auto [first, is_first] = places.try_emplace(child.name, child.place);
  if (!is_first) {
    report.error(child.place, "a second <" + child.name + "> in " + container + "; the first is in line " +
                                  std::to_string(first->second.line) + ", remove one");
  }
  return is_first;
}

bool is_leaf(const base::Element& element, base::Diagnostics& report) {
  if (element.children.empty()) {
    return true;
  }
  report.error(element.children.front().place, "<" + element.name + "> takes a value, not the element " +
                                                   base::in_quotes("<" + element.children.front().name + ">") +
                                                   "; is </" + element.name + "> missing before it?");
  return false;
}

void check_attributes(const base::Element& element, const std::vector<std::string>& known, base::Diagnostics& report) {
  for (const base::Attribute& a : element.attributes) {
    if (std::find(known.begin(), known.end(), a.name) == known.end()) {
      unknown_attribute(element, a, known, report);
    }
  }
}

void check_root_attributes(const base::Element& root, const std::vector<std::string>& known,
                           base::Diagnostics& report) {
  for (const base::Attribute& a : root.attributes) {
    if (!is_schema_attribute(a.name) && std::find(known.begin(), known.end(), a.name) == known.end()) {
      unknown_attribute(root, a, known, report);
    }
  }
}

const base::Attribute* find_attribute(const base::Element& element, std::string_view name) {
  const auto found = std::find_if(element.attributes.begin(), element.attributes.end(),
                                  [name](const base::Attribute& a) { return a.name == name; });
  return found == element.attributes.end() ? nullptr : &*found;
}

const base::Attribute* need_attribute(const base::Element& element, const char* name, std::string_view example,
                                      base::Diagnostics& report) {
  const base::Attribute* found = find_attribute(element, name);
  if (found != nullptr && !found->value.empty()) {
    return found;
  }
  report.error(element.place, "<" + element.name + "> needs a " + name + "; write " + std::string(example));
  return nullptr;
}

std::optional<std::string> text_of(const base::Element& element, std::string_view example, base::Diagnostics& report) {
  check_attributes(element, {}, report);
  if (!is_leaf(element, report)) {
    return std::nullopt;
  }
  if (element.text.empty()) {
    report.error(element.place, "<" + element.name + "> is empty; write, for example, <" + element.name + ">" +
                                    std::string(example) + "</" + element.name + ">");
    return std::nullopt;
  }
  return element.text;
}

std::optional<base::Nanos> duration_of(const base::Element& element, bool zero_allowed, base::Diagnostics& report) {
  const auto text = text_of(element, "1ms", report);
  if (!text) {
    return std::nullopt;
  }
  base::DurationText read = base::read_duration(*text, zero_allowed);
  if (!read.value) {
    report.error(element.text_place, "<" + element.name + ">: " + read.problem);
  }
  return read.value;
}

bool is_file_name(const base::Element& element, const std::string& text, base::Diagnostics& report) {
  const std::string last = std::filesystem::path(text).filename().string();
  if (last.empty() || last == "." || last == "..") {
    report.error(element.text_place, base::path_in_quotes(text) + " is a directory; give the file in it");
    return false;
  }
  if (text.find_first_of("\r\n\t") != std::string::npos) {
    report.error(element.text_place, "the file name contains a tab or line break; write it in one line");
    return false;
  }
  return true;
}

std::optional<std::size_t> choose(const base::Element& element, const std::vector<std::string>& words,
                                  base::Diagnostics& report) {
  const auto text = text_of(element, words.front(), report);
  if (!text) {
    return std::nullopt;
  }
  const auto found = std::find(words.begin(), words.end(), *text);
  if (found == words.end()) {
    report.error(element.text_place,
                 base::in_quotes(*text) + " is not a value of <" + element.name + ">; write " + enumerate_or(words));
    return std::nullopt;
  }
  return static_cast<std::size_t>(found - words.begin());
}

void check_no_text(const base::Element& container, base::Diagnostics& report) {
  if (!container.text.empty()) {
    report.error(container.text_place, "text " + base::in_quotes(container.text) + " inside <" + container.name +
                                           ">; put values in elements and comments in <!-- -->");
  }
}

int read_core(const base::Element& element, base::Diagnostics& report) {
  check_attributes(element, {}, report);
  if (!is_leaf(element, report)) {
    return -1;
  }
  constexpr std::int64_t kMaxCores = 4096;
  const auto value = read_integer(element.text, 0, kMaxCores - 1);
  if (!value) {
    report.error(element.text_place,
                 "<core>: " + base::in_quotes(element.text) + " is not a processor number; write 0 for the first");
    return -1;
  }
  return static_cast<int>(*value);
}

}  // namespace indurop::config
