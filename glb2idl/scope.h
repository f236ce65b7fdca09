// SPDX-License-Identifier: Apache-2.0
// All names of a compilation: their declarations, lookup from inside a namespace, and clashes that only appear in IDL
// or C (names that differ only in case, a::b_c and a_b::c).

#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/schema/schema.h"
#include "glb2idl/constant.h"
#include "glb2idl/diagnostics.h"
#include "glb2idl/names.h"

namespace indurop::glb2idl {

struct Symbol {
  enum class Kind {
    Namespace,
    Constant,  // also enumerators
    Type,
    Variable,
    Function,
    Taken,   // a name that generated code uses
    Broken,  // its declaration had an error; further messages about it would not help
  };
  Kind kind = Kind::Broken;
  Span at;
  Value value;        // Constant
  schema::Type type;  // Type
  bool is_define = false;
};

class Scope {
 public:
  explicit Scope(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  // Returns false with a message if the name is already declared in this scope. A namespace may be declared again.
  bool declare(const std::string& full_name, Symbol symbol);

  // Reserves a name that appears in IDL and C, and the names idlc derives from it. Returns false with a message on a
  // clash.
  bool claim_idl(const std::string& full_name, Span at, bool is_struct);
  // Returns true if claim_idl would succeed; for names that can be left out.
  [[nodiscard]] bool idl_is_free(const std::string& full_name) const;
  // Reserves a name in generated C++, "var_knu_Robot_tick".
  bool claim_cpp(const std::string& prefix, const std::string& full_name, Span at);
  // Reserves a variable's name; variables must not differ only in case.
  bool claim_variable(const std::string& full_name, Span at);

  // Returns the nearest declaration of `parts` seen from namespace `from` in file `file`; null if there is none.
  [[nodiscard]] const Symbol* find(const std::string& from, std::span<const std::string> parts,
                                   std::uint32_t file) const;
  // Returns the visible symbols of a kind for suggestions; only the last parts of their names.
  [[nodiscard]] std::vector<std::string> names(Symbol::Kind kind, std::uint32_t file) const;
  // Finds a #define, which is known in all namespaces if its name is unique.
  [[nodiscard]] const Symbol* find_define(const std::string& name, std::uint32_t file) const;

  // Makes the declarations of file `of` usable in file `in`.
  void make_visible(std::uint32_t in, std::uint32_t of) { visible_.insert({in, of}); }

  // Returns true if a name in namespace `from` or around it equals `top` in IDL, where case does not matter.
  [[nodiscard]] bool hides(const std::string& from, const std::string& top) const;

 private:
  [[nodiscard]] bool sees(std::uint32_t file, const Symbol& symbol) const {
    return file == symbol.at.file || visible_.contains({file, symbol.at.file});
  }
  struct Claim {
    std::string name;
    Span at;
  };
  bool clash(const Claim* other, const std::string& full_name, Span at, std::string_view why);

  Diagnostics& diagnostics_;
  std::map<std::string, Symbol, std::less<>> symbols_;
  std::map<std::string, std::vector<std::string>> defines_;  // name -> full names
  std::map<std::string, Claim> idl_;                         // lower case full name
  std::map<std::string, Claim> c_names_;
  std::map<std::string, Claim> cpp_names_;
  std::map<std::string, Claim> variables_;  // lower case full name
  std::set<std::pair<std::uint32_t, std::uint32_t>> visible_;
};

}  // namespace indurop::glb2idl
