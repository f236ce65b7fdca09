// SPDX-License-Identifier: Apache-2.0
// <indurop/testing.h>: a plant under test, made of a node process, its store and its run block.

#include <fmt/format.h>
#include <indurop/irp.h>
#include <indurop/testing.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <limits>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/read_file.h"
#include "core/base/xml.h"
#include "core/schema/leaf.h"
#include "core/schema/schema.h"
#include "store/vars/node_lock.h"
#include "store/vars/process.h"
#include "store/vars/store.h"
#include "tools/testing/golden.h"
#include "tools/testing/node_process.h"

namespace irp::testing {
namespace {

namespace schema = indurop::schema;
namespace vars = indurop::vars;
namespace scheduler = indurop::scheduler;
using namespace std::chrono_literals;

constexpr const char* kPrefix = "test-";

std::string new_name() {
  static std::atomic<unsigned> count{0};
  indurop::testing::remove_orphans(kPrefix);
  return fmt::format("{}{}-{}", kPrefix, ::getpid(), ++count);
}

std::vector<std::string> arguments_of(const std::filesystem::path& configuration, const Settings& settings) {
  std::vector<std::string> words = settings.arguments;
  if (!settings.board.empty()) {
    words.insert(words.end(), {"--board", settings.board, "--one-host"});
  }
  if (!settings.times.empty()) {
    words.insert(words.end(), {"--times", settings.times.string()});
  }
  words.insert(words.end(), {"--", configuration.string()});
  return words;
}

constexpr std::size_t kMostDepth = 50;

bool is_plant(const std::filesystem::path& configuration) {
  const auto text = indurop::base::read_file(configuration);
  return text.ok() &&
         indurop::base::xml_root_name(*text, {.max_bytes = text->size() + 1, .max_depth = kMostDepth}) == "plant";
}

}  // namespace

struct Plant::Impl {
  struct Part {
    schema::Place place;
    const vars::DirectoryEntry* entry = nullptr;
    vars::Store* store = nullptr;
    std::size_t board = 0;
  };

  Impl(const std::filesystem::path& configuration, const Settings& settings)
      : name(new_name()),
        node(name, settings.board.empty() && is_plant(configuration), arguments_of(configuration, settings),
             settings.patience, indurop::testing::find_node_program()) {
    attach();
    if (node.boards().size() == 1) {
      (void)irp::attach(node.boards()[0].node.c_str());  // prints to stderr what this program uses and the node lacks
    }
  }

  // Attaches to all boards, and again to those that were restarted.
  void attach() {
    stores.resize(node.boards().size());
    starts.resize(node.boards().size());
    for (std::size_t i = 0; i < stores.size(); ++i) {
      const auto& board = node.boards()[i];
      if (starts[i] == board.starts) {
        continue;
      }
      auto attached = vars::Store::attach(board.node, vars::Mode::ReadWrite);
      if (!attached) {
        node.fail("the variables of the node cannot be reached");
      }
      stores[i] = std::make_unique<vars::Store>(std::move(attached).value());
      starts[i] = board.starts;
    }
  }

  // Returns the boards that are addressed, "torque@control"; all, if none is named.
  [[nodiscard]] std::vector<std::size_t> boards_of(std::string_view& text) const {
    const auto& boards = node.boards();
    const auto at = text.find('@');
    const std::string_view wanted = at == std::string_view::npos ? std::string_view{} : text.substr(at + 1);
    std::vector<std::size_t> found;
    std::string known;
    for (std::size_t i = 0; i < boards.size(); ++i) {
      if (at == std::string_view::npos || boards[i].name == wanted) {
        found.push_back(i);
      }
      known += (i > 0 ? ", " : "") + boards[i].name;
    }
    if (found.empty()) {
      throw std::runtime_error(fmt::format("there is no board {}; there is {}", wanted, known));
    }
    text = text.substr(0, at);
    return found;
  }

  [[noreturn]] void ask_for_board(std::string_view text) const {
    throw std::runtime_error(
        fmt::format("several boards have {0}: say which is meant, as in {0}@{1}", text, node.boards()[0].name));
  }

