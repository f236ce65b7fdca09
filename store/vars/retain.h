// SPDX-License-Identifier: Apache-2.0
// Values of `retain` variables on disk: two copies, written alternately, each complete or absent after a power loss at
// any moment. For a normal thread: nothing here is real-time safe.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "store/vars/store.h"

namespace indurop::vars {

// $INDUROP_STATE_DIR/<node>, else /var/lib/indurop/<node> for root, else
// ${XDG_STATE_HOME:-~/.local/state}/indurop/<node>.
std::filesystem::path state_directory(const std::string& node);

struct RetainReport {
  std::size_t restored = 0;        // variables
  std::vector<std::string> notes;  // one line each for people: damage that was found
  std::vector<std::string> lost;   // the same: values that do not fit their variable, and where they are kept
  std::vector<std::string> kept;   // names of what is not declared retain now: their values stay in the file

  // Returns a line about `kept` for people, empty if there is nothing.
  [[nodiscard]] std::string kept_line() const;
};

// The two files retain.a and retain.b in one directory. One object per directory at a time: the node lock ensures it.
class RetainFile {
 public:
  explicit RetainFile(std::filesystem::path directory);

  // Writes the newest valid copy's values into the store's retain variables of the same name; if the type differs,
  // whatever fits (core/schema/carry.h). If something is lost, the older file is kept as retain.before.N. Lines of the
  // report stay on the disk until a load without any. Without any file nothing happens; a damaged copy is a note. For a
  // store of Origin::Fresh. With `only_changed` for one that is CarriedOver, where variables of the same type are
  // newer. Errors: PermissionDenied, System (a file exists but cannot be read).
  Result<RetainReport> load(Store& store, bool only_changed = false);

  // Returns the lines of the last load's report.
  [[nodiscard]] std::vector<std::string> last_report() const;

  // Writes the present values over the older copy, and the values in it of variables that the store does not declare
  // retain; does not touch the disk if they equal the last saved ones. `written` (may be null) returns whether it
  // wrote. Errors: NoSpace, PermissionDenied, System; both older copies are kept then.
  Status save(const Store& store, bool* written = nullptr);

  // Removes both copies: the next start has initial values. Errors: PermissionDenied, System.
  Status erase();

 private:
  struct Copy {
    std::uint64_t sequence = 0;
    std::uint32_t version = 0;
    std::vector<std::uint8_t> payload;
  };
  Status scan(std::vector<std::string>& notes);
  void keep_report(RetainReport& report) const;
  void prepare(const Store& store);
  Status write_copy(const std::filesystem::path& target, const std::vector<std::uint8_t>& bytes) const;

  std::filesystem::path directory_;
  bool scanned_ = false;
  int newest_ = -1;                 // 0: a, 1: b, -1: none is valid
  Copy copy_;                       // contents of the newest
  std::uint64_t layout_ = 0;        // layout hash of the store that the following belong to
  std::string types_;               // types of all values in the file, as text
  std::vector<std::uint8_t> kept_;  // records of what that store does not declare retain
};

}  // namespace indurop::vars
