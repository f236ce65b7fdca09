// SPDX-License-Identifier: Apache-2.0
#include "core/base/json.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace indurop::base {
namespace {

constexpr std::size_t kMaxLevels = 64;  // limit for recursive destruction and writing

// Builds a Json from the parser's events.
class Reader {
 public:
  using Native = nlohmann::ordered_json;

  bool null() { return put(Json()); }
  bool boolean(bool value) { return put(Json(value)); }
  bool number_integer(Native::number_integer_t value) { return put(Json(value)); }
  bool number_unsigned(Native::number_unsigned_t value) { return put(Json(value)); }
  bool number_float(Native::number_float_t value, const std::string& /*text*/) { return put(Json(value)); }
  bool string(std::string& value) { return put(Json(std::move(value))); }
  bool binary(Native::binary_t& /*value*/) { return false; }
  bool start_object(std::size_t /*size*/) { return begin(Json::object()); }
  bool start_array(std::size_t /*size*/) { return begin(Json::array()); }
  bool end_object() { return end(); }
  bool end_array() { return end(); }
  bool key(std::string& name) {
    open_.back().key = std::move(name);
    return true;
  }
  bool parse_error(std::size_t /*at*/, const std::string& /*token*/, const Native::exception& /*error*/) {
    return false;
  }

  Json take() { return std::move(whole_); }

 private:
  struct Level {
    Json value;
    std::string key;  // of the next member
  };

  bool put(Json value) {
    if (open_.empty()) {
      whole_ = std::move(value);
    } else if (Level& level = open_.back(); level.value.is_object()) {
      level.value[level.key] = std::move(value);
    } else {
      level.value.push_back(std::move(value));
    }
    return true;
  }
  bool begin(Json value) {
    open_.push_back({std::move(value), {}});
    return open_.size() <= kMaxLevels;
  }
  bool end() {
    Json value = std::move(open_.back().value);
    open_.pop_back();
    return put(std::move(value));
  }

  Json whole_;
  std::vector<Level> open_;
};

std::string scalar(const Reader::Native& value) {
  return value.dump(-1, ' ', false, Reader::Native::error_handler_t::replace);
}

bool contains_object(const Json& value) noexcept {
  const auto values = value.values();
  return std::any_of(values.begin(), values.end(),
                     [](const Json& one) { return one.is_object() || contains_object(one); });
}

}  // namespace

Json::Json() noexcept = default;
Json::Json(std::nullptr_t) noexcept {}
Json::Json(const char* text) : type_(Type::Text), text_(text) {}
Json::Json(std::string text) : type_(Type::Text), text_(std::move(text)) {}
Json::Json(std::string_view text) : type_(Type::Text), text_(text) {}
Json::Json(double value) noexcept : type_(Type::Number), number_(value) {}
Json::Json(const std::vector<std::string>& texts) : type_(Type::Array), values_(texts.begin(), texts.end()) {}
Json::Json(const Json& other) = default;
Json::Json(Json&& other) noexcept = default;
Json& Json::operator=(const Json& other) = default;
Json& Json::operator=(Json&& other) noexcept = default;
Json::~Json() = default;

Json::Json(std::initializer_list<Json> values) {
  const bool members = std::all_of(values.begin(), values.end(), [](const Json& each) {
    return each.is_array() && each.values_.size() == 2 && each.values_[0].is_text();
  });
  type_ = members ? Type::Object : Type::Array;
  for (const Json& each : values) {
    if (members) {
      (*this)[each.values_[0].text_] = each.values_[1];
    } else {
      values_.push_back(each);
    }
  }
}

Json Json::array() {
  Json made;
  made.type_ = Type::Array;
  return made;
}

Json Json::object() {
  Json made;
  made.type_ = Type::Object;
  return made;
}

std::optional<Json> Json::parse(std::string_view text) {
  Reader reader;
  if (!Reader::Native::sax_parse(text, &reader)) {
    return std::nullopt;
  }
  return reader.take();
}

Json& Json::operator[](std::string_view key) {
  const auto at = std::find(keys_.begin(), keys_.end(), key);
  if (at != keys_.end()) {
    return values_[static_cast<std::size_t>(at - keys_.begin())];
  }
  type_ = Type::Object;
  keys_.emplace_back(key);
  return values_.emplace_back();
}

void Json::push_back(Json value) {
  type_ = Type::Array;
  values_.push_back(std::move(value));
}

void Json::update(const Json& other) {
  for (std::size_t i = 0; i < other.keys_.size(); ++i) {
    (*this)[other.keys_[i]] = other.values_[i];
  }
}

