// SPDX-License-Identifier: Apache-2.0
// A node's name for one test, and the shape of its pool.

#pragma once

#include <unistd.h>

#include <string>

#include "pool_memory.h"
#include "store/pools/pool.h"

namespace indurop::pools::test {

inline const Shape kShape{"test::camera", 42, sizeof(Content), 4};  // NOLINT(cert-err58-cpp): tests

class PoolNode {
 public:
  explicit PoolNode(const std::string& label) : name_("t-pool-" + label + "-" + std::to_string(::getpid())) {
    remove();
  }
  PoolNode(const PoolNode&) = delete;
  PoolNode& operator=(const PoolNode&) = delete;
  ~PoolNode() { remove(); }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::string path() const {
    return std::string(vars::kShmDirectory) + "/" + vars::pool_files(name_).at(0);
  }

 private:
  void remove() const {
    for (const std::string& file : vars::pool_files(name_)) {
      static_cast<void>(vars::remove_shm_file(file));
    }
  }
  std::string name_;
};

}  // namespace indurop::pools::test
