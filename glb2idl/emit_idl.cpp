// SPDX-License-Identifier: Apache-2.0
// Writes OMG IDL: modules, enums, @final structs, and a wrapper struct for each variable that is not a single struct.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

#include "core/schema/idl_word.h"
#include "glb2idl/emit.h"
#include "glb2idl/text.h"

namespace indurop::glb2idl {
namespace {

using schema::Base;

std::string idl_type(const schema::Type& type) {
  constexpr std::array<std::string_view, 12> kNames{"boolean", "char",   "int8",  "uint8",  "int16", "uint16",
                                                    "int32",   "uint32", "int64", "uint64", "float", "double"};
  if (type.base == Base::Text) {
    return fmt::format("string<{}>", type.text_size - 1);
  }
  // Without a leading "::", which some vendors' compilers cannot read; the checker has made sure that the name is
  // unique.
  return type.name.empty() ? std::string(kNames[static_cast<std::size_t>(type.base)]) : type.name;
}

class IdlWriter {
 public:
  explicit IdlWriter(const GlbFile& unit) : unit_(unit) {}

  std::string run(const Program& program) {
    std::string word = unit_.stem;
    std::replace(word.begin(), word.end(), '-', '_');
    line("// {}.idl: DDS types of the shared variables in {}.glb, written by glb2idl. Do not edit.", unit_.stem,
         unit_.stem);
    line("#ifndef INDUROP_IDL_{}", word);
    line("#define INDUROP_IDL_{}", word);
    for (const std::size_t other : unit_.includes) {
      line("#include \"{}.idl\"", program.units[other].stem);
    }
    for (const Item& item : unit_.items) {
      std::visit(*this, item);
    }
    enter("");
    if (!any_) {
      line("");
      line("// No types: some compilers refuse a file without a definition.");
      line("module indurop_glb {{ const int32 file_{} = 1; }};", word);
    }
    line("");
    line("#endif");
    return std::move(out_);
  }

  void operator()(const Constant& constant) {
    if (!constant.in_idl) {
      return;
    }
    enter(scope_of(constant.name));
    std::string_view type = "int64";
    if (constant.value.integer > std::numeric_limits<std::int64_t>::max()) {
      type = "uint64";
    } else if (constant.value.integer == static_cast<std::int32_t>(constant.value.integer)) {
      type = "int32";
    }
    any_ = true;
    line("const {} {} = {};{}", type, last_of(constant.name), to_text(constant.value.integer),
         comment(constant.description));
  }

  void operator()(const Enumeration& enumeration) {
    if (enumeration.type.name.empty()) {
      return;
    }
    enter(enumeration.scope);
    std::string values;
    for (const schema::Enumerator& e : enumeration.type.enumerators) {
      values += (values.empty() ? "" : ", ") + schema::idl_name(e.name);
    }
    any_ = true;
    line("enum {} {{ {} }};{}", last_of(enumeration.type.name), values, comment(enumeration.description));
  }

  void operator()(const Structure& structure) {
    enter(scope_of(structure.type.name));
    any_ = true;
    line("@final struct {} {{{}", last_of(structure.type.name), comment(structure.description));
    for (const schema::Field& field : structure.type.fields) {
      line("  {} {}{};{}", idl_type(field.type), schema::idl_name(field.name), dims(field.type),
           comment(notes(field.description, field.unit, field.range)));
    }
    line("}};");
  }

  void operator()(const Alias& /*unused*/) {}

  void operator()(const schema::Variable& variable) {
    const std::string about = notes(variable.description, variable.unit, variable.range);
    const std::string text = about.empty() ? about : fmt::format(": {}", about);
    if (!is_wrapped(variable.type)) {
      remark("variable {}: {}{}", variable.name, variable.type.name, text);
      return;
    }
    enter(scope_of(variable.name));
    any_ = true;
    const std::string_view name = last_of(variable.name);
    line("@final struct {}_ {{ {} value{}; }};{}", name, idl_type(variable.type), dims(variable.type),
         comment(fmt::format("variable {}{}", name, text)));
  }

  void operator()(const schema::Function& function) {
    remark("shared function {}: called on its board only, no DDS type", function.name);
  }

  void operator()(const schema::Pool& pool) {
    remark("pool {}: chunks of {} that stay on their board, no topic", pool.name, pool.type.name);
  }

 private:
  template <class... Argument>
  void line(fmt::format_string<Argument...> format, Argument&&... arguments) {
    out_ += std::string(2 * depth_, ' ');
    fmt::format_to(std::back_inserter(out_), format, std::forward<Argument>(arguments)...);
    out_ += '\n';
  }

  // Writes a comment outside any module, because an empty module is not valid IDL.
  template <class... Argument>
  void remark(fmt::format_string<Argument...> format, Argument&&... arguments) {
    line("// {}", comment_line(fmt::format(format, std::forward<Argument>(arguments)...)));
  }

  // Closes and opens modules until `scope` is reached.
  void enter(std::string_view scope) {
    if (scope == current_ && started_) {
      return;
    }
    while (depth_ > 0) {
      --depth_;
      line("}};");
    }
    started_ = true;
    current_ = scope;
    if (scope.empty()) {
      return;
    }
    line("");
    std::string_view rest = scope;
    while (!rest.empty()) {
      const std::size_t length = std::min(rest.find("::"), rest.size());
      line("module {} {{", rest.substr(0, length));
      ++depth_;
      rest.remove_prefix(std::min(length + 2, rest.size()));
    }
  }

  static std::string dims(const schema::Type& type) {
    std::string out;
    for (const std::uint32_t dim : type.dims) {
      out += fmt::format("[{}]", dim);
    }
    return out;
  }
  static std::string notes(const std::string& description, const std::string& unit,
                           const std::optional<schema::Range>& range) {
    std::string out = description;
    if (!unit.empty()) {
      out += fmt::format("{}[{}]", out.empty() ? "" : " ", unit);
    }
    if (range) {
      out += fmt::format("{}{} to {}", out.empty() ? "" : " ", range->min, range->max);
    }
    return out;
  }
  static std::string comment(const std::string& text) { return text.empty() ? "" : "  // " + comment_line(text); }

  const GlbFile& unit_;
  std::string out_;
  std::size_t depth_ = 0;
  std::string current_;
  bool started_ = false;
  bool any_ = false;  // a definition has been written
};

}  // namespace

std::string emit_idl(const Program& program, const GlbFile& unit) {
  return IdlWriter(unit).run(program);
}

}  // namespace indurop::glb2idl
