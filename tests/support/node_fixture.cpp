// SPDX-License-Identifier: Apache-2.0
#include "node_fixture.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>

#include "store/vars/layout.h"
#include "store/vars/store.h"

namespace indurop::test {
namespace {

int g_tests = 0;

}  // namespace

std::string xml(const std::vector<Module>& modules) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<root>\n";
  for (const Module& m : modules) {
    const bool sporadic = m.operation == "sporadic";
    const bool path = m.file.find('/') != std::string::npos;
    text += "  <module>\n    <filename>" + (path ? m.file : std::string(MODULE_DIR) + "/" + m.file) + "</filename>\n";
    text += m.name.empty() ? "" : "    <name>" + m.name + "</name>\n";
    text += "    <moduletype>" + m.type + "</moduletype>\n";
    text += "    <operationtype>" + m.operation + "</operationtype>\n";
    if (m.operation != "non-real") {
      text += (sporadic ? "    <deadline>" : "    <period>") + m.period + (sporadic ? "</deadline>\n" : "</period>\n");
      text += "    <priority>" + std::to_string(m.priority) + "</priority>\n";
    }
    if (!m.properties.empty()) {
      text += "    <property>\n";
      for (const auto& [name, value] : m.properties) {
        text += "      <value name=\"" + name + "\">" + value + "</value>\n";
      }
      text += "    </property>\n";
    }
    text += m.more.empty() ? "" : "    " + m.more + "\n";
    text += "  </module>\n";
  }
  return text + "</root>\n";
}

NodeTest::NodeTest() : name_("nt-" + std::to_string(::getpid()) + "-" + std::to_string(g_tests++)) {
  folder_ = std::filesystem::temp_directory_path() / ("indurop-" + name_);
  std::filesystem::create_directories(folder_);
  std::filesystem::permissions(folder_, std::filesystem::perms::all);
}

