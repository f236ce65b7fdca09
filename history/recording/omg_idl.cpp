// SPDX-License-Identifier: Apache-2.0
#include "history/recording/omg_idl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>

#include "core/schema/idl_word.h"

namespace indurop::recording {
namespace {

using schema::Base;
using schema::Type;

std::string type_name(const Type& type) {
  constexpr std::array<std::string_view, 12> kNames{"boolean", "char",   "int8",  "uint8",  "int16", "uint16",
                                                    "int32",   "uint32", "int64", "uint64", "float", "double"};
  if (type.base == Base::Text) {
    return fmt::format("string<{}>", std::max(type.text_size, 2U) - 1);
  }
  // Without a leading "::", which not every reader understands.
  return type.name.empty() ? std::string(kNames.at(static_cast<std::size_t>(type.base))) : type.name;
}

std::string dims(const Type& type) {
  std::string out;
  for (const std::uint32_t dim : type.dims) {
    out += fmt::format("[{}]", dim);
  }
  return out;
}

// Some readers treat `byte` as a keyword too, and all understand a name that is escaped without need.
std::string member_name(const std::string& name) {
  return name == "byte" ? "_byte" : schema::idl_name(name);
}

class IdlText {
 public:
  // Defines everything that the type needs, each definition once.
  void define(const Type& type) {
    if ((type.base != Base::Struct && type.base != Base::Enum) || !defined_.insert(type.name).second) {
      return;
    }
    for (const schema::Field& field : type.fields) {
      define(field.type);
    }
    const std::string_view name = enter(type.name);
    if (type.base == Base::Enum) {
      line("enum {} {{ {} }};", name, enumerators(type));
      return;
    }
    line("@final struct {} {{", name);
    for (const schema::Field& field : type.fields) {
      line("  {} {}{};", type_name(field.type), member_name(field.name), dims(field.type));
    }
    line("}};");
  }

  // Wraps a type that is no struct in one; returns the struct's name.
  std::string wrap(const Type& type) {
    std::string name = "indurop::value_";
    if (type.base == Base::Text) {
      name += fmt::format("text_{}", type.text_size);
    } else {
      for (const char c : type_name(type)) {
        name += c == ':' ? '_' : c;
      }
    }
    for (const std::uint32_t dim : type.dims) {
      name += fmt::format("_{}", dim);
    }
    const std::string_view last = enter(name);
    line("@final struct {} {{", last);
    line("  {} value{};", type_name(type), dims(type));
    line("}};");
    return name;
  }

  std::string finish() && {
    leave();
    return std::move(out_);
  }

 private:
  // Opens the modules of a full name and returns its last component.
  std::string_view enter(std::string_view name) {
    const std::size_t last = name.rfind("::");
    const std::string_view scope = last == std::string_view::npos ? "" : name.substr(0, last);
    if (scope != scope_) {
      leave();
      scope_ = scope;
      for (std::string_view rest = scope; !rest.empty();) {
        const std::size_t length = std::min(rest.find("::"), rest.size());
        line("module {} {{", rest.substr(0, length));
        ++depth_;
        rest.remove_prefix(std::min(length + 2, rest.size()));
      }
    }
    return last == std::string_view::npos ? name : name.substr(last + 2);
  }

  void leave() {
    while (depth_ > 0) {
      --depth_;
      line("}};");
    }
    scope_.clear();
  }

  static std::string enumerators(const Type& type) {
    std::string out;
    std::int64_t next = 0;
    for (const schema::Enumerator& each : type.enumerators) {
      out += out.empty() ? "" : ", ";
      out += each.value == next ? "" : fmt::format("@value({}) ", each.value);
      out += member_name(each.name);
      next = each.value + 1;
    }
    return out;
  }

  template <class... Argument>
  void line(fmt::format_string<Argument...> format, Argument&&... arguments) {
    out_.append(2 * depth_, ' ');
    fmt::format_to(std::back_inserter(out_), format, std::forward<Argument>(arguments)...);
    out_ += '\n';
  }

  std::string out_;
  std::size_t depth_ = 0;
  std::string scope_;
  std::set<std::string> defined_;
};

}  // namespace

OmgIdl omg_idl(const Type& type) {
  IdlText text;
  text.define(type);
  const bool is_struct = type.base == Base::Struct && type.dims.empty();
  std::string name = is_struct ? type.name : text.wrap(type);
  return {std::move(name), std::move(text).finish()};
}

}  // namespace indurop::recording
