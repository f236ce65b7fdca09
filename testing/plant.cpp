// SPDX-License-Identifier: Apache-2.0
// <indurop/testing.h>: a plant as its tests see it, made of a node process, its store and its run block.

#include <fmt/format.h>
#include <indurop/irp.h>
#include <indurop/testing.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <optional>
#include <stdexcept>

#include "schema/leaf.h"
#include "schema/schema.h"
#include "testing/golden.h"
#include "testing/node_process.h"
#include "vars/store.h"

namespace irp::testing {
namespace {

namespace schema = indurop::schema;
namespace vars = indurop::vars;
namespace scheduler = indurop::scheduler;

std::string new_name() {
  static std::atomic<unsigned> count{0};
  return fmt::format("test-{}-{}", ::getpid(), ++count);
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

std::optional<long double> number_in(schema::Base base, const std::vector<std::uint8_t>& bytes) {
  switch (base) {
    case schema::Base::Bool:
    case schema::Base::Char:
      return schema::load<std::uint8_t>(bytes.data());
    case schema::Base::Enum:
      return schema::load<std::int32_t>(bytes.data());
    default:
      break;
  }
  std::optional<long double> value;
  schema::with_number(base, bytes.data(), [&value](auto number) { value = static_cast<long double>(number); });
  return value;
}

}  // namespace

struct Plant::Impl {
  struct Part {
    schema::Place place;
    const vars::DirectoryEntry* entry = nullptr;
  };

  Impl(const std::filesystem::path& configuration, const Settings& settings)
      : name(new_name()), node(name, arguments_of(configuration, settings), settings.patience) {
    auto attached = vars::Store::attach(name, vars::Mode::ReadWrite);
    if (!attached) {
      node.fail("the variables of the node cannot be reached");
    }
    store.emplace(std::move(attached).value());
    (void)irp::attach(name.c_str());  // what this program uses and the node lacks is said on stderr
  }

  [[nodiscard]] Part find(std::string_view text) const {
    std::string message;
    auto place = schema::find_place(store->schema(), text, message);
    if (!place) {
      throw std::runtime_error(message);
    }
    const vars::DirectoryEntry* entry =
        store->find(indurop::abi::fnv1a64(place->variable->name.data(), place->variable->name.size()));
    if (entry == nullptr) {
      throw std::runtime_error(fmt::format("{} is not in the node's memory", text));
    }
    return {std::move(place).value(), entry};
  }

  [[nodiscard]] std::vector<std::uint8_t> read(const Part& part) const {
    std::vector<std::uint8_t> bytes(part.place.type.size());
    if (!store->read(*part.entry, part.place.offset, bytes)) {
      throw std::runtime_error(fmt::format("{} cannot be read", part.place.variable->name));
    }
    return bytes;
  }

  void write(const Part& part, std::span<const std::uint8_t> from) {
    if (!store->write(*part.entry, part.place.offset, from)) {
      throw std::runtime_error(fmt::format("{} cannot be written", part.place.variable->name));
    }
  }

  [[nodiscard]] scheduler::ModuleRecord& module(std::string_view wanted) const {
    scheduler::RunBlock& run = node.run();
    std::string known;
    for (std::uint32_t i = 0; i < run.module_count; ++i) {
      scheduler::ModuleRecord& record = run.modules()[i];
      if (wanted == record.name) {
        return record;
      }
      known += (i > 0 ? ", " : "") + std::string(record.name);
    }
    throw std::runtime_error(fmt::format("there is no module {}; there is {}", wanted, known));
  }

  void go(std::uint64_t ticks);

  std::string name;
  indurop::testing::NodeProcess node;
  std::optional<vars::Store> store;
  indurop::testing::Trace trace;
};

void Plant::Impl::go(std::uint64_t ticks) {
  if (!trace.on()) {
    node.go(ticks);
    return;
  }
  for (std::uint64_t i = 0; i < ticks; ++i) {
    node.go(1);
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

Plant::~Plant() {
  const std::string name = impl_->name;
  impl_.reset();
  (void)vars::remove_node(name);
}

void Plant::run(std::chrono::nanoseconds time) {
  const std::int64_t basic = impl_->node.run().basic_period_ns;
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
  return std::chrono::nanoseconds(impl_->node.run().basic_period_ns);
}

std::chrono::nanoseconds Plant::time() const {
  return basic_period() * static_cast<std::int64_t>(tick());
}

long double Plant::number(std::string_view name) const {
  const Impl::Part part = impl_->find(name);
  const auto value = part.place.type.dims.empty() ? number_in(part.place.type.base, impl_->read(part)) : std::nullopt;
  if (!value) {
    throw std::runtime_error(
        fmt::format("{} is a {}, not a number: name a part of it", name, schema::display_name(part.place.type)));
  }
  return *value;
}

std::string Plant::text(std::string_view name) const {
  const Impl::Part part = impl_->find(name);
  const auto bytes = impl_->read(part);
  if (part.place.type.base == schema::Base::Text && part.place.type.dims.empty()) {
    const auto end = std::find(bytes.begin(), bytes.end(), 0);
    return {bytes.begin(), end};
  }
  return schema::format_value(part.place.type, bytes);
}

void Plant::bytes(std::string_view name, std::span<std::uint8_t> to) const {
  const Impl::Part part = impl_->find(name);
  const auto from = impl_->read(part);
  if (from.size() != to.size()) {
    throw std::runtime_error(fmt::format("{} is a {} of {} bytes, not of {}", name,
                                         schema::display_name(part.place.type), from.size(), to.size()));
  }
  std::copy(from.begin(), from.end(), to.begin());
}

void Plant::set_text(std::string_view name, const std::string& text, bool hold) {
  const Impl::Part part = impl_->find(name);
  std::vector<std::uint8_t> bytes = impl_->read(part);
  std::string message;
  if (!schema::parse_value(part.place.type, text, bytes, message)) {
    throw std::runtime_error(fmt::format("{}: {}", name, message));
  }
  if (!hold) {
    impl_->write(part, bytes);
  } else if (!impl_->store->force(*part.entry, part.place.offset, bytes, vars::kForever)) {
    throw std::runtime_error(
        fmt::format("{} cannot be forced: only numbers can, {} at a time", name, vars::kMostForces));
  }
}

void Plant::set_bytes(std::string_view name, std::span<const std::uint8_t> from) {
  const Impl::Part part = impl_->find(name);
  if (part.place.type.size() != from.size()) {
    throw std::runtime_error(fmt::format("{} is a {} of {} bytes, not of {}", name,
                                         schema::display_name(part.place.type), part.place.type.size(), from.size()));
  }
  impl_->write(part, from);
}

void Plant::unforce(std::string_view name) {
  const Impl::Part part = impl_->find(name);
  if (!impl_->store->let_go(*part.entry, part.place.offset)) {
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
  ::kill(pid, SIGKILL);
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
