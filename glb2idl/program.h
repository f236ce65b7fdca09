// SPDX-License-Identifier: Apache-2.0
// The checked content of a set of .glb files: everything resolved, laid out and computed. Input of the emitters.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/schema/schema.h"
#include "glb2idl/constant.h"

namespace indurop::glb2idl {

struct Constant {
  std::string name;  // full name, as in all items
  Value value;
  std::optional<schema::Base> base;  // const TYPE NAME; none for #define
  std::string description;
  bool in_idl = false;
};

struct Enumeration {
  schema::Type type;  // name empty: only the values are declared
  std::string scope;  // namespace of type and values, "knu::Robot" or ""
  std::string description;
};

struct Structure {
  schema::Type type;
  std::string description;
};

struct Alias {
  std::string name;
  schema::Type type;
};

using Item = std::variant<Constant, Enumeration, Structure, Alias, schema::Variable, schema::Function, schema::Pool>;

// One .glb file.
struct GlbFile {
  std::string path;                   // as given by the user
  std::string stem;                   // "knuRobot"
  std::vector<std::size_t> includes;  // units named by its #include lines, in order
  std::vector<Item> items;            // in order of declaration
};

struct Program {
  std::vector<GlbFile> units;                // each unit comes after those it includes
  std::map<std::string, std::size_t> owner;  // struct name -> unit that declares it
};

// "knu::Robot::tick" -> "knu::Robot" / "tick".
[[nodiscard]] std::string_view scope_of(std::string_view full_name) noexcept;
[[nodiscard]] std::string_view last_of(std::string_view full_name) noexcept;
[[nodiscard]] std::string qualified(std::string_view scope, std::string_view name);
// "knu::Robot::tick" -> "knu_Robot_tick", the name in C.
[[nodiscard]] std::string mangled(std::string_view full_name);
// Returns the namespace of an item.
[[nodiscard]] std::string_view scope_of(const Item& item) noexcept;

// Returns the unit's own declarations, for modules that include its header.
[[nodiscard]] schema::Schema schema_of(const GlbFile& unit);

// Returns true if the variable's DDS type is the struct <variable>_ with one member `value`; false only for single
// structs.
[[nodiscard]] bool is_wrapped(const schema::Type& type) noexcept;
// Returns true if there is no result, or there are no parameters.
[[nodiscard]] bool is_void(const schema::Type& type) noexcept;

}  // namespace indurop::glb2idl
