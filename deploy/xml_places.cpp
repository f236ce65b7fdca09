// SPDX-License-Identifier: Apache-2.0
#include "deploy/xml_places.h"

#include <algorithm>
#include <charconv>

#include "deploy/text.h"
#include "schema/utf8.h"

namespace indurop::deploy {
namespace {

constexpr std::size_t kMaxAttributes = 32;
constexpr std::size_t kMaxMistakes = 200;

bool is_space(char c) noexcept {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}
bool is_name_start(char c) noexcept {
  const auto byte = static_cast<unsigned char>(c);
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == ':' || byte >= 0x80;
}
bool is_name(char c) noexcept {
  return is_name_start(c) || (c >= '0' && c <= '9') || c == '.' || c == '-';
}

std::string at(Place place) {
  return std::to_string(place.line) + ":" + std::to_string(place.column);
}

class Scanner {
 public:
  explicit Scanner(std::string_view xml) : xml_(xml) {}

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
    std::stable_sort(found_.mistakes.begin(), found_.mistakes.end(), [](const XmlMistake& a, const XmlMistake& b) {
      return a.place.line != b.place.line ? a.place.line < b.place.line : a.place.column < b.place.column;
    });
    return std::move(found_);
  }

 private:
  [[nodiscard]] bool at_end() const noexcept { return pos_ >= xml_.size(); }
  [[nodiscard]] char peek() const noexcept { return xml_[pos_]; }
  [[nodiscard]] bool starts_with(std::string_view text) const noexcept { return xml_.substr(pos_).starts_with(text); }
  [[nodiscard]] Place here() const noexcept { return {line_, column_}; }

  void advance() {
    const char c = xml_[pos_];
    if (c == '\n') {
      ++line_;
      column_ = 1;
      ++pos_;
      return;
    }
    const std::size_t length = schema::utf8_length(xml_.substr(pos_));
    if (length == 0) {
      stop(here(), "this is not UTF-8; save the file in the encoding UTF-8");
      return;
    }
    if (static_cast<unsigned char>(c) < 0x20 && !is_space(c)) {
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
    while (!stopped_ && !at_end() && is_space(peek())) {
      advance();
    }
  }
  // Up to behind `end`; false if the text ends before.
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
    while (!stopped_ && !at_end() && is_name(peek())) {
      advance();
    }
    return xml_.substr(start, pos_ - start);
  }

  void note(Place place, std::string text) {
    found_.mistakes.push_back({place, std::move(text)});
    stopped_ = stopped_ || found_.mistakes.size() >= kMaxMistakes;
  }
  void stop(Place place, std::string text) {
    note(place, std::move(text));
    stopped_ = true;
  }

  void markup() {
    const Place start = here();
    if (starts_with("<!--")) {
      comment(start);
    } else if (starts_with("<![CDATA[")) {
      cdata(start);
    } else if (starts_with("<?")) {
      instruction(start);
    } else if (starts_with("<!")) {
      stop(start, "document type and entity declarations are not accepted; remove this one");
    } else if (starts_with("</")) {
      end_tag(start);
    } else {
      start_tag(start);
    }
  }

  void comment(Place start) {
    advance(4);
    const std::size_t nested = xml_.find("<!--", pos_);
    if (stopped_) {
      return;
    }
    if (!skip_behind("-->")) {
      if (!stopped_) {
        stop(start, "this comment has no end; write --> behind it");
      }
    } else if (nested < pos_) {
      stop(start, "a comment inside a comment: this one already ends at " + at(here()) + "; remove the inner one");
    }
  }

  void cdata(Place start) {
    advance(9);
    if (open_.empty()) {
      stop(start, "text outside of the root element; move it into an element or a comment");
      return;
    }
    remember_text(here());
    if (!stopped_ && !skip_behind("]]>") && !stopped_) {
      stop(start, "this CDATA section has no end; write ]]> behind it");
    }
  }

