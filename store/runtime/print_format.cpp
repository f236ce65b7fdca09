// SPDX-License-Identifier: Apache-2.0

#include "store/runtime/print_format.h"

#include <algorithm>
#include <climits>
#include <cstdio>
#include <cstring>

namespace indurop::runtime {

namespace {

using detail::PrintArgument;
using Kind = PrintArgument::Kind;

// The C library allocates for enormous fields; nothing beyond the message is visible anyway.
constexpr int kMaxField = 500;

// One conversion: "%" flags width "." precision length type.
struct Conversion {
  bool left = false, plus = false, blank = false, alternate = false, zero = false;
  int width = 0;
  int precision = -1;
  int narrow = 0;  // number of 'h'
  char type = 0;   // 0: the format ended before it
};

class Writer {
 public:
  Writer(char* to, std::size_t size) noexcept : to_(to), room_(size - 1) {}

  void put(const char* text, std::size_t length) noexcept {
    const std::size_t fits = std::min(length, room_ - used_);
    std::memcpy(to_ + used_, text, fits);
    used_ += fits;
    cut_ = cut_ || fits < length;
  }
  // snprintf to the current position.
  template <class... Value>
  void print(const char* spec, Value... value) noexcept {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
    const int length = std::snprintf(to_ + used_, room_ - used_ + 1, spec, value...);
#pragma GCC diagnostic pop
    if (length > 0) {
      const std::size_t fits = std::min(static_cast<std::size_t>(length), room_ - used_);
      cut_ = cut_ || fits < static_cast<std::size_t>(length);
      used_ += fits;
    }
  }
  std::size_t finish() noexcept {
    if (cut_) {
      std::memcpy(to_ + room_ - kCutMark, "[cut]\n", kCutMark);
    }
    to_[used_] = '\0';
    return used_;
  }
  [[nodiscard]] bool full() const noexcept {
    return cut_;
  }

 private:
  char* to_;
  std::size_t room_;
  std::size_t used_ = 0;
  bool cut_ = false;
};

class Formatter {
 public:
  Formatter(Writer& out, const char* format, std::span<const PrintArgument> arguments) noexcept
      : out_(out), at_(format), arguments_(arguments) {}

  void run() noexcept {
    while (*at_ != '\0' && !out_.full()) {
      const std::size_t plain = std::strcspn(at_, "%");
      out_.put(at_, plain);
      at_ += plain;
      if (*at_ == '%') {
        convert();
      }
    }
  }

 private:
  void convert() noexcept {
    const char* begin = at_++;
    if (*at_ == '%') {
      out_.put(at_++, 1);
      return;
    }
    const Conversion conversion = parse();
    const bool known = conversion.type != 0 && std::strchr("diouxXeEfFgGaAcspDUO", conversion.type) != nullptr;
    if (!known || next_ >= arguments_.size()) {
      out_.put(begin, static_cast<std::size_t>(at_ - begin));  // shown as written, so that the mistake is visible
      return;
    }
    print(conversion, arguments_[next_++]);
  }

  Conversion parse() noexcept {
    Conversion c;
    for (;; ++at_) {
      switch (*at_) {
        case '-':
          c.left = true;
          continue;
        case '+':
          c.plus = true;
          continue;
        case ' ':
          c.blank = true;
          continue;
        case '#':
          c.alternate = true;
          continue;
        case '0':
          c.zero = true;
          continue;
        default:
          break;
      }
      break;
    }
    c.width = number();
    if (c.width < 0) {  // from `*`
      c.left = true;
      c.width = -c.width;
    }
    if (*at_ == '.') {
      ++at_;
      c.precision = number();
    }
    for (; *at_ != '\0' && std::strchr("hlLqjzt", *at_) != nullptr; ++at_) {
      c.narrow += *at_ == 'h' ? 1 : 0;
    }
    c.type = *at_;
    at_ += *at_ != '\0' ? 1 : 0;
    return c;
  }

  int number() noexcept {
    if (*at_ == '*') {
      ++at_;
      const bool there = next_ < arguments_.size() && arguments_[next_].kind <= Kind::Unsigned;
      return there ? static_cast<int>(std::clamp<std::int64_t>(arguments_[next_++].as_signed, -kMaxField, kMaxField))
                   : 0;
    }
    int value = 0;
    for (; *at_ >= '0' && *at_ <= '9'; ++at_) {
      value = std::min(value * 10 + (*at_ - '0'), kMaxField);
    }
    return value;
  }

