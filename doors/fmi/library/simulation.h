// SPDX-License-Identifier: Apache-2.0
// The configuration of an FMU in virtual time: a node, or the nodes of a plant, and the variables of the FMU in them.

#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/schema/place_index.h"
#include "core/schema/schema.h"
#include "doors/fmi/library/resources.h"
#include "store/vars/store.h"
#include "tools/testing/node_process.h"

namespace indurop::fmi {

// Used by one thread at a time. Errors are std::runtime_error, as those of NodeProcess: what failed, and the last
// output of the node.
class Simulation {
 public:
  explicit Simulation(const Resources& resources);

  [[nodiscard]] std::chrono::nanoseconds basic_period() const;
  // Runs until so many ticks have run since the start.
  void run_to(std::uint64_t ticks);
  // Returns what happened to modules since the last call, "module main faulted: exception"; empty: no faults.
  [[nodiscard]] std::string new_faults();
  // Returns what node and modules printed since the last call, in whole lines.
  [[nodiscard]] std::string new_output();

  // Part of a shared variable. `variable` is an index into Contents::variables.
  [[nodiscard]] const schema::Type& type(std::size_t variable) const { return parts_[variable].front().type; }
  [[nodiscard]] const std::optional<schema::Range>& range(std::size_t variable) const {
    return parts_[variable].front().range;
  }
  // `to` and `from` have at most type().size() bytes.
  void read(std::size_t variable, std::span<std::uint8_t> to) const;
  void write(std::size_t variable, std::span<const std::uint8_t> from);

 private:
  struct Part {  // of a variable on one board
    vars::Store* store = nullptr;
    const vars::DirectoryEntry* entry = nullptr;
    std::uint32_t offset = 0;
    schema::Type type;
    std::optional<schema::Range> range;
  };
  [[nodiscard]] Part find(const std::string& variable, const std::string& board,
                          const std::vector<schema::PlaceIndex>& indices) const;

  std::string name_;
  testing::NodeProcess node_;
  std::vector<std::unique_ptr<vars::Store>> stores_;  // of the node's boards
  std::vector<std::vector<Part>> parts_;
  std::vector<std::uint64_t> faults_;  // of all modules, in the order of boards
  std::size_t printed_ = 0;            // bytes of output that new_output() has returned
};

}  // namespace indurop::fmi
