// SPDX-License-Identifier: Apache-2.0
// The versions of modules' code that a recording names: each is found by the SHA-256 of its file, loaded, and follows
// the one before it between the same two runs as in the recording, with what that one kept.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "node/exchange/candidate.h"
#include "node/replay/recorded_runs.h"
#include "node/replay/repeater.h"
#include "node/replay/replayed_modules.h"

namespace indurop::node {

class ReplayedVersions {
 public:
  // All references are borrowed.
  ReplayedVersions(const Options& options, const Console& console, const Checked& checked, const Prepared& prepared,
                   std::vector<ModuleLibrary>& libraries);

  // Finds and loads the versions of all modules that run and were exchanged in the recording, except those with a file
  // of --with. The store gets their variables. Returns false, after errors, if one is missing.
  bool load(const RecordedRuns& recorded, const ReplayedModules& modules);
  // Returns true if each run of the module is repeated by the version that it was one of.
  [[nodiscard]] bool follows(const ReplayedModule& module) const { return all_.contains(module.index); }
  // Lets the modules begin with the versions of their first runs that are read; before any module is started. Returns
  // false, after an error, if one cannot be loaded.
  bool begin(const ReplayedModules& modules, Repeater& repeater);

  // Before each run: lets another version follow if this run is its first one. Returns false, after an error, if the
  // replay cannot continue.
  bool prepare(ReplayedModule& module, const recorder::RunWords& run, Repeater& repeater);
  // After that, before the run is repeated: it may be one after which a version returns.
  void prepare_return(const ReplayedModule& module, const recorder::RunWords& run);
  // The replay ends: stops the versions that do not run.
  void end(const ReplayedModules& modules, Repeater& repeater);

 private:
  struct Version {
    std::filesystem::path file;  // empty: none of its runs is repeated: it is not wanted, or has other types
    AllowedAccess access;
    ModuleLibrary library;  // empty: it runs, or is not loaded now
    bool started = false;
    bool is_unsound = false;                     // it was left in the middle of a run
    bool is_known = false;                       // it keeps what it kept in the recording when it was left
    std::optional<ReplayedProcess::State> kept;  // that, of a process
  };
  // How much of what a version keeps came from the one before it.
  struct Carried {
    bool exact = false;       // as in the recording
    bool in_tick = false;     // the thread that runs the module copied it then
    bool with_state = false;  // else it begins with initial values
    bool whole = false;       // all that it keeps
  };
  struct Versions {
    std::vector<recorder::RecordedVersion> order;  // by first run
    std::size_t at = 0;                            // the one of the run that is repeated
    std::map<std::uint32_t, Version> by_number;
    std::uint32_t held = 0;          // the one whose library is called; 0: that of the configuration
    std::optional<Carried> carried;  // to the next one, before its first run
    [[nodiscard]] Version& current() { return by_number[order[at].number]; }
    [[nodiscard]] bool follows_earlier() const noexcept;
    [[nodiscard]] bool follows_later(const Version& version) const;
  };
  enum class Loading { Done, ChangesTypes, Failed };
  bool load(ReplayedModule& module, Versions& versions, const RecordedRuns& recorded);
  Loading load_first(const ReplayedModule& module, Version& version);
  bool load_again(const ReplayedModule& module, Version& version) const;
  [[nodiscard]] bool is_wanted(const Versions& versions, std::size_t index) const noexcept;
  void report_missing(const ReplayedModule& module, const recorder::RecordedVersion& version) const;
  void show(ReplayedModule& module, Versions& versions);
  bool exchange(ReplayedModule& module, Versions& versions, const recorder::RunWords& run, Repeater& repeater);
  void show_process(ReplayedModule& module, Versions& versions, Repeater& repeater) const;
  bool exchange_process(ReplayedModule& module, Versions& versions, const recorder::RunWords& run,
                        Repeater& repeater) const;
  static bool take_over(const ReplayedModule& module, const Version& from, bool own_is_exact, Repeater& repeater);
  [[nodiscard]] Carried carry(const ReplayedModule& module, const ModuleMemory& to) const;
  void note_carried(ReplayedModule& module, Versions& versions, bool knew) const;
  void retire(const ReplayedModule& module, Version& version, Repeater& repeater) const;

  const Options& options_;
  const Console& console_;
  const Checked& checked_;
  vars::Store& store_;
  std::vector<ModuleLibrary>& libraries_;
  std::map<std::uint32_t, Versions> all_;  // by module
};

}  // namespace indurop::node