  void print(const Conversion& c, const PrintArgument& argument) noexcept {
    switch (argument.kind) {
      case Kind::Signed:
      case Kind::Unsigned:
        return print_integer(c, argument);
      case Kind::Real:
        return print_real(c, argument.as_real);
      case Kind::Text:
        return print_text(c, argument);
      case Kind::Pointer:
        out_.print(spec(c, "", 'p'), c.width, argument.as_pointer);
    }
  }

  void print_integer(const Conversion& c, const PrintArgument& argument) noexcept {
    const bool is_signed = argument.kind == Kind::Signed;
    switch (c.type) {
      case 'e':
      case 'E':
      case 'f':
      case 'F':
      case 'g':
      case 'G':
      case 'a':
      case 'A':
        return print_real(
            c, is_signed ? static_cast<double>(argument.as_signed) : static_cast<double>(argument.as_unsigned));
      case 'c':
        out_.print(spec(c, "", 'c'), c.width, static_cast<int>(static_cast<unsigned char>(argument.as_unsigned)));
        return;
      case 'o':
      case 'u':
      case 'x':
      case 'X':
      case 'U':
      case 'O':
        out_.print(spec(c, "ll", c.type == 'U' ? 'u' : (c.type == 'O' ? 'o' : c.type)), c.width, c.precision,
                   static_cast<unsigned long long>(narrowed(c, argument)));
        return;
      default:  // d, i, s, p: as a number
        if (is_signed) {
          const long long value = c.narrow == 0   ? argument.as_signed
                                  : c.narrow == 1 ? static_cast<short>(argument.as_signed)
                                                  : static_cast<signed char>(argument.as_signed);
          out_.print(spec(c, "ll", 'd'), c.width, c.precision, value);
        } else {
          out_.print(spec(c, "ll", 'u'), c.width, c.precision, static_cast<unsigned long long>(narrowed(c, argument)));
        }
    }
  }

  // The bits that an unsigned conversion shows: those of the argument's own type, or fewer with h and hh.
  static std::uint64_t narrowed(const Conversion& c, const PrintArgument& argument) noexcept {
    const unsigned bytes = c.narrow == 0 ? argument.size : (c.narrow == 1 ? 2 : 1);
    return bytes >= 8 ? argument.as_unsigned : argument.as_unsigned & ((std::uint64_t{1} << (bytes * 8)) - 1);
  }

  void print_real(const Conversion& c, double value) noexcept {
    const bool fits = std::strchr("eEfFgGaA", c.type) != nullptr;
    out_.print(spec(c, "", fits ? c.type : 'g'), c.width, c.precision, value);
  }

  void print_text(const Conversion& c, const PrintArgument& argument) noexcept {
    const int length = static_cast<int>(std::min<std::uint32_t>(argument.size, INT_MAX));
    const bool limited = c.type == 's' && c.precision >= 0 && c.precision < length;
    out_.print(c.left ? "%-*.*s" : "%*.*s", c.width, limited ? c.precision : length, argument.as_text);
  }

  // "%" flags "*" [".*"] length type; a precision of -1 counts as not given.
  const char* spec(const Conversion& c, const char* length, char type) noexcept {
    char* to = spec_;
    *to++ = '%';
    const bool number = type != 'c' && type != 'p';
    for (const auto& [set, flag] : {std::pair{c.left, '-'},
                                    {c.plus && number, '+'},
                                    {c.blank && number, ' '},
                                    {c.alternate && number, '#'},
                                    {c.zero && number, '0'}}) {
      if (set) {
        *to++ = flag;
      }
    }
    *to++ = '*';
    if (number) {
      *to++ = '.';
      *to++ = '*';
    }
    while (*length != '\0') {
      *to++ = *length++;
    }
    *to++ = type;
    *to = '\0';
    return spec_;
  }

  Writer& out_;
  const char* at_;
  std::span<const PrintArgument> arguments_;
  std::size_t next_ = 0;
  char spec_[16] = {};
};

}  // namespace

std::size_t format_message(char* to, std::size_t size, const char* format,
                           std::span<const PrintArgument> arguments) noexcept {
  Writer out(to, size);
  Formatter(out, format == nullptr ? "(null)" : format, arguments).run();
  return out.finish();
}

}  // namespace indurop::runtime
