// SPDX-License-Identifier: Apache-2.0
// Writes XML: elements inside each other, indented, with everything escaped that has to be.

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
  // <name><xhtml:p>text</xhtml:p></name>, as the format has texts for people and programs
  void formatted(std::string_view name, std::string_view text);

  [[nodiscard]] std::string take();

 private:
  void begin(std::string_view name, const Attributes& attributes);

  std::string out_ = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n";
  std::vector<std::string> open_;
};

}  // namespace indurop::plc::plcopen
