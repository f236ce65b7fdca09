// SPDX-License-Identifier: Apache-2.0
#include "tools/client/values/here_source.h"

#include <fmt/format.h>

#include "core/rt/clock.h"
#include "store/vars/node_lock.h"
#include "store/vars/shm_file.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

std::string since(std::int64_t beat_ns) {
  const std::int64_t age = rt::now_ns() - beat_ns;
  return beat_ns > 0 && age >= 0 ? fmt::format("not running, last seen {} ago", human_age(age)) : "not running";
}

}  // namespace

Result<vars::Store> HereSource::attach() {
  return vars::Store::attach(node_, mode_);
}

std::uint64_t HereSource::generation() const {
  return vars::store_number(node_);
}

std::string HereSource::absence(const vars::Store* store) {
  if (store == nullptr) {
    return since(last_beat_ns_);
  }
  const vars::BlockHeader& header = store->header();
  const std::int64_t beat = header.heartbeat_ns.load(std::memory_order_relaxed);
  last_beat_ns_ = beat != 0 ? beat : last_beat_ns_;
  const pid_t pid = vars::running_node(node_);
  return pid != 0 && pid == header.node_pid.load(std::memory_order_relaxed) ? std::string() : since(beat);
}

Result<void, Failure> HereSource::set(vars::Store& store, const std::string& name, const vars::DirectoryEntry& entry,
                                      const schema::Place& place, std::span<const std::uint8_t> bytes) {
  const Status written = store.write(entry, place.offset, bytes);
  if (written.ok()) {
    return {};
  }
  if (written.error().code == Errc::Busy) {
    return Failure{kUnreachable, fmt::format("another process is writing {} and does not finish; try again", name)};
  }
  return Failure{kFailed, fmt::format("{} cannot be written: {} ({})", name, written.error().where,
                                      to_string(written.error().code))};
}

std::string HereSource::prefer(const std::string& /*pattern*/, const std::string& board) {
  return fmt::format("there is no board {} here; boards in the network: --remote", board);
}

std::string HereSource::owner(const std::string& /*variable*/) const {
  return {};
}

std::string HereSource::silent_owner(const std::string& /*name*/) const {
  return {};
}

std::vector<std::string> HereSource::follow(const std::set<std::string>& /*variables*/) {
  return {};
}

}  // namespace indurop::tools
