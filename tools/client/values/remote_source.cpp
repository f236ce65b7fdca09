// SPDX-License-Identifier: Apache-2.0
#include "tools/client/values/remote_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "core/rt/clock.h"
#include "network/dds/log.h"
#include "store/vars/shm_file.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

constexpr std::chrono::milliseconds kLook{20};
constexpr std::int64_t kRemoteQuietNs = 200'000'000;  // after this time without anything new discovery is complete
constexpr std::int64_t kSetNs = 3'000'000'000;
constexpr std::int64_t kRemoteRepeatNs = 300'000'000;
constexpr int kMostRepeats = 4;
constexpr std::chrono::milliseconds kPoll{20};

std::vector<std::string> silent(const std::vector<mirror::RemoteBoard>& boards) {
  std::vector<std::string> names;
  for (const mirror::RemoteBoard& board : boards) {
    if (!board.heard) {
      names.push_back(board.name);
    }
  }
  return names;
}

// Returns whether a name on a command line refers to the variable or a part of it. It may lack namespaces, and name a
// board.
bool means(const std::string& text, const std::string& variable) {
  std::string name = text.substr(0, text.find('@'));
  for (auto dot = name.find('.'); dot != std::string::npos; dot = name.find('.')) {
    name.replace(dot, 1, "::");  // both separators of namespaces are accepted
  }
  name = name.substr(0, name.find('['));
  for (std::string begin = name;; begin.resize(begin.rfind("::"))) {
    const bool whole = variable == begin;
    const bool last = variable.size() > begin.size() + 2 && variable.ends_with("::" + begin);
    if (whole || last || begin.rfind("::") == std::string::npos) {
      return whole || last;
    }
  }
}

// Returns a hint that keys may be why no board was discovered: a participant with keys does not answer one without, or
// with others.
std::string keys_hint(const dds::NetworkSettings& network) {
  if (!network.security.on()) {
    return "<external secure=\"on\">: --keys";
  }
  const std::string refusal = dds::last_refusal();
  return "with --keys, only boards of the same plant with <external secure=\"on\"> answer" +
         (refusal.empty() ? "" : ": " + refusal);
}

}  // namespace

Result<std::unique_ptr<RemoteSource>, Failure> RemoteSource::open(const dds::NetworkSettings& network,
                                                                  std::int64_t wait_ns,
                                                                  const std::vector<std::string>& names,
                                                                  std::vector<std::string>& notes) {
  auto opened = mirror::RemotePlane::open(network);
  if (!opened) {
    return Failure{kUnreachable, opened.error().text};
  }
  if (!opened->note.empty()) {
    notes.push_back(opened->note);
  }
  std::unique_ptr<RemoteSource> made(new RemoteSource(std::move(opened->plane), wait_ns));
  if (auto gathered = made->gather(network, names, notes); !gathered.ok()) {
    return std::move(gathered).error();
  }
  made->thread_ = std::thread([&self = *made] { self.feed(); });
  return made;
}

RemoteSource::~RemoteSource() {
  stop_.store(true);
  if (thread_.joinable()) {
    thread_.join();
  }
}

// Returns true if each of them belongs to a board that is received, or is known to belong to one that is not.
bool RemoteSource::knows(const std::vector<std::string>& names) const {
  const auto variables = plane_->variables();
  const auto silent = plane_->silent_variables();
  return !names.empty() && std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    return std::any_of(variables.begin(), variables.end(),
                       [&](const auto& seen) { return means(name, seen.declared.name); }) ||
           std::any_of(silent.begin(), silent.end(), [&](const auto& entry) { return means(name, entry.first); });
  });
}

// Waits until nothing new was discovered for a while and no board is missing, or the time is over.
Result<void, Failure> RemoteSource::gather(const dds::NetworkSettings& network, const std::vector<std::string>& names,
                                           std::vector<std::string>& notes) {
  const std::int64_t end = rt::now_ns() + wait_ns_;
  std::int64_t changed_ns = rt::now_ns();
  std::uint64_t generation = plane_->generation();
  while (!interrupted() && rt::now_ns() < end) {
    plane_->poll(rt::MonoClock::now() + kLook);
    if (plane_->generation() != generation) {
      generation = plane_->generation();
      changed_ns = rt::now_ns();
    }
    if (rt::now_ns() - changed_ns > kRemoteQuietNs && (plane_->complete() || knows(names))) {
      break;
    }
  }
  update();
  silent_ = plane_->silent_variables();
  title_ = fmt::format("DDS domain {}", network.domain);
  std::set<std::string> plants;
  for (const mirror::RemoteBoard& board : boards_) {
    plants.insert(board.plant);
  }
  if (plants.size() == 1 && !plants.begin()->empty()) {
    title_ = "plant " + *plants.begin();
  }
  for (const std::string& why : hidden_) {
    notes.push_back(fmt::format("not shown: {}", printable(why)));
  }
  if (const auto missing = silent(boards_); !missing.empty()) {
    notes.push_back(fmt::format("{}: silent: {}", title_, fmt::join(missing, ", ")));
  }
  if (interrupted()) {
    return Failure{interrupt_code(), {}};
  }
  if (variables_.empty()) {
    return Failure{kUnreachable,
                   fmt::format("no board shows variables in DDS domain {} (heard for {}). Boards do if their manifest "
                               "names <types>; other networks: --domain, --interface, --peer; {}",
                               network.domain, human_age(wait_ns_), keys_hint(network))};
  }
  return {};
}

