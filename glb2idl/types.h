// SPDX-License-Identifier: Apache-2.0
// Types as written to types with layout: sizes, alignment and offsets as a C compiler for 64-bit boards lays them out.

#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "glb2idl/context.h"

namespace indurop::glb2idl {

class TypeBuilder {
 public:
  explicit TypeBuilder(Context& context) : context_(context) {}

  // The type a specifier means, without array dimensions. Structs and enums with a body are declared on the way;
  // `hint` is the name of an anonymous one, without "_t". nullopt after a message, or silently if the name belongs
  // to a broken declaration.
  std::optional<schema::Type> resolve(const ast::TypeSpec& spec, const std::string& hint, const std::string& comment);

  // `type` with the dimensions of a declarator. char arrays become texts. `initial` gives the size of [].
  std::optional<schema::Type> with_dims(schema::Type type, const ast::Declarator& declarator);

  // A struct or enum under this very name: struct P {...}; and typedef struct {...} P;
  std::optional<schema::Type> define(const ast::TypeSpec& spec, const ast::Name& name, const std::string& comment);

  // Puts `fields` one behind the other: offsets, size, alignment. False with a message at `at` beyond the limits.
  bool lay_out(schema::Type& type, Span at);

 private:
  std::optional<schema::Type> define_struct(const ast::TypeSpec& spec, const ast::Name& name, const std::string& hint,
                                            const std::string& comment);
  std::optional<schema::Type> define_enum(const ast::EnumBody& body, const std::string& full_name, Span at,
                                          const std::string& comment);
  using Seen = std::map<std::string, std::string>;  // field names: lower case -> as written
  bool add_fields(const ast::Declaration& declaration, const std::string& hint, schema::Type& to, Seen& seen);
  bool check_field(const ast::Declarator& declarator, const schema::Type& owner, Seen& seen);
  std::optional<schema::Type> named(const ast::TypeSpec& spec);
  std::optional<std::uint32_t> dimension(const ast::Dimension& from, const ast::Declarator& declarator, bool first,
                                         bool is_text);
  [[nodiscard]] ast::Name derived_name(const std::string& hint, Span at) const;

  Context& context_;
};

// Fields, enum values and their inner ones; what a type costs wherever it is written out.
[[nodiscard]] std::size_t parts_of(const schema::Type& type) noexcept;
// Counts the type's parts for the whole program; false with a message at `at` beyond the limit.
bool count_parts(Context& context, const schema::Type& type, Span at);

}  // namespace indurop::glb2idl
