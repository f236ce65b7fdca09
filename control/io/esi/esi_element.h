// SPDX-License-Identifier: Apache-2.0
// An element of an ESI file: its children by name, its values, and what is wrong with them.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/base/text.h"
#include "core/base/xml_element.h"

namespace indurop::io::esi {

class EsiElement {
 public:
  // Borrows both.
  EsiElement(const base::Element& element, base::Diagnostics& report) : element_(&element), report_(&report) {}

  [[nodiscard]] const std::string& name() const noexcept { return element_->name; }
  // Without the white space around it.
  [[nodiscard]] std::string text() const { return std::string(base::trimmed(element_->text)); }
  [[nodiscard]] base::SourcePlace place() const noexcept { return element_->place; }
  [[nodiscard]] bool has(std::string_view child) const { return find(child).has_value(); }

  [[nodiscard]] std::optional<EsiElement> find(std::string_view child) const;
  // Reports that it is missing.
  [[nodiscard]] std::optional<EsiElement> need(std::string_view child) const;
  [[nodiscard]] std::vector<EsiElement> all(std::string_view child) const;
  // The text of a child that is there once for each language: the English one, else the first.
  [[nodiscard]] std::string english(std::string_view child) const;

  // A number from 0 to `most`; 0 if it is absent, or wrong, which is reported. In hexadecimal digits after #x.
  [[nodiscard]] std::uint32_t number(std::uint32_t most) const;
  [[nodiscard]] std::uint32_t number(std::string_view attribute, std::uint32_t most) const;
  // A whole number in decimal digits, which may be below 0.
  [[nodiscard]] std::int64_t whole() const;
  [[nodiscard]] std::int64_t whole(std::string_view attribute) const;
  [[nodiscard]] bool flag(std::string_view attribute) const;
  [[nodiscard]] std::optional<std::string> attribute(std::string_view name) const;
  // Pairs of hexadecimal digits.
  [[nodiscard]] std::vector<std::uint8_t> bytes() const;

  void error(const std::string& text) const { report_->error(element_->place, text); }

 private:
  [[nodiscard]] const base::Attribute* find_attribute(std::string_view name) const;
  [[nodiscard]] std::uint32_t number_of(const std::string& what, std::string_view text, base::SourcePlace place,
                                        std::uint32_t most) const;
  [[nodiscard]] std::int64_t whole_of(const std::string& what, std::string_view text, base::SourcePlace place) const;

  const base::Element* element_;
  base::Diagnostics* report_;
};

}  // namespace indurop::io::esi