void RemoteSource::feed() {
  while (!stop_.load()) {
    plane_->poll(rt::MonoClock::now() + kLook);
    update();
  }
}

// Processes what the plane has received, and sets what it requests.
void RemoteSource::update() {
  const std::lock_guard<std::mutex> guard(mutex_);
  boards_ = plane_->boards();
  if (plane_->generation() != plane_generation_) {
    plane_generation_ = plane_->generation();
    hidden_ = plane_->hidden();
    rebuild(plane_->variables());
  }
  for (const std::string& variable : followed_) {
    const auto known = variables_.find(variable);
    if (known != variables_.end()) {
      plane_->follow(variable, known->second.owner);
    }
    if (plane_->may_not_read(variable)) {
      forbidden_.insert(variable);
    }
  }
  if (order_) {
    order_->forbidden = plane_->may_not_set(order_->variable);
  }
  // The board may discover this writer after the writer discovered the board: messages in between are lost.
  if (order_ && order_->repeats < kMostRepeats && order_->answer != order_->value && rt::now_ns() >= order_->next_ns &&
      plane_->send(order_->variable, variables_.at(order_->variable).owner, order_->value)) {
    order_->sent = true;
    order_->next_ns = rt::now_ns() + kRemoteRepeatNs;
    ++order_->repeats;
  }
  plane_->take([this](const std::string& variable, const std::string& board, std::span<const std::uint8_t> value) {
    value_came(variable, board, value);
  });
  news_.notify_all();
}

void RemoteSource::value_came(const std::string& variable, const std::string& board,
                              std::span<const std::uint8_t> value) {
  const auto known = variables_.find(variable);
  if (known == variables_.end() || known->second.owner != board || !store_ ||
      value.size() != known->second.declared.type.size()) {
    return;
  }
  const auto* entry = store_->find(known->second.declared.name_hash());
  if (entry != nullptr && store_->write(*entry, 0, value).ok()) {
    arrived_.insert(variable);
  }
  if (order_ && order_->sent && order_->variable == variable) {
    order_->shown = true;
    order_->answer.assign(value.begin(), value.end());
  }
}

// Boards that are gone keep their variables: the last values remain, and continue when the board is back, or come from
// another one that shows them now (a standby).
void RemoteSource::rebuild(const std::vector<mirror::RemoteVariable>& variables) {
  const auto shows = [&](const std::string& variable, const std::string& board) {
    return std::any_of(variables.begin(), variables.end(),
                       [&](const auto& seen) { return seen.board == board && seen.declared.name == variable; });
  };
  bool other = !store_;
  for (const mirror::RemoteVariable& seen : variables) {
    auto& known = variables_[seen.declared.name];
    const bool first = known.boards.empty();
    const bool stands_in = !seen.board.empty() && known.owner != seen.board && !known.chosen;
    if (first || (stands_in && !shows(seen.declared.name, known.owner))) {
      known.owner = seen.board;
    }
    const bool replaced = first || (known.owner == seen.board && known.declared.type_hash != seen.declared.type_hash);
    if (replaced) {
      known.declared = seen.declared;
      plane_->reopen(seen.declared.name);
      known.declared.kind = abi::Kind::Ring;  // a ring numbers the received values
      other = true;
    }
    known.boards[seen.board] = seen.writable;
  }
  if (other && !variables_.empty()) {
    (void)renew_store();
  }
}

Status RemoteSource::renew_store() {
  schema::Schema schema;
  for (const auto& [name, known] : variables_) {
    schema.variables.push_back(known.declared);
  }
  const std::string name = fmt::format("remote-{}-{}", ::getpid(), ++stores_);
  auto fresh = vars::Store::create(name, schema);
  if (!fresh) {
    return fresh.error();
  }
  auto view = vars::Store::attach(name, vars::Mode::ReadOnly);
  (void)vars::remove_shm_file(vars::block_file(name));  // only this process uses it
  if (!view) {
    return view.error();
  }
  std::vector<std::uint8_t> bytes;
  for (const vars::DirectoryEntry& entry : fresh.value().directory()) {
    const auto* old = store_ ? store_->find(entry.name_hash) : nullptr;
    if (old != nullptr && old->type_hash == entry.type_hash) {
      bytes.resize(entry.value_size);
      if (store_->read(*old, 0, bytes).ok()) {
        (void)fresh.value().write(entry, 0, bytes);
      }
    }
  }
  store_ = std::move(fresh).value();
  view_ = std::move(view).value();
  generation_.fetch_add(1);
  return {};
}

