// SPDX-License-Identifier: Apache-2.0
// Converts text to values: the output of format_value and value_to_json, and what people type instead.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "core/base/nearest.h"
#include "core/schema/cursor.h"
#include "core/schema/leaf.h"

namespace indurop::schema {
namespace {

class Parser {
 public:
  explicit Parser(std::string_view text) : cursor_(text) {}

  // Parses the whole text as one value of `type`. On false, code and message describe the error.
  bool whole(const Type& type, std::uint8_t* to) {
    const std::string_view text = cursor_.all();
    if (type.dims.empty() && type.base == Base::Text && !cursor_.at_quote()) {
      return store_text(type, std::string(text), to);
    }
    if (type.dims.empty() && type.base == Base::Char && text.size() == 1 && (text[0] < '0' || text[0] > '9')) {
      *to = static_cast<std::uint8_t>(text[0]);
      return true;
    }
    if (!value(type, 0, to)) {
      return false;
    }
    cursor_.skip_spaces();
    return cursor_.at_end() || syntax(fmt::format("'{}' after the value", cursor_.rest().substr(0, 20)));
  }

  Failure failure;

 private:
  bool fail(Errc why, std::string what) {
    failure = {why, path_.empty() ? std::move(what) : path_ + ": " + what};
    return false;
  }
  bool syntax(const std::string& what) {
    return fail(Errc::InvalidArgument, fmt::format("{} (column {})", what, cursor_.column()));
  }

  bool quoted(std::string& to) {
    const char* wrong = cursor_.quoted(to);
    return wrong == nullptr || syntax(wrong);
  }

  bool value(const Type& type, std::size_t dim, std::uint8_t* to) {
    if (dim < type.dims.size()) {
      return array(type, dim, to);
    }
    switch (type.base) {
      case Base::Bool:
        return boolean(to);
      case Base::Char:
        return character(to);
      case Base::Int8:
        return integer<std::int8_t>(type, to);
      case Base::UInt8:
        return integer<std::uint8_t>(type, to);
      case Base::Int16:
        return integer<std::int16_t>(type, to);
      case Base::UInt16:
        return integer<std::uint16_t>(type, to);
      case Base::Int32:
        return integer<std::int32_t>(type, to);
      case Base::UInt32:
        return integer<std::uint32_t>(type, to);
      case Base::Int64:
        return integer<std::int64_t>(type, to);
      case Base::UInt64:
        return integer<std::uint64_t>(type, to);
      case Base::Float:
        return real<float>(type, to);
      case Base::Double:
        return real<double>(type, to);
      case Base::Text: {
        std::string text;
        return quoted(text) && store_text(type, text, to);
      }
      case Base::Enum:
        return enumerator(type, to);
      case Base::Struct:
        return fields(type, to);
    }
    return false;
  }

  bool array(const Type& type, std::size_t dim, std::uint8_t* to) {
    const std::uint32_t wanted = type.dims[dim];
    if (!cursor_.take('[')) {
      return syntax(fmt::format("expected '[' and {} values of {}", wanted, element_name(type)));
    }
    const std::uint64_t stride = stride_of(type, dim);
    const std::string outer = path_;
    for (std::uint32_t i = 0; i < wanted; ++i) {
      if (i != 0 && !cursor_.take(',')) {
        return cursor_.peek() == ']' ? syntax(fmt::format("{} values where there must be {}", i, wanted))
                                     : syntax("expected ',' or ']'");
      }
      path_ = fmt::format("{}[{}]", outer, i);
      if (!value(type, dim + 1, to + i * stride)) {
        return false;
      }
      path_ = outer;
    }
    if (cursor_.take(']')) {
      return true;
    }
    return cursor_.peek() == ',' ? syntax(fmt::format("more than {} values", wanted)) : syntax("expected ']'");
  }

  static std::string element_name(const Type& type) {
    Type element = type;
    element.dims.clear();
    return display_name(element);
  }

