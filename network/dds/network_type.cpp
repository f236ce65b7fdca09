// SPDX-License-Identifier: Apache-2.0
#include "network/dds/network_type.h"

#include <dds/ddsi/ddsi_xt_typeinfo.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace indurop::dds {
namespace {

using Identifier = DDS_XTypes_TypeIdentifier;
using Object = DDS_XTypes_TypeObject;
using Found = Result<schema::Type, base::Problem>;

constexpr int kDeepest = 32;  // nested structs; deeper types are considered hostile
constexpr std::uint64_t kLargest = 1U << 26U;

struct FreeObject {
  void operator()(dds_typeobj_t* object) const noexcept { (void)dds_free_typeobj(object); }
};

std::optional<schema::Base> base_of(std::uint8_t kind) {
  switch (kind) {
    case DDS_XTypes_TK_BOOLEAN:
      return schema::Base::Bool;
    case DDS_XTypes_TK_BYTE:
      return schema::Base::UInt8;
    case DDS_XTypes_TK_CHAR8:  // int8 is announced in the same way
      return schema::Base::Char;
    case DDS_XTypes_TK_INT16:
      return schema::Base::Int16;
    case DDS_XTypes_TK_UINT16:
      return schema::Base::UInt16;
    case DDS_XTypes_TK_INT32:
      return schema::Base::Int32;
    case DDS_XTypes_TK_UINT32:
      return schema::Base::UInt32;
    case DDS_XTypes_TK_INT64:
      return schema::Base::Int64;
    case DDS_XTypes_TK_UINT64:
      return schema::Base::UInt64;
    case DDS_XTypes_TK_FLOAT32:
      return schema::Base::Float;
    case DDS_XTypes_TK_FLOAT64:
      return schema::Base::Double;
    default:
      return std::nullopt;
  }
}

// Converts identifiers to types, outermost first.
class Reader {
 public:
  Reader(Handle participant, std::int64_t timeout_ns) : participant_(participant), timeout_ns_(timeout_ns) {}

  Found read(const Identifier& id, int depth) {
    if (depth > kDeepest) {
      return refuse("it is nested too deeply");
    }
    if (const auto base = base_of(id._d)) {
      schema::Type type;
      type.base = *base;
      type.element_size = type.align = schema::size_of(*base);
      return type;
    }
    switch (id._d) {
      case DDS_XTypes_TI_STRING8_SMALL:
        return text(id._u.string_sdefn.bound);
      case DDS_XTypes_TI_STRING8_LARGE:
        return text(id._u.string_ldefn.bound);
      case DDS_XTypes_TI_PLAIN_ARRAY_SMALL:
        return array(id._u.array_sdefn.array_bound_seq, id._u.array_sdefn.element_identifier, depth);
      case DDS_XTypes_TI_PLAIN_ARRAY_LARGE:
        return array(id._u.array_ldefn.array_bound_seq, id._u.array_ldefn.element_identifier, depth);
      case DDS_XTypes_EK_COMPLETE:
        return named(id, depth);
      default:
        return refuse("it has a part of a kind that variables do not have (a sequence, a union, wide text)");
    }
  }

 private:
  static Found refuse(const char* why) { return base::Problem{why}; }

  static Found text(std::uint32_t bound) {
    if (bound == 0 || bound >= kLargest) {
      return refuse("it has text without a limit");
    }
    schema::Type type;
    type.base = schema::Base::Text;
    type.text_size = type.element_size = bound + 1;
    return type;
  }

  template <class Bounds>
  Found array(const Bounds& bounds, const Identifier* element, int depth) {
    auto type = element == nullptr ? refuse("its publisher does not announce the type") : read(*element, depth + 1);
    if (!type) {
      return type;
    }
    std::vector<std::uint32_t> dims(bounds._buffer, bounds._buffer + bounds._length);
    type->dims.insert(type->dims.begin(), dims.begin(), dims.end());
    return type->size() == 0 || type->size() > kLargest ? refuse("it is too large") : type;
  }

  Found named(const Identifier& id, int depth) {
    dds_typeobj_t* raw = nullptr;
    if (dds_get_typeobj(participant_, reinterpret_cast<const dds_typeid_t*>(&id), timeout_ns_, &raw) < 0 ||
        raw == nullptr) {
      return refuse("its publisher does not announce the type");
    }
    const std::unique_ptr<dds_typeobj_t, FreeObject> object(raw);
    const auto& whole = *reinterpret_cast<const Object*>(raw);
    if (whole._d != DDS_XTypes_EK_COMPLETE) {
      return refuse("its publisher announces only the minimal description of its type");
    }
    const auto& complete = whole._u.complete;
    switch (complete._d) {
      case DDS_XTypes_TK_STRUCTURE:
        return structure(complete._u.struct_type, depth);
      case DDS_XTypes_TK_ENUM:
        return enumeration(complete._u.enumerated_type);
      case DDS_XTypes_TK_ALIAS:
        return read(complete._u.alias_type.body.common.related_type, depth + 1);
      default:
        return refuse("it has a part of a kind that variables do not have (a union, a bit set)");
    }
  }

  Found structure(const DDS_XTypes_CompleteStructType& from, int depth) {
    if (from.header.base_type._d != DDS_XTypes_TK_NONE) {
      return refuse("it is derived from another one");
    }
    schema::Type type;
    type.base = schema::Base::Struct;
    type.name = from.header.detail.type_name;
    std::uint64_t end = 0;
    for (std::uint32_t i = 0; i < from.member_seq._length; ++i) {
      const auto& member = from.member_seq._buffer[i];
      constexpr unsigned kElsewhere = DDS_XTypes_IS_OPTIONAL | DDS_XTypes_IS_EXTERNAL;
      if ((member.common.member_flags & kElsewhere) != 0) {
        return refuse("it has optional parts");
      }
      auto part = read(member.common.member_type_id, depth + 1);
      if (!part) {
        return part;
      }
      schema::Field field;
      field.name = member.detail.name;
      end = (end + part->align - 1) / part->align * part->align;
      field.offset = static_cast<std::uint32_t>(end);
      end += part->size();
      type.align = std::max(type.align, part->align);
      field.type = std::move(*part);
      type.fields.push_back(std::move(field));
      if (end > kLargest) {
        return refuse("it is too large");
      }
    }
    type.element_size = static_cast<std::uint32_t>((end + type.align - 1) / type.align * type.align);
    return type.element_size == 0 ? refuse("it is empty") : Found(std::move(type));
  }

  static Found enumeration(const DDS_XTypes_CompleteEnumeratedType& from) {
    schema::Type type;
    type.base = schema::Base::Enum;
    type.name = from.header.detail.type_name;
    type.element_size = type.align = schema::size_of(schema::Base::Enum);
    for (std::uint32_t i = 0; i < from.literal_seq._length; ++i) {
      const auto& literal = from.literal_seq._buffer[i];
      type.enumerators.push_back({literal.detail.name, literal.common.value});
    }
    return type;
  }

  Handle participant_;
  std::int64_t timeout_ns_;
};

}  // namespace

Result<schema::Type, base::Problem> type_from_network(Handle participant, const dds_typeinfo_t& information,
                                                      std::int64_t timeout_ns) {
  const auto& info_of_endpoint = *reinterpret_cast<const DDS_XTypes_TypeInformation*>(&information);
  return Reader(participant, timeout_ns).read(info_of_endpoint.complete.typeid_with_size.type_id, 0);
}

}  // namespace indurop::dds
