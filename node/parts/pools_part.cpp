// SPDX-License-Identifier: Apache-2.0
#include "node/parts/pools_part.h"

#include <chrono>
#include <utility>

namespace indurop::node {

Result<PoolsPart> PoolsPart::create(const std::string& node, const schema::Schema& schema) {
  PoolsPart part;
  std::vector<std::string> declared;
  for (const schema::Pool& pool : schema.pools) {
    auto made = pools::Pool::create(node, {pool.name, pool.type_hash, pool.type.element_size, pool.type.dims[0]});
    if (!made) {
      return made.error();
    }
    declared.push_back(vars::pool_file(node, pool.name_hash()));
    part.pools_.push_back(std::move(made).value());
  }
  pools::remove_others(node, declared);
  return part;
}

PoolsPart::~PoolsPart() {
  for (pools::Pool& pool : pools_) {
    pool.remove();
  }
}

void PoolsPart::sweep(rt::MonoTime now) noexcept {
  constexpr std::chrono::milliseconds kInterval{100};
  if (now < next_) {
    return;
  }
  next_ = now + kInterval;
  for (pools::Pool& pool : pools_) {
    (void)pool.sweep();
  }
}

}  // namespace indurop::node
