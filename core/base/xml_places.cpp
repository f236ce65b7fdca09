// SPDX-License-Identifier: Apache-2.0
#include "core/base/xml_places.h"

#include <algorithm>
#include <utility>

#include "core/base/text.h"
#include "core/base/utf8.h"
#include "core/base/xml_characters.h"

namespace indurop::base {
namespace {

constexpr std::size_t kMaxMistakes = 200;

std::string at(SourcePlace place) {
  return std::to_string(place.line) + ":" + std::to_string(place.column);
}

class Scanner {
 public:
  Scanner(std::string_view xml, const XmlRules& rules) : xml_(xml), rules_(rules) {}

  XmlPlaces run() {
    while (!stopped_ && !at_end()) {
      if (peek() == '<') {
        markup();
      } else {
        character_data();
      }
    }
    if (!stopped_) {
      finish();
    }
    if (rules_.tolerant && at_end() && !open_.empty()) {
      found_.unclosed = open_.back();
    }
    std::stable_sort(found_.mistakes.begin(), found_.mistakes.end(), [](const XmlMistake& a, const XmlMistake& b) {
      return a.place.line != b.place.line ? a.place.line < b.place.line : a.place.column < b.place.column;
    });
    return std::move(found_);
  }

 private:
  [[nodiscard]] bool at_end() const noexcept { return pos_ >= xml_.size(); }
  [[nodiscard]] char peek() const noexcept { return xml_[pos_]; }
  [[nodiscard]] bool starts_with(std::string_view text) const noexcept { return xml_.substr(pos_).starts_with(text); }
  [[nodiscard]] SourcePlace here() const noexcept { return {line_, column_}; }

  void advance() {
    const char c = xml_[pos_];
    if (c == '\n') {
      ++line_;
      column_ = 1;
      ++pos_;
      return;
    }
    if (rules_.tolerant) {
      ++pos_;
      column_ += continues_utf8(c) ? 0 : 1;
      return;
    }
    const std::size_t length = utf8_length(xml_.substr(pos_));
    if (length == 0) {
      stop(here(), "this is not UTF-8; save the file in the encoding UTF-8");
      return;
    }
    if (static_cast<unsigned char>(c) < 0x20 && !is_xml_space(c)) {
      stop(here(), "control characters are not allowed in XML; remove this one");
      return;
    }
    pos_ += length;
    ++column_;
  }
  void advance(std::size_t bytes) {
    const std::size_t end = std::min(pos_ + bytes, xml_.size());
    while (!stopped_ && pos_ < end) {
      advance();
    }
  }
  void skip_space() {
    while (!stopped_ && !at_end() && is_xml_space(peek())) {
      advance();
    }
  }
  // Advances past `end`; returns false if the text ends before.
  bool skip_behind(std::string_view end) {
    const std::size_t found = xml_.find(end, pos_);
    if (found == std::string_view::npos) {
      return false;
    }
    advance(found + end.size() - pos_);
    return !stopped_;
  }
  std::string_view name() {
    const std::size_t start = pos_;
    while (!stopped_ && !at_end() && continues_xml_name(peek())) {
      advance();
    }
    return xml_.substr(start, pos_ - start);
  }

  void note(SourcePlace place, std::string text) {
    if (rules_.tolerant) {
      return;
    }
    found_.mistakes.push_back({place, std::move(text)});
    stopped_ = stopped_ || found_.mistakes.size() >= kMaxMistakes;
  }
  void stop(SourcePlace place, std::string text) {
    note(place, std::move(text));
    stopped_ = true;
  }
  // A limit is exceeded, which is a mistake in tolerant reading, too: the XML library would take it.
  void refuse(SourcePlace place, std::string text) {
    found_.mistakes.push_back({place, std::move(text)});
    stopped_ = true;
  }

  void markup() {
    const SourcePlace start = here();
    if (starts_with("<!--")) {
      comment(start);
    } else if (starts_with("<![CDATA[")) {
      cdata(start);
    } else if (starts_with("<?")) {
      instruction(start);
    } else if (starts_with("<!") && rules_.tolerant) {
      if (!skip_behind(">")) {
        stop(start, {});
      }
    } else if (starts_with("<!")) {
      stop(start, "document type and entity declarations are not accepted; remove this one");
    } else if (starts_with("</")) {
      end_tag(start);
    } else {
      start_tag(start);
    }
  }