void NodeTest::TearDown() {
  if (HasFailure()) {
    for (const auto& program : programs_) {
      ADD_FAILURE() << "--- program " << program->pid() << " printed:\n"
                    << program->out() << "--- and said:\n"
                    << program->err();
    }
  }
  // Process modules die with their node; what outlives even that is ended by its pid.
  std::vector<pid_t> children;
  for (const auto& [inode, file] : seen_) {
    const auto* block = static_cast<const scheduler::RunBlock*>(file.data());
    for (std::uint32_t i = 0; i < block->module_count; ++i) {
      children.push_back(block->modules()[i].pid.load());
    }
  }
  programs_.clear();
  for (const pid_t pid : children) {
    if (pid > 0 && !wait_until([pid] { return !alive(pid); }, std::chrono::seconds(5))) {
      ADD_FAILURE() << "process module " << pid << " outlived its node";
      ::kill(pid, SIGKILL);
    }
  }
  seen_.clear();
  (void)vars::remove_node(name_);
  for (const std::string& node : vars::list_nodes(vars::Nodes::All)) {
    if (node.starts_with(name_ + "-")) {  // a test has started it besides
      (void)vars::remove_node(node);
    }
  }
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::string NodeTest::write(const std::string& file, const std::string& text) const {
  const auto path = folder_ / file;
  std::ofstream(path) << text;
  return path;
}

Environment NodeTest::environment() const {
  return {{"INDUROP_STATE_DIR=" + (folder_ / "state").string(), "INDUROP_NODE=" + name_}, static_cast<uid_t>(-1), {}};
}

Program& NodeTest::start_file(const std::string& file, const std::vector<std::string>& more,
                              const Environment& environment) {
  std::vector<std::string> command = {NODE_PROGRAM, file};
  command.insert(command.end(), more.begin(), more.end());
  programs_.push_back(std::make_unique<Program>(command, environment));
  return *programs_.back();
}

Program& NodeTest::start(const std::vector<Module>& modules, const std::vector<std::string>& more) {
  return start_file(write("module.xml", xml(modules)), more);
}

bool NodeTest::wait_until_running(Program& program) {
  const bool runs = wait_until([&] {
    const auto* block = run();
    return !program.running() || (block != nullptr && block->node_pid.load() == program.pid() &&
                                  block->state.load() == scheduler::NodeState::Running);
  });
  return runs && program.running();
}

Program& NodeTest::start_and_wait(const std::vector<Module>& modules, const std::vector<std::string>& more) {
  Program& program = start(modules, more);
  EXPECT_TRUE(wait_until_running(program));
  return program;
}

Outcome NodeTest::run_to_end(const std::vector<Module>& modules, const std::vector<std::string>& more) {
  return start(modules, more).finish();
}

Outcome NodeTest::indurop(const std::vector<std::string>& arguments) const {
  std::vector<std::string> command = {INDUROP_PROGRAM};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return Program(command, environment()).finish();
}

const scheduler::RunBlock* NodeTest::run() {
  struct stat info {};
  if (::stat(("/dev/shm/" + vars::run_file(name_)).c_str(), &info) != 0) {
    return nullptr;
  }
  auto found = seen_.find(info.st_ino);
  if (found == seen_.end()) {
    auto file = vars::RunFile::open(name_, vars::Mode::ReadOnly, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
    if (!file) {
      return nullptr;
    }
    found = seen_.emplace(info.st_ino, std::move(file).value()).first;
  }
  return static_cast<const scheduler::RunBlock*>(found->second.data());
}

const scheduler::ModuleRecord& NodeTest::module(const std::string& name) {
  static const scheduler::ModuleRecord kNone{};
  const auto* block = run();
  for (std::uint32_t i = 0; block != nullptr && i < block->module_count; ++i) {
    if (block->modules()[i].name == name) {
      return block->modules()[i];
    }
  }
  ADD_FAILURE() << "the node has no module " << name;
  return kNone;
}

bool NodeTest::runs_reach(const std::string& name, std::uint64_t runs) {
  const auto& record = module(name);
  return wait_until([&] { return record.runs.load() >= runs; });
}

void NodeTest::read(const std::string& name, void* to, std::size_t size) const {
  auto store = vars::Store::attach(name_, vars::Mode::ReadOnly);
  ASSERT_TRUE(store.ok()) << "no variables of node " << name_;
  for (const schema::Variable& variable : store.value().schema().variables) {
    if (variable.name == name) {
      const auto* entry = store.value().find(variable.name_hash());
      ASSERT_NE(entry, nullptr);
      ASSERT_TRUE(store.value().read(*entry, 0, {static_cast<std::uint8_t*>(to), size}).ok());
      return;
    }
  }
  ADD_FAILURE() << "there is no variable " << name;
}

void NodeTest::expect_each_run_once() {
  const auto& record = module("process");
  EXPECT_TRUE(wait_until([&] {
    const std::uint64_t before = record.runs.load();
    const std::uint64_t executed = value<std::uint32_t>("nt::process_runs");
    return executed == before + 1 || executed == before;  // the node counts a run at the release after it
  })) << value<std::uint32_t>("nt::process_runs")
      << " of " << record.runs.load();
}

std::vector<std::string> NodeTest::files_left() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator("/dev/shm")) {
    const std::string file = entry.path().filename();
    if (file == "indurop." + name_ || file.starts_with("indurop." + name_ + ".")) {
      names.push_back(file);
    }
  }
  return names;
}

std::vector<Started> slot_log(const scheduler::RunBlock& run) {
  const auto* entries = run.at<scheduler::SlotEntry>(run.slot_log_offset);
  std::vector<Started> result;
  const std::uint64_t next = run.slot_log_next.load(std::memory_order_acquire);
  for (std::uint64_t n = next > run.slot_log_capacity ? next - run.slot_log_capacity : 0; n < next; ++n) {
    const auto& entry = entries[n & (run.slot_log_capacity - 1)];
    if (entry.sequence.load(std::memory_order_acquire) == n + 1) {
      result.push_back({entry.tick, entry.module, entry.start_ns, entry.end_ns});
    }
  }
  return result;
}

int order_violations(const scheduler::RunBlock& run) {
  std::vector<Started> log = slot_log(run);
  std::erase_if(log,
                [&](const Started& s) { return run.modules()[s.module].operation != scheduler::Operation::Periodic; });
  std::sort(log.begin(), log.end(), [](const Started& a, const Started& b) {
    return a.tick != b.tick ? a.tick < b.tick : a.start_ns < b.start_ns;
  });
  int violations = 0;
  for (std::size_t i = 0; i < log.size(); ++i) {
    for (std::size_t k = i + 1; k < log.size() && log[k].tick == log[i].tick; ++k) {
      const int before = run.modules()[log[i].module].priority;
      const int after = run.modules()[log[k].module].priority;
      violations += before > after || (before < after && log[i].end_ns > log[k].start_ns) ? 1 : 0;
    }
  }
  return violations;
}

}  // namespace indurop::test
