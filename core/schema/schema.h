// SPDX-License-Identifier: Apache-2.0
// Description of shared variables: names, types, layout, units, initial values. One model for the .glb compiler, the
// store, the checks and the tools; as JSON text it is part of every module (ELF section .indurop.schema, one line per
// .glb) and of the store. Not real-time safe: load time only.

#pragma once

#include <indurop/detail/abi.h>
#include <indurop/result.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::schema {

enum class Base : std::uint8_t {
  Bool,
  Char,
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float,
  Double,
  Text,    // char array: `text_size` bytes including the NUL
  Enum,    // int32 underneath, names in Type::enumerators
  Struct,  // fields
};

struct Field;

struct Enumerator {
  std::string name;
  std::int64_t value = 0;
};

struct Type {
  Base base = Base::Int32;
  std::string name;                // "knu::Robot::joints_t" for Struct and Enum, else empty
  std::uint32_t text_size = 0;     // Base::Text
  std::uint32_t element_size = 0;  // bytes of one element, including padding at the end
  std::uint32_t align = 1;
  std::vector<std::uint32_t> dims;      // outermost first; empty: not an array
  std::vector<Field> fields;            // Base::Struct, in declaration order
  std::vector<Enumerator> enumerators;  // Base::Enum
  // Returns element_size times all dims; UINT64_MAX on overflow.
  [[nodiscard]] std::uint64_t size() const noexcept;
};

// Returns the size of a base type in bytes, which is also its alignment; 0 for Text and Struct, whose size varies.
std::uint32_t size_of(Base base) noexcept;
// Returns the name as in C++: "uint32_t", "double"; "char" for Text, "enum", "struct".
const char* name_of(Base base) noexcept;

struct Range {
  double min = 0;
  double max = 0;
};

enum class Priority : std::uint8_t { Critical, High, Medium, Low };
enum class Comparison : std::uint8_t { Equal, NotEqual, Less, LessEqual, Greater, GreaterEqual };

// An alarm that requires an action: @alarm. In an array, each element has its own alarm.
struct Alarm {
  std::string text;
  Priority priority = Priority::Medium;
  Comparison comparison = Comparison::Equal;  // value COMPARISON limit
  double limit = 1;
  double deadband = 0;        // distance from the limit at which the alarm ends
  std::int64_t delay_ns = 0;  // time for which the condition has to be true
};
const char* word_of(Priority priority) noexcept;  // "critical"
std::optional<Priority> priority_of(std::string_view word) noexcept;
const char* symbol_of(Comparison comparison) noexcept;  // "=="
// Returns "> 80", "== FAULT"; empty for a bool that is compared with true.
std::string condition_text(const Type& type, const Alarm& alarm);
// The deadband applies only if the condition was true before.
bool is_met(const Alarm& alarm, double value, bool was_met) noexcept;

struct Field {
  std::string name;
  Type type;
  std::uint32_t offset = 0;
  std::string unit;
  std::string description;
  std::optional<Range> range;
  std::vector<Alarm> alarms;
};

struct Variable {
  std::string name;  // full name, "knu::Robot::joints"
  Type type;
  abi::Kind kind = abi::Kind::Ring;
  std::uint64_t type_hash = 0;
  std::string unit;
  std::string description;
  std::optional<Range> range;
  bool retain = false;
  bool view = false;                   // for tools only: versions of a module may write different values
  std::int64_t maxage_ns = 0;          // 0: none
  std::vector<std::uint8_t> initial;   // empty: all zero, else type.size() bytes
  bool given = false;                  // an initial value was written, even 0
  bool optional = false;               // a request or measurement that need not be there: never a parameter
  std::vector<std::uint8_t> fallback;  // empty: none declared
  std::string source;                  // "knuRobot.glb:3"
  std::vector<Alarm> alarms;
  [[nodiscard]] std::uint64_t name_hash() const noexcept { return abi::fnv1a64(name.data(), name.size()); }
  // What people tune: recipes save it, and the lock `tune` permits to set it.
  [[nodiscard]] bool is_parameter() const noexcept { return given && !optional; }
};

// A shared function: arguments and result travel as two structs through a call slot of the store.
struct Function {
  std::string name;  // full name
  Type arguments;    // Base::Struct named "...::add_args", fields = parameters
  Type result;       // dims allowed; Base::Struct with no fields = void
  std::uint64_t type_hash = 0;
  std::int64_t deadline_ns = 0;  // 0: the default (indurop::kDefaultCallDeadline)
  std::string description;
  std::string source;
};

// A pool of large data: chunks that are filled and read in place, next to the store.
struct Pool {
  std::string name;  // full name
  Type type;         // Base::Struct with one dimension, the number of chunks
  std::uint64_t type_hash = 0;
  std::string description;
  std::string source;
  [[nodiscard]] std::uint64_t name_hash() const noexcept { return abi::fnv1a64(name.data(), name.size()); }
};
inline constexpr std::uint32_t kMinChunks = 2;  // the newest one and one to fill
inline constexpr std::uint32_t kMaxChunks = 64;

struct Schema {
  std::vector<Variable> variables;
  std::vector<Function> functions;
  std::vector<Pool> pools;
};