  void comment(SourcePlace start) {
    advance(4);
    const std::size_t nested = xml_.find("<!--", pos_);
    if (stopped_) {
      return;
    }
    if (!skip_behind("-->")) {
      if (!stopped_) {
        stop(start, "this comment has no end; write --> after it");
      }
    } else if (nested < pos_ && !rules_.tolerant) {
      stop(start, "a comment inside a comment: this one already ends at " + at(here()) + "; remove the inner one");
    }
  }

  void cdata(SourcePlace start) {
    advance(9);
    if (open_.empty()) {
      stop(start, "text outside of the root element; move it into an element or a comment");
      return;
    }
    remember_text(here());
    if (!stopped_ && !skip_behind("]]>") && !stopped_) {
      stop(start, "this CDATA section has no end; write ]]> after it");
    }
  }

  void instruction(SourcePlace start) {
    const std::size_t begin = pos_;
    advance(2);
    if (!skip_behind("?>")) {
      if (!stopped_) {
        stop(start, "this has no end; write ?> after it");
      }
      return;
    }
    const std::string_view text = xml_.substr(begin, pos_ - begin);
    if (!rules_.tolerant && text.size() > 5 && text.starts_with("<?xml") && is_xml_space(text[5])) {
      declaration(start, text);
    }
  }

  void declaration(SourcePlace start, std::string_view text) {
    if (!found_.tags.empty()) {
      stop(start, "the XML declaration belongs at the start of the file; remove this one");
      return;
    }
    const std::size_t key = text.find("encoding");
    const std::size_t open = key == std::string_view::npos ? key : text.find_first_of("\"'", key);
    const std::size_t close = open == std::string_view::npos ? open : text.find(text[open], open + 1);
    if (close == std::string_view::npos) {
      return;
    }
    const std::string_view encoding = text.substr(open + 1, close - open - 1);
    std::string upper(encoding);
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    if (upper != "UTF-8" && upper != "UTF8" && upper != "US-ASCII" && upper != "ASCII") {
      stop(start,
           "encoding " + in_quotes(encoding) + " is not accepted; save the file as UTF-8 and write encoding=\"UTF-8\"");
    }
  }

  void end_tag(SourcePlace start) {
    advance(2);
    const std::string_view closed = name();
    skip_space();
    if (stopped_) {
      return;
    }
    if (at_end() || peek() != '>') {
      stop(start, "the end tag " + in_quotes("</" + std::string(closed)) + " lacks its '>'");
      return;
    }
    advance();
    if (open_.empty()) {
      stop(start,
           "</" + std::string(closed) + "> closes nothing; remove it or add <" + std::string(closed) + "> before");
      return;
    }
    const TagPlaces& tag = found_.tags[open_.back()];
    if (tag.name != closed) {
      stop(start, "</" + std::string(closed) + "> where </" + std::string(tag.name) + "> must come first: <" +
                      std::string(tag.name) + "> was opened at " + at(tag.place));
      return;
    }
    open_.pop_back();
  }

  void start_tag(SourcePlace start) {
    advance();
    if (at_end() || !begins_xml_name(peek())) {
      stop(start, "'<' does not begin a tag here; as text write &lt;");
      return;
    }
    if (open_.empty() && !found_.tags.empty()) {
      stop(start, "a second root element; there is one, with everything inside");
      return;
    }
    if (open_.size() >= rules_.max_depth) {
      refuse(start, "elements are nested deeper than " + std::to_string(rules_.max_depth) + " levels; no " +
                        rules_.purpose + " needs that");
      return;
    }
    TagPlaces tag;
    tag.place = start;
    tag.name = name();
    const bool closed = attributes(tag);
    found_.tags.push_back(std::move(tag));
    if (!stopped_ && !closed) {
      open_.push_back(found_.tags.size() - 1);
    }
  }

