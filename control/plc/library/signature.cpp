// SPDX-License-Identifier: Apache-2.0
#include "control/plc/library/signature.h"

#include <algorithm>

namespace indurop::plc {
namespace {

LibraryType type_named(std::string_view name) {
  if (const auto elementary = elementary_named(name)) {
    return *elementary;
  }
  for (const Generic generic :
       {Generic::AnyElementary, Generic::AnyNum, Generic::AnyInt, Generic::AnyReal, Generic::AnyBit}) {
    if (name == name_of(generic)) {
      return generic;
    }
  }
  return Generic::Any;
}

// Returns the member of the block's struct: lower case, and not a word of C++.
std::string member_named(std::string_view name) {
  std::string member;
  for (const char c : name) {
    member += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return member == "auto" ? "automatic" : member;
}

// Reads "R/RESET BOOL".
LibraryParameter make_parameter(std::string_view text) {
  const std::size_t blank = text.find(' ');
  const std::string_view names = text.substr(0, blank);
  const std::size_t slash = names.find('/');
  LibraryParameter parameter;
  parameter.name = names.substr(0, slash);
  if (slash != std::string_view::npos) {
    parameter.alias = names.substr(slash + 1);
  }
  parameter.type = type_named(text.substr(blank + 1));
  parameter.cpp = member_named(parameter.name);
  return parameter;
}

std::vector<LibraryParameter> make_parameters(std::string_view list) {
  std::vector<LibraryParameter> parameters;
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(", "), list.size());
    parameters.push_back(make_parameter(list.substr(0, comma)));
    list.remove_prefix(std::min(comma + 2, list.size()));
  }
  return parameters;
}

struct Parts {
  std::string_view name;
  std::string_view inputs;
  std::string_view outputs;
};
Parts split(std::string_view signature) {
  const std::size_t open = signature.find('(');
  const std::size_t close = signature.find("): ");
  return {signature.substr(0, open), signature.substr(open + 1, close - open - 1), signature.substr(close + 3)};
}

}  // namespace

LibraryFunction make_function(std::string_view signature, std::string_view cpp) {
  Parts parts = split(signature);
  LibraryFunction function;
  function.name = parts.name;
  function.extensible = parts.inputs.ends_with("...");
  parts.inputs.remove_suffix(function.extensible ? 3 : 0);
  function.inputs = make_parameters(parts.inputs);
  function.result = type_named(parts.outputs);
  function.faults = cpp.starts_with('!');
  function.joins = cpp.starts_with('+');
  function.cpp = "iec::" + std::string(cpp.substr(function.faults || function.joins ? 1 : 0));
  return function;
}

LibraryBlock make_block(std::string_view signature, std::string_view cpp) {
  const Parts parts = split(signature);
  LibraryBlock block;
  block.name = parts.name;
  block.inputs = make_parameters(parts.inputs);
  block.outputs = make_parameters(parts.outputs);
  block.cpp = "iec::" + std::string(cpp);
  return block;
}

}  // namespace indurop::plc
