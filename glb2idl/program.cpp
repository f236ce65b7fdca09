// SPDX-License-Identifier: Apache-2.0
// Names in the checked program.

#include "glb2idl/program.h"

namespace indurop::glb2idl {

std::string_view scope_of(std::string_view full_name) noexcept {
  const std::size_t colons = full_name.rfind("::");
  return colons == std::string_view::npos ? std::string_view() : full_name.substr(0, colons);
}

std::string_view last_of(std::string_view full_name) noexcept {
  const std::size_t colons = full_name.rfind("::");
  return colons == std::string_view::npos ? full_name : full_name.substr(colons + 2);
}

std::string qualified(std::string_view scope, std::string_view name) {
  return scope.empty() ? std::string(name) : std::string(scope) + "::" + std::string(name);
}

std::string mangled(std::string_view full_name) {
  std::string out;
  for (std::size_t i = 0; i < full_name.size(); ++i) {
    if (full_name[i] == ':') {
      out += '_';
      ++i;
    } else {
      out += full_name[i];
    }
  }
  return out;
}

std::string_view scope_of(const Item& item) noexcept {
  struct Visitor {
    std::string_view operator()(const Constant& c) const noexcept { return scope_of(c.name); }
    std::string_view operator()(const Enumeration& e) const noexcept { return e.scope; }
    std::string_view operator()(const Structure& s) const noexcept { return scope_of(s.type.name); }
    std::string_view operator()(const Alias& a) const noexcept { return scope_of(a.name); }
    std::string_view operator()(const schema::Variable& v) const noexcept { return scope_of(v.name); }
    std::string_view operator()(const schema::Function& f) const noexcept { return scope_of(f.name); }
    std::string_view operator()(const schema::Pool& p) const noexcept { return scope_of(p.name); }
  };
  return std::visit(Visitor{}, item);
}

schema::Schema schema_of(const GlbFile& unit) {
  schema::Schema out;
  for (const Item& item : unit.items) {
    if (const auto* variable = std::get_if<schema::Variable>(&item)) {
      out.variables.push_back(*variable);
    } else if (const auto* function = std::get_if<schema::Function>(&item)) {
      out.functions.push_back(*function);
    } else if (const auto* pool = std::get_if<schema::Pool>(&item)) {
      out.pools.push_back(*pool);
    }
  }
  return out;
}

bool is_wrapped(const schema::Type& type) noexcept {
  return type.base != schema::Base::Struct || !type.dims.empty();
}

bool is_void(const schema::Type& type) noexcept {
  return type.base == schema::Base::Struct && type.fields.empty();
}

}  // namespace indurop::glb2idl