Result<vars::Store> RemoteSource::attach() {
  const std::lock_guard<std::mutex> guard(mutex_);
  if (!view_) {
    return Error{Errc::Busy, 0, "variables of the network"};
  }
  vars::Store view = std::move(*view_);
  view_.reset();
  return view;
}

std::string RemoteSource::absence(const vars::Store* /*store*/) {
  const std::lock_guard<std::mutex> guard(mutex_);
  const auto missing = silent(boards_);
  return missing.empty() ? std::string{} : fmt::format("not heard: {}", fmt::join(missing, ", "));
}

std::string RemoteSource::prefer(const std::string& pattern, const std::string& board) {
  const std::lock_guard<std::mutex> guard(mutex_);
  bool any = false;
  for (auto& [name, known] : variables_) {
    if (known.boards.contains(board) && (name == pattern || schema::glob_match(pattern, name))) {
      known.owner = board;
      known.chosen = true;
      any = true;
    }
  }
  const auto known = std::find_if(boards_.begin(), boards_.end(), [&](const auto& one) { return one.name == board; });
  return any                      ? std::string{}
         : known == boards_.end() ? fmt::format("there is no board {}", board)
         : known->heard           ? fmt::format("board {} shows no variable '{}'", board, pattern)
                                  : fmt::format("'{}' of board {} is not known", pattern, board);
}

std::string RemoteSource::owner(const std::string& variable) const {
  const std::lock_guard<std::mutex> guard(mutex_);
  const auto known = variables_.find(variable);
  return known == variables_.end() ? std::string{} : known->second.owner;
}

std::string RemoteSource::silent_owner(const std::string& name) const {
  const auto found =
      std::find_if(silent_.begin(), silent_.end(), [&](const auto& entry) { return means(name, entry.first); });
  return found == silent_.end() ? std::string{} : found->second;
}

std::vector<std::string> RemoteSource::follow(const std::set<std::string>& variables) {
  std::unique_lock<std::mutex> lock(mutex_);
  followed_.insert(variables.begin(), variables.end());
  const std::int64_t end = rt::now_ns() + wait_ns_;
  std::vector<std::string> missing;
  do {
    missing.clear();
    std::set_difference(variables.begin(), variables.end(), arrived_.begin(), arrived_.end(),
                        std::back_inserter(missing));
    std::erase_if(missing, [this](const std::string& variable) { return forbidden_.contains(variable); });
  } while (!missing.empty() && !interrupted() && rt::now_ns() < end && (news_.wait_for(lock, kPoll), true));
  return missing;
}

bool RemoteSource::forbidden(const std::string& variable) const {
  const std::lock_guard<std::mutex> guard(mutex_);
  return forbidden_.contains(variable);
}

Result<void, Failure> RemoteSource::set(vars::Store& store, const std::string& name, const vars::DirectoryEntry& entry,
                                        const schema::Place& place, std::span<const std::uint8_t> bytes) {
  std::vector<std::uint8_t> whole(place.variable->type.size());
  if (const Status read = store.read(entry, 0, whole); !read.ok()) {
    return Failure{kFailed, fmt::format("{} cannot be read: {}", name, read.error().where)};
  }
  std::copy(bytes.begin(), bytes.end(), whole.begin() + place.offset);
  auto done = set_whole(place.variable->name, whole);
  if (!done.ok()) {
    return Failure{done.error().code, fmt::format("{} was not set: {}", name, done.error().text)};
  }
  return {};
}

Result<void, Failure> RemoteSource::set_whole(const std::string& variable, std::span<const std::uint8_t> value) {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto known = variables_.find(variable);
  if (known == variables_.end() || !known->second.boards[known->second.owner]) {
    return Failure{kFailed, known != variables_.end() && known->second.owner.empty()
                                ? "the program that shows it is not a board of InduRoP"
                                : "its board does not let it be set from outside: external=\"write\" in the manifest"};
  }
  order_.emplace();
  order_->variable = variable;
  order_->value.assign(value.begin(), value.end());
  const std::int64_t end = rt::now_ns() + kSetNs;
  const auto taken = [&] { return order_->shown && order_->answer == order_->value; };
  while (!taken() && !order_->forbidden && !interrupted() && rt::now_ns() < end) {
    news_.wait_for(lock, kPoll);
  }
  const RemoteOrder order = std::move(*order_);
  order_.reset();
  if (order.forbidden) {
    return Failure{kFailed,
                   "the keys given by --keys do not let it be set (indurop keys list -o json shows their lists)"};
  }
  if (!order.shown) {
    return Failure{kUnreachable,
                   fmt::format("board {} did not answer within {}", known->second.owner, human_age(kSetNs))};
  }
  if (order.answer != order.value) {
    return Failure{kFailed,
                   fmt::format("board {} shows {}: it was refused there (is it locked? its log says why), or a module "
                               "writes it too",
                               known->second.owner, schema::format_value(known->second.declared.type, order.answer))};
  }
  return {};
}

}  // namespace indurop::tools
