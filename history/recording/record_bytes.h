// SPDX-License-Identifier: Apache-2.0
// Encodes and decodes MCAP records: little endian, texts and lists preceded by their length in bytes.

#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "history/recording/records.h"

namespace indurop::recording {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

// Appends fields to `to`.
class FieldWriter {
 public:
  explicit FieldWriter(Bytes& to) : to_(to) {}

  template <std::unsigned_integral Number>
  void put(Number number) {
    const std::size_t at = to_.size();
    to_.resize(at + sizeof number);
    std::memcpy(to_.data() + at, &number, sizeof number);
  }
  void put(const std::string& text) {
    put(static_cast<std::uint32_t>(text.size()));
    to_.insert(to_.end(), text.begin(), text.end());
  }
  void put(const LongBytes& bytes) {
    put(std::uint64_t{bytes.view.size()});
    put(RestBytes{bytes.view});
  }
  void put(const RestBytes& bytes) { to_.insert(to_.end(), bytes.view.begin(), bytes.view.end()); }
  void put(const TextMap& map) { list(map); }
  template <class First, class Second>
  void put(const std::vector<std::pair<First, Second>>& pairs) {
    list(pairs);
  }
  // As above, in one copy: a recording has one such pair for each message.
  void put(const std::vector<std::pair<std::uint64_t, std::uint64_t>>& pairs) {
    constexpr std::size_t kSize = sizeof(std::uint64_t);
    const std::size_t size = pairs.size() * 2 * kSize;
    put(static_cast<std::uint32_t>(size));
    std::size_t at = to_.size();
    to_.resize(at + size);
    for (const auto& [first, second] : pairs) {
      std::memcpy(to_.data() + at, &first, kSize);
      std::memcpy(to_.data() + at + kSize, &second, kSize);
      at += 2 * kSize;
    }
  }

 private:
  void list(const auto& pairs) {
    const std::size_t at = to_.size();
    put(std::uint32_t{0});
    for (const auto& [first, second] : pairs) {
      put(first);
      put(second);
    }
    const auto length = static_cast<std::uint32_t>(to_.size() - at - sizeof(std::uint32_t));
    std::memcpy(to_.data() + at, &length, sizeof length);
  }

  Bytes& to_;
};

// Reads fields from the front of `from`. Each call returns false if the bytes hold no such field.
class FieldReader {
 public:
  explicit FieldReader(View from) : from_(from) {}

  [[nodiscard]] View rest() const { return from_; }

  template <std::unsigned_integral Number>
  bool get(Number& number) {
    if (from_.size() < sizeof number) {
      return false;
    }
    std::memcpy(&number, from_.data(), sizeof number);
    from_ = from_.subspan(sizeof number);
    return true;
  }
  bool get(std::string& text) {
    std::uint32_t length = 0;
    View bytes;
    if (!get(length) || !take(length, bytes)) {
      return false;
    }
    text.assign(bytes.begin(), bytes.end());
    return true;
  }
  bool get(LongBytes& bytes) {
    std::uint64_t length = 0;
    return get(length) && take(length, bytes.view);
  }
  bool get(RestBytes& bytes) { return take(from_.size(), bytes.view); }
  bool get(TextMap& map) {
    return list([&map](FieldReader& each) {
      std::string key;
      std::string value;
      const bool good = each.get(key) && each.get(value);
      map[std::move(key)] = std::move(value);
      return good;
    });
  }
  template <class First, class Second>
  bool get(std::vector<std::pair<First, Second>>& pairs) {
    return list([&pairs](FieldReader& each) {
      auto& [first, second] = pairs.emplace_back();
      return each.get(first) && each.get(second);
    });
  }

 private:
  bool take(std::uint64_t length, View& bytes) {
    if (length > from_.size()) {
      return false;
    }
    bytes = from_.first(length);
    from_ = from_.subspan(length);
    return true;
  }
  bool list(auto read_one) {
    std::uint32_t length = 0;
    View bytes;
    if (!get(length) || !take(length, bytes)) {
      return false;
    }
    FieldReader inside(bytes);
    while (!inside.from_.empty()) {
      if (!read_one(inside)) {
        return false;
      }
    }
    return true;
  }

  View from_;
};

// Appends the whole record, with opcode and length.
template <class Record>
void append_record(Bytes& to, const Record& record) {
  FieldWriter writer(to);
  writer.put(static_cast<std::uint8_t>(Record::kOpcode));
  const std::size_t at = to.size();
  writer.put(std::uint64_t{0});
  Record::fields(record, [&writer](const auto&... field) { (writer.put(field), ...); });
  const std::uint64_t length = to.size() - at - sizeof(std::uint64_t);
  std::memcpy(to.data() + at, &length, sizeof length);
}

// Reads the content of a record, which begins after its length. Unknown fields after the last known one are ignored.
template <class Record>
[[nodiscard]] bool read_record(View content, Record& record) {
  FieldReader reader(content);
  bool good = false;
  Record::fields(record, [&](auto&... field) { good = (reader.get(field) && ...); });
  return good;
}

}  // namespace indurop::recording
