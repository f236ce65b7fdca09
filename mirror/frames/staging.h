// SPDX-License-Identifier: Apache-2.0
// Frames of one board wait here until they make up one of its updates, so that its values are taken over together. What
// is lost on the way holds nothing up for long: values are then taken over as they come. Pure, one thread.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace indurop::mirror {

class Staging {
 public:
  static constexpr std::int64_t kPatienceNs = 5'000'000;

  enum class Verdict {
    Old,      // a newer frame of this part is known
    Wait,     // others of the update are to come
    Whole,    // what waits() is one update, all of it
    Overdue,  // others have not come in time: what waits() is of different updates
  };

  // Frames of a board's next session; nothing waits. `sizes`: bytes of each part that are wanted, 0: none.
  void reset(std::span<const std::uint32_t> sizes);
  // A frame of update number `update`. `sum`: of the numbers of the last updates of all parts, this update included.
  // A part is sent whole whenever something in it changed, so equal sums mean that nothing is missing: no number here
  // can be larger than the sender's.
  Verdict arrived(std::uint32_t number, std::uint64_t update, std::uint64_t sum, std::span<const std::uint8_t> data,
                  std::int64_t now_ns);

  // Calls `use(part, data)` for everything that waits, and nothing does any more.
  template <class Use>
  void take(Use use) {
    for (const std::uint32_t part : waiting_) {
      use(part, std::span<const std::uint8_t>(parts_[part].data));
      parts_[part].waits = false;
    }
    waiting_.clear();
  }

 private:
  struct Part {
    std::uint64_t update = 0;  // newest known
    bool waits = false;
    std::vector<std::uint8_t> data;
  };
  std::vector<Part> parts_;
  std::vector<std::uint32_t> waiting_;  // indices, in order of arrival
  std::uint64_t sum_ = 0;               // of the parts' numbers
  std::uint64_t newest_ = 0;            // update
  std::uint64_t newest_sum_ = 0;        // as its frames say
  std::int64_t since_ns_ = 0;           // not whole since then, 0: whole
};

}  // namespace indurop::mirror
