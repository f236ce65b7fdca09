// SPDX-License-Identifier: Apache-2.0
// Topics that other participants publish, with types that need not be known beforehand. Used by one thread.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/rt/signal_word.h"
#include "core/schema/schema.h"
#include "network/dds/entity.h"
#include "network/dds/guid.h"

namespace indurop::dds {

struct Publication {
  Guid participant{};
  std::string topic;
  std::string type;             // its name
  InstanceHandle instance = 0;  // in the reader that stores the announcement
};

class Publications {
 public:
  // Changes wake `wake`, which is borrowed.
  Result<void, base::Problem> open(Handle participant, rt::SignalWord& wake);

  struct News {
    Guid endpoint{};
    std::optional<Publication> publication;  // empty: it is gone
  };
  // Returns the changes since the last call; own publications are left out.
  std::vector<News> take();

  // Returns its type as announced on the network; requests unknown types with at most `timeout_ns` for each. Errors:
  // the type is not available, or no variable can have it.
  [[nodiscard]] Result<schema::Type, base::Problem> type_of(const Publication& publication,
                                                            std::int64_t timeout_ns) const;

  // For network/dds/ only: calls `use` with the announced data; returns false if the publication is gone.
  bool with(const Publication& publication, const std::function<void(dds_builtintopic_endpoint_t&)>& use) const;

 private:
  Handle participant_ = 0;
  Guid own_{};
  Entity reader_;
};

}  // namespace indurop::dds
