// SPDX-License-Identifier: Apache-2.0
#include "control/plc/plcopen/xml_writer.h"

#include <fmt/format.h>

#include "core/base/xml_text.h"

namespace indurop::plc::plcopen {
namespace {

// Returns whether XML allows the character: it has no other control characters.
bool is_character(char c) noexcept {
  return static_cast<unsigned char>(c) >= 0x20 || c == '\t' || c == '\n' || c == '\r';
}

std::string escaped(std::string_view text, bool in_attribute) {
  std::string out;
  for (const char c : base::xml_text(text)) {
    if (c == '\r' || (in_attribute && (c == '\n' || c == '\t'))) {
      out += fmt::format("&#{};", static_cast<int>(c));
    } else {
      out += is_character(c) ? c : ' ';
    }
  }
  return out;
}

// Editors show text in CDATA unchanged. CDATA cannot contain its own end: there it is split.
std::string unescaped(std::string_view text) {
  constexpr std::string_view kEnd = "]]>";
  std::string out = "<![CDATA[";
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.substr(i).starts_with(kEnd)) {
      out += "]]]]><![CDATA[>";
      i += kEnd.size() - 1;
    } else if (text[i] != '\r') {
      out += is_character(text[i]) ? text[i] : ' ';
    }
  }
  return out + kEnd.data();
}

}  // namespace

void XmlWriter::begin(std::string_view name, const Attributes& attributes) {
  out_ += fmt::format("{}<{}", std::string(2 * open_.size(), ' '), name);
  for (const auto& [attribute, value] : attributes) {
    out_ += fmt::format(" {}=\"{}\"", attribute, escaped(value, true));
  }
}

void XmlWriter::open(std::string_view name, const Attributes& attributes) {
  begin(name, attributes);
  out_ += ">\n";
  open_.emplace_back(name);
}

void XmlWriter::close() {
  const std::string name = std::move(open_.back());
  open_.pop_back();
  out_ += fmt::format("{}</{}>\n", std::string(2 * open_.size(), ' '), name);
}

void XmlWriter::leaf(std::string_view name, const Attributes& attributes) {
  begin(name, attributes);
  out_ += "/>\n";
}

void XmlWriter::attribute_text(std::string_view name, std::string_view attribute, std::string_view value,
                               std::string_view text) {
  begin(name, {{attribute, std::string(value)}});
  out_ += fmt::format(">{}</{}>\n", escaped(text, false), name);
}

void XmlWriter::text(std::string_view name, std::string_view text) {
  begin(name, {});
  out_ += fmt::format(">{}</{}>\n", escaped(text, false), name);
}

void XmlWriter::formatted(std::string_view name, std::string_view text) {
  begin(name, {});
  out_ += fmt::format("><xhtml:p>{}</xhtml:p></{}>\n", unescaped(text), name);
}

std::string XmlWriter::take() {
  return std::move(out_);
}

}  // namespace indurop::plc::plcopen
