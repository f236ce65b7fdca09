// SPDX-License-Identifier: Apache-2.0
// The variables of a board as the server's stream shows them, and which of them have changed enough to be published.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/json.h"
#include "core/base/problem.h"
#include "core/schema/schema.h"

namespace indurop::mqtt {

// As in the stream; Stopped: the node does not run, these are its last values.
enum class Quality : std::uint8_t { Good = 0, Stale = 1, Silent = 2, Unread = 3, Stopped = 4 };
const char* word_of(Quality quality) noexcept;

// Numbers of these variables count as changed when they differ by more than `distance` from what was published last.
struct Deadband {
  std::string pattern;
  double distance = 0;
};

// A number, text or bool of a variable.
struct Leaf {
  std::string name;          // "knu::Robot::joints[1].y"
  std::uint32_t offset = 0;  // in the variable
  std::uint32_t size = 0;
  schema::Base base = schema::Base::Int32;
  std::string unit;
};

struct Variable {
  std::string name;
  schema::Type type;
  std::uint64_t size = 0;
  std::size_t offset = 0;  // in the record
  std::string unit;
  double deadband = 0;
  std::vector<Leaf> leaves;  // none if there are more than kMostLeaves
};

// A binary frame of the stream (docs/serve.md).
struct Frame {
  std::uint32_t stream = 0;
  bool alive = false;
  std::int64_t time_ns = 0;  // of the board
  std::int64_t wall_ns = 0;  // of the server, since 1970
  std::string_view bytes;
};
// Returns nothing if it is no frame of values, or of an unknown version.
std::optional<Frame> read_frame(std::string_view bytes);

// What of a variable differs from what was published before.
struct Change {
  std::size_t variable = 0;
  bool quality = false;
  std::vector<std::size_t> leaves;
};

class Board {
 public:
  static constexpr std::size_t kMostLeaves = 2000;

  // From the answer to a subscription. Errors: it does not describe a record.
  static Result<Board, base::Problem> from(const base::Json& subscribed, const std::vector<Deadband>& deadbands);

  // Takes over the values that have changed, and returns what changed; the first frame changes everything, and so does
  // one that tells that the node runs or no longer runs. A frame of
  // another stream or size changes nothing.
  std::vector<Change> update(const Frame& frame);

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] std::uint32_t stream() const noexcept { return stream_; }
  [[nodiscard]] bool is_alive() const noexcept { return alive_; }
  [[nodiscard]] bool has_values() const noexcept { return !bytes_.empty(); }
  [[nodiscard]] std::int64_t time_ns() const noexcept { return time_ns_; }
  [[nodiscard]] std::int64_t wall_ns() const noexcept { return wall_ns_; }
  [[nodiscard]] const std::vector<Variable>& variables() const noexcept { return variables_; }
  // The values that were published last; has_values() must be true.
  [[nodiscard]] std::span<const std::uint8_t> value(std::size_t variable) const;
  [[nodiscard]] std::span<const std::uint8_t> value(std::size_t variable, const Leaf& leaf) const;
  [[nodiscard]] Quality quality(std::size_t variable) const;
  [[nodiscard]] bool is_forced(std::size_t variable) const;

 private:
  std::string name_;
  std::uint32_t stream_ = 0;
  std::size_t record_size_ = 0;
  std::size_t quality_offset_ = 0;
  std::vector<Variable> variables_;
  std::vector<std::uint8_t> bytes_;  // the record as published; empty: nothing was received
  bool alive_ = false;
  std::int64_t time_ns_ = 0;
  std::int64_t wall_ns_ = 0;
};

}  // namespace indurop::mqtt
