// SPDX-License-Identifier: Apache-2.0
// Takes what there is on a node's tape to an MCAP file, again and again. Looks only: the node does not know of it. Not
// real-time safe; one thread at a time.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/problem.h"
#include "recording/mcap_writer.h"
#include "tape/follower.h"
#include "vars/store.h"

namespace indurop::recorder {

// What is said of the node in the file.
struct About {
  std::string node;
  std::string config;  // the file it runs
  std::string board;   // empty: none of a plant
  std::string deployment;
  std::string reason;  // why it was recorded; empty: somebody wanted it
  std::int64_t basic_period_ns = 0;
  std::int64_t real_minus_node_ns = 0;                     // CLOCK_REALTIME less the node's time
  std::vector<std::string> modules;                        // their names, by index
  std::vector<std::pair<std::string, std::string>> files;  // name and text of what it was configured with
};

struct Counts {
  std::uint64_t runs = 0;
  std::uint64_t values = 0;
  std::map<std::uint32_t, std::uint64_t> lost;  // runs of a module that were overwritten before they were read
};

class Recorder {
 public:
  // `globs`: variables that are wanted; none: all. The store is borrowed.
  // Errors: the file is there already or cannot be written; the tape is of another store; no variable has such a name.
  static Result<Recorder, base::Problem> create(const std::filesystem::path& path, const About& about,
                                                const vars::Store& store, tape::Follower follower,
                                                const std::vector<std::string>& globs);
  // One of several in a file, which begins with go_on_in(): its topics have `prefix` in front, "sensor/".
  // `matched`: which of the globs some variable has, kept as true. Errors: the tape is of another store.
  static Result<Recorder, base::Problem> create_one_of(const std::string& prefix, const About& about,
                                                       const vars::Store& store, tape::Follower follower,
                                                       const std::vector<std::string>& globs,
                                                       std::vector<bool>& matched);

  // Leaves out what there is by now: for a recording from now on. Before the first take().
  void learn();
  // Keeps in mind what every module knew last, for go_on_in(). Before the first take().
  void remember() { remembers_ = true; }
  // Takes the runs that ended before a time of the node. Errors: those of the disk; what was not taken can be taken
  // later, and nothing is written twice.
  Result<void, base::Problem> take(std::int64_t until_ns = std::numeric_limits<std::int64_t>::max());
  // End of the earliest run that take() left for later.
  [[nodiscard]] std::optional<std::int64_t> waiting_ns() const noexcept;
  // What is in memory goes to the file.
  Result<void, base::Problem> flush() { return writer_->flush(); }
  // A text beside the runs and values. Before conclude().
  Result<void, base::Problem> attach(std::string_view name, std::string_view text);
  // The counts go to the file. Nothing may be taken then before go_on_in().
  Result<void, base::Problem> conclude();
  // The same, and closes the file.
  Result<void, base::Problem> close();
  // Goes on in another file, which begins with what every module knew last, so that it can be read and replayed by
  // itself. Errors: those of the disk; it may be repeated with a new file.
  // `part`: number of the file, from 1; 0: the only one.
  Result<void, base::Problem> go_on_in(std::shared_ptr<recording::McapWriter> writer, std::uint64_t part = 0);

  [[nodiscard]] const Counts& counts() const noexcept { return counts_; }
  [[nodiscard]] std::uint64_t bytes() const noexcept { return writer_->size(); }
  [[nodiscard]] const About& about() const noexcept { return about_; }
  // End of the latest run that was taken, in the node's time; 0: none yet.
  [[nodiscard]] std::int64_t latest_ns() const noexcept { return latest_ns_; }
  [[nodiscard]] std::size_t variables() const noexcept { return wanted_count_; }
  // Wanted ones that no tape tells, they are too large.
  [[nodiscard]] const std::vector<std::string>& too_large() const noexcept { return too_large_; }

 private:
  Recorder(std::string prefix, const vars::Store& store, tape::Follower follower, About about)
      : prefix_(std::move(prefix)), store_(store), follower_(std::move(follower)), about_(std::move(about)) {}

  // What the runs of a track said last.
  struct Known {
    std::vector<std::vector<std::uint8_t>> values;  // by variable; empty: nothing
    std::int64_t end_ns = 0;                        // of its last run
  };

  // Read from the tape, and not or not wholly written.
  struct Held {
    tape::Run run;
    std::size_t written = 0;  // parts of it
  };

  void choose(const std::vector<std::string>& globs, std::vector<bool>& matched);
  Result<void, base::Problem> begin_file();
  Result<void, base::Problem> add_own_channels();
  Result<void, base::Problem> tell_first_values(const tape::Run& first);
  Result<void, base::Problem> tell_known_values();
  void note(std::size_t track, const tape::Run& run);
  Result<bool, base::Problem> take_run(std::size_t track, std::int64_t until_ns);
  Result<void, base::Problem> write_run(Held& held);
  Result<void, base::Problem> write_part(const tape::Run& run, std::size_t part);
  Result<void, base::Problem> write_value(const tape::Value& value, std::uint32_t module, std::int64_t time_ns,
                                          std::int64_t release_ns);
  Result<std::uint16_t, base::Problem> channel_of(std::uint32_t index);
  [[nodiscard]] const schema::Variable& variable(std::uint32_t index) const;
  [[nodiscard]] std::uint64_t real_time(std::int64_t node_ns) const noexcept;
  [[nodiscard]] std::uint64_t log_time(std::int64_t node_ns) const noexcept;

  std::shared_ptr<recording::McapWriter> writer_;
  std::string prefix_;  // of topics
  const vars::Store& store_;
  tape::Follower follower_;
  About about_;
  std::vector<bool> wanted_;
  std::vector<bool> copied_;  // those that lie in memory as in the file
  std::size_t wanted_count_ = 0;
  std::vector<std::string> too_large_;
  std::vector<std::uint16_t> channels_;  // of variables; 0: none yet
  std::map<std::string, std::uint16_t> schemas_;
  std::uint16_t runs_channel_ = 0;
  std::uint16_t clock_channel_ = 0;
  std::uint16_t told_channel_ = 0;
  bool remembers_ = false;
  bool first_told_ = false;
  std::vector<Known> known_;               // by track
  std::vector<std::optional<Held>> held_;  // by track
  std::int64_t begun_wall_ns_ = 0;         // tells the recording from others of the node; 0: of a simulation
  std::uint64_t part_ = 0;
  std::int64_t latest_ns_ = 0;
  std::int64_t begin_ns_ = 0;  // no message of this file is earlier; 0: as early as the first run
  std::vector<std::uint8_t> cdr_;
  Counts counts_;
  Counts before_;  // those at the begin of this file
};

}  // namespace indurop::recorder
