// SPDX-License-Identifier: Apache-2.0
// A JSON value, for documents we write and small ones we read. Objects keep the order of their members. Hides the JSON
// library, which costs seconds of compile time in every file that includes it.

#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::base {

class Json {
 public:
  enum class Type { Null, Boolean, Integer, Natural, Number, Text, Array, Object };  // Natural: an integer >= 0

  Json() noexcept;
  Json(std::nullptr_t) noexcept;
  Json(const char* text);
  Json(std::string text);
  Json(std::string_view text);
  template <std::same_as<bool> T>  // nothing is converted to bool
  Json(T value) noexcept : Json(Type::Boolean, value ? 1 : 0) {}
  template <std::integral T>
  requires(!std::same_as<T, bool>) Json(T value)
  noexcept
      : Json(std::signed_integral<T> && value < 0 ? Type::Integer : Type::Natural, static_cast<std::uint64_t>(value)) {}
  Json(double value) noexcept;
  Json(const std::vector<std::string>& texts);
  // An object if all values are arrays of a text and a value, else an array.
  Json(std::initializer_list<Json> values);
  Json(const Json& other);
  Json(Json&& other) noexcept;
  Json& operator=(const Json& other);
  Json& operator=(Json&& other) noexcept;
  ~Json();

  static Json array();
  static Json object();
  // Returns nothing if `text` is not JSON, or is nested deeper than 64 levels.
  static std::optional<Json> parse(std::string_view text);

  // ---- writing
  // Returns the member `key`, created if missing; null becomes an object. Must not be called for arrays and scalars.
  Json& operator[](std::string_view key);
  // Appends to an array; null becomes an array.
  void push_back(Json value);
  // Copies the members of another object into this one.
  void update(const Json& other);
  // Writes one line, or lines indented by `indent` >= 0. Invalid UTF-8 is replaced.
  [[nodiscard]] std::string dump(int indent = -1) const;
  // Writes arrays and objects with one line for each element or member, down to values that contain no object: tables
  // have one line for each row.
  [[nodiscard]] std::string dump_rows() const;

  // ---- reading: nothing is thrown; a missing value is null or nothing
  [[nodiscard]] Type type() const noexcept { return type_; }
  [[nodiscard]] bool is_null() const noexcept { return type_ == Type::Null; }
  [[nodiscard]] bool is_text() const noexcept { return type_ == Type::Text; }
  [[nodiscard]] bool is_array() const noexcept { return type_ == Type::Array; }
  [[nodiscard]] bool is_object() const noexcept { return type_ == Type::Object; }
  // Elements of an array, values of an object, else none.
  [[nodiscard]] std::span<const Json> values() const noexcept { return values_; }
  // Names of an object's members, in the order of values(); else none.
  [[nodiscard]] std::span<const std::string> keys() const noexcept { return keys_; }
  // Null if this is no object or has no such member.
  [[nodiscard]] const Json* find(std::string_view key) const noexcept;
  // The member, or null.
  const Json& operator[](std::string_view key) const noexcept;
  [[nodiscard]] std::optional<std::string> text() const;
  [[nodiscard]] std::optional<std::int64_t> integer() const noexcept;
  [[nodiscard]] std::optional<std::uint64_t> natural() const noexcept;
  [[nodiscard]] std::optional<double> number() const noexcept;  // integers too
  [[nodiscard]] std::optional<bool> boolean() const noexcept;

 private:
  Json(Type type, std::uint64_t integer) noexcept : type_(type), integer_(integer) {}

  void write(std::string& out, int indent, int depth) const;
  void write_rows(std::string& out, int depth) const;

  Type type_ = Type::Null;
  std::uint64_t integer_ = 0;  // of Integer in two's complement, of Boolean 0 or 1
  double number_ = 0;
  std::string text_;
  std::vector<Json> values_;
  std::vector<std::string> keys_;  // of an object, parallel to values_
};

// Reads the member `key` of `object`. Returns false if it is missing or of another type; `to` is then unchanged.
bool read(const Json& object, std::string_view key, std::string& to);
bool read(const Json& object, std::string_view key, std::int64_t& to);
bool read(const Json& object, std::string_view key, std::uint64_t& to);
bool read(const Json& object, std::string_view key, bool& to);
bool read(const Json& object, std::string_view key, std::vector<std::string>& to);

// Reads a member that may be missing. Returns false if it is there and of another type.
template <class T>
bool read_if_given(const Json& object, std::string_view key, T& to) {
  return object.find(key) == nullptr || read(object, key, to);
}

}  // namespace indurop::base
