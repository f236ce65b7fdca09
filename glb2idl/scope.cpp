// SPDX-License-Identifier: Apache-2.0
// Symbol table and clashes.

#include "glb2idl/scope.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "glb2idl/program.h"
#include "glb2idl/text.h"

namespace indurop::glb2idl {
namespace {

// Suffixes that idlc appends to the name of a struct.
constexpr std::array<std::string_view, 5> kDerived{"_desc", "_free", "_ops", "_keys", "_alloc"};

}  // namespace

bool Scope::declare(const std::string& full_name, Symbol symbol) {
  const auto known = symbols_.find(full_name);
  if (known == symbols_.end()) {
    if (symbol.is_define) {
      defines_[std::string(last_of(full_name))].push_back(full_name);
    }
    symbols_.emplace(full_name, std::move(symbol));
    return true;
  }
  using Kind = Symbol::Kind;
  if (known->second.kind == Kind::Namespace && symbol.kind == Kind::Namespace) {
    return true;
  }
  if (known->second.kind == Kind::Broken || symbol.kind == Kind::Broken) {
    return false;  // one of the two was already reported
  }
  const char* what = known->second.kind == Kind::Namespace ? " as a namespace"
                     : known->second.kind == Kind::Taken   ? ", or its name is needed for what is declared there,"
                                                           : "";
  diagnostics_.error(symbol.at, fmt::format("'{}' is already declared{} at {}, choose another name", last_of(full_name),
                                            what, diagnostics_.place(known->second.at)));
  return false;
}

bool Scope::clash(const Claim* other, const std::string& full_name, Span at, std::string_view why) {
  if (other == nullptr) {
    return false;
  }
  diagnostics_.error(at, fmt::format("'{}' and '{}' ({}) {}, rename one of them", full_name, other->name,
                                     diagnostics_.place(other->at), why));
  return true;
}

bool Scope::claim_idl(const std::string& full_name, Span at, bool is_struct) {
  const auto lookup = [](const std::map<std::string, Claim>& in, const std::string& key) {
    const auto found = in.find(key);
    return found == in.end() ? nullptr : &found->second;
  };
  const std::string c_name = mangled(full_name);
  if (clash(lookup(idl_, lower(full_name)), full_name, at, "differ only in case, which IDL does not distinguish") ||
      clash(lookup(c_names_, c_name), full_name, at, fmt::format("are both '{}' in C", c_name))) {
    return false;
  }
  idl_.emplace(lower(full_name), Claim{full_name, at});
  c_names_.emplace(c_name, Claim{full_name, at});
  // NOLINTNEXTLINE(readability-use-anyofallof): it remembers names on its way
  for (const std::string_view suffix : kDerived) {
    if (is_struct) {
      const std::string derived = c_name + std::string(suffix);
      if (clash(lookup(c_names_, derived), full_name, at, fmt::format("both need '{}' in C", derived))) {
        return false;
      }
      c_names_.emplace(derived, Claim{full_name, at});
    }
  }
  return true;
}

bool Scope::idl_is_free(const std::string& full_name) const {
  return !idl_.contains(lower(full_name)) && !c_names_.contains(mangled(full_name));
}

bool Scope::claim_cpp(const std::string& prefix, const std::string& full_name, Span at) {
  const auto [entry, is_new] = cpp_names_.emplace(prefix + mangled(full_name), Claim{full_name, at});
  return is_new || !clash(&entry->second, full_name, at, fmt::format("are both '{}' in generated code", entry->first));
}

bool Scope::claim_variable(const std::string& full_name, Span at) {
  const auto [entry, is_new] = variables_.emplace(lower(full_name), Claim{full_name, at});
  return is_new || !clash(&entry->second, full_name, at, "differ only in case, which IDL does not distinguish");
}

const Symbol* Scope::find(const std::string& from, std::span<const std::string> parts, std::uint32_t file) const {
  const std::string wanted = join_names(parts, "::");
  std::string_view scope = from;
  while (true) {
    const auto found = symbols_.find(qualified(scope, wanted));
    if (found != symbols_.end() && sees(file, found->second)) {
      return &found->second;
    }
    if (scope.empty()) {
      return nullptr;
    }
    scope = scope_of(scope);
  }
}

const Symbol* Scope::find_define(const std::string& name, std::uint32_t file) const {
  const auto found = defines_.find(name);
  if (found == defines_.end()) {
    return nullptr;
  }
  const Symbol* only = nullptr;
  for (const std::string& full_name : found->second) {
    const Symbol& symbol = symbols_.at(full_name);
    if (sees(file, symbol)) {
      if (only != nullptr) {
        return nullptr;
      }
      only = &symbol;
    }
  }
  return only;
}

std::vector<std::string> Scope::names(Symbol::Kind kind, std::uint32_t file) const {
  constexpr std::size_t kMaxNames = 1000;
  std::vector<std::string> out;
  for (const auto& [full_name, symbol] : symbols_) {
    if (symbol.kind == kind && sees(file, symbol) && out.size() < kMaxNames) {
      out.emplace_back(last_of(full_name));
    }
  }
  return out;
}

bool Scope::hides(const std::string& from, const std::string& top) const {
  for (std::string_view scope = from; !scope.empty(); scope = scope_of(scope)) {
    if (idl_.contains(lower(qualified(scope, top)))) {
      return true;
    }
  }
  return false;
}

}  // namespace indurop::glb2idl
