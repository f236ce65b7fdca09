// SPDX-License-Identifier: Apache-2.0
#include "history/recording/cdr.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace indurop::recording {
namespace {

using schema::Base;
using schema::Type;

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

std::uint64_t elements(const Type& type) {
  std::uint64_t count = 1;
  for (const std::uint32_t dim : type.dims) {
    count *= dim;
  }
  return count;
}

std::size_t padding(std::size_t at, std::size_t align) {
  return (align - (at - kCdrHead.size()) % align) % align;
}

class Encoder {
 public:
  explicit Encoder(std::vector<std::uint8_t>& to) : to_(to) {}

  void value(const Type& type, const std::uint8_t* at) {
    const std::uint64_t count = elements(type);
    switch (type.base) {
      case Base::Struct:
        for (std::uint64_t i = 0; i < count && !type.fields.empty(); ++i, at += type.element_size) {
          for (const schema::Field& field : type.fields) {
            value(field.type, at + field.offset);
          }
        }
        return;
      case Base::Text:
        for (std::uint64_t i = 0; i < count; ++i, at += type.element_size) {
          text(type, at);
        }
        return;
      case Base::Bool:
        std::transform(at, at + count, grown(1, count), [](std::uint8_t byte) { return byte != 0 ? 1 : 0; });
        return;
      default:
        numbers(schema::size_of(type.base), count, at);
    }
  }

 private:
  // Appends room for `count` numbers of `size` bytes each.
  std::uint8_t* grown(std::size_t size, std::uint64_t count) {
    const std::size_t begin = to_.size() + padding(to_.size(), size);
    to_.resize(begin + size * count);
    return to_.data() + begin;
  }
  void numbers(std::size_t size, std::uint64_t count, const std::uint8_t* at) {
    std::uint8_t* room = grown(size, count);
    std::copy_n(at, size * count, room);
  }
  void text(const Type& type, const std::uint8_t* at) {
    const std::size_t most = type.text_size == 0 ? 0 : type.text_size - 1;
    const std::uint8_t* end = std::find(at, at + most, 0);
    const auto length = static_cast<std::uint32_t>(end - at);
    const std::uint32_t with_nul = length + 1;
    std::memcpy(grown(sizeof with_nul, 1), &with_nul, sizeof with_nul);
    to_.insert(to_.end(), at, end);
    to_.push_back(0);
  }

  std::vector<std::uint8_t>& to_;
};

// Each function returns false if the bytes are no valid value.
class Decoder {
 public:
  explicit Decoder(std::span<const std::uint8_t> from) : from_(from) {}

  [[nodiscard]] bool at_end() const { return at_ == from_.size(); }

  bool value(const Type& type, std::uint8_t* to) {
    const std::uint64_t count = elements(type);
    switch (type.base) {
      case Base::Struct:
        return structs(type, count, to);
      case Base::Text:
        for (std::uint64_t i = 0; i < count; ++i, to += type.element_size) {
          if (!text(type, to)) {
            return false;
          }
        }
        return true;
      case Base::Bool:
        return numbers(1, count, to) && std::all_of(to, to + count, [](std::uint8_t byte) { return byte <= 1; });
      default:
        return numbers(schema::size_of(type.base), count, to);
    }
  }

 private:
  bool structs(const Type& type, std::uint64_t count, std::uint8_t* to) {
    for (std::uint64_t i = 0; i < count && !type.fields.empty(); ++i, to += type.element_size) {
      for (const schema::Field& field : type.fields) {
        if (!value(field.type, to + field.offset)) {
          return false;
        }
      }
    }
    return true;
  }
  bool numbers(std::size_t size, std::uint64_t count, std::uint8_t* to) {
    const std::size_t begin = at_ + padding(at_, size);
    if (begin > from_.size() || (from_.size() - begin) / size < count) {
      return false;
    }
    std::copy_n(from_.data() + begin, size * count, to);
    at_ = begin + size * count;
    return true;
  }
  bool text(const Type& type, std::uint8_t* to) {
    std::array<std::uint8_t, 4> bytes{};
    if (!numbers(sizeof bytes, 1, bytes.data())) {
      return false;
    }
    const auto length = std::bit_cast<std::uint32_t>(bytes);
    if (length == 0 || length > std::max(type.text_size, 1U) || from_.size() - at_ < length ||
        from_[at_ + length - 1] != 0) {
      return false;
    }
    std::copy_n(from_.data() + at_, length - 1, to);
    at_ += length;
    return true;
  }

  std::span<const std::uint8_t> from_;
  std::size_t at_ = kCdrHead.size();
};

// `end`: end of the bytes that are known to match; is moved past those of `type`, which begin at `at`.
bool lies_so(const Type& type, std::size_t at, std::size_t& end) {
  const std::uint64_t count = elements(type);
  if (type.base == Base::Text || type.base == Base::Bool) {
    return false;
  }
  if (type.base == Base::Struct) {
    for (std::uint64_t i = 0; i < count; ++i, at += type.element_size) {
      for (const schema::Field& field : type.fields) {
        if (!lies_so(field.type, at + field.offset, end)) {
          return false;
        }
      }
    }
    return true;
  }
  const std::size_t size = schema::size_of(type.base);
  const bool so = at == end && at % size == 0;
  end += size * count;
  return so;
}

constexpr Error kWrongSize{Errc::InvalidArgument, 0, "a value of another size than its type"};

}  // namespace

Status to_cdr(const Type& type, std::span<const std::uint8_t> value, std::vector<std::uint8_t>& cdr) {
  if (value.size() != type.size()) {
    return kWrongSize;
  }
  cdr.assign(kCdrHead.begin(), kCdrHead.end());
  Encoder(cdr).value(type, value.data());
  return {};
}

bool lies_as_cdr(const Type& type) {
  std::size_t end = 0;
  return lies_so(type, 0, end) && end == type.size();
}

Status from_cdr(const Type& type, std::span<const std::uint8_t> cdr, std::span<std::uint8_t> value) {
  if (value.size() != type.size()) {
    return kWrongSize;
  }
  if (cdr.size() < kCdrHead.size()) {
    return Error{Errc::Corrupt, 0, "a value without the header of CDR"};
  }
  if (cdr[0] != kCdrHead[0] || cdr[1] != kCdrHead[1]) {
    return Error{Errc::Unsupported, 0, "a value in another encoding than CDR in little endian"};
  }
  std::fill(value.begin(), value.end(), std::uint8_t{0});
  Decoder decoder(cdr);
  if (!decoder.value(type, value.data()) || !decoder.at_end()) {
    return Error{Errc::Corrupt, 0, "a value that is not of its type"};
  }
  return {};
}

}  // namespace indurop::recording
