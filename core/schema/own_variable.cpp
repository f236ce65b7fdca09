// SPDX-License-Identifier: Apache-2.0
#include "core/schema/own_variable.h"

#include <cxxabi.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <memory>
#include <string_view>

namespace indurop::schema {
namespace {

using std::string_view;

// Objects that compilers make in addition to variables: guards, tables of virtual functions, temporaries.
constexpr std::array<string_view, 4> kOfCompilers{"_ZG", "_ZT", "DW.ref.", "completed."};
constexpr std::array<string_view, 8> kOfOthers{
    "std::", "__gnu_cxx::", "__cxxabiv1::", "Eigen::", "fmt::", "indurop::", "indurop_", "irp::"};
constexpr string_view kUnnamed = "(anonymous namespace)::";

bool begins_with_one_of(string_view text, const auto& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(), [&](string_view one) { return text.starts_with(one); });
}

// C reserves names of this form for compilers and their libraries.
bool is_reserved(string_view symbol) {
  return symbol.size() > 1 && symbol[0] == '_' &&
         (symbol[1] == '_' || std::isupper(static_cast<unsigned char>(symbol[1])) != 0);
}

std::string demangled(const std::string& symbol) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> name(::abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &status),
                                                    &std::free);
  return status == 0 && name != nullptr ? std::string(name.get()) : std::string();
}

// Returns the text after the last "::" outside of parentheses and angle brackets.
string_view last_part(string_view name) {
  int depth = 0;
  for (std::size_t i = name.size(); i > 1; --i) {
    const char c = name[i - 1];
    depth += c == ')' || c == '>' ? 1 : 0;
    depth -= c == '(' || c == '<' ? 1 : 0;
    if (depth == 0 && c == ':' && name[i - 2] == ':') {
      return name.substr(i);
    }
  }
  return name;
}

}  // namespace

std::optional<std::string> own_variable(const std::string& symbol) {
  if (symbol.empty() || begins_with_one_of(symbol, kOfCompilers)) {
    return std::nullopt;
  }
  const bool mangled = symbol.starts_with("_Z");
  if (!mangled) {
    const std::string name = symbol.substr(0, symbol.find('.'));  // C numbers static variables of functions
    return name.empty() || is_reserved(name) || name.starts_with("indurop_") ? std::nullopt : std::optional(name);
  }
  std::string name = demangled(symbol);
  name.resize(std::min(name.find(" [clone"), name.size()));
  while (name.starts_with(kUnnamed)) {
    name.erase(0, kUnnamed.size());
  }
  const bool of_function = symbol.starts_with("_ZZ");
  if (name.empty() || begins_with_one_of(name, kOfOthers) || is_reserved(last_part(name))) {
    return std::nullopt;
  }
  return of_function ? std::string(last_part(name)) : name;
}

}  // namespace indurop::schema
