// SPDX-License-Identifier: Apache-2.0
// Random types and values for the tests of recordings.

#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/schema/schema.h"
#include "tests/unit/core/schema/types.h"

namespace indurop::recording {

class RandomValue {
 public:
  explicit RandomValue(std::uint32_t seed) : random_(seed) {}

  std::uint32_t below(std::uint32_t limit) {
    return std::uniform_int_distribution<std::uint32_t>(0, limit - 1)(random_);
  }

  schema::Type type(int depth = 3) {
    schema::Type out = element(depth);
    for (std::uint32_t n = below(8) / 5; n > 0; --n) {
      out.dims.push_back(1 + below(3));
    }
    return out;
  }

  // What a program could have put there: padding and the bytes behind a text's end are 0.
  std::vector<std::uint8_t> value(const schema::Type& type) {
    std::vector<std::uint8_t> out(type.size());
    fill(type, out.data());
    return out;
  }

 private:
  schema::Type element(int depth) {
    const std::uint32_t kind = below(depth > 0 ? 18 : 14);
    if (kind < 12) {
      return schema::number(static_cast<schema::Base>(kind));
    }
    if (kind == 12) {
      return schema::text(2 + below(12));
    }
    const std::string name = (below(3) == 0   ? ""
                              : below(2) == 0 ? "a::"
                                              : "a::b_c::") +
                             ("t" + std::to_string(++names_));
    if (kind == 13) {
      return schema::enumeration(name, {{"one_" + std::to_string(names_), 0},
                                        {"Port_" + std::to_string(names_), 7},
                                        {"low_" + std::to_string(names_), -3}});
    }
    static const std::vector<std::string> kFields{"x", "port", "value", "byte", "Any"};
    std::vector<std::pair<std::string, schema::Type>> fields;
    for (std::uint32_t i = 0; i <= below(5); ++i) {
      fields.emplace_back(kFields[i], type(depth - 1));
    }
    return schema::structure(name, fields);
  }

  void fill(const schema::Type& type, std::uint8_t* at) {
    const std::uint64_t count = type.element_size == 0 ? 0 : type.size() / type.element_size;
    for (std::uint64_t i = 0; i < count; ++i, at += type.element_size) {
      one(type, at);
    }
  }

  void one(const schema::Type& type, std::uint8_t* at) {
    switch (type.base) {
      case schema::Base::Struct:
        for (const schema::Field& field : type.fields) {
          fill(field.type, at + field.offset);
        }
        return;
      case schema::Base::Text:
        for (std::uint32_t i = below(type.text_size); i > 0; --i) {
          *at++ = static_cast<std::uint8_t>('a' + below(26));
        }
        return;
      case schema::Base::Bool:
        *at = static_cast<std::uint8_t>(below(2));
        return;
      case schema::Base::Float: {
        const float number = std::uniform_real_distribution<float>(-1e6F, 1e6F)(random_);
        std::memcpy(at, &number, sizeof number);
        return;
      }
      case schema::Base::Double: {
        const double number = std::uniform_real_distribution<double>(-1e9, 1e9)(random_);
        std::memcpy(at, &number, sizeof number);
        return;
      }
      default:
        std::generate_n(at, type.element_size, [this] { return static_cast<std::uint8_t>(random_()); });
    }
  }

  std::mt19937 random_;
  int names_ = 0;
};

}  // namespace indurop::recording
