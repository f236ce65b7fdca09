// SPDX-License-Identifier: Apache-2.0
// Wrong tokens and certificates by address: how long a refusal is delayed, and when it is logged. Its memory is bounded
// under any load. Pure numbers, no sockets.

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "core/base/note_limit.h"

namespace indurop::serve {

class WrongTokens {
 public:
  static constexpr std::size_t kMostAddresses = 256;
  static constexpr std::int64_t kWindowNs = base::NoteLimit::kWindowNs;  // after this time without a wrong one the
                                                                         // counts are cleared
  static constexpr std::uint64_t kAtOnce = 3;                            // these are refused without delay
  static constexpr std::int64_t kFirstDelayNs = 250'000'000;             // doubled with each further one
  static constexpr std::int64_t kMostDelayNs = 2'000'000'000;
  static constexpr std::uint64_t kMostNotes = base::NoteLimit::kMostNotes;  // for all addresses together

  struct Verdict {
    std::int64_t delay_ns = 0;
    std::uint64_t note = 0;  // number of refusals to log now, this one included; 0: log nothing
  };
  // Counts another refusal of this address.
  Verdict wrong(const std::string& address, std::int64_t now_ns);
  [[nodiscard]] std::size_t size() const noexcept { return all_.size(); }

 private:
  struct One {
    std::uint64_t count = 0;
    std::uint64_t not_noted = 0;
    std::int64_t last_ns = 0;
    std::int64_t noted_ns = 0;
  };
  One& of(const std::string& key, std::int64_t now_ns);

  std::map<std::string, One> all_;
  base::NoteLimit notes_;
};

}  // namespace indurop::serve
