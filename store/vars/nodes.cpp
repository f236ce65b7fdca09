// SPDX-License-Identifier: Apache-2.0
// The nodes of this machine, seen from their files.
#include "store/vars/nodes.h"

#include <dirent.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "store/vars/batch.h"
#include "store/vars/block.h"
#include "store/vars/custody.h"
#include "store/vars/node_lock.h"
#include "store/vars/store.h"

namespace indurop::vars {

namespace {

// Notifies processes that are still attached that the block is no longer the node's.
void retire_block(const std::string& node) {
  auto file = ShmFile::open(block_file(node), Mode::ReadWrite);
  if (file && check_block({file->data(), file->size()})) {
    header_of(file->data())->state.store(BlockState::Retired, std::memory_order_release);
  }
}

}  // namespace

Result<rt::MonoTime> last_beat(const std::string& node) {
  const auto file = ShmFile::open(block_file(node), Mode::ReadOnly);
  if (!file) {
    return file.error();
  }
  if (const Status status = check_header({file->data(), file->size()}); !status) {
    return status.error();
  }
  const std::int64_t beat = header_of(file->data())->heartbeat_ns.load();
  return beat != 0 ? Result<rt::MonoTime>(rt::mono_time(beat)) : Error{Errc::NotFound, 0, "no heartbeat yet"};
}

std::uint32_t store_format(const std::string& node) {
  const auto file = ShmFile::open(block_file(node), Mode::ReadOnly);
  const bool is_store = file && file->size() >= offsetof(BlockHeader, header_size) &&
                        header_of(file->data())->magic.load(std::memory_order_acquire) == kMagic;
  return is_store ? header_of(file->data())->abi : 0;
}

namespace {

// Unless asked for all nodes, the search does not even open files that other users created.
bool is_near(const std::string& file) {
  struct stat info {};
  if (::lstat((std::string(kShmDirectory) + "/" + file).c_str(), &info) != 0 || !S_ISREG(info.st_mode)) {
    return false;
  }
  static const std::vector<gid_t> kGroups = [] {
    std::vector<gid_t> groups(static_cast<std::size_t>(std::max(::getgroups(0, nullptr), 0)));
    groups.resize(static_cast<std::size_t>(std::max(::getgroups(static_cast<int>(groups.size()), groups.data()), 0)));
    groups.push_back(::getegid());
    return groups;
  }();
  return info.st_uid == 0 || info.st_uid == ::geteuid() ||
         std::find(kGroups.begin(), kGroups.end(), info.st_gid) != kGroups.end();
}

}  // namespace

std::vector<std::string> list_nodes(Nodes which) {
  constexpr std::string_view kPrefix = "indurop.";
  constexpr std::string_view kLock = ".lock";
  std::vector<std::string> nodes;
  std::vector<std::string> locks;
  const auto close = [](DIR* directory) { ::closedir(directory); };
  const std::unique_ptr<DIR, decltype(close)> directory(::opendir(kShmDirectory), close);
  while (directory != nullptr) {
    const dirent* entry = ::readdir(directory.get());
    if (entry == nullptr) {
      break;
    }
    std::string_view name = entry->d_name;
    if (!name.starts_with(kPrefix) || (which == Nodes::Near && !is_near(entry->d_name))) {
      continue;
    }
    name.remove_prefix(kPrefix.size());
    const bool is_lock = name.ends_with(kLock);
    name.remove_suffix(is_lock ? kLock.size() : 0);
    if (valid_node_name(name)) {
      (is_lock ? locks : nodes).emplace_back(name);
    }
  }
  std::sort(nodes.begin(), nodes.end());
  std::vector<std::string> bare;  // the store does not exist yet, or no longer exists
  std::copy_if(locks.begin(), locks.end(), std::back_inserter(bare), [&](const std::string& node) {
    return !std::binary_search(nodes.begin(), nodes.end(), node) && running_node(node) != 0;
  });
  nodes.insert(nodes.end(), bare.begin(), bare.end());
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

bool has_node(const std::string& node, Nodes which) {
  const auto is_there = [which](const std::string& file) {
    struct stat info {};
    return which == Nodes::Near ? is_near(file)
                                : ::lstat((std::string(kShmDirectory) + "/" + file).c_str(), &info) == 0;
  };
  return valid_node_name(node) &&
         (is_there(block_file(node)) || (is_there(lock_file(node)) && running_node(node) != 0));
}

std::vector<std::string> running_nodes() {
  std::vector<std::string> names = list_nodes();
  std::erase_if(names, [](const std::string& name) { return running_node(name) == 0; });
  return names;
}

bool is_running(const std::string& node, const BlockHeader& header) {
  const pid_t pid = running_node(node);
  return pid != 0 && pid == header.node_pid.load(std::memory_order_relaxed);
}

std::string node_of_environment() {
  const char* const node = std::getenv("INDUROP_NODE");
  return node == nullptr ? "" : node;
}

std::string usual_node(const std::vector<std::string>& names) {
  for (const std::string& usual : {default_node(), std::string("local")}) {
    if (std::find(names.begin(), names.end(), usual) != names.end()) {
      return usual;
    }
  }
  return names.size() == 1 ? names.front() : "";
}

Status remove_node(const std::string& node) {
  pid_t holder = 0;
  const auto lock = NodeLock::acquire(node, holder);
  if (!lock) {
    return lock.error();
  }
  retire_block(node);
  Status result;
  std::vector<std::string> names{block_file(node),        run_file(node),
                                 tape_file(node),         batch_file(node),
                                 custody_file(node),      mirror_file(node),
                                 external_file(node),     keyframe_file(node),
                                 replay_input_file(node), block_file(node) + ".kernel"};
  std::ranges::move(pool_files(node), std::back_inserter(names));
  std::ranges::move(shm_files_beginning_with(keyframe_file(node) + "."), std::back_inserter(names));  // of processes
  names.push_back(lock_file(node));  // the last one: until then no other process can start a node of this name
  for (const std::string& name : names) {
    for (const Status& status : {remove_unfinished(name), remove_shm_file(name)}) {
      if (!status && result.ok()) {
        result = status;
      }
    }
  }
  return result;
}

}  // namespace indurop::vars