  bool fields(const Type& type, std::uint8_t* to) {
    if (!cursor_.take('{')) {
      return syntax(fmt::format("expected '{{' and the fields of {}, like {{{}: ...}}", display_name(type),
                                type.fields.empty() ? "" : type.fields.front().name));
    }
    if (cursor_.take('}')) {
      return true;
    }
    std::vector<const Field*> seen;
    const std::string outer = path_;
    do {
      const Field* field = field_name(type);
      if (field == nullptr) {
        return false;
      }
      if (std::find(seen.begin(), seen.end(), field) != seen.end()) {
        return syntax(fmt::format("field '{}' appears twice", field->name));
      }
      seen.push_back(field);
      path_ = outer.empty() ? field->name : outer + "." + field->name;
      if (!value(field->type, 0, to + field->offset)) {
        return false;
      }
      path_ = outer;
    } while (cursor_.take(','));
    return cursor_.take('}') || syntax("expected ',' or '}'");
  }

  // Reads "name:"; returns null if there is no such field.
  const Field* field_name(const Type& type) {
    std::string name;
    if (cursor_.at_quote()) {
      if (!quoted(name)) {
        return nullptr;
      }
    } else {
      name = cursor_.word(':');
    }
    const auto found =
        std::find_if(type.fields.begin(), type.fields.end(), [&](const Field& field) { return field.name == name; });
    if (found == type.fields.end()) {
      std::vector<std::string> names;
      for (const Field& field : type.fields) {
        names.push_back(field.name);
      }
      const std::string near = base::nearest(name, names);
      syntax(fmt::format("{} has no field '{}'; {} {}", display_name(type), name,
                         near.empty() ? "it has" : "did you mean",
                         near.empty() ? fmt::format("{}", fmt::join(names, ", ")) : "'" + near + "'?"));
      return nullptr;
    }
    if (!cursor_.take(':')) {
      syntax(fmt::format("expected ':' after field '{}'", name));
      return nullptr;
    }
    return &*found;
  }

  // A word, or what is there instead of one: a message must show it.
  std::string_view word() {
    constexpr std::size_t kShown = 20;
    const std::string_view text = cursor_.word();
    return text.empty() ? cursor_.rest().substr(0, kShown) : text;
  }

  bool boolean(std::uint8_t* to) {
    const std::string_view text = word();
    if (text != "true" && text != "false" && text != "0" && text != "1") {
      return fail(Errc::InvalidArgument, fmt::format("'{}' is not a bool; write true, false, 1 or 0", text));
    }
    *to = text == "true" || text == "1" ? 1 : 0;
    return true;
  }

  // Reads sign and magnitude of a decimal or 0x number. Returns Ok, InvalidArgument, or OutOfRange beyond 64 bits.
  static Errc read_integer(std::string_view text, bool& negative, std::uint64_t& amount) {
    negative = !text.empty() && text.front() == '-';
    text.remove_prefix(!text.empty() && (text.front() == '-' || text.front() == '+') ? 1 : 0);
    const bool hex = text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X');
    text.remove_prefix(hex ? 2 : 0);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), amount, hex ? 16 : 10);
    if (error == std::errc::invalid_argument || end != text.data() + text.size()) {
      return Errc::InvalidArgument;
    }
    return error == std::errc() ? Errc::Ok : Errc::OutOfRange;
  }

  template <class T>
  bool integer(const Type& type, std::uint8_t* to) {
    const std::string_view text = word();
    bool negative = false;
    std::uint64_t amount = 0;
    const Errc read = read_integer(text, negative, amount);
    if (read == Errc::InvalidArgument) {
      return fail(read, fmt::format("'{}' is not a whole number; {} takes {} to {}", text, name_of(type.base),
                                    std::numeric_limits<T>::min(), std::numeric_limits<T>::max()));
    }
    const auto max = static_cast<std::uint64_t>(std::numeric_limits<T>::max());
    const std::uint64_t limit = !negative ? max : std::is_signed_v<T> ? max + 1 : 0;
    if (read != Errc::Ok || amount > limit) {
      return fail(Errc::OutOfRange, fmt::format("{} does not fit {} ({} to {})", text, name_of(type.base),
                                                std::numeric_limits<T>::min(), std::numeric_limits<T>::max()));
    }
    const T number = static_cast<T>(negative ? 0 - amount : amount);
    std::memcpy(to, &number, sizeof number);
    return true;
  }

