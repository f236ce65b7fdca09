// SPDX-License-Identifier: Apache-2.0
// indurop run: becomes indurop-node, so exit code and signals are the node's own.
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "deploy/plant.h"
#include "tools/run_local.h"
#include "tools/self.h"
#include "tools/verbs.h"

namespace indurop::tools {
namespace {

constexpr const char* kProgram = "indurop-node";

bool executable(const std::filesystem::path& file) {
  return access(file.c_str(), X_OK) == 0;
}

// Beside this program, in ../libexec/indurop, then along PATH.
std::filesystem::path find_node_program() {
  const auto here = program_folder();
  std::vector<std::filesystem::path> places;
  if (!here.empty()) {
    places = {here / kProgram, here / "../libexec/indurop" / kProgram};
  }
  const char* path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "";
  while (!rest.empty()) {
    const auto colon = rest.find(':');
    const auto folder = rest.substr(0, colon);
    if (!folder.empty()) {
      places.emplace_back(std::filesystem::path(folder) / kProgram);
    }
    rest = colon == std::string_view::npos ? "" : rest.substr(colon + 1);
  }
  for (const auto& place : places) {
    if (executable(place)) {
      return place;
    }
  }
  return {};
}

struct Request {
  std::string file;  // empty: none named
  bool local = false;
  bool board = false;
  bool about = false;                // --help, --version
  std::vector<std::string> options;  // all but the file and --local
};

Request parse(const std::vector<std::string>& arguments) {
  constexpr std::array kWithValue{"--node", "--board", "--duration", "--report", "--core", "--spin"};
  Request request;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& word = arguments[i];
    if (word == "--local") {
      request.local = true;
      continue;
    }
    const bool option = word.size() > 1 && word[0] == '-';
    if (!option && request.file.empty()) {
      request.file = word;
      continue;
    }
    request.about = request.about || word == "-h" || word == "--help" || word == "--version";
    request.board = request.board || word == "--board" || word.starts_with("--board=");
    request.options.push_back(word);
    if (i + 1 < arguments.size() && std::find(kWithValue.begin(), kWithValue.end(), word) != kWithValue.end()) {
      request.options.push_back(arguments[++i]);
    }
  }
  return request;
}

int become_node(Context& context, const std::filesystem::path& program, const Request& request) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), request.options.begin(), request.options.end());
  if (!request.file.empty()) {
    words.push_back(request.file);
  }
  std::vector<char*> raw;
  for (std::string& word : words) {
    raw.push_back(word.data());
  }
  raw.push_back(nullptr);
  context.out.flush();
  signal(SIGPIPE, SIG_DFL);  // ignoring it would be inherited
  execv(program.c_str(), raw.data());
  context.out.error(fmt::format("cannot start {}: {}", program.string(), std::strerror(errno)));
  return kFailed;
}

int run(Context& context, const std::vector<std::string>& arguments) {
  const auto program = find_node_program();
  if (program.empty()) {
    context.out.error(fmt::format("{} was found neither beside this program nor in PATH", kProgram));
    return kFailed;
  }
  Request request = parse(arguments);
  std::error_code ignored;
  if (request.file.empty() && !request.about && std::filesystem::exists("module.xml", ignored)) {
    request.file = "module.xml";
  }
  const bool plant = !request.file.empty() && deploy::is_plant_file(request.file);
  if (request.local && !request.about) {
    if (!plant) {
      context.out.error("--local is for the manifest of a plant: indurop run plant.xml --local");
      return kUsage;
    }
    if (request.board) {
      context.out.error("--local runs all boards and --board one of them: choose");
      return kUsage;
    }
    return run_local(context, program, request.file, request.options);
  }
  if (plant && !request.board && !request.about) {
    context.out.error(
        fmt::format("{} is the manifest of a plant; run all its boards on this host with --local, or be "
                    "one of them with --board NAME",
                    request.file));
    return kUsage;
  }
  return become_node(context, program, request);
}

}  // namespace

const Verb kRunVerb{.name = "run",
                    .group = "Start and stop",
                    .summary = "Run a configuration, or with --local all boards of a plant (see indurop run --help)",
                    .details = "",
                    .declare = nullptr,
                    .pass_through = &run};

}  // namespace indurop::tools
