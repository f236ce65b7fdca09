// SPDX-License-Identifier: Apache-2.0
// Small schemas made by hand, and a unique node name, removed with all its files at the end.

#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/schema/schema.h"
#include "store/vars/shm_file.h"

namespace indurop::vars::test {

inline schema::Type scalar_type(schema::Base base) {
  schema::Type type;
  type.base = base;
  type.element_size = schema::size_of(base);
  type.align = type.element_size;
  return type;
}

inline schema::Type array_type(schema::Base base, std::uint32_t count) {
  schema::Type type = scalar_type(base);
  type.dims = {count};
  return type;
}

inline schema::Variable variable(const std::string& name, const schema::Type& type, bool retain = false) {
  schema::Variable made;
  made.name = name;
  made.type = type;
  made.kind = type.dims.empty() && type.base != schema::Base::Struct ? abi::Kind::Scalar : abi::Kind::Ring;
  made.type_hash = schema::hash_of(type);
  made.retain = retain;
  return made;
}

template <class T>
std::vector<std::uint8_t> bytes_of(const T& value) {
  std::vector<std::uint8_t> bytes(sizeof(T));
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

inline std::uint64_t hash(const std::string& name) {
  return abi::fnv1a64(name.data(), name.size());
}

class TestNode {
 public:
  explicit TestNode(const std::string& label) : name_("t-" + label + "-" + std::to_string(::getpid())) { remove(); }
  TestNode(const TestNode&) = delete;
  TestNode& operator=(const TestNode&) = delete;
  ~TestNode() { remove(); }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::string path() const { return std::string(kShmDirectory) + "/" + block_file(name_); }
  void remove() const {
    for (const std::string& file :
         {block_file(name_), run_file(name_), tape_file(name_), keyframe_file(name_), lock_file(name_)}) {
      static_cast<void>(remove_shm_file(file));
      static_cast<void>(remove_unfinished(file));
    }
  }

 private:
  std::string name_;
};

}  // namespace indurop::vars::test
