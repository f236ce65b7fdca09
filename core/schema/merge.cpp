// SPDX-License-Identifier: Apache-2.0
// Merges two schemas, and describes where two types differ.

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "core/schema/schema.h"

namespace indurop::schema {
namespace {

std::string dims_text(const Type& type) {
  std::string out;
  for (const std::uint32_t dim : type.dims) {
    out += fmt::format("[{}]", dim);
  }
  return out.empty() ? "no array" : out;
}

std::string first_enumerator_difference(const Type& a, const Type& b) {
  for (std::size_t i = 0; i < std::max(a.enumerators.size(), b.enumerators.size()); ++i) {
    const auto text = [i](const Type& type) {
      return i < type.enumerators.size() ? fmt::format("{} = {}", type.enumerators[i].name, type.enumerators[i].value)
                                         : std::string("absent");
    };
    if (text(a) != text(b)) {
      return fmt::format("enumerator {}: {} / {}", i + 1, text(a), text(b));
    }
  }
  return {};
}

std::string field_text(const Field* field) {
  return field == nullptr ? "absent" : fmt::format("{} at {}", display_name(field->type), field->offset);
}

std::string compare(const Type& a, const Type& b, const std::string& path);

std::string compare_fields(const Type& a, const Type& b, const std::string& path) {
  const auto find = [](const Type& type, const std::string& name) -> const Field* {
    const auto found =
        std::find_if(type.fields.begin(), type.fields.end(), [&](const Field& f) { return f.name == name; });
    return found == type.fields.end() ? nullptr : &*found;
  };
  for (std::size_t i = 0; i < std::max(a.fields.size(), b.fields.size()); ++i) {
    const Field* left = i < a.fields.size() ? &a.fields[i] : nullptr;
    const Field* right = left != nullptr ? find(b, left->name) : &b.fields[i];
    const std::string where = path + (left != nullptr ? left : right)->name;
    if (left == nullptr || right == nullptr) {
      return fmt::format("field {}: {} / {}", where, field_text(left), field_text(right));
    }
    std::string inner = compare(left->type, right->type, where + ".");
    if (inner.empty() && left->offset != right->offset) {
      return fmt::format("field {}: {} / {}", where, field_text(left), field_text(right));
    }
    if (!inner.empty()) {
      const bool named = inner.rfind("field ", 0) == 0;
      const bool base_differs = left->type.base != right->type.base || left->type.dims != right->type.dims ||
                                left->type.text_size != right->type.text_size;
      if (base_differs) {
        return fmt::format("field {}: {} / {}", where, field_text(left), field_text(right));
      }
      return named ? inner : fmt::format("field {}: {}", where, inner);
    }
  }
  return {};
}

// `path` is put before field names: "pose.".
std::string compare(const Type& a, const Type& b, const std::string& path) {
  if (a.base != b.base || a.text_size != b.text_size) {
    return fmt::format("{} / {}", display_name(a), display_name(b));
  }
  if (a.dims != b.dims) {
    return fmt::format("{} / {}", dims_text(a), dims_text(b));
  }
  if (a.base == Base::Enum) {
    return first_enumerator_difference(a, b);
  }
  if (a.base != Base::Struct) {
    return {};
  }
  if (std::string fields = compare_fields(a, b, path); !fields.empty()) {
    return fields;
  }
  if (a.element_size != b.element_size || a.align != b.align) {
    return fmt::format("{} bytes aligned to {} / {} bytes aligned to {}", a.element_size, a.align, b.element_size,
                       b.align);
  }
  return {};
}

std::string difference(const Variable& a, const Variable& b) {
  std::string types = first_difference(a.type, b.type);
  if (types.empty() && a.kind != b.kind) {
    types = a.kind == abi::Kind::Scalar ? "an atomic / a ring of versions" : "a ring of versions / an atomic";
  }
  return types;
}

std::string difference(const Pool& a, const Pool& b) {
  return first_difference(a.type, b.type);
}

std::string difference(const Function& a, const Function& b) {
  const std::string arguments = first_difference(a.arguments, b.arguments);
  if (!arguments.empty()) {
    return "arguments: " + arguments;
  }
  const bool both_void = a.result.base == Base::Struct && b.result.base == Base::Struct && a.result.fields.empty() &&
                         b.result.fields.empty();
  const std::string result = both_void ? std::string() : first_difference(a.result, b.result);
  return result.empty() ? result : "result: " + result;
}

template <class T>
void merge_list(std::vector<T>& into, const std::vector<T>& from, std::vector<std::string>& differences) {
  std::unordered_map<std::string, std::size_t> index;
  for (std::size_t i = 0; i < into.size(); ++i) {
    index.emplace(into[i].name, i);
  }
  for (const T& item : from) {
    const auto [place, added] = index.emplace(item.name, into.size());
    if (added) {
      into.push_back(item);
      continue;
    }
    const T& known = into[place->second];
    if (const std::string what = difference(known, item); !what.empty()) {
      const bool sources = !known.source.empty() && !item.source.empty();
      differences.push_back(fmt::format("{}: {}{}", item.name, what,
                                        sources ? fmt::format(" ({} / {})", known.source, item.source) : ""));
    }
  }
}

}  // namespace

std::string first_difference(const Type& a, const Type& b) {
  return canonical(a) == canonical(b) ? std::string() : compare(a, b, "");
}

void merge(Schema& into, const Schema& from, std::vector<std::string>& differences) {
  merge_list(into.variables, from.variables, differences);
  merge_list(into.functions, from.functions, differences);
  merge_list(into.pools, from.pools, differences);
}

}  // namespace indurop::schema
