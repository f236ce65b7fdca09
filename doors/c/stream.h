// SPDX-License-Identifier: Apache-2.0
// Rows of values from a node's tape: one for each run of the modules that write the variables.

#pragma once

#include <indurop/c.h>
#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "doors/c/failure.h"
#include "doors/c/node.h"
#include "store/tape/follower.h"

struct irp_stream {
 public:
  static indurop::Result<irp_stream*, indurop::c::Failure> open(const irp_node& node,
                                                                std::span<const std::uint32_t> ids, bool past);

  // Where a row has the value of each column; the row's tick and time come first.
  struct RowForm {
    std::size_t size = 0;
    std::span<const std::size_t> offsets;
  };
  [[nodiscard]] std::size_t columns() const noexcept { return columns_.size(); }
  [[nodiscard]] indurop::Result<void, indurop::c::Failure> fits(const RowForm& form) const;
  // Writes the next row; returns false if none is ready.
  bool next(const RowForm& form, std::uint8_t* row);
  [[nodiscard]] bool has_runs() const noexcept;  // that were read and have no row yet
  [[nodiscard]] const irp_node& node() const noexcept { return node_; }
  [[nodiscard]] std::uint64_t lost() const noexcept;

 private:
  struct Column {
    std::uint32_t variable = 0;  // index in the store's directory
    std::uint32_t offset = 0;    // of the part
    std::vector<std::uint8_t> bytes;
  };
  struct Track {
    std::size_t number = 0;
    std::vector<std::size_t> columns;  // that this track tells
    bool has_run = false;
    indurop::tape::Run run;  // the next one, if has_run
  };
  irp_stream(const irp_node& node, indurop::tape::Follower follower) : node_(node), follower_(std::move(follower)) {}
  indurop::Result<void, indurop::c::Failure> add_column(std::uint32_t id);
  indurop::Result<void, indurop::c::Failure> take_present_values();
  Track& track(std::size_t number);
  Track* earliest();
  void apply(const Track& track);

  const irp_node& node_;
  indurop::tape::Follower follower_;
  std::vector<Column> columns_;
  std::vector<Track> tracks_;
  std::int64_t from_ns_ = 0;  // rows begin with the first run that ends later
};
