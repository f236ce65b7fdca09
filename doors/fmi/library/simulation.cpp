// SPDX-License-Identifier: Apache-2.0
#include "doors/fmi/library/simulation.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace indurop::fmi {
namespace {

// One portion of ticks may take so long; a run of a module that does not return is ended by the node after 10 s.
constexpr std::chrono::seconds kPatience{120};
constexpr std::uint64_t kPortionTicks = 100;

constexpr std::string_view kPrefix = "fmu-";

// A name that no other instance has, also of another FMU in this process, whose library has its own counters: two
// places in memory of the same name are 32 GiB apart. It is short, because the names of boards follow it.
std::string node_name(const void* instance) {
  constexpr std::string_view kDigits = "0123456789abcdefghijklmnopqrstuvwxyz";
  constexpr int kLength = 6;
  std::uintptr_t place = reinterpret_cast<std::uintptr_t>(instance) / alignof(std::max_align_t);
  std::string digits;
  for (int i = 0; i < kLength; ++i, place /= kDigits.size()) {
    digits += kDigits[place % kDigits.size()];
  }
  return fmt::format("{}{}-{}", kPrefix, ::getpid(), digits);
}

// The one where the FMU was made, if it is there. Not one near the FMU: it may lie in a folder that others can write.
std::filesystem::path node_program(const std::filesystem::path& programs) {
  const std::filesystem::path program = programs / "indurop-node";
  return !programs.empty() && ::access(program.c_str(), X_OK) == 0 ? program : std::filesystem::path();
}

}  // namespace

Simulation::Simulation(const Resources& resources)
    : name_(node_name(this)),
      node_(name_, resources.contents.plant, {"--", resources.configuration().string()}, kPatience,
            node_program(resources.contents.programs)) {
  testing::remove_orphans(kPrefix);
  std::vector<schema::PlaceIndex> indices;
  for (const auto& board : node_.boards()) {
    auto attached = vars::Store::attach(board.node, vars::Mode::ReadWrite);
    if (!attached) {
      node_.fail(fmt::format("the variables of the node cannot be reached: {}", to_string(attached.error().code)));
    }
    stores_.push_back(std::make_unique<vars::Store>(std::move(attached).value()));
    indices.emplace_back(stores_.back()->schema());
  }
  parts_.reserve(resources.contents.variables.size());
  for (const FmuVariable& variable : resources.contents.variables) {
    std::vector<Part>& parts = parts_.emplace_back();
    for (const std::string& board : variable.boards) {
      parts.push_back(find(variable.name, board, indices));
    }
  }
  (void)new_faults();
}

Simulation::Part Simulation::find(const std::string& variable, const std::string& board,
                                  const std::vector<schema::PlaceIndex>& indices) const {
  const auto& boards = node_.boards();
  const auto found =
      std::find_if(boards.begin(), boards.end(), [&board](const auto& one) { return one.name == board; });
  if (found == boards.end()) {
    throw std::runtime_error(fmt::format("{}: there is no board '{}'; make the FMU again", variable, board));
  }
  const auto index = static_cast<std::size_t>(found - boards.begin());
  auto place = indices[index].find(variable, schema::NearestName::Skip);
  if (!place) {
    throw std::runtime_error(fmt::format("{}; make the FMU again", place.error().message));
  }
  const vars::DirectoryEntry* entry = stores_[index]->find(place->variable->name_hash());
  if (entry == nullptr || !place->type.dims.empty() || place->type.base == schema::Base::Struct) {
    throw std::runtime_error(fmt::format("{} is not a number in the node's memory; make the FMU again", variable));
  }
  return {stores_[index].get(), entry, place->offset, std::move(place->type), place->range};
}

std::chrono::nanoseconds Simulation::basic_period() const {
  return std::chrono::nanoseconds(node_.basic_period_ns());
}

void Simulation::run_to(std::uint64_t ticks) {
  while (node_.ticks() < ticks) {
    node_.go(std::min(ticks - node_.ticks(), kPortionTicks));
  }
}

std::string Simulation::new_faults() {
  std::string text;
  std::size_t module = 0;
  for (const auto& board : node_.boards()) {
    scheduler::RunBlock& run = board.run();
    for (std::uint32_t i = 0; i < run.module_count; ++i, ++module) {
      const scheduler::ModuleRecord& record = run.modules()[i];
      const std::uint64_t faults = record.faults.load(std::memory_order_acquire);
      faults_.resize(std::max(faults_.size(), module + 1));
      if (faults != std::exchange(faults_[module], faults)) {
        text += fmt::format("{}module {}{}{} faulted: {}", text.empty() ? "" : "; ", record.name,
                            board.name.empty() ? "" : "@", board.name, record.last_fault);
      }
    }
  }
  return text;
}

std::string Simulation::new_output() {
  std::string text = node_.printed(printed_);
  text.resize(text.rfind('\n') + 1);  // npos + 1 is 0
  printed_ += text.size();
  return text;
}

void Simulation::read(std::size_t variable, std::span<std::uint8_t> to) const {
  const Part& part = parts_[variable].front();
  if (const Status done = part.store->read(*part.entry, part.offset, to); !done) {
    throw std::runtime_error(fmt::format("it cannot be read: {}", to_string(done.error().code)));
  }
}

void Simulation::write(std::size_t variable, std::span<const std::uint8_t> from) {
  for (const Part& part : parts_[variable]) {
    if (const Status done = part.store->write(*part.entry, part.offset, from); !done) {
      throw std::runtime_error(fmt::format("it cannot be written: {}", to_string(done.error().code)));
    }
  }
}

}  // namespace indurop::fmi
