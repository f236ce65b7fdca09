// SPDX-License-Identifier: Apache-2.0
// Which topics others in the network publish, with types that nobody here needs to know beforehand. One thread uses it.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/problem.h"
#include "dds/entity.h"
#include "dds/guid.h"
#include "rt/signal_word.h"
#include "schema/schema.h"

namespace indurop::dds {

struct Publication {
  Guid participant{};
  std::string topic;
  InstanceHandle instance = 0;  // of the reader that keeps what was told
};

class Publications {
 public:
  // News wake `wake`, which is borrowed.
  Result<void, base::Problem> open(Handle participant, rt::SignalWord& wake);

  struct News {
    Guid endpoint{};
    std::optional<Publication> publication;  // empty: it is gone
  };
  // What has come since; own publications are left out.
  std::vector<News> take();

  // Its type, as the network tells it: asks for what is not known yet, `timeout_ns` per type at most.
  // Errors: it cannot be had, or no variable can have it.
  [[nodiscard]] Result<schema::Type, base::Problem> type_of(const Publication& publication,
                                                            std::int64_t timeout_ns) const;

  // Within this room: what was told about it; false if it is gone.
  bool with(const Publication& publication, const std::function<void(dds_builtintopic_endpoint_t&)>& use) const;

 private:
  Handle participant_ = 0;
  Guid own_{};
  Entity reader_;
};

}  // namespace indurop::dds
