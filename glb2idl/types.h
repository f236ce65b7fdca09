// SPDX-License-Identifier: Apache-2.0
// Converts types as written to types with layout: sizes, alignment and offsets as a C compiler for 64-bit boards lays
// them out.

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

  // Returns the type of a specifier, without array dimensions. Structs and enums with a body are declared by the call;
  // `hint` is the name of an anonymous one, without "_t". nullopt after a message, or silently if the name belongs to a
  // broken declaration.
  std::optional<schema::Type> resolve(const ast::TypeSpec& spec, const std::string& hint, const std::string& comment);

  // Returns `type` with the dimensions of a declarator. char arrays become texts. `initial` gives the size of [].
  std::optional<schema::Type> with_dims(schema::Type type, const ast::Declarator& declarator);

  // Declares a struct or enum with this name: struct P {...}; and typedef struct {...} P;
  std::optional<schema::Type> define(const ast::TypeSpec& spec, const ast::Name& name, const std::string& comment);

  // Lays out the `fields` one after the other: offsets, size, alignment. Returns false with a message at `at` if limits
  // are exceeded.
  bool lay_out(schema::Type& type, Span at);

 private:
  std::optional<schema::Type> define_struct(const ast::TypeSpec& spec, const ast::Name& name, const std::string& hint,
                                            const std::string& comment);
  std::optional<schema::Type> define_enum(const ast::EnumBody& body, const std::string& full_name, Span at,
                                          const std::string& comment);
  using Seen = std::map<std::string, std::string>;  // field names: lower case -> as written
  bool add_fields(const ast::Declaration& declaration, const std::string& hint, schema::Type& to, Seen& seen);
  bool check_field(const ast::Declarator& declarator, const schema::Type& owner, Seen& seen);
  [[nodiscard]] std::string similar_type(const std::string& name) const;
  std::optional<schema::Type> named(const ast::TypeSpec& spec);
  std::optional<std::uint32_t> dimension(const ast::Dimension& from, const ast::Declarator& declarator, bool first,
                                         bool is_text);
  [[nodiscard]] ast::Name derived_name(const std::string& hint, Span at) const;

  Context& context_;
};

// Returns the number of fields and enum values, including inner ones: the size of a type when it is written out.
[[nodiscard]] std::size_t parts_of(const schema::Type& type) noexcept;
// Adds the type's parts to the count of the whole program; returns false with a message at `at` if the limit is
// exceeded.
bool count_parts(Context& context, const schema::Type& type, Span at);

}  // namespace indurop::glb2idl
