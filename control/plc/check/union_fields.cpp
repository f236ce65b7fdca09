// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/union_fields.h"

#include <fmt/format.h>

namespace indurop::plc {

std::string why_no_overlap(const Type& type) {
  if (type.kind == Type::Kind::Array) {
    return why_no_overlap(*type.element);
  }
  if (type.is(Elementary::Bool)) {
    return "a UNION has no BOOL and no BIT, which would get values that are neither TRUE nor FALSE; use bits: x.w.3";
  }
  if (type.kind == Type::Kind::Pointer || type.kind == Type::Kind::Interface || type.kind == Type::Kind::Block) {
    return fmt::format("a UNION cannot contain {}, which would get values that lead nowhere", with_article(type));
  }
  if (type.range) {
    return "a UNION has no subrange, whose values nothing would check; use its base type";
  }
  std::string why;
  for (const Field& field : type.fields) {
    why = why.empty() ? why_no_overlap(*field.type) : why;
  }
  return why;
}

}  // namespace indurop::plc