  void instruction(Place start) {
    const std::size_t begin = pos_;
    advance(2);
    if (!skip_behind("?>")) {
      if (!stopped_) {
        stop(start, "this has no end; write ?> behind it");
      }
      return;
    }
    const std::string_view text = xml_.substr(begin, pos_ - begin);
    if (text.size() > 5 && text.starts_with("<?xml") && is_space(text[5])) {
      declaration(start, text);
    }
  }

  void declaration(Place start, std::string_view text) {
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

  void end_tag(Place start) {
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

  void start_tag(Place start) {
    advance();
    if (at_end() || !is_name_start(peek())) {
      stop(start, "'<' does not begin a tag here; as text write &lt;");
      return;
    }
    if (open_.empty() && !found_.tags.empty()) {
      stop(start, "a second root element; there is one <root> with all modules inside");
      return;
    }
    if (open_.size() >= kMaxDepth) {
      stop(start,
           "elements are nested deeper than " + std::to_string(kMaxDepth) + " levels; no configuration needs that");
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

  // Up to behind '>' of a start tag. True: it was "/>".
  bool attributes(TagPlaces& tag) {
    while (!stopped_) {
      const bool separated = !at_end() && is_space(peek());
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
      if (at_end() || !is_name_start(peek())) {
        stop(tag.place, "the tag <" + std::string(tag.name) + " lacks its '>'");
      } else if (!separated) {
        stop(here(), "a space is missing before this attribute");
      } else if (tag.attributes.size() >= kMaxAttributes) {
        stop(here(),
             "more than " + std::to_string(kMaxAttributes) + " attributes in one tag; no element has that many");
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
    const Place start = here();
    const char c = peek();
    if (!is_space(c)) {
      if (open_.empty()) {
        stop(start, found_.tags.empty() ? "the file does not begin with a tag; a module.xml begins with <root>"
                                        : "text behind the root element; move it into an element or a comment");
        return;
      }
      remember_text(start);
    }
    value_character();
  }

  void value_character() {
    if (peek() == '&') {
      entity();
    }
    advance();
  }

  void entity() {
    const std::string_view rest = xml_.substr(pos_ + 1, 12);
    const std::size_t end = rest.find(';');
    const std::string_view reference = end == std::string_view::npos ? std::string_view{} : rest.substr(0, end);
    for (const std::string_view known : {"amp", "lt", "gt", "quot", "apos"}) {
      if (reference == known) {
        return;
      }
    }
    if (!reference.starts_with('#')) {
      note(here(), "'&' begins no known entity; as text write &amp;");
    } else if (!is_character(reference.substr(1))) {
      note(here(), in_quotes("&" + std::string(reference) + ";") + " is not a character XML allows; remove it");
    }
  }

  static bool is_character(std::string_view number) {
    const bool hex = number.starts_with('x');
    if (hex) {
      number.remove_prefix(1);
    }
    std::uint32_t code = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), code, hex ? 16 : 10);
    if (error != std::errc{} || end != number.data() + number.size()) {
      return false;
    }
    return code == 9 || code == 10 || code == 13 || (code >= 0x20 && code < 0xD800) ||
           (code >= 0xE000 && code < 0x110000 && code != 0xFFFE && code != 0xFFFF);
  }

  void remember_text(Place place) {
    if (TagPlaces& tag = found_.tags[open_.back()]; tag.text.line == 0) {
      tag.text = place;
    }
  }

  void finish() {
    if (!open_.empty()) {
      const TagPlaces& tag = found_.tags[open_.back()];
      note(tag.place, "<" + std::string(tag.name) + "> is never closed; add </" + std::string(tag.name) + ">");
    } else if (found_.tags.empty()) {
      note(here(), "the file has no element; a module.xml is <root> with one <module> per program");
    }
  }

  std::string_view xml_;
  std::size_t pos_ = 0;
  int line_ = 1;
  int column_ = 1;
  bool stopped_ = false;
  std::vector<std::size_t> open_;  // indices of tags not closed yet
  XmlPlaces found_;
};

}  // namespace

XmlPlaces find_places(std::string_view xml) {
  return Scanner(xml).run();
}

}  // namespace indurop::deploy
