// SPDX-License-Identifier: Apache-2.0
// The recording of one node or of several in one file, or in consecutive parts, of which the oldest are deleted so that
// the disk does not fill up. Every part can be read and replayed on its own.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "history/recorder/recorder.h"

namespace indurop::recorder {

// The limits; 0: no limit.
struct Limits {
  std::int64_t split_ns = 0;  // maximum duration of a part
  std::uint64_t split_bytes = 0;
  std::int64_t keep_ns = 0;  // minimum duration of the newest data that is kept
  std::uint64_t keep_bytes = 0;
  [[nodiscard]] bool in_parts() const noexcept { return split_ns + keep_ns > 0 || split_bytes + keep_bytes > 0; }
};

// A node that is recorded; its store is borrowed.
struct Taped {
  std::string prefix;  // topic prefix, "sensor/"; empty: there is one node
  About about;
  const vars::Store* store = nullptr;
  tape::Follower follower;
};

class Parts {
 public:
  // Creates the recording; parts of "run.mcap" are run.0001.mcap and so on. With a keep limit but no split limit the
  // kept data is split into eight parts. Errors: those of Recorder::create(); parts of another recording exist already.
  static Result<Parts, base::Problem> create(const std::filesystem::path& path, const Limits& limits,
                                             std::vector<Taped> nodes, const std::vector<std::string>& globs);

  void learn();
  // Takes what is available. If the disk is full, the oldest parts are deleted, if parts may be deleted at all. Errors:
  // those of the disk.
  Result<void, base::Problem> take();
  // Writes what was taken to the file, and begins to bring it to the disk, where it survives a loss of power.
  Result<void, base::Problem> flush();
  // Attaches a text to the node of this number, in the part that is being written. Errors: those of the disk.
  Result<void, base::Problem> attach(std::size_t node, std::string_view name, std::string_view text);
  Result<void, base::Problem> close();

  // One recorder for each node.
  [[nodiscard]] const std::vector<Recorder>& recorders() const noexcept { return recorders_; }
  // Returns "run.mcap", or "run.0003.mcap ... run.0010.mcap".
  [[nodiscard]] std::string files() const;
  // Returns the size of all existing parts.
  [[nodiscard]] std::uint64_t bytes() const noexcept;
  [[nodiscard]] std::uint64_t removed() const noexcept { return removed_; }

 private:
  struct Part {
    std::filesystem::path path;
    std::int64_t end_ns = 0;
    std::uint64_t bytes = 0;
  };
  Parts(std::filesystem::path path, const Limits& limits, std::vector<Recorder> recorders)
      : path_(std::move(path)), limits_(limits), recorders_(std::move(recorders)) {}
  [[nodiscard]] std::filesystem::path path_of(std::uint64_t number) const;
  [[nodiscard]] bool part_is_full() const noexcept;
  [[nodiscard]] std::int64_t latest_ns() const noexcept;
  Result<void, base::Problem> begin(std::uint64_t number);
  Result<void, base::Problem> begin_next();
  Result<void, base::Problem> begin_next_if_needed();
  Result<void, base::Problem> take_until(std::int64_t until_ns);
  Result<void, base::Problem> take_portion(std::int64_t until_ns);
  [[nodiscard]] std::optional<std::int64_t> waiting_ns() const noexcept;
  template <class Work>
  Result<void, base::Problem> with_room(const Work& work);
  bool remove_oldest();
  void remove_old_ones();

  std::filesystem::path path_;
  Limits limits_;
  std::vector<Recorder> recorders_;
  std::shared_ptr<recording::McapWriter> writer_;
  std::deque<Part> closed_;
  std::uint64_t number_ = 1;  // number of the open part
  std::int64_t begin_ns_ = 0;
  std::uint64_t removed_ = 0;
};

}  // namespace indurop::recorder
