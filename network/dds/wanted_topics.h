// SPDX-License-Identifier: Apache-2.0
// Topics that other participants want to read, published or not.

#pragma once

#include <indurop/result.h>

#include <functional>
#include <string>

#include "core/base/problem.h"
#include "network/dds/entity.h"
#include "network/dds/guid.h"

namespace indurop::dds {

class WantedTopics {
 public:
  Result<void, base::Problem> open(Handle participant);
  void close() noexcept { reader_.reset(); }
  // Calls `use` for readers announced since the last call; own ones are left out.
  void take(const std::function<void(const std::string& topic)>& use);

 private:
  Guid own_{};
  Entity reader_;
};

}  // namespace indurop::dds
