// SPDX-License-Identifier: Apache-2.0
#include "core/schema/idl_word.h"

#include <algorithm>
#include <array>

namespace indurop::schema {
namespace {

using namespace std::string_view_literals;

constexpr std::array kKeywords{
    "abstract"sv,   "alias"sv,     "any"sv,        "attribute"sv,   "bitfield"sv,  "bitmask"sv, "bitset"sv,
    "boolean"sv,    "case"sv,      "char"sv,       "component"sv,   "connector"sv, "const"sv,   "consumes"sv,
    "context"sv,    "custom"sv,    "default"sv,    "double"sv,      "emits"sv,     "enum"sv,    "eventtype"sv,
    "exception"sv,  "factory"sv,   "false"sv,      "finder"sv,      "fixed"sv,     "float"sv,   "getraises"sv,
    "home"sv,       "import"sv,    "in"sv,         "inout"sv,       "int16"sv,     "int32"sv,   "int64"sv,
    "int8"sv,       "interface"sv, "local"sv,      "long"sv,        "manages"sv,   "map"sv,     "mirrorport"sv,
    "module"sv,     "multiple"sv,  "native"sv,     "object"sv,      "octet"sv,     "oneway"sv,  "out"sv,
    "port"sv,       "porttype"sv,  "primarykey"sv, "private"sv,     "provides"sv,  "public"sv,  "publishes"sv,
    "raises"sv,     "readonly"sv,  "sequence"sv,   "setraises"sv,   "short"sv,     "string"sv,  "struct"sv,
    "supports"sv,   "switch"sv,    "true"sv,       "truncatable"sv, "typedef"sv,   "typeid"sv,  "typename"sv,
    "typeprefix"sv, "uint16"sv,    "uint32"sv,     "uint64"sv,      "uint8"sv,     "union"sv,   "unsigned"sv,
    "uses"sv,       "valuebase"sv, "valuetype"sv,  "void"sv,        "wchar"sv,     "wstring"sv};
static_assert(std::is_sorted(kKeywords.begin(), kKeywords.end()));

}  // namespace

bool is_idl_keyword(std::string_view name) {
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return std::binary_search(kKeywords.begin(), kKeywords.end(), std::string_view(lower));
}

std::string idl_name(std::string_view name) {
  return (is_idl_keyword(name) ? "_" : "") + std::string(name);
}

}  // namespace indurop::schema
