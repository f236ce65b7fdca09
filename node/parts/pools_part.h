// SPDX-License-Identifier: Apache-2.0
// The pools of large data that the modules of a node declare: made before the first module is loaded, watched in the
// background, removed at an orderly end.

#pragma once

#include <indurop/result.h>

#include <string>
#include <vector>

#include "core/rt/clock.h"
#include "core/schema/schema.h"
#include "store/pools/pool.h"

namespace indurop::node {

class PoolsPart {
 public:
  // Pools that a killed run left are adopted if they are still declared, else removed. Errors: those of
  // pools::Pool::create().
  static Result<PoolsPart> create(const std::string& node, const schema::Schema& schema);
  PoolsPart(PoolsPart&&) noexcept = default;
  PoolsPart& operator=(PoolsPart&&) = delete;
  PoolsPart(const PoolsPart&) = delete;
  PoolsPart& operator=(const PoolsPart&) = delete;
  ~PoolsPart();

  // Frees what processes had in their hand that are gone; at most ten times a second.
  void sweep(rt::MonoTime now) noexcept;

 private:
  PoolsPart() = default;
  std::vector<pools::Pool> pools_;
  rt::MonoTime next_{};
};

}  // namespace indurop::node
