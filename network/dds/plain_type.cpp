// SPDX-License-Identifier: Apache-2.0
#include "network/dds/plain_type.h"

#include <algorithm>
#include <utility>

namespace indurop::dds {
namespace {

constexpr std::uint32_t kLocated = DDS_OP_ADR;
constexpr std::uint32_t kArray = DDS_OP_TYPE_ARR;
constexpr std::uint32_t kFourBytes = 2U << DDS_OP_FLAG_SZ_SHIFT;

// The DDS code of a kind of value: for a single one, and, elsewhere in the word, for the elements of an array.
struct Kind {
  std::uint32_t value = 0;
  std::uint32_t flags = 0;
};

Kind kind_of(schema::Base base) noexcept {
  switch (base) {
    case schema::Base::Bool:
      return {DDS_OP_VAL_BLN};
    case schema::Base::Char:
    case schema::Base::Int8:
      return {DDS_OP_VAL_1BY, DDS_OP_FLAG_SGN};
    case schema::Base::UInt8:
      return {DDS_OP_VAL_1BY};
    case schema::Base::Int16:
      return {DDS_OP_VAL_2BY, DDS_OP_FLAG_SGN};
    case schema::Base::UInt16:
      return {DDS_OP_VAL_2BY};
    case schema::Base::Int32:
      return {DDS_OP_VAL_4BY, DDS_OP_FLAG_SGN};
    case schema::Base::UInt32:
      return {DDS_OP_VAL_4BY};
    case schema::Base::Int64:
      return {DDS_OP_VAL_8BY, DDS_OP_FLAG_SGN};
    case schema::Base::UInt64:
      return {DDS_OP_VAL_8BY};
    case schema::Base::Float:
      return {DDS_OP_VAL_4BY, DDS_OP_FLAG_FP};
    case schema::Base::Double:
      return {DDS_OP_VAL_8BY, DDS_OP_FLAG_FP};
    case schema::Base::Text:
      return {DDS_OP_VAL_BST};
    case schema::Base::Enum:
      return {DDS_OP_VAL_ENU, kFourBytes};
    case schema::Base::Struct:
      break;
  }
  return {};
}

std::uint32_t count_of(const schema::Type& type) noexcept {
  std::uint32_t count = 1;
  for (const std::uint32_t dim : type.dims) {
    count *= dim;
  }
  return count;
}

std::uint32_t greatest(const std::vector<schema::Enumerator>& enumerators) noexcept {
  std::int64_t most = 0;
  for (const schema::Enumerator& one : enumerators) {
    most = std::max(most, one.value);
  }
  return static_cast<std::uint32_t>(most);
}

}  // namespace

PlainType::PlainType(const schema::Type& type, std::string name)
    : name_(std::move(name)), size_(static_cast<std::uint32_t>(type.size())), align_(type.align) {
  add(type, 0);
  operations_.push_back(DDS_OP_RTS);
  ++instructions_;
}

void PlainType::add(const schema::Type& type, std::uint32_t offset) {
  const std::uint32_t count = count_of(type);
  if (type.base != schema::Base::Struct) {
    add_plain(type, offset, type.dims.empty() ? 0 : count);
    return;
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    for (const schema::Field& field : type.fields) {
      add(field.type, offset + i * type.element_size + field.offset);
    }
  }
}

// `count` 0: not an array.
void PlainType::add_plain(const schema::Type& type, std::uint32_t offset, std::uint32_t count) {
  const Kind kind = kind_of(type.base);
  const bool text = type.base == schema::Base::Text;
  ++instructions_;
  if (count == 0) {
    operations_.insert(operations_.end(), {kLocated | kind.value << 16U | kind.flags, offset});
  } else {
    operations_.insert(operations_.end(), {kLocated | kArray | kind.value << 8U | kind.flags, offset, count});
    if (text) {
      operations_.push_back(0);
    }
  }
  if (text) {
    operations_.push_back(type.text_size);
  } else if (type.base == schema::Base::Enum) {
    operations_.push_back(greatest(type.enumerators));
  }
}

TypeDescriptor PlainType::descriptor() const noexcept {
  // Only the first encoding of DDS has arrays of structs without a length before them.
  return {size_,
          align_,
          DDS_TOPIC_RESTRICT_DATA_REPRESENTATION,
          0,
          name_.c_str(),
          nullptr,
          instructions_,
          operations_.data(),
          "",
          {},
          {},
          DDS_DATA_REPRESENTATION_FLAG_XCDR1};
}

}  // namespace indurop::dds
