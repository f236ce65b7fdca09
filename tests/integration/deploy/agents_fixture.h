// SPDX-License-Identifier: Apache-2.0
// Agents as processes, manifests of the test's own, and what `indurop` says about them.

#pragma once

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/plant_fixture.h"

namespace indurop::test {

using namespace std::chrono_literals;
using Json = nlohmann::json;

class AgentsTest : public PlantTest {
 protected:
  AgentsTest() {
    for (const char* module : {"steady", "other", "faulty", "slow"}) {
      std::filesystem::copy_file(std::string(MODULE_FOLDER) + "/" + module + ".so",
                                 folder() / (std::string(module) + ".so"));
    }
  }
  // An agent that ends well leaves its node running, or ends it: here none shall.
  ~AgentsTest() override {
    for (const auto& [board, agent] : agents_) {
      agent->kill();
    }
    ::unsetenv("INDUROP_KEYS_DIR");
  }

  // A plant of boards and their modules; `more`: elements of the first board besides.
  // A machine that stands still for some milliseconds is no fault of a module: they have a second for each run.
  [[nodiscard]] std::string manifest(const std::string& file,
                                     const std::vector<std::pair<std::string, std::string>>& boards,
                                     std::string more = {}) const {
    std::ofstream out(folder() / file);
    out << "<plant name=\"p" << ::getpid() << "\"><domain>" << domain() << "</domain><external>off</external>\n";
    for (const auto& [name, module] : boards) {
      out << "<board name=\"" << board(name) << "\"><module><filename>./" << module
          << ".so</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>"
             "<period>2ms</period><priority>1</priority><budget>1s</budget></module>"
          << std::exchange(more, {}) << "</board>\n";
    }
    out << "</plant>\n";
    out.close();
    return path(file);
  }

  // Extra words stand before the program, as those of indurop-lab.
  void start_agent(const std::string& name, const std::vector<std::string>& before = {},
                   const std::string& state = "") {
    std::vector<std::string> words = before;
    words.insert(words.end(), {agent_program_, "--quiet", "--board", board(name)});
    Environment environment;
    if (!state.empty()) {
      environment.variables.push_back("INDUROP_STATE_DIR=" + state);
    }
    agents_[name] = &start(with_link(words, !before.empty()), environment);
  }
  // Of agents started from now on.
  void use_program(const std::string& program) { agent_program_ = program; }
  void stop_agent(const std::string& name, int signal) {
    agents_.at(name)->signal(signal);
    EXPECT_NE(agents_.at(name)->wait(), -1) << "agent " << name << " did not end";
    agents_.erase(name);
  }
  // For a second agent of the same name: the first one, and back again.
  [[nodiscard]] Program& agent(const std::string& name) const { return *agents_.at(name); }
  void adopt_agent(const std::string& name, Program& agent) { agents_[name] = &agent; }

  Program& start_indurop(const std::vector<std::string>& arguments, const std::vector<std::string>& before = {}) {
    std::vector<std::string> words = before;
    words.emplace_back(INDUROP_PROGRAM);
    words.insert(words.end(), arguments.begin(), arguments.end());
    if (!keys_.empty() && std::find(words.begin(), words.end(), "--keys") == words.end()) {
      words.insert(words.end(), {"--keys", keys_});
    }
    return start(with_link(words, !before.empty()));
  }
  Outcome indurop(const std::vector<std::string>& arguments, const std::vector<std::string>& before = {}) {
    return start_indurop(arguments, before).finish();
  }
  // Without the words that lead to agents.
  Outcome indurop_here(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), INDUROP_PROGRAM);
    return start(arguments).finish();
  }
  Outcome deploy(const std::string& file, const std::vector<std::string>& more = {},
                 const std::vector<std::string>& before = {}) {
    std::vector<std::string> words{"deploy", file, "--health", "500ms", "--timeout", "10s", "-o", "json"};
    words.insert(words.end(), more.begin(), more.end());
    Outcome done = indurop(words, before);
    // A busy machine may deliver the order after its tick. All boards run what they ran before then.
    for (int i = 0; i < 2 && done.err.find("it missed the tick of the exchange") != std::string::npos; ++i) {
      done = indurop(words, before);
    }
    return done;
  }
  // The audit log of this host.
  Json audit() {
    return indurop_here({"audit", "-o", "json", "--file", path("state/serve/audit.jsonl")}).json()["audit"];
  }
  // What the board says of itself; null if it is not heard.
  Json report(const std::string& name, const std::vector<std::string>& before = {}) {
    const Json all = indurop({"boards", "-o", "json"}, before).json();
    if (all.is_object() && all.contains("boards")) {
      for (const Json& one : all["boards"]) {
        if (one["board"] == board(name)) {
          return one;
        }
      }
    }
    return {};
  }
  bool runs(const std::string& name, const std::string& deployment, const std::vector<std::string>& before = {}) {
    const Json one = report(name, before);
    return one.is_object() && one["state"] == "running" && one["deployment"] == deployment && one["phase"] == "steady";
  }

  // The default of tools.
  void speak_with_keys(const std::string& folder) { keys_ = folder; }
  // Keys of a manifest's plant in `keys`, and its boards' where their agents find them from now on.
  void bring_keys(const std::string& file, const std::vector<std::string>& boards) {
    if (!std::filesystem::exists(folder() / "keys")) {
      EXPECT_EQ(indurop_here({"keys", "init", file, "--dir", path("keys")}).code, 0);
    }
    const auto plant = folder() / "etc" / ("p" + std::to_string(::getpid()));
    std::filesystem::create_directories(plant);
    for (const std::string& name : boards) {
      std::filesystem::copy(folder() / "keys/boards" / board(name), plant / board(name),
                            std::filesystem::copy_options::recursive);
    }
    ::setenv("INDUROP_KEYS_DIR", path("etc").c_str(), 1);
  }

  // Of agents and who speaks to them.
  static int link_domain() { return dds_domain(1); }

 private:
  static std::vector<std::string> with_link(std::vector<std::string> words, bool network) {
    words.insert(words.end(), {"--domain", std::to_string(link_domain())});
    if (!network) {
      words.emplace_back("--one-host");
    }
    return words;
  }

  std::string agent_program_ = AGENT_PROGRAM;
  std::string keys_;
  std::map<std::string, Program*> agents_;
};

}  // namespace indurop::test
