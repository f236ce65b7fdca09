// SPDX-License-Identifier: Apache-2.0
// irp_printf of <indurop/module_c.h>: takes the arguments of C with the types that the format names.

#include <indurop/detail/print_argument.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace {

using indurop::detail::print_argument;
using indurop::detail::PrintArgument;

constexpr std::size_t kMaxArguments = 64;  // of one message, which has 487 bytes
constexpr int kMaxField = 1000;            // more is cut

// The arguments of one call.
class Arguments {
 public:
  // `list` is advanced.
  void take(const char* format, std::va_list& list) noexcept {
    for (const char* at = std::strchr(format, '%'); at != nullptr; at = std::strchr(at, '%')) {
      ++at;
      at = *at == '%' ? at + 1 : take_one(at, list);
    }
  }
  [[nodiscard]] const PrintArgument* data() const noexcept { return all_.data(); }
  [[nodiscard]] std::uint32_t count() const noexcept { return static_cast<std::uint32_t>(count_); }

 private:
  void add(PrintArgument one) noexcept {
    if (count_ < all_.size()) {
      all_[count_++] = one;
    }
  }

  // Flags, width, precision, length, type. Returns what follows them.
  const char* take_one(const char* at, std::va_list& list) noexcept {
    at += std::strspn(at, "-+ #0");
    (void)take_number(at, list);
    int precision = -1;
    if (*at == '.') {
      precision = take_number(++at, list);
    }
    int longs = 0;  // on this platform each of them makes an integer one of 64 bits
    bool is_long_double = false;
    for (; *at != '\0' && std::strchr("hlLqjzt", *at) != nullptr; ++at) {
      longs += *at == 'h' || *at == 'L' ? 0 : 1;
      is_long_double = is_long_double || *at == 'L';
    }
    if (*at == '\0') {
      return at;
    }
    if (std::strchr("dic", *at) != nullptr) {
      add(longs > 0 ? print_argument(va_arg(list, std::int64_t)) : print_argument(va_arg(list, int)));
    } else if (std::strchr("uoxX", *at) != nullptr) {
      add(longs > 0 ? print_argument(va_arg(list, std::uint64_t)) : print_argument(va_arg(list, unsigned)));
    } else if (std::strchr("eEfFgGaA", *at) != nullptr) {
      add(print_argument(is_long_double ? static_cast<double>(va_arg(list, long double)) : va_arg(list, double)));
    } else if (*at == 's') {
      add(text(va_arg(list, const char*), precision));
    } else if (*at == 'p') {
      add(print_argument(va_arg(list, const void*)));
    }
    return at + 1;
  }

  // A width or precision: digits, or `*` for an argument. `at` is advanced.
  int take_number(const char*& at, std::va_list& list) noexcept {
    if (*at == '*') {
      ++at;
      const int value = va_arg(list, int);
      add(print_argument(value));
      return value;
    }
    int value = 0;
    for (; *at >= '0' && *at <= '9'; ++at) {
      value = std::min(value * 10 + (*at - '0'), kMaxField);
    }
    return value;
  }

  // As in C, a text with a precision need not end with NUL.
  static PrintArgument text(const char* text, int precision) noexcept {
    if (text == nullptr || precision < 0) {
      return print_argument(text);
    }
    return indurop::detail::text_argument({text, strnlen(text, static_cast<std::size_t>(precision))});
  }

  std::array<PrintArgument, kMaxArguments> all_{};
  std::size_t count_ = 0;
};

}  // namespace

extern "C" [[gnu::format(printf, 1, 2)]] int irp_printf(const char* format, ...) noexcept {
  Arguments arguments;
  std::va_list list;
  va_start(list, format);
  arguments.take(format, list);
  va_end(list);
  return indurop_print(format, arguments.data(), arguments.count());
}
