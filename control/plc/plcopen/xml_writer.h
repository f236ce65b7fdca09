// SPDX-License-Identifier: Apache-2.0
// Writes XML: nested elements, indented, with all special characters escaped.

#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace indurop::plc::plcopen {

class XmlWriter {
 public:
  using Attributes = std::vector<std::pair<std::string_view, std::string>>;

  // <name a="b">; each is closed once.
  void open(std::string_view name, const Attributes& attributes = {});
  void close();
  // <name a="b"/>
  void leaf(std::string_view name, const Attributes& attributes = {});
  // <name>text</name>
  void text(std::string_view name, std::string_view text);
  // <name attribute="value">text</name>
  void attribute_text(std::string_view name, std::string_view attribute, std::string_view value, std::string_view text);
  // <name><xhtml:p>text</xhtml:p></name>, the form of the format for comments and code
  void formatted(std::string_view name, std::string_view text);

  [[nodiscard]] std::string take();

 private:
  void begin(std::string_view name, const Attributes& attributes);

  std::string out_ = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n";
  std::vector<std::string> open_;
};

}  // namespace indurop::plc::plcopen
