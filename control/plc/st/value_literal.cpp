// SPDX-License-Identifier: Apache-2.0
#include "control/plc/st/value_literal.h"

#include <fmt/format.h>

#include <algorithm>

#include "control/plc/st/literal.h"

namespace indurop::plc {
namespace {

using st::Literal;

bool put_text(const std::string& text, std::span<std::uint8_t> bytes) {
  if (text.size() >= bytes.size()) {
    return false;
  }
  std::fill(std::copy(text.begin(), text.end(), bytes.begin()), bytes.end(), std::uint8_t{0});
  return true;
}

Literal literal_of(std::string_view text) {
  if (same_name(text, "TRUE") || same_name(text, "FALSE")) {
    Literal made;
    made.value = same_name(text, "TRUE");
    return made;
  }
  const std::size_t hash = text.find('#');
  if (hash == std::string_view::npos) {
    return {};
  }
  const bool based = text.find_first_not_of("0123456789") == hash;  // 16#FF
  return based ? st::number_literal(text) : st::typed_literal(text);
}

// Returns the literal in the notation of shared variables.
std::string plain(const Literal& literal) {
  const std::string sign = literal.negative ? "-" : "";
  if (const auto* truth = std::get_if<bool>(&*literal.value)) {
    return *truth ? "true" : "false";
  }
  if (const auto* number = std::get_if<std::uint64_t>(&*literal.value)) {
    return sign + fmt::format("{}", *number);
  }
  if (const auto* real = std::get_if<double>(&*literal.value)) {
    return sign + fmt::format("{}", *real);
  }
  const auto* ns = std::get_if<std::int64_t>(&*literal.value);
  return ns == nullptr ? std::string() : fmt::format("{}", *ns);
}

}  // namespace

bool read_value_literal(const schema::Type& type, std::string_view text, std::span<std::uint8_t> bytes) {
  if (!type.dims.empty()) {
    return false;
  }
  if (type.base == schema::Base::Text) {
    if (text.size() < 2 || text.front() != '\'' || text.back() != '\'') {
      return false;
    }
    const Literal literal = st::text_literal(text);
    return literal.value && put_text(std::get<std::string>(*literal.value), bytes);
  }
  const Literal literal = literal_of(text);
  return literal.value && schema::parse_value(type, plain(literal), bytes).ok();
}

}  // namespace indurop::plc
