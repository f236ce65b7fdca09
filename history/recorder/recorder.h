// SPDX-License-Identifier: Apache-2.0
// Copies the data on a node's tape to an MCAP file, step by step. Only reads: the node is not affected. Not real-time
// safe; one thread at a time.

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

#include "core/base/problem.h"
#include "history/recorder/keyframe_queue.h"
#include "history/recorder/run_queue.h"
#include "history/recording/mcap_writer.h"
#include "store/tape/follower.h"
#include "store/vars/store.h"

namespace indurop::recorder {

// The description of the node in the file.
struct About {
  std::string node;
  std::string config;  // path of the configuration file that it runs
  std::string board;   // empty: no board of a plant
  std::string deployment;
  std::string reason;  // why it was recorded; empty: a user requested it
  std::int64_t basic_period_ns = 0;
  std::int64_t real_minus_node_ns = 0;                     // CLOCK_REALTIME minus the node's time
  std::vector<std::string> modules;                        // their names, by index
  std::vector<std::pair<std::string, std::string>> files;  // name and text of its configuration files
};

struct Counts {
  std::uint64_t runs = 0;
  std::uint64_t values = 0;
  std::map<std::uint32_t, std::uint64_t> lost;  // runs of a module that were overwritten before they were read
};

class Recorder {
 public:
  // `globs`: variables to record; none: all. The store is borrowed. Errors: the file exists already or cannot be
  // written; the tape belongs to another store; no variable matches a glob.
  static Result<Recorder, base::Problem> create(const std::filesystem::path& path, const About& about,
                                                const vars::Store& store, tape::Follower follower,
                                                const std::vector<std::string>& globs);
  // Creates one of several recorders for a file, which begins with go_on_in(): its topics get the prefix `prefix`,
  // "sensor/". `matched`: set to true for the globs that match a variable. Errors: the tape belongs to another store.
  static Result<Recorder, base::Problem> create_one_of(const std::string& prefix, const About& about,
                                                       const vars::Store& store, tape::Follower follower,
                                                       const std::vector<std::string>& globs,
                                                       std::vector<bool>& matched);

  // Skips what is on the tape now: for a recording from now on. To be called before the first take().
  void learn();
  // Keeps the last known values of every module, for go_on_in(). To be called before the first take().
  void remember() { remembers_ = true; }
  // Takes the runs that ended before `until_ns` (the node's time), in the order in which they began. Errors: those of
  // the disk; what was not taken can be taken later, and nothing is written twice.
  Result<void, base::Problem> take(std::int64_t until_ns = std::numeric_limits<std::int64_t>::max());
  // The end of the earliest run that take() left for later.
  [[nodiscard]] std::optional<std::int64_t> waiting_ns() const noexcept { return runs_.earliest_ns(); }
  // Writes what is in memory to the file.
  Result<void, base::Problem> flush() { return writer_->flush(); }
  // Begins to bring to the disk what is in the file, where it survives a loss of power.
  Result<void, base::Problem> begin_sync() { return writer_->begin_sync(); }
  // Attaches a text to the recording. To be called before conclude().
  Result<void, base::Problem> attach(std::string_view name, std::string_view text);
  // Writes the counts to the file. Afterwards nothing may be taken before go_on_in().
  Result<void, base::Problem> conclude();
  // As conclude(), and closes the file.
  Result<void, base::Problem> close();
  // Continues in another file, which begins with the last known values of every module, so that it can be read and
  // replayed on its own. Errors: those of the disk; it may be repeated with a new file.
  // `part`: number of the file, from 1; 0: the only one.
  Result<void, base::Problem> go_on_in(std::shared_ptr<recording::McapWriter> writer, std::uint64_t part = 0);

