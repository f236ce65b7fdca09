// SPDX-License-Identifier: Apache-2.0
// The variables of the test boards.

#pragma once

#include <string>

#include "core/schema/schema.h"

namespace indurop::test {

inline schema::Variable scalar(const std::string& name, schema::Base base) {
  schema::Variable v;
  v.name = name;
  v.type.base = base;
  v.type.element_size = v.type.align = schema::size_of(base);
  v.kind = abi::Kind::Scalar;
  return v;
}

inline schema::Variable array(const std::string& name, schema::Base base, std::uint32_t length) {
  schema::Variable v = scalar(name, base);
  v.type.dims = {length};
  v.kind = abi::Kind::Ring;
  return v;
}

inline constexpr int kTicking = 400;

// "other": the same names, but t::pair has another element type. "ticking": t::s0, t::s1, ... instead, pairs of
// numbers.
inline schema::Schema make_schema(const std::string& variant) {
  schema::Schema schema;
  for (int i = 0; variant == "ticking" && i < kTicking; ++i) {
    schema.variables.push_back(array("t::s" + std::to_string(i), schema::Base::UInt64, 2));
    schema.variables.back().type_hash = schema::hash_of(schema.variables.back().type);
  }
  if (variant == "ticking") {
    return schema;
  }
  schema.variables.push_back(scalar("t::count", schema::Base::Int64));
  schema.variables.push_back(array("t::pair", variant == "other" ? schema::Base::Float : schema::Base::UInt64, 2));
  schema.variables.push_back(array("t::large", schema::Base::UInt64, 12'500));
  schema.variables.push_back(scalar("t::loose", schema::Base::Int32));
  schema.variables.push_back(scalar("t::reply", schema::Base::Int64));
  schema::Variable guarded = scalar("t::guarded", schema::Base::Int32);
  guarded.maxage_ns = 1'000'000'000;
  guarded.fallback = {0xff, 0xff, 0xff, 0xff};
  schema.variables.push_back(guarded);
  for (schema::Variable& v : schema.variables) {
    v.type_hash = schema::hash_of(v.type);
  }
  return schema;
}

}  // namespace indurop::test