void Json::write(std::string& out, int indent, int depth) const {
  const auto new_line = [&](int level) {
    if (indent >= 0) {
      out += '\n';
      out.append(static_cast<std::size_t>(indent) * static_cast<std::size_t>(level), ' ');
    }
  };
  switch (type_) {
    case Type::Null:
      out += "null";
      return;
    case Type::Boolean:
      out += integer_ != 0 ? "true" : "false";
      return;
    case Type::Integer:
      out += std::to_string(static_cast<std::int64_t>(integer_));
      return;
    case Type::Natural:
      out += std::to_string(integer_);
      return;
    case Type::Number:
      out += scalar(number_);
      return;
    case Type::Text:
      out += scalar(text_);
      return;
    case Type::Array:
    case Type::Object:
      break;
  }
  const bool object = type_ == Type::Object;
  out += object ? '{' : '[';
  for (std::size_t i = 0; i < values_.size(); ++i) {
    out += i == 0 ? "" : ",";
    new_line(depth + 1);
    if (object) {
      out += scalar(keys_[i]) + (indent >= 0 ? ": " : ":");
    }
    values_[i].write(out, indent, depth + 1);
  }
  if (!values_.empty()) {
    new_line(depth);
  }
  out += object ? '}' : ']';
}

std::string Json::dump(int indent) const {
  std::string out;
  write(out, indent, 0);
  return out;
}

void Json::write_rows(std::string& out, int depth) const {
  const bool is_scalar = type_ != Type::Array && type_ != Type::Object;
  if (is_scalar || (depth > 0 && !contains_object(*this))) {
    write(out, -1, 0);
    return;
  }
  const std::string line = "\n" + std::string(2 * static_cast<std::size_t>(depth), ' ');
  const bool object = type_ == Type::Object;
  out += object ? '{' : '[';
  for (std::size_t i = 0; i < values_.size(); ++i) {
    out += (i == 0 ? "" : ",") + line + "  ";
    if (object) {
      out += scalar(keys_[i]) + ": ";
    }
    values_[i].write_rows(out, depth + 1);
  }
  out += (values_.empty() ? "" : line) + (object ? "}" : "]");
}

std::string Json::dump_rows() const {
  std::string out;
  write_rows(out, 0);
  return out;
}

const Json* Json::find(std::string_view key) const noexcept {
  const auto at = std::find(keys_.begin(), keys_.end(), key);
  return at == keys_.end() ? nullptr : &values_[static_cast<std::size_t>(at - keys_.begin())];
}

const Json& Json::operator[](std::string_view key) const noexcept {
  static const Json kNull;
  const Json* found = find(key);
  return found == nullptr ? kNull : *found;
}

std::optional<std::string> Json::text() const {
  return is_text() ? std::optional(text_) : std::nullopt;
}

std::optional<std::int64_t> Json::integer() const noexcept {
  const bool fits = type_ == Type::Integer || (type_ == Type::Natural && integer_ <= INT64_MAX);
  return fits ? std::optional(static_cast<std::int64_t>(integer_)) : std::nullopt;
}

std::optional<std::uint64_t> Json::natural() const noexcept {
  return type_ == Type::Natural ? std::optional(integer_) : std::nullopt;
}

std::optional<double> Json::number() const noexcept {
  switch (type_) {
    case Type::Integer:
      return static_cast<double>(static_cast<std::int64_t>(integer_));
    case Type::Natural:
      return static_cast<double>(integer_);
    case Type::Number:
      return number_;
    default:
      return std::nullopt;
  }
}

std::optional<bool> Json::boolean() const noexcept {
  return type_ == Type::Boolean ? std::optional(integer_ != 0) : std::nullopt;
}

namespace {

template <class T>
bool take(std::optional<T> from, T& to) {
  if (from) {
    to = std::move(*from);
  }
  return from.has_value();
}

}  // namespace

bool read(const Json& object, std::string_view key, std::string& to) {
  return take(object[key].text(), to);
}

bool read(const Json& object, std::string_view key, std::int64_t& to) {
  return take(object[key].integer(), to);
}

bool read(const Json& object, std::string_view key, std::uint64_t& to) {
  return take(object[key].natural(), to);
}

bool read(const Json& object, std::string_view key, bool& to) {
  return take(object[key].boolean(), to);
}

bool read(const Json& object, std::string_view key, std::vector<std::string>& to) {
  std::vector<std::string> texts;
  for (const Json& each : object[key].values()) {
    if (!each.is_text()) {
      return false;
    }
    texts.push_back(*each.text());
  }
  if (!object[key].is_array()) {
    return false;
  }
  to = std::move(texts);
  return true;
}

}  // namespace indurop::base