  template <class T>
  bool real(const Type& type, std::uint8_t* to) {
    const std::string_view text = word();
    const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
    const std::string_view digits = text.substr(plus ? 1 : 0);
    T number{};
    bool negative = false;
    std::uint64_t amount = 0;
    if (text.find_first_of("xX") != std::string_view::npos && read_integer(text, negative, amount) == Errc::Ok) {
      number = negative ? -static_cast<T>(amount) : static_cast<T>(amount);
    } else {
      const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
      if (error == std::errc::invalid_argument || end != digits.data() + digits.size()) {
        return fail(Errc::InvalidArgument, fmt::format("'{}' is not a number; write it like 2, 0.5 or 1e-3", text));
      }
      if (error != std::errc()) {
        return fail(Errc::OutOfRange, fmt::format("{} does not fit {}", text, name_of(type.base)));
      }
    }
    std::memcpy(to, &number, sizeof number);
    return true;
  }

  bool enumerator(const Type& type, std::uint8_t* to) {
    std::string text;
    if (cursor_.at_quote()) {
      if (!quoted(text)) {
        return false;
      }
    } else {
      text = word();
    }
    const std::size_t scope = text.rfind("::");
    const std::string name = scope == std::string::npos ? text : text.substr(scope + 2);
    bool negative = false;
    std::uint64_t amount = 0;
    const bool numeric = read_integer(text, negative, amount) == Errc::Ok && amount <= INT32_MAX + std::uint64_t{1};
    const std::int64_t number = negative ? -static_cast<std::int64_t>(amount) : static_cast<std::int64_t>(amount);
    const auto found = std::find_if(type.enumerators.begin(), type.enumerators.end(),
                                    [&](const Enumerator& e) { return numeric ? e.value == number : e.name == name; });
    if (found == type.enumerators.end()) {
      return fail(numeric ? Errc::OutOfRange : Errc::InvalidArgument, unknown_enumerator(type, text));
    }
    const auto value = static_cast<std::int32_t>(found->value);
    std::memcpy(to, &value, sizeof value);
    return true;
  }

  static std::string unknown_enumerator(const Type& type, const std::string& text) {
    constexpr std::size_t kShown = 12;
    std::string known;
    for (std::size_t i = 0; i < std::min(type.enumerators.size(), kShown); ++i) {
      known += fmt::format("{}{} = {}", i == 0 ? "" : ", ", type.enumerators[i].name, type.enumerators[i].value);
    }
    return fmt::format("'{}' is not a value of {}; it has {}{}", text, display_name(type), known,
                       type.enumerators.size() > kShown ? ", ..." : "");
  }

  bool character(std::uint8_t* to) {
    if (cursor_.at_quote()) {
      Character c;
      if (const char* wrong = cursor_.quoted_unit(c)) {
        return syntax(wrong);
      }
      *to = static_cast<std::uint8_t>(c.code);
      return c.code <= 0xFF || fail(Errc::OutOfRange, "a char holds one byte");
    }
    const std::string_view text = word();
    bool negative = false;
    std::uint64_t amount = 0;
    const Errc read = read_integer(text, negative, amount);
    if (read == Errc::InvalidArgument) {
      return fail(read, fmt::format("'{}' is not a char; write it like 'a' or as a number", text));
    }
    if (read != Errc::Ok || amount > (negative ? 128U : 255U)) {
      return fail(Errc::OutOfRange, fmt::format("{} does not fit char (-128 to 255)", text));
    }
    *to = static_cast<std::uint8_t>(negative ? 0 - amount : amount);
    return true;
  }

  bool store_text(const Type& type, const std::string& text, std::uint8_t* to) {
    if (text.find('\0') != std::string::npos) {
      return fail(Errc::InvalidArgument, "text cannot contain a NUL");
    }
    if (text.size() >= type.text_size) {
      return fail(Errc::OutOfRange, fmt::format("{} bytes of text do not fit char[{}], which holds {}", text.size(),
                                                type.text_size, type.text_size - 1));
    }
    std::fill(std::copy(text.begin(), text.end(), to), to + type.text_size, std::uint8_t{0});
    return true;
  }

  Cursor cursor_;
  std::string path_;  // of the part being read, for messages
};

}  // namespace

Result<void, Failure> parse_value(const Type& type, std::string_view text, std::span<std::uint8_t> bytes) {
  if (bytes.size() < type.size()) {
    return Failure{Errc::InvalidArgument, "there is less room than the type needs"};
  }
  std::vector<std::uint8_t> copy(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(type.size()));
  Parser parser(text);
  if (!parser.whole(type, copy.data())) {
    return std::move(parser.failure);
  }
  std::copy(copy.begin(), copy.end(), bytes.begin());
  return {};
}

}  // namespace indurop::schema
