// SPDX-License-Identifier: Apache-2.0
#include "control/io/esi/esi_element.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace indurop::io::esi {

namespace {

constexpr std::string_view kEnglish = "1033";  // as Windows numbers languages
constexpr int kHex = 16;

template <class T>
std::optional<T> read_number(std::string_view text, int base) {
  T number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  return error == std::errc() && end == text.data() + text.size() && !text.empty() ? std::optional(number)
                                                                                   : std::nullopt;
}

}  // namespace

std::optional<EsiElement> EsiElement::find(std::string_view child) const {
  const auto found = std::find_if(element_->children.begin(), element_->children.end(),
                                  [child](const base::Element& element) { return element.name == child; });
  return found == element_->children.end() ? std::nullopt : std::optional(EsiElement(*found, *report_));
}

std::optional<EsiElement> EsiElement::need(std::string_view child) const {
  auto found = find(child);
  if (!found) {
    error(fmt::format("<{}> has no <{}>; is this the whole file of the maker?", element_->name, child));
  }
  return found;
}

std::vector<EsiElement> EsiElement::all(std::string_view child) const {
  std::vector<EsiElement> found;
  for (const base::Element& element : element_->children) {
    if (element.name == child) {
      found.emplace_back(element, *report_);
    }
  }
  return found;
}

std::string EsiElement::english(std::string_view child) const {
  const auto names = all(child);
  const auto found = std::find_if(names.begin(), names.end(), [](const EsiElement& name) {
    const auto language = name.attribute("LcId");
    return !language || *language == kEnglish;
  });
  return found != names.end() ? found->text() : names.empty() ? std::string() : names.front().text();
}

const base::Attribute* EsiElement::find_attribute(std::string_view name) const {
  const auto found = std::find_if(element_->attributes.begin(), element_->attributes.end(),
                                  [name](const base::Attribute& attribute) { return attribute.name == name; });
  return found == element_->attributes.end() ? nullptr : &*found;
}

std::optional<std::string> EsiElement::attribute(std::string_view name) const {
  const base::Attribute* const found = find_attribute(name);
  return found == nullptr ? std::nullopt : std::optional(found->value);
}

std::uint32_t EsiElement::number_of(const std::string& what, std::string_view text, base::SourcePlace place,
                                    std::uint32_t most) const {
  const auto digits = base::trimmed(text);
  const auto number = digits.starts_with("#x") ? read_number<std::uint64_t>(digits.substr(2), kHex)
                                               : read_number<std::uint64_t>(digits, 10);
  if (!number || *number > most) {
    report_->error(
        place, fmt::format("{}: {} is no number from 0 to {}; write 18 or #x12", what, base::in_quotes(text), most));
    return 0;
  }
  return static_cast<std::uint32_t>(*number);
}

std::int64_t EsiElement::whole_of(const std::string& what, std::string_view text, base::SourcePlace place) const {
  constexpr std::int64_t kMost = 1'000'000'000'000;
  auto digits = base::trimmed(text);
  digits.remove_prefix(digits.starts_with('+') ? 1 : 0);
  const auto number = read_number<std::int64_t>(digits, 10);
  if (!number || *number < -kMost || *number > kMost) {
    report_->error(place, fmt::format("{}: {} is no whole number", what, base::in_quotes(text)));
    return 0;
  }
  return *number;
}

std::uint32_t EsiElement::number(std::uint32_t most) const {
  return number_of(element_->name, element_->text, element_->text_place, most);
}

std::uint32_t EsiElement::number(std::string_view attribute, std::uint32_t most) const {
  const base::Attribute* const found = find_attribute(attribute);
  return found == nullptr ? 0 : number_of(found->name, found->value, found->value_place, most);
}

std::int64_t EsiElement::whole() const {
  return whole_of(element_->name, element_->text, element_->text_place);
}

std::int64_t EsiElement::whole(std::string_view attribute) const {
  const base::Attribute* const found = find_attribute(attribute);
  return found == nullptr ? 0 : whole_of(found->name, found->value, found->value_place);
}

bool EsiElement::flag(std::string_view attribute) const {
  const base::Attribute* const found = find_attribute(attribute);
  if (found == nullptr || found->value == "0" || found->value == "false") {
    return false;
  }
  if (found->value != "1" && found->value != "true") {
    report_->error(found->value_place,
                   fmt::format("{}: {} is none of 0, 1, false and true", found->name, base::in_quotes(found->value)));
  }
  return true;
}

std::vector<std::uint8_t> EsiElement::bytes() const {
  std::vector<std::uint8_t> all;
  const std::string digits = text();
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    const auto byte = read_number<std::uint8_t>(std::string_view(digits).substr(i, 2), kHex);
    if (!byte) {
      break;
    }
    all.push_back(*byte);
  }
  if (2 * all.size() != digits.size()) {
    report_->error(element_->text_place, fmt::format("{}: {} is no row of bytes; write two hexadecimal digits for each",
                                                     element_->name, base::in_quotes(digits)));
  }
  return all;
}

}  // namespace indurop::io::esi
