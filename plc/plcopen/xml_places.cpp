// SPDX-License-Identifier: Apache-2.0
#include "plc/plcopen/xml_places.h"

#include <algorithm>

namespace indurop::plc::plcopen {
namespace {

class Scanner {
 public:
  explicit Scanner(std::string_view xml) : xml_(xml) {}

  TagPlaces run() {
    while (pos_ < xml_.size()) {
      if (xml_[pos_] == '<') {
        markup();
      } else {
        text();
      }
    }
    if (!open_.empty()) {
      found_.open = open_.back().name;
      found_.open_line = found_.tags[open_.back().tag].line;
    }
    return std::move(found_);
  }

 private:
  struct Open {
    std::size_t tag;
    std::string name;
  };

  void advance_to(std::size_t end) {
    for (; pos_ < std::min(end, xml_.size()); ++pos_) {
      if (xml_[pos_] == '\n') {
        ++line_;
        column_ = 1;
      } else if ((static_cast<unsigned char>(xml_[pos_]) & 0xC0U) != 0x80U) {
        ++column_;
      }
    }
  }
  void advance_behind(std::string_view end) {
    const std::size_t found = xml_.find(end, pos_);
    advance_to(found == std::string_view::npos ? xml_.size() : found + end.size());
  }

  void remember_text() {
    if (!open_.empty() && found_.tags[open_.back().tag].text_line == 0) {
      found_.tags[open_.back().tag].text_line = line_;
      found_.tags[open_.back().tag].text_column = column_;
    }
  }

  // White space alone is no text, but belongs to the text that follows it.
  void text() {
    const std::size_t end = std::min(xml_.find('<', pos_), xml_.size());
    if (xml_.substr(pos_, end - pos_).find_first_not_of(" \t\r\n") != std::string_view::npos) {
      remember_text();
    }
    advance_to(end);
  }

  void markup() {
    const std::string_view rest = xml_.substr(pos_);
    if (rest.starts_with("<!--")) {
      advance_behind("-->");
    } else if (rest.starts_with("<![CDATA[")) {
      advance_to(pos_ + 9);
      remember_text();
      advance_behind("]]>");
    } else if (rest.starts_with("<?") || rest.starts_with("<!")) {
      advance_behind(">");
    } else if (rest.starts_with("</")) {
      if (!open_.empty()) {
        open_.pop_back();
      }
      advance_behind(">");
    } else {
      start_tag();
    }
  }

  void start_tag() {
    const std::size_t start = pos_;
    found_.tags.push_back({line_, column_, 0, 0});
    const std::size_t name_end = std::min(xml_.find_first_of(" \t\r\n/>", pos_), xml_.size());
    std::size_t end = name_end;
    char quote = 0;
    for (; end < xml_.size() && (quote != 0 || xml_[end] != '>'); ++end) {
      const char c = xml_[end];
      if (quote != 0) {
        quote = c == quote ? '\0' : quote;
      } else if (c == '"' || c == '\'') {
        quote = c;
      }
    }
    const bool closed = end > start && end < xml_.size() && xml_[end - 1] == '/';
    if (!closed) {
      open_.push_back({found_.tags.size() - 1, std::string(xml_.substr(start + 1, name_end - start - 1))});
      if (open_.size() > found_.depth) {
        found_.depth = open_.size();
        found_.deepest_line = line_;
      }
    }
    advance_to(end + 1);
  }

  std::string_view xml_;
  std::size_t pos_ = 0;
  std::uint32_t line_ = 1;
  std::uint32_t column_ = 1;
  std::vector<Open> open_;
  TagPlaces found_;
};

}  // namespace

TagPlaces find_tags(std::string_view xml) {
  return Scanner(xml).run();
}

}  // namespace indurop::plc::plcopen
