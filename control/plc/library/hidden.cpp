// SPDX-License-Identifier: Apache-2.0
#include "control/plc/library/hidden.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "control/plc/library/signature.h"

namespace indurop::plc {
namespace {

std::vector<LibraryFunction> make_hidden() {
  std::vector<LibraryFunction> out;
  out.push_back(make_function("@LOG(LEVEL INT, MSG STRING): BOOL", "log_message"));
  for (const auto& [name, unit] :
       {std::pair(kTicksNs, "1"), std::pair(kTicksUs, "iec::kMicrosecond"), std::pair(kTicksMs, "iec::kMillisecond")}) {
    for (std::size_t i = 0; i < kElementaryCount; ++i) {
      const auto type = static_cast<Elementary>(i);
      if (is_num(type) || (is_bit(type) && type != Elementary::Bool)) {
        out.push_back(make_function(fmt::format("{}(): {}", name, name_of(type)),
                                    fmt::format("ticks<{}, {}>", cpp_type(type), unit)));
      }
    }
  }
  return out;
}

// Returns the generic type that the name replaces: that of the result, else of the first input that has one.
std::optional<Generic> named_generic(const LibraryFunction& function) {
  if (const auto* result = std::get_if<Generic>(&function.result)) {
    return *result;
  }
  for (const LibraryParameter& one : function.inputs) {
    if (const auto* generic = std::get_if<Generic>(&one.type)) {
      return *generic;
    }
  }
  return std::nullopt;
}

std::optional<LibraryFunction> typed(const LibraryFunction& function, Elementary type) {
  if (function.result == LibraryType(Elementary::String) || function.result == LibraryType(Elementary::Wstring)) {
    return std::nullopt;  // LEFT and so on count in any type
  }
  const auto generic = named_generic(function);
  if (!generic || !accepts(*generic, type)) {
    return std::nullopt;
  }
  LibraryFunction out = function;
  for (LibraryParameter& one : out.inputs) {
    one.type = one.type == LibraryType(*generic) ? LibraryType(type) : one.type;
  }
  out.result = out.result == LibraryType(*generic) ? LibraryType(type) : out.result;
  return out;
}

// The overloaded functions of the standard's tables; not conversions, which have two types in their names.
std::map<std::string, LibraryFunction> make_typed() {
  std::map<std::string, LibraryFunction> out;
  for (const LibraryFunction& function : library_functions()) {
    if (function.name.find('_') != std::string::npos) {
      continue;
    }
    for (std::size_t i = 0; i < kElementaryCount; ++i) {
      if (auto made = typed(function, static_cast<Elementary>(i))) {
        out.emplace(fmt::format("{}_{}", function.name, name_of(static_cast<Elementary>(i))), std::move(*made));
      }
    }
  }
  return out;
}

}  // namespace

std::vector<const LibraryFunction*> find_typed(std::string_view name) {
  static const std::map<std::string, LibraryFunction> kAll = make_typed();
  const auto found = kAll.find(upper(name));
  return found == kAll.end() ? std::vector<const LibraryFunction*>() : std::vector{&found->second};
}

const LibraryFunction* find_hidden(std::string_view name, std::optional<Elementary> wanted) {
  static const std::vector<LibraryFunction> kAll = make_hidden();
  const auto found = std::find_if(kAll.begin(), kAll.end(), [&](const LibraryFunction& one) {
    return one.name == name && (name == kLogMessage || (wanted && one.result == LibraryType(*wanted)));
  });
  return found == kAll.end() ? nullptr : &*found;
}

}  // namespace indurop::plc