  [[nodiscard]] Part find(std::string_view text) const {
    std::string unknown;
    std::optional<Part> found;
    for (const std::size_t board : boards_of(text)) {
      vars::Store& store = *stores[board];
      auto place = schema::find_place(store.schema(), text);
      if (!place) {
        unknown = place.error().message;
        continue;
      }
      const vars::DirectoryEntry* entry =
          store.find(indurop::abi::fnv1a64(place->variable->name.data(), place->variable->name.size()));
      if (entry == nullptr) {
        throw std::runtime_error(fmt::format("{} is not in the node's memory", text));
      }
      if (found) {
        ask_for_board(text);
      }
      found = Part{std::move(place).value(), entry, &store, board};
    }
    if (!found) {
      throw std::runtime_error(unknown);
    }
    return *std::move(found);
  }

  [[nodiscard]] static std::vector<std::uint8_t> read(const Part& part) {
    std::vector<std::uint8_t> bytes(part.place.type.size());
    if (!part.store->read(*part.entry, part.place.offset, bytes)) {
      throw std::runtime_error(fmt::format("{} cannot be read", part.place.variable->name));
    }
    return bytes;
  }

  // Checks the range as `indurop set` and `force` do.
  static void check_range(const Part& part, std::string_view name, std::span<const std::uint8_t> bytes) {
    constexpr double kUnlimited = std::numeric_limits<double>::infinity();
    const schema::Range range = part.place.range.value_or(schema::Range{-kUnlimited, kUnlimited});
    if (const auto inside = schema::check_range(range, part.place.type, bytes); !inside) {
      throw std::runtime_error(fmt::format("{}: {}", name, inside.error().message));
    }
  }

  void write(const Part& part, std::span<const std::uint8_t> from) const {
    const auto& boards = node.boards();
    if (boards.size() > 1 && vars::running_node(boards[part.board].node) == 0) {
      throw std::runtime_error(fmt::format("board {} does not run: no module would read {}", boards[part.board].name,
                                           part.place.variable->name));
    }
    if (!part.store->write(*part.entry, part.place.offset, from)) {
      throw std::runtime_error(fmt::format("{} cannot be written", part.place.variable->name));
    }
  }

  [[nodiscard]] scheduler::ModuleRecord& module(std::string_view wanted) const {
    std::string known;
    scheduler::ModuleRecord* found = nullptr;
    for (const std::size_t board : boards_of(wanted)) {
      scheduler::RunBlock& run = node.boards()[board].run();
      for (std::uint32_t i = 0; i < run.module_count; ++i) {
        scheduler::ModuleRecord& record = run.modules()[i];
        if (wanted == record.name) {
          if (found != nullptr) {
            ask_for_board(wanted);
          }
          found = &record;
        }
        known += (known.empty() ? "" : ", ") + std::string(record.name);
      }
    }
    if (found == nullptr) {
      throw std::runtime_error(fmt::format("there is no module {}; there is {}", wanted, known));
    }
    return *found;
  }

  void go(std::uint64_t ticks);

