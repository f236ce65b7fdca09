// SPDX-License-Identifier: Apache-2.0
// Resolved types of a PLC program and the table that owns them.

#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "control/plc/model/ast.h"
#include "control/plc/model/dialect.h"

namespace indurop::plc {

struct Pou;
struct LibraryBlock;

inline constexpr std::size_t kDefaultStringLength = 80;

struct Field {
  std::string name;
  const Type* type = nullptr;
  const ast::Initial* initial = nullptr;  // null: the initial value of the type
  std::string comment;
  std::string shared = {};  // name in the .glb and in C++; empty: unchanged
  [[nodiscard]] const std::string& member() const noexcept { return shared.empty() ? name : shared; }
};

struct EnumItem {
  std::string name;
  std::int64_t value = 0;
  std::string shared = {};  // name in the .glb
};

struct Bounds {
  std::int64_t low = 0;
  std::int64_t high = 0;
  [[nodiscard]] std::uint64_t count() const noexcept {
    return static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low) + 1;
  }
};

struct Type {
  enum class Kind : std::uint8_t { Elementary, Enum, Struct, Array, Block, Pointer, Interface };
  Kind kind = Kind::Elementary;
  Elementary elementary = Elementary::Int;  // Elementary; Enum: its storage type
  std::string name;                         // Enum, Struct, Block, Interface and subranges: as declared
  std::size_t length = 0;                   // STRING, WSTRING: maximum number of characters
  std::optional<Bounds> range;              // subrange
  std::vector<Field> fields;                // Struct
  bool overlaps = false;                    // Struct: a UNION
  bool open = false;                        // Array: [*], the bounds are those of the argument; only as VAR_IN_OUT
  std::vector<EnumItem> items;              // Enum
  std::vector<Bounds> dimensions;           // Array
  const Type* element = nullptr;            // Array, Pointer
  ast::PointerKind pointer = ast::PointerKind::PointerTo;
  const Pou* pou = nullptr;               // user's function block, Interface
  const LibraryBlock* block = nullptr;    // library function block
  const ast::Initial* initial = nullptr;  // of the declaration; null: zero, or the first value of an enumeration
  std::string shared_name;                // Struct, Enum of a .glb file: "knu::Robot::Point"
  std::string glb_name = {};              // Struct, Enum of the project: its name in the .glb

  // Set when the type is added to the table. Elements of arrays count in `parts` only; targets of pointers are not
  // counted.
  std::uint64_t parts = 1;                                   // elementary values, a text as its words; saturates
  std::uint64_t fields_inside = 1;                           // fields of structures, including inner ones; saturates
  std::size_t depth = 0;                                     // nesting of structures and arrays
  std::size_t pointers = 0;                                  // length of a chain of pointers to pointers
  std::size_t extends = 0;                                   // Struct: number of structures it extends
  bool is_private = false;                                   // see is_private()
  std::map<std::string, std::size_t> field_names = {};       // Struct: index in `fields` by name in capitals
  mutable std::optional<std::uint64_t> default_values = {};  // see values_of(); computed on first use

  [[nodiscard]] bool is(Elementary type) const noexcept { return kind == Kind::Elementary && elementary == type; }
  [[nodiscard]] bool is_reference() const noexcept {
    return kind == Kind::Pointer && pointer == ast::PointerKind::ReferenceTo;
  }
  [[nodiscard]] bool is_text() const noexcept { return kind == Kind::Elementary && plc::is_text(elementary); }
};

// "INT", "STRING[20]", "ARRAY[1..3] OF Motor"
[[nodiscard]] std::string to_string(const Type& type);
// "an INT", "a STRING[20]"
[[nodiscard]] std::string with_article(const Type& type);
// Returns whether both are the same type, for VAR_IN_OUT and whole arrays; a subrange is the same as its base.
[[nodiscard]] bool same_type(const Type& a, const Type& b) noexcept;
// Returns whether a variable of `from` can be used as one of `to`: a function block that extends or implements `to`.
[[nodiscard]] bool stands_for(const Type& from, const Type& to) noexcept;
// Returns whether every value of `from` is one of `to` with regard to subranges, including those in arrays and behind
// pointers.
[[nodiscard]] bool in_range_of(const Type& from, const Type& to) noexcept;
// Returns whether both have the same values with regard to subranges: a value written through one is read through the
// other.
[[nodiscard]] bool same_range(const Type& a, const Type& b) noexcept;
// Returns whether a value of `from` can be assigned to a `to` without a conversion function.
[[nodiscard]] bool assignable(const Type& from, const Type& to, Dialect dialect) noexcept;
// Returns the one of the two types that the other widens to; null if there is none. Texts: the longer one.
[[nodiscard]] const Type* common_type(const Type& a, const Type& b, Dialect dialect) noexcept;
// Returns whether the type contains function blocks, interfaces, pointers or unions, which other modules cannot share.
[[nodiscard]] bool is_private(const Type& type) noexcept;
// Returns the number of elementary values, including those of arrays; saturates. Requires that the types inside are in
// the table.
[[nodiscard]] std::uint64_t parts_of(const Type& type) noexcept;

// Larger values are an error of the program, so that no pass over a type takes long or overflows the stack.
inline constexpr std::size_t kMaxTypeNesting = 64;         // nesting of structures and arrays
inline constexpr std::uint64_t kMaxFieldsInside = 20'000;  // of one structure
inline constexpr std::uint64_t kMaxFields = 4'000'000;     // sum of all types and variables

// The smallest and largest value of an integer or bit string type.
struct IntegerLimits {
  std::int64_t low = 0;
  std::uint64_t high = 0;
};
[[nodiscard]] IntegerLimits limits_of(Elementary type) noexcept;

class TypeTable {
 public:
  TypeTable();
  TypeTable(const TypeTable&) = delete;
  TypeTable& operator=(const TypeTable&) = delete;

  [[nodiscard]] const Type* elementary(Elementary type) const noexcept {
    return elementary_[static_cast<std::size_t>(type)];
  }
  // Returns STRING[length] or WSTRING[length].
  [[nodiscard]] const Type* text(Elementary of, std::size_t length);
  [[nodiscard]] bool has_pointers() const noexcept { return has_pointers_; }
  // Returns whether the bytes of a variable are accessed as values of several types.
  [[nodiscard]] bool has_aliases() const noexcept { return has_aliases_; }
  void note_aliases() noexcept { has_aliases_ = true; }
  // Adds a new type; its address stays valid.
  Type* add(Type type);

 private:
  std::deque<Type> types_;
  bool has_pointers_ = false;
  bool has_aliases_ = false;
  std::vector<const Type*> elementary_;
  std::map<std::pair<Elementary, std::size_t>, const Type*> texts_;
};

}  // namespace indurop::plc
