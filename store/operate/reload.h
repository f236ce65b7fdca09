// SPDX-License-Identifier: Apache-2.0
// Exchanging the code of a module while the node runs: what is requested, and what the node reports. Two files in the
// node's folder; the command itself goes through the run block (ModuleCommand::Reload). Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/descriptor.h"
#include "core/base/json.h"

namespace indurop::operate {

struct ReloadRequest {
  std::string file;            // of the new version; empty: the file of the configuration
  bool lossy = false;          // exchange although values are lost
  bool dry_run = false;        // load, compare and report only
  std::int64_t health_ns = 0;  // after the exchange, the previous version runs again for this long if the new one fails
  std::string guard;           // condition that must hold meanwhile, "O0 == 0"; empty: none
};

// What an exchange carries: names of variables that the versions keep.
struct ReloadPlan {
  bool compared = true;  // false: only a process of the new version tells what is carried
  bool with_state = false;
  std::string why_not;                 // why the new version begins with its initial values; empty: it does not
  std::uint64_t bytes = 0;             // that are carried
  std::vector<std::string> kept;       // in both versions, with the same type
  std::vector<std::string> grown;      // an array with more elements now
  std::vector<std::string> added;      // in the new version only: initial values
  std::vector<std::string> removed;    // in the old version only
  std::vector<std::string> changed;    // of another type now: initial values
  std::vector<std::string> appeared;   // shared variables, or parts, that the node did not have: initial values
  std::vector<std::string> converted;  // parts of shared variables of another type now: carried by name
  std::vector<std::string> lost;       // parts of shared variables that are not, with the reason
};

struct ReloadReport {
  std::string module;
  std::string text;                 // one sentence: what was done, or why not
  std::vector<std::string> errors;  // all that is wrong with the new version
  bool needs_restart = false;       // a node that is started with it has none of the errors
  ReloadPlan plan;
  std::string from;  // SHA-256 of the files
  std::string to;
  std::uint64_t version = 0;     // number of the version that runs now
  std::uint64_t tick = 0;        // of its first run
  std::uint64_t left_out = 0;    // ticks without new values of the module
  std::int64_t copying_ns = 0;   // in the tick of the exchange
  std::int64_t response_ns = 0;  // from the release of the first run to its end
};

// Errors: System (the folder cannot be written).
Status write_request(const std::string& node, const ReloadRequest& request);
// Called by the node: returns the request and removes it. Errors as text.
std::optional<ReloadRequest> take_reload_request(const std::string& node);
Status write_report(const std::string& node, const ReloadReport& report);
// Returns the report of the last command; nothing if there is none.
std::optional<ReloadReport> read_report(const std::string& node);

base::Json json_of(const ReloadReport& report);
ReloadReport report_of(const base::Json& json);  // what is missing in it is empty
base::Json json_of(const ReloadRequest& request);
ReloadRequest request_of(const base::Json& json);

// Held by the process that commands an exchange, until it has read the report. Errors: Busy (another process holds it),
// System.
class ReloadLock {
 public:
  static Result<ReloadLock> acquire(const std::string& node);

 private:
  explicit ReloadLock(base::Descriptor file) noexcept : file_(std::move(file)) {}
  base::Descriptor file_;
};

}  // namespace indurop::operate
