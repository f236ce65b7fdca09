// SPDX-License-Identifier: Apache-2.0
// Data of boards that could not be sent, in files of a folder: kept over the end of the program, however it ends, until
// a broker has confirmed them. When they take more room than is allowed, the oldest file is removed.
//
// A file (a segment) is a list of records: the metrics of a board with their names and aliases, before its first data,
// and data with aliases only. A record that was being written when the program was killed ends its file.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/base/descriptor.h"
#include "core/base/problem.h"
#include "doors/mqtt/sparkplug/payload.h"

namespace indurop::mqtt {

class Backlog {
 public:
  // A place between two records.
  struct Position {
    std::uint64_t segment = 0;
    std::uint64_t offset = 0;
    auto operator<=>(const Position&) const = default;
  };
  // Data of one moment, with names instead of aliases, marked as historical.
  struct Stored {
    std::string board;
    Payload payload;
    Position begin;
    Position end;
  };

  // Creates the folder. `most_bytes`: of all files, at least 1 MiB. Errors: the folder cannot be used.
  static Result<Backlog, base::Problem> open(const std::filesystem::path& folder, std::uint64_t most_bytes);

  // The metrics of a board, with name, alias and type, from now on. Aliases of all boards differ.
  void set_names(const std::string& board, const Payload& names);
  // Keeps data of a board whose names are known. Returns why that failed, else an empty text. It outlives the program,
  // and after sync() a loss of power.
  std::string add(const std::string& board, const Payload& data);
  void sync();

  [[nodiscard]] bool is_empty() const noexcept { return bytes_.empty(); }
  // Returns the oldest data that were not read yet, about `most_bytes` of them.
  std::vector<Stored> read(std::uint64_t most_bytes);
  // Reads again from this place on.
  void seek(const Position& to) noexcept { read_ = to; }
  // What was read ends here.
  [[nodiscard]] Position position() const noexcept { return read_; }
  // What is before this place was received by the broker, and is removed.
  void commit(const Position& end);
  // Begins to read again at the oldest data.
  void rewind();
  // The bytes that were removed because there was no room.
  [[nodiscard]] std::uint64_t lost_bytes() const noexcept { return lost_bytes_; }

 private:
  struct Name {
    std::string board;
    std::string metric;
  };
  explicit Backlog(std::filesystem::path folder, std::uint64_t most_bytes)
      : folder_(std::move(folder)), most_bytes_(most_bytes) {}
  [[nodiscard]] std::filesystem::path file_of(std::uint64_t segment) const;
  [[nodiscard]] std::uint64_t complete_bytes(std::uint64_t segment) const;
  void find_segments();
  // Returns why it failed, else an empty text.
  std::string begin_segment();
  std::string write_record(std::uint32_t kind, const std::string& body);
  void make_room();
  void remove(std::uint64_t segment);
  // Reads about `most_bytes` of records of the segment at `read_`.
  void read_segment(std::uint64_t most_bytes, std::vector<Stored>& to);
  void take_names(std::string_view body);
  [[nodiscard]] std::vector<Stored> data_of(std::string_view body, const Position& begin, const Position& end) const;

  std::filesystem::path folder_;
  std::uint64_t most_bytes_;
  std::map<std::uint64_t, std::uint64_t> bytes_;  // by segment
  std::map<std::string, std::string> names_;      // of boards, as bodies of records
  std::set<std::string> written_names_;           // boards whose names are in the segment that is written
  base::Descriptor file_;                         // of that segment; closed: the next record begins one
  std::uint64_t writing_ = 0;
  std::uint64_t last_segment_ = 0;
  Position read_;
  std::uint64_t names_of_ = 0;           // segment whose names are in `known_`
  std::map<std::uint64_t, Name> known_;  // by alias
  std::string text_;                     // the segment that is read
  std::uint64_t text_of_ = 0;
  std::uint64_t lost_bytes_ = 0;
  bool unsynced_ = false;
};

}  // namespace indurop::mqtt
