// SPDX-License-Identifier: Apache-2.0
// The nodes of this machine, seen from their files.

#include <dirent.h>
#include <sys/types.h>

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "vars/batch.h"
#include "vars/block.h"
#include "vars/custody.h"
#include "vars/node_lock.h"
#include "vars/store.h"

namespace indurop::vars {

namespace {

// Processes that are still attached learn that the block is no longer the node's.
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

std::vector<std::string> list_nodes() {
  constexpr std::string_view kPrefix = "indurop.";
  std::vector<std::string> nodes;
  const auto close = [](DIR* directory) { ::closedir(directory); };
  const std::unique_ptr<DIR, decltype(close)> directory(::opendir(kShmDirectory), close);
  while (directory != nullptr) {
    const dirent* entry = ::readdir(directory.get());
    if (entry == nullptr) {
      break;
    }
    const std::string_view name = entry->d_name;
    if (name.starts_with(kPrefix) && valid_node_name(name.substr(kPrefix.size()))) {
      nodes.emplace_back(name.substr(kPrefix.size()));
    }
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

Status remove_node(const std::string& node) {
  pid_t holder = 0;
  const auto lock = NodeLock::acquire(node, holder);
  if (!lock) {
    return lock.error();
  }
  retire_block(node);
  Status result;
  // The lock file last: until then nobody else can start a node of this name.
  for (const std::string& name :
       {block_file(node), run_file(node), tape_file(node), batch_file(node), custody_file(node), mirror_file(node),
        external_file(node), retold_file(node), block_file(node) + ".kernel", lock_file(node)}) {
    for (const Status& status : {remove_unfinished(name), remove_shm_file(name)}) {
      if (!status && result.ok()) {
        result = status;
      }
    }
  }
  return result;
}

}  // namespace indurop::vars