  [[nodiscard]] const Counts& counts() const noexcept { return counts_; }
  [[nodiscard]] std::uint64_t bytes() const noexcept { return writer_->size(); }
  [[nodiscard]] const About& about() const noexcept { return about_; }
  // The end of the latest run that was taken, in the node's time; 0: none yet.
  [[nodiscard]] std::int64_t latest_ns() const noexcept { return latest_ns_; }
  [[nodiscard]] std::size_t variables() const noexcept;
  // Requested variables that no tape records, because they are too large.
  [[nodiscard]] const std::vector<std::string>& too_large() const noexcept { return missing_.too_large; }
  // Requested variables that appeared while the node runs, and that no module has used yet.
  [[nodiscard]] const std::vector<std::string>& appeared() const noexcept { return missing_.appeared; }

 private:
  Recorder(std::string prefix, const vars::Store& store, tape::Follower follower, About about)
      : prefix_(std::move(prefix)), store_(&store), follower_(std::move(follower)), about_(std::move(about)) {}

  // The last values in the runs of a track.
  struct Known {
    std::vector<std::vector<std::uint8_t>> values;  // by variable; empty: not known
    std::int64_t end_ns = 0;                        // end of its last run
    std::uint32_t version = 0;                      // of its module, as this file says; 0: it says nothing
  };

  void choose(const std::vector<std::string>& globs, std::vector<bool>& matched);
  void add_places();
  Result<void, base::Problem> begin_file();
  Result<void, base::Problem> add_own_channels();
  Result<void, base::Problem> write_first_values(const tape::Run& first);
  Result<void, base::Problem> write_known_values();
  void note(std::size_t track, const tape::Run& run);
  Result<void, base::Problem> write_version(std::size_t track, const tape::Run& run);
  Result<bool, base::Problem> take_run(std::size_t track, std::int64_t until_ns);
  Result<void, base::Problem> write_run(RunQueue::Held& held);
  Result<void, base::Problem> write_part(const tape::Run& run, std::size_t part);
  Result<void, base::Problem> write_value(const tape::Value& value, std::uint32_t module, std::int64_t time_ns,
                                          std::int64_t release_ns);
  Result<std::uint16_t, base::Problem> schema_of(std::string_view name, const std::string& idl);
  Result<std::uint16_t, base::Problem> channel_of(std::uint32_t index);
  [[nodiscard]] bool records_inputs(std::uint32_t module) const;
  Result<std::uint16_t, base::Problem> keyframe_channel_of(std::uint32_t module);
  Result<void, base::Problem> write_keyframe(const RunQueue::Held& held);
  [[nodiscard]] const schema::Variable& variable(std::uint32_t index) const;
  [[nodiscard]] std::uint64_t real_time(std::int64_t node_ns) const noexcept;
  [[nodiscard]] std::uint64_t log_time(std::int64_t node_ns) const noexcept;

  std::shared_ptr<recording::McapWriter> writer_;
  std::string prefix_;  // topic prefix
  const vars::Store* store_;
  std::unique_ptr<vars::Store> own_store_;  // once it has grown beyond the borrowed one
  tape::Follower follower_;
  About about_;
  std::vector<std::string> globs_;
  struct Place {
    bool wanted = false;
    bool copied = false;        // it has the same bytes in memory and in the file
    std::uint16_t channel = 0;  // 0: none yet
  };
  std::vector<Place> places_;  // by variable
  struct Missing {
    std::vector<std::string> too_large;
    std::vector<std::string> appeared;
  };
  Missing missing_;
  std::map<std::string, std::uint16_t> schemas_;
  std::uint16_t runs_channel_ = 0;
  std::uint16_t clock_channel_ = 0;
  std::uint16_t answer_channel_ = 0;
  KeyframeQueue keyframes_;
  bool remembers_ = false;
  bool first_values_written_ = false;
  std::vector<Known> known_;  // by track
  RunQueue runs_;
  std::int64_t begun_wall_ns_ = 0;  // distinguishes the recording from others of the node; 0: of a simulation
  std::uint64_t part_ = 0;
  std::int64_t latest_ns_ = 0;
  std::int64_t begin_ns_ = 0;  // no message of this file is earlier; 0: as early as the first run
  std::vector<std::uint8_t> cdr_;
  Counts counts_;
  Counts before_;  // the counts at the begin of this file
};

}  // namespace indurop::recorder