// Returns the canonical text of a type: everything that must agree for two programs to share its bytes (base types,
// field names, offsets, sizes, dims, enumerators), and nothing else: no type names, units, comments, ranges. type_hash
// is fnv1a64 of it. The text is ASCII without blanks and follows this grammar, so it is the same on every machine and
// compiler:
//   type   = base { "[" dim "]" }                               outermost dim first
//   base   = "bool" | "char" | "i8" | "u8" | ... | "u64" | "f32" | "f64" | "text(" bytes ")"
//          | "enum{" name "=" value { "," name "=" value } "}"  in order of declaration
//          | "struct(" size "," align "){" name "@" offset ":" type { "," ... } "}"
// Figure 3's joints: struct(24,8){x@0:f64,y@8:f64,z@16:f64}[10]
std::string canonical(const Type& type);
std::uint64_t hash_of(const Type& type);
// For a function: canonical(arguments) "->" canonical(result), "void" for a result without fields. The deadline may
// differ.
std::uint64_t hash_of(const Function& function);

// Returns the type as C-like text: "double", "knu::Robot::joints_t[10]", "char[16]".
std::string display_name(const Type& type);

// JSON text of a schema: one object on one line, without a newline; it contains the schema version and abi::kVersion.
// Type hashes are not written: from_json computes them. from_json accepts several lines (duplicates are merged), and
// none: an empty schema. Its result is always valid, even for hostile text: names are identifiers, sizes and offsets
// agree, nothing overlaps. Errors: Corrupt if it is not such JSON, VersionMismatch if written by another schema
// version, TypeMismatch if two lines give one variable different types (a module linked from old and new object files).
inline constexpr int kSchemaVersion = 1;
std::string to_json(const Schema& schema);
Result<Schema> from_json(std::string_view text);
// Returns abi::kVersion of the headers from which a schema text was made, 0 if it has none. Reads only the beginning of
// the first line.
std::uint32_t abi_of_json(std::string_view text) noexcept;

// Returns the variable with this full name, or nullptr.
const Variable* find_variable(const Schema& schema, std::string_view name) noexcept;

// Adds `from` to `into`. A variable, function or pool present in both with the same type is kept once; with different
// types the one in `into` stays and `differences` gets one line, naming the first differing field.
void merge(Schema& into, const Schema& from, std::vector<std::string>& differences);
// Returns "field y: double at 8 / float at 8", or empty if equal.
std::string first_difference(const Type& a, const Type& b);

// A part of a variable addressed by text: "knu::Robot::joints[1].y", "joints" , "grid[0][2]".
struct Place {
  const Variable* variable = nullptr;
  Type type;  // of the part; dims that remain after the given indices
  std::uint32_t offset = 0;
  std::string unit;
  std::optional<Range> range;
};
// Why a text names no part, or is no value. `message` describes the error and the correction.
struct Failure {
  Errc code = Errc::Ok;
  std::string message;
};
// Finds the part that `text` addresses. Leading namespaces may be omitted if the rest is unique; '.' and '::' both
// separate namespaces. Unit and range are those of the innermost declaration that has one. An index into text gives one
// char. Errors: NotFound (no variable or field of that name; ambiguous), OutOfRange (index), InvalidArgument (syntax).
// The message of a failure has the nearest name.
Result<Place, Failure> find_place(const Schema& schema, std::string_view text);

// The part of a variable at a byte offset, "knu::Robot::joints[1].y", and its type; as deep as there are names.
struct Part {
  std::string name;
  Type type;
};
Part part_at(const Variable& variable, std::uint32_t offset);

// Converts a value to text and back. format: numbers in shortest form, enums by name, text quoted, arrays [a, b],
// structs {x: 1}. parse accepts the same, and also 0/1 for bool, hex integers, numbers for enums, JSON's quoted field
// names, and text and single characters without quotes when they are the whole value. Fields omitted in a struct keep
// their bytes. Errors: InvalidArgument (not such a value), OutOfRange (the type cannot hold it); `bytes` is unchanged
// then. `bytes` holds type.size() bytes; with fewer format returns "" and parse fails.
std::string format_value(const Type& type, std::span<const std::uint8_t> bytes);
Result<void, Failure> parse_value(const Type& type, std::string_view text, std::span<std::uint8_t> bytes);
// Returns the same bytes as JSON: numbers, strings, arrays, objects; NaN and infinities are null, a char is a string.
std::string value_to_json(const Type& type, std::span<const std::uint8_t> bytes);

// Checks every number of a value against `range`, or against its field's own range where it has one. Infinite limits
// are not checked. Errors: OutOfRange; the message names the first offender: "x: 190 is outside -180..180".
Result<void, Failure> check_range(const Range& range, const Type& type, std::span<const std::uint8_t> bytes);

// Matches a shell glob (*, ?, [a-z], [!a-z], a backslash quotes) against full names; '.' in a pattern means "::", and a
// pattern without either also matches the last part alone.
bool glob_match(std::string_view pattern, std::string_view name);
// Returns true if the text is a glob, not a name: "[2]" is an index.
bool is_glob(std::string_view text);

}  // namespace indurop::schema