  std::string name;
  indurop::testing::NodeProcess node;
  std::vector<std::unique_ptr<vars::Store>> stores;  // by board
  std::vector<std::uint64_t> starts;                 // start count of the board to which each is attached
  indurop::testing::Trace trace;
};

void Plant::Impl::go(std::uint64_t ticks) {
  if (!trace.on()) {
    node.go(ticks);
    attach();
    return;
  }
  for (std::uint64_t i = 0; i < ticks; ++i) {
    node.go(1);
    attach();
    std::vector<std::string> values;
    for (const std::string& wanted : trace.names()) {
      const Part part = find(wanted);
      values.push_back(schema::format_value(part.place.type, read(part)));
    }
    trace.add(node.ticks() - 1, std::move(values));
  }
}

Plant::Plant(const std::filesystem::path& configuration, const Settings& settings)
    : impl_(std::make_unique<Impl>(configuration, settings)) {}

Plant::~Plant() = default;

void Plant::run(std::chrono::nanoseconds time) {
  const std::int64_t basic = impl_->node.basic_period_ns();
  if (time.count() < 0) {
    throw std::runtime_error("time does not run backwards");
  }
  impl_->go(static_cast<std::uint64_t>((time.count() + basic - 1) / basic));
}

void Plant::step(std::uint64_t ticks) {
  impl_->go(ticks);
}

bool Plant::run_until(const std::function<bool()>& condition, std::chrono::nanoseconds at_most) {
  const std::chrono::nanoseconds end = time() + at_most;
  while (!condition()) {
    if (time() >= end) {
      return false;
    }
    impl_->go(1);
  }
  return true;
}

std::uint64_t Plant::tick() const {
  return impl_->node.ticks();
}

std::chrono::nanoseconds Plant::basic_period() const {
  return std::chrono::nanoseconds(impl_->node.basic_period_ns());
}

std::chrono::nanoseconds Plant::time() const {
  return basic_period() * static_cast<std::int64_t>(tick());
}

long double Plant::number(std::string_view name) const {
  const Impl::Part part = impl_->find(name);
  const schema::Type& type = part.place.type;
  const auto value =
      type.dims.empty() ? schema::as_number<long double>(type.base, Impl::read(part).data()) : std::nullopt;
  if (!value) {
    throw std::runtime_error(
        fmt::format("{} is a {}, not a number: name a part of it", name, schema::display_name(type)));
  }
  return *value;
}

std::string Plant::text(std::string_view name) const {
  const Impl::Part part = impl_->find(name);
  const auto bytes = Impl::read(part);
  if (part.place.type.base == schema::Base::Text && part.place.type.dims.empty()) {
    const auto end = std::find(bytes.begin(), bytes.end(), 0);
    return {bytes.begin(), end};
  }
  return schema::format_value(part.place.type, bytes);
}

void Plant::bytes(std::string_view name, std::span<std::uint8_t> to) const {
  const Impl::Part part = impl_->find(name);
  const auto from = Impl::read(part);
  if (from.size() != to.size()) {
    throw std::runtime_error(fmt::format("{} is a {} of {} bytes, not of {}", name,
                                         schema::display_name(part.place.type), from.size(), to.size()));
  }
  std::copy(from.begin(), from.end(), to.begin());
}

void Plant::set_text(std::string_view name, const std::string& text, bool hold) {
  const Impl::Part part = impl_->find(name);
  std::vector<std::uint8_t> bytes = Impl::read(part);
  if (const auto read = schema::parse_value(part.place.type, text, bytes); !read) {
    throw std::runtime_error(fmt::format("{}: {}", name, read.error().message));
  }
  Impl::check_range(part, name, bytes);
  if (!hold) {
    impl_->write(part, bytes);
  } else if (!part.store->force(*part.entry, part.place.offset, bytes, vars::kForever)) {
    throw std::runtime_error(
        fmt::format("{} cannot be forced: only numbers can, {} at a time", name, vars::kMaxForces));
  }
}

void Plant::set_bytes(std::string_view name, std::span<const std::uint8_t> from) {
  const Impl::Part part = impl_->find(name);
  if (part.place.type.size() != from.size()) {
    throw std::runtime_error(fmt::format("{} is a {} of {} bytes, not of {}", name,
                                         schema::display_name(part.place.type), part.place.type.size(), from.size()));
  }
  Impl::check_range(part, name, from);
  impl_->write(part, from);
}

void Plant::unforce(std::string_view name) {
  const Impl::Part part = impl_->find(name);
  if (!part.store->release(*part.entry, part.place.offset)) {
    throw std::runtime_error(fmt::format("{} is not forced", name));
  }
}

void Plant::cannot_hold(std::string_view name, long double value) {
  throw std::runtime_error(fmt::format("{} is {}, which the type asked for cannot hold", name, words(value)));
}

std::string Plant::words(long double value) {
  return fmt::format("{}", static_cast<double>(value));
}

ModuleCount Plant::module(std::string_view name) const {
  const scheduler::ModuleRecord& record = impl_->module(name);
  ModuleCount count;
  count.runs = record.runs.load();
  count.skipped = record.skipped.load();
  count.overruns = record.overruns.load();
  count.deadline_misses = record.deadline_misses.load();
  count.faults = record.faults.load(std::memory_order_acquire);
  count.restarts = record.restarts.load();
  count.faulted = record.state.load() == scheduler::ModuleState::Faulted;
  count.last_fault = count.faults > 0 ? record.last_fault : "";
  return count;
}

void Plant::kill(std::string_view module) {
  const std::int32_t pid = impl_->module(module).pid.load();
  if (pid <= 0) {
    throw std::runtime_error(fmt::format("{} has no process that could be killed", module));
  }
  const std::uint64_t started = vars::process_start_time(pid);
  ::kill(pid, SIGKILL);
  while (vars::process_alive(pid, started)) {  // the node checks that before it lets time continue
    std::this_thread::sleep_for(1ms);
  }
}

void Plant::trace(std::vector<std::string> names) {
  for (const std::string& name : names) {
    (void)impl_->find(name);
  }
  impl_->trace.begin(std::move(names));
}

std::string Plant::differs_from_golden(const std::filesystem::path& file) const {
  return impl_->trace.difference_to(file);
}

std::string Plant::printed() const {
  return impl_->node.printed();
}

}  // namespace irp::testing
