// SPDX-License-Identifier: Apache-2.0
// Converts values to text for people and to JSON. One walk over the type makes both; they differ only in the leaves.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/base/utf8.h"
#include "core/schema/leaf.h"

namespace indurop::schema {
namespace {

class Writer {
 public:
  explicit Writer(bool as_json) : json_(as_json) {}

  void value(const Type& type, std::size_t dim, const std::uint8_t* at) {
    if (dim == type.dims.size()) {
      element(type, at);
      return;
    }
    const std::uint64_t stride = stride_of(type, dim);
    out_ += '[';
    for (std::uint32_t i = 0; i < type.dims[dim]; ++i) {
      out_ += i == 0 ? "" : comma();
      value(type, dim + 1, at + i * stride);
    }
    out_ += ']';
  }

  std::string take() { return std::move(out_); }

 private:
  [[nodiscard]] const char* comma() const noexcept { return json_ ? "," : ", "; }

  void element(const Type& type, const std::uint8_t* at) {
    if (with_number(type.base, at, [this](auto number) { this->number(number); })) {
      return;
    }
    if (type.base == Base::Bool) {
      out_ += *at != 0 ? "true" : "false";
    } else if (type.base == Base::Char) {
      character(*at);
    } else if (type.base == Base::Text) {
      const auto* text = reinterpret_cast<const char*>(at);
      quoted({text, strnlen(text, type.text_size)});
    } else if (type.base == Base::Enum) {
      enumerator(type, load<std::int32_t>(at));
    } else {
      fields(type, at);
    }
  }

  template <class Number>
  void number(Number number) {
    if constexpr (std::is_floating_point_v<Number>) {
      if (!std::isfinite(number)) {
        const char* infinite = number > 0 ? "inf" : "-inf";
        const char* text = std::isnan(number) ? "nan" : infinite;
        out_ += json_ ? "null" : text;
        return;
      }
    }
    fmt::format_to(std::back_inserter(out_), "{}", number);
  }

  void character(std::uint8_t c) {
    const char quote = json_ ? '"' : '\'';
    out_ += quote;
    if (c < 0x80) {
      escaped(static_cast<char>(c), quote);
    } else {
      unprintable(c);
    }
    out_ += quote;
  }

  void quoted(std::string_view text) {
    out_ += '"';
    while (!text.empty()) {
      const std::size_t length = base::utf8_length(text);
      if (length > 1) {
        out_ += text.substr(0, length);
      } else if (length == 1) {
        escaped(text.front(), '"');
      } else if (json_) {
        out_ += "\\ufffd";
      } else {
        unprintable(static_cast<unsigned char>(text.front()));
      }
      text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    out_ += '"';
  }

  // Writes one ASCII character of a text between `quote`s.
  void escaped(char c, char quote) {
    constexpr std::string_view kShort = "\nn\tt\rr";
    if (const std::size_t known = kShort.find(c); known != std::string_view::npos && known % 2 == 0) {
      out_ += '\\';
      out_ += kShort[known + 1];
    } else if (c < ' ' || c == '\x7f') {
      unprintable(static_cast<unsigned char>(c));
    } else {
      out_ += c == quote || c == '\\' ? "\\" : "";
      out_ += c;
    }
  }
  void unprintable(unsigned code) {
    fmt::format_to(std::back_inserter(out_), fmt::runtime(json_ ? "\\u{:04x}" : "\\x{:02x}"), code);
  }

  void enumerator(const Type& type, std::int32_t number) {
    const auto found = std::find_if(type.enumerators.begin(), type.enumerators.end(),
                                    [number](const Enumerator& e) { return e.value == number; });
    if (found == type.enumerators.end()) {
      this->number(number);
    } else if (json_) {
      quoted(found->name);
    } else {
      out_ += found->name;
    }
  }

  void fields(const Type& type, const std::uint8_t* at) {
    out_ += '{';
    for (const Field& field : type.fields) {
      out_ += out_.back() == '{' ? "" : comma();
      if (json_) {
        quoted(field.name);
        out_ += ':';
      } else {
        out_ += field.name;
        out_ += ": ";
      }
      value(field.type, 0, at + field.offset);
    }
    out_ += '}';
  }

  bool json_;
  std::string out_;
};

std::string write(bool as_json, const Type& type, std::span<const std::uint8_t> bytes) {
  if (bytes.size() < type.size()) {
    return {};
  }
  Writer writer(as_json);
  writer.value(type, 0, bytes.data());
  return writer.take();
}

}  // namespace

std::string format_value(const Type& type, std::span<const std::uint8_t> bytes) {
  return write(false, type, bytes);
}

std::string value_to_json(const Type& type, std::span<const std::uint8_t> bytes) {
  std::string out = write(true, type, bytes);
  return out.empty() ? "null" : out;
}

}  // namespace indurop::schema