  // Advances past '>' of a start tag. Returns true if it was "/>".
  bool attributes(TagPlaces& tag) {
    while (!stopped_) {
      const bool separated = !at_end() && is_xml_space(peek());
      skip_space();
      if (stopped_) {
        return true;
      }
      if (starts_with("/>")) {
        advance(2);
        return true;
      }
      if (!at_end() && peek() == '>') {
        advance();
        return false;
      }
      if (at_end() || !begins_xml_name(peek())) {
        stop(tag.place, "the tag <" + std::string(tag.name) + " lacks its '>'");
      } else if (!separated) {
        stop(here(), "a space is missing before this attribute");
      } else if (tag.attributes.size() >= rules_.max_attributes) {
        refuse(here(), "more than " + std::to_string(rules_.max_attributes) +
                           " attributes in one tag; no element has that many");
      } else {
        attribute(tag);
      }
    }
    return true;
  }

  void attribute(TagPlaces& tag) {
    AttributePlaces attribute;
    attribute.place = here();
    attribute.name = name();
    skip_space();
    if (stopped_) {
      return;
    }
    const std::string hint = "; write " + std::string(attribute.name) + "=\"...\"";
    if (at_end() || peek() != '=') {
      stop(attribute.place, "attribute " + in_quotes(attribute.name) + " has no value" + hint);
      return;
    }
    advance();
    skip_space();
    if (stopped_) {
      return;
    }
    if (at_end() || (peek() != '"' && peek() != '\'')) {
      stop(here(), "the value of " + in_quotes(attribute.name) + " is not in quotes" + hint);
      return;
    }
    const char quote = peek();
    advance();
    attribute.value = here();
    while (!stopped_ && !at_end() && peek() != quote && peek() != '<') {
      value_character();
    }
    if (stopped_) {
      return;
    }
    if (at_end() || peek() == '<') {
      stop(attribute.value,
           "the value of " + in_quotes(attribute.name) + " has no closing quote before the next tag" + hint);
      return;
    }
    advance();
    const bool twice = std::any_of(tag.attributes.begin(), tag.attributes.end(),
                                   [&](const AttributePlaces& other) { return other.name == attribute.name; });
    if (twice) {
      stop(attribute.place, "attribute " + in_quotes(attribute.name) + " appears twice in this tag; remove one");
    }
    tag.attributes.push_back(attribute);
  }

  void character_data() {
    const SourcePlace start = here();
    const char c = peek();
    if (!is_xml_space(c)) {
      if (open_.empty()) {
        stop(start, found_.tags.empty()
                        ? std::string("the file does not begin with a tag; a ") + rules_.name + " is " + rules_.form
                        : "text after the root element; move it into an element or a comment");
        return;
      }
      remember_text(start);
    } else if (rules_.tolerant && !open_.empty()) {
      white_space();
      return;
    }
    value_character();
  }

  // White space before a text belongs to the text; alone it is no text.
  void white_space() {
    const SourcePlace start = here();
    skip_space();
    if (!at_end() && peek() != '<') {
      remember_text(start);
    }
  }

  void value_character() {
    if (peek() == '&') {
      if (std::string mistake = mistake_of_reference(xml_.substr(pos_ + 1)); !mistake.empty()) {
        note(here(), std::move(mistake));
      }
    }
    advance();
  }

  void remember_text(SourcePlace place) {
    if (TagPlaces& tag = found_.tags[open_.back()]; tag.text.line == 0) {
      tag.text = place;
    }
  }

  void finish() {
    if (!open_.empty()) {
      const TagPlaces& tag = found_.tags[open_.back()];
      note(tag.place, "<" + std::string(tag.name) + "> is never closed; add </" + std::string(tag.name) + ">");
    } else if (found_.tags.empty()) {
      note(here(), std::string("the file has no element; a ") + rules_.name + " is " + rules_.form);
    }
  }

  std::string_view xml_;
  const XmlRules& rules_;
  std::size_t pos_ = 0;
  int line_ = 1;
  int column_ = 1;
  bool stopped_ = false;
  std::vector<std::size_t> open_;  // indices of tags not closed yet
  XmlPlaces found_;
};

}  // namespace

XmlPlaces find_places(std::string_view xml, const XmlRules& rules) {
  return Scanner(xml, rules).run();
}

}  // namespace indurop::base
