// SPDX-License-Identifier: Apache-2.0
#include "node/run/checked.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "config/xml/plant_reader.h"
#include "config/xml/reader.h"
#include "core/base/print.h"

namespace indurop::node {
namespace {

struct Reading {
  bool ok = false;
  Checked checked;
  std::vector<base::Diagnostic> diagnostics;
  std::vector<std::string> boards;  // of the plant

  void add(const std::vector<base::Diagnostic>& more) {
    diagnostics.insert(diagnostics.end(), more.begin(), more.end());
  }
};

// A file of --with: "MODULE=FILE", or a file whose name is that of a module or of its file.
struct Replacement {
  std::vector<config::Module>::iterator module;
  std::filesystem::path file;
};
Replacement replacement(const std::string& text, std::vector<config::Module>& modules) {
  const std::size_t named = text.find('=');
  if (const auto module = std::find_if(modules.begin(), modules.end(),
                                       [&](const config::Module& one) { return one.name == text.substr(0, named); });
      named != std::string::npos && module != modules.end()) {
    return {module, text.substr(named + 1)};
  }
  const std::filesystem::path file = text;
  return {std::find_if(modules.begin(), modules.end(),
                       [&](const config::Module& one) {
                         return one.name == file.stem() || one.file.filename() == file.filename();
                       }),
          file};
}

// Files that replace those of modules. Returns false if one fits no module.
bool take_files(const std::vector<std::string>& files, Checked& checked, config::Config& config,
                std::vector<base::Diagnostic>& diagnostics) {
  bool ok = true;
  std::map<std::string, std::filesystem::path> taken;  // by module
  const auto wrong = [&](const std::filesystem::path& file, std::string text) {
    ok = false;
    diagnostics.push_back({base::Diagnostic::Severity::Error, file.string(), {}, std::move(text)});
  };
  std::error_code ignored;
  for (const std::string& text : files) {
    const auto [module, file] = replacement(text, config.modules);
    if (module == config.modules.end()) {
      wrong(file, "no module has this name or such a file; name it: --with MODULE=FILE");
    } else if (const auto [first, fresh] = taken.emplace(module->name, file); !fresh) {
      wrong(file,
            fmt::format("replaces module {}, as {} does; leave one of them out", module->name, first->second.string()));
    } else if (!std::filesystem::exists(file, ignored)) {
      wrong(file, "no such file; build it, or correct --with");
    } else {
      module->file = std::filesystem::absolute(file);
      module->file_as_written = file.string();
      checked.replaced.push_back(static_cast<std::uint32_t>(module - config.modules.begin()));
    }
  }
  return ok;
}

// Applies the node's core from the command line: <cores> spreads modules around it.
void take_core(const Options& options, config::Config& config) {
  if (config.cores && options.core) {
    config.core = *options.core;
  }
}

config::CheckResult check_modules(const Options& options, config::Config& config) {
  return config::check_config(config, {.adjust = options.adjust, .machine = !options.simulation.on});
}

Reading read_modules(const Options& options) {
  Reading out;
  config::ReadResult read = config::read_config(options.config);
  out.add(read.diagnostics);
  if (!read.ok()) {
    return out;
  }
  Checked& checked = out.checked;
  checked.config = std::move(read.config);
  if (!take_files(options.replay.with, checked, checked.config, out.diagnostics)) {
    return out;
  }
  take_core(options, checked.config);
  checked.check = check_modules(options, checked.config);
  out.add(checked.check.diagnostics);
  checked.external.configure(checked.config, checked.check);
  out.ok = checked.check.ok();
  return out;
}

Reading read_plant(const Options& options) {
  Reading out;
  config::ReadPlant read = config::read_plant(options.config);
  out.add(read.diagnostics);
  if (!read.ok()) {
    return out;
  }
  config::Plant& plant = read.plant;
  for (config::Board& board : plant.boards) {
    if (board.name == options.board) {
      if (!take_files(options.replay.with, out.checked, board.config, out.diagnostics)) {
        return out;
      }
      take_core(options, board.config);
    }
  }
  config::PlantCheck check =
      config::check_plant(plant, {.adjust = options.adjust, .machine = !options.simulation.on, .board = options.board});
  out.add(check.diagnostics);
  for (std::size_t i = 0; i < plant.boards.size(); ++i) {
    out.boards.push_back(plant.boards[i].name);
    if (plant.boards[i].name == options.board) {
      out.checked.mirror = mirror_settings(plant, check, i);
      out.checked.mirror->network.one_host = options.one_host;
      out.checked.routes = BoardRoutes(out.checked.mirror->routes);
      out.checked.external.configure(plant, check, i, options.one_host);
      out.checked.config = std::move(plant.boards[i].config);
      out.checked.check = std::move(check.boards[i]);
    }
  }
  out.ok = check.ok();
  return out;
}

}  // namespace

namespace {

Rechecked recheck_board(Options options, const std::filesystem::path& file) {
  options.config = file;
  Reading reading = read_plant(options);
  Rechecked out;
  out.ok = reading.ok && reading.checked.mirror.has_value();
  out.config = std::move(reading.checked.config);
  out.check = std::move(reading.checked.check);
  out.diagnostics = std::move(reading.diagnostics);
  out.mirror = std::move(reading.checked.mirror);
  return out;
}

}  // namespace

Rechecked recheck(const Options& options, const std::filesystem::path& file) {
  if (!options.board.empty()) {
    return recheck_board(options, file);
  }
  config::ReadResult read = config::read_config(file);
  if (!read.ok()) {
    return {false, {}, {}, std::move(read.diagnostics), {}};
  }
  take_core(options, read.config);
  Rechecked out = recheck(options, read.config);
  out.diagnostics.insert(out.diagnostics.begin(), read.diagnostics.begin(), read.diagnostics.end());
  return out;
}

Rechecked recheck(const Options& options, const config::Config& config) {
  Rechecked out;
  out.config = config;
  out.check = check_modules(options, out.config);
  out.ok = out.check.ok();
  out.diagnostics = out.check.diagnostics;
  return out;
}

Result<Checked, Ending> check(const Options& options, const Console& console) {
  const bool plant = config::is_plant_file(options.config);
  if (plant == options.board.empty()) {
    console.error("{} {}", options.config.string(),
                  plant ? "is the manifest of a plant: name one of its boards with --board NAME"
                        : "is not the manifest of a plant, so there is no --board");
    return Ending{kUsage};
  }
  Reading reading = plant ? read_plant(options) : read_modules(options);
  for (const base::Diagnostic& diagnostic : reading.diagnostics) {
    // Where all boards are on one host, the program that starts them prints warnings once.
    const bool said = diagnostic.severity == base::Diagnostic::Severity::Note ||
                      (options.one_host && diagnostic.severity == base::Diagnostic::Severity::Warning);
    if (!said) {
      base::print(stderr, "{}\n", base::to_string(diagnostic));
    }
  }
  if (reading.ok && plant && !reading.checked.mirror) {
    console.error("the plant has no board {}; it has {}", options.board, fmt::join(reading.boards, ", "));
    return Ending{kUsage};
  }
  if (!reading.ok) {
    return Ending{kCheckFailed};
  }
  if (!options.replay.report.empty()) {
    reading.checked.alone = reading.checked.replaced.front();
  }
  return std::move(reading.checked);
}

}  // namespace indurop::node
