// SPDX-License-Identifier: Apache-2.0
#include "glb2idl/pool_checker.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "glb2idl/notes.h"

namespace indurop::glb2idl {
namespace {

// Returns the type of the pool, an array of its chunks; nothing after a message.
std::optional<schema::Type> type_of(Context& context, TypeBuilder& types, const ast::Declaration& found,
                                    const ast::Declarator& declarator, const schema::Type& chunk) {
  const ast::Name& name = declarator.name;
  if (found.kind != ast::Declaration::Kind::Plain || declarator.is_function || chunk.base != schema::Base::Struct ||
      is_void(chunk) || !chunk.dims.empty()) {
    context.error(found.type.at,
                  fmt::format("the chunks of a pool are structs, write pool struct {{ ... }} {}[4];", name.text));
    return std::nullopt;
  }
  if (declarator.dims.size() != 1) {
    context.error(name.at,
                  fmt::format("a pool has one number in brackets, that of its chunks, write {}[4]", name.text));
    return std::nullopt;
  }
  if (declarator.initial) {
    context.error(declarator.initial->at, "the chunks of a pool have no initial values, remove them");
    return std::nullopt;
  }
  auto whole = types.with_dims(chunk, declarator);
  if (whole && (whole->dims[0] < schema::kMinChunks || whole->dims[0] > schema::kMaxChunks)) {
    context.error(declarator.dims[0].at,
                  fmt::format("a pool has {} to {} chunks: one is the newest, one is being filled, and one more for "
                              "each reader that holds one",
                              schema::kMinChunks, schema::kMaxChunks));
    return std::nullopt;
  }
  return whole;
}

}  // namespace

void check_pool(Context& context, TypeBuilder& types, const ast::Declaration& found) {
  const auto chunk =
      types.resolve(found.type, found.declarators.empty() ? "" : found.declarators[0].name.text, found.description);
  if (found.declarators.empty()) {
    context.error(found.at, "a pool needs a name and the number of its chunks: pool struct { ... } camera[4];");
  }
  for (const ast::Declarator& declarator : found.declarators) {
    const ast::Name& name = declarator.name;
    auto whole = chunk ? type_of(context, types, found, declarator, *chunk) : std::nullopt;
    const bool usable = context.check_name(name, NameRole::Variable) && whole;
    schema::Pool pool;
    pool.name = context.full(name.text);
    if (!context.declare(name, usable ? Symbol::Kind::Variable : Symbol::Kind::Broken) || !usable ||
        !context.scope.claim_variable(pool.name, name.at) || !context.scope.claim_cpp("pool_", pool.name, name.at) ||
        !count_parts(context, *whole, name.at)) {
      continue;
    }
    pool.description =
        read_notes(context, found.annotations, declarator.annotations, *whole, NoteTarget::Other, found.description)
            .description;
    pool.type_hash = schema::hash_of(*whole);
    pool.type = std::move(*whole);
    pool.source = context.source(name);
    context.add(std::move(pool));
  }
}

}  // namespace indurop::glb2idl
