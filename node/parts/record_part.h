// SPDX-License-Identifier: Apache-2.0
// --record: writes the node's tape to a file, from the first run on.

#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/rt/clock.h"
#include "history/recorder/recorder.h"
#include "node/run/checked.h"
#include "node/run/console.h"
#include "node/run/prepared.h"

namespace indurop::node {

// The description of this node in its recordings.
recorder::About about_node(const Options& options, const Checked& checked, const Prepared& prepared);

class RecordPart {
 public:
  // Returns null if no recording is requested. Errors are reported on the console.
  static Result<std::unique_ptr<RecordPart>, Ending> begin(const Options& options, const Checked& checked,
                                                           const Prepared& prepared, Console& console);
  ~RecordPart();
  RecordPart(const RecordPart&) = delete;
  RecordPart& operator=(const RecordPart&) = delete;

  // In real time: a normal thread of its own takes new entries, on these cores if any are named.
  void start(const std::vector<int>& cores);
  void take();
  // In virtual time: the simulation calls this before the tape is full. Entries older than a second are on the disk.
  void take(rt::MonoTime now);
  // Called after all runs: writes the rest and the facts, and closes the file. Returns false if something is missing in
  // it, reported on the console.
  bool end(const std::string& facts);

 private:
  RecordPart(recorder::Recorder recorder, Console& console) : recorder_(std::move(recorder)), console_(console) {}
  void loop();

  rt::MonoTime flushed_{};  // in virtual time
  recorder::Recorder recorder_;
  Console& console_;
  std::string failure_;  // why no more was written; empty: no error
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace indurop::node
