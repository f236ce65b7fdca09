// SPDX-License-Identifier: Apache-2.0
// What the group keeps from one period to the next. All of it lies in the group itself and in a few vectors that do not
// grow after loading. The planner is left out: between two plans it keeps nothing that counts.

#include <indurop/robot_layout.h>

#include <cstddef>
#include <cstdint>

#include "control/robot/group/group.h"

namespace indurop::robot {
namespace {

// Differs if any type has another layout: by its header, or by Eigen's.
constexpr std::uint64_t kLayout = kLayoutOfRobot + EIGEN_WORLD_VERSION * 10000 + EIGEN_MAJOR_VERSION * 100 +
                                  EIGEN_MINOR_VERSION + EIGEN_MAX_ALIGN_BYTES * 1000000ULL + sizeof(Group);

}  // namespace

void Group::begin_keeping() {
  auto* const begin = reinterpret_cast<std::byte*>(this);
  auto* const planner = reinterpret_cast<std::byte*>(&plans_.desk().planner());
  auto* const after = planner + sizeof(Planner);
  kept_.add(begin, static_cast<std::size_t>(planner - begin));
  kept_.add(after, static_cast<std::size_t>(reinterpret_cast<std::byte*>(&kept_) - after));
  const auto changing = [this](auto& row) { kept_.add(row.data(), row.size() * sizeof row[0]); };
  plans_.ahead().blocks(changing);
  shelf_.blocks(changing);
  robot_.follower.clear_way().blocks(changing);
  gate_.clear().blocks(changing);
  space_.blocks(changing);
  robot_.tool.blocks([this](const auto& one) { kept_.add_constant(&one, sizeof one); });
  for (const auto& one : robot_.parts.book.known) {
    kept_.add_constant(one.get(), sizeof *one);
  }
  kept_.begin(kLayout ^ robot_.parts.mark);
}

std::size_t Group::save(void* to, std::size_t most) const noexcept {
  return plans_.desk().at_rest() && !reloading_.used() ? kept_.save({static_cast<std::byte*>(to), most}) : 0;
}

bool Group::restore(const void* from, std::size_t bytes) noexcept {
  return !reloading_.used() && kept_.restore({static_cast<const std::byte*>(from), bytes});
}

}  // namespace indurop::robot
