// SPDX-License-Identifier: Apache-2.0
// The recording of one node or of several in one file, or in parts one after the other, of which the oldest go so that
// the disk does not fill up. Every part can be read and replayed by itself.

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

#include "base/problem.h"
#include "recorder/recorder.h"

namespace indurop::recorder {

// 0: no limit.
struct Limits {
  std::int64_t split_ns = 0;  // a part tells so much
  std::uint64_t split_bytes = 0;
  std::int64_t keep_ns = 0;  // at least the newest so much stays
  std::uint64_t keep_bytes = 0;
  [[nodiscard]] bool in_parts() const noexcept { return split_ns + keep_ns > 0 || split_bytes + keep_bytes > 0; }
};

// A node that is recorded; its store is borrowed.
struct Taped {
  std::string prefix;  // of its topics, "sensor/"; empty: there is one node
  About about;
  const vars::Store* store = nullptr;
  tape::Follower follower;
};

class Parts {
 public:
  // "run.mcap" in parts is run.0001.mcap and so on. What is kept is split into eight if nothing is said of that.
  // Errors: as those of Recorder::create(); there are parts of another recording already.
  static Result<Parts, base::Problem> create(const std::filesystem::path& path, const Limits& limits,
                                             std::vector<Taped> nodes, const std::vector<std::string>& globs);

  void learn();
  // Takes what there is. If the disk is full, the oldest parts make room, if parts may go at all.
  // Errors: those of the disk.
  Result<void, base::Problem> take();
  Result<void, base::Problem> flush();
  // Beside the runs of the node of this number, in the part that is being written. Errors: those of the disk.
  Result<void, base::Problem> attach(std::size_t node, std::string_view name, std::string_view text);
  Result<void, base::Problem> close();

  // One for each node.
  [[nodiscard]] const std::vector<Recorder>& recorders() const noexcept { return recorders_; }
  // "run.mcap", "run.0003.mcap ... run.0010.mcap".
  [[nodiscard]] std::string files() const;
  // Of all parts that are there.
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
  std::uint64_t number_ = 1;  // of the open part
  std::int64_t begin_ns_ = 0;
  std::uint64_t removed_ = 0;
};

}  // namespace indurop::recorder
