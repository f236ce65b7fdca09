// SPDX-License-Identifier: Apache-2.0
// Collects frames of one board until they form one of its updates, so that its values are written together. Lost frames
// do not delay the others for long: values are then written as they come. Pure, one thread.

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
    Wait,     // other frames of the update are to come
    Whole,    // what waits() is one complete update
    Overdue,  // other frames have not come in time: what waits() is of different updates
  };

  // Starts the next session of a board; no frames wait. `sizes`: bytes required of each part, 0: part not used.
  void reset(std::span<const std::uint32_t> sizes);
  // The board has more parts, or other bytes of its parts are required. No frames wait: call take() before.
  void resize(std::span<const std::uint32_t> sizes);
  // A frame of update number `update` arrived. `sum`: of the numbers of the last updates of all parts, this update
  // included. A part is sent whole whenever something in it has changed, so equal sums mean that nothing is missing: no
  // number held locally can be larger than the sender's.
  Verdict arrived(std::uint32_t number, std::uint64_t update, std::uint64_t sum, std::span<const std::uint8_t> data,
                  std::int64_t now_ns);

  [[nodiscard]] bool has_waiting() const noexcept { return !waiting_.empty(); }
  // Calls `use(part, data)` for all waiting frames; none wait afterwards.
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
  std::uint64_t sum_ = 0;               // sum of the parts' numbers
  std::uint64_t newest_ = 0;            // newest update
  std::uint64_t newest_sum_ = 0;        // sum that its frames give
  std::int64_t since_ns_ = 0;           // incomplete since then, 0: complete
};

}  // namespace indurop::mirror
