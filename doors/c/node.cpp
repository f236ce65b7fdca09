// SPDX-License-Identifier: Apache-2.0
#include "doors/c/node.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "core/schema/schema.h"
#include "store/vars/nodes.h"
#include "store/vars/shm_file.h"

using indurop::Result;
using indurop::c::Failure;
using indurop::c::Found;
namespace vars = indurop::vars;
namespace schema = indurop::schema;

namespace {

Result<std::string, Failure> chosen(const std::string& asked) {
  const std::string named = asked.empty() ? vars::node_of_environment() : asked;
  if (!named.empty()) {
    return vars::valid_node_name(named)
               ? Result<std::string, Failure>(named)
               : Failure{IRP_INVALID, fmt::format("'{}' is not a node name: 1 to 40 of A-Z a-z 0-9 _ -", named)};
  }
  const std::vector<std::string> running = vars::running_nodes();
  if (std::string usual = vars::usual_node(running); !usual.empty()) {
    return usual;
  }
  return running.empty()
             ? Failure{IRP_NOT_FOUND, "no node runs on this machine. Start one: indurop run module.xml"}
             : Failure{IRP_INVALID, fmt::format("several nodes run; name one of them: {}", fmt::join(running, ", "))};
}

Result<vars::Store, Failure> attach(const std::string& name, irp_access access) {
  auto store = vars::Store::attach(name, access == IRP_WRITE ? vars::Mode::ReadWrite : vars::Mode::ReadOnly);
  if (store) {
    return std::move(store).value();
  }
  return store.error().code == indurop::Errc::NotFound
             ? Failure{IRP_NOT_FOUND, fmt::format("there is no node '{}' on this machine", name)}
             : indurop::c::failure_of(store.error(), fmt::format("node '{}'", name));
}

Found described(indurop::operate::Item item) {
  indurop::c::Texts texts = indurop::c::texts_of(item.name, item.place.type);
  return {std::move(item), std::move(texts)};
}

}  // namespace

irp_node::irp_node(std::string name, irp_access access, vars::Store store)
    : name_(std::move(name)), access_(access), store_(std::move(store)) {
  list_names();
}

Result<irp_node*, Failure> irp_node::open(const std::string& name, irp_access access) {
  auto which = chosen(name);
  if (!which) {
    return std::move(which).error();
  }
  auto store = attach(*which, access);
  if (!store) {
    return std::move(store).error();
  }
  return new irp_node(std::move(which).value(), access, std::move(store).value());
}

void irp_node::list_names() {
  names_.clear();
  for (const schema::Variable& variable : store_.schema().variables) {
    names_.push_back(variable.name);
  }
  std::sort(names_.begin(), names_.end());
}

Failure irp_node::changed() const {
  return {IRP_CHANGED, fmt::format("node '{}' has other variables now; call irp_refresh()", name_)};
}

Result<const Found*, Failure> irp_node::found(std::uint32_t id) const {
  if (store_.retired()) {
    return changed();
  }
  if (id >= found_.size()) {
    return Failure{IRP_NOT_FOUND, fmt::format("{} is not an id that irp_find() returned", id)};
  }
  const Found& one = found_[id];
  if (one.item.entry == nullptr) {
    return Failure{IRP_NOT_FOUND, fmt::format("node '{}' has no variable '{}' of type {} any more; call irp_find()",
                                              name_, one.item.name, one.texts.type)};
  }
  return &one;
}

Result<std::uint32_t, Failure> irp_node::find(const std::string& name) {
  if (store_.retired()) {
    return changed();
  }
  auto item = indurop::operate::find(store_, name);
  if (!item) {
    return store_.grown() ? changed() : Failure{IRP_NOT_FOUND, std::move(item).error().text};
  }
  if (const auto known = ids_.find(item->name); known != ids_.end() && found_[known->second].item.entry != nullptr) {
    return known->second;
  }
  const auto id = static_cast<std::uint32_t>(found_.size());
  found_.push_back(described(std::move(item).value()));
  ids_[found_.back().item.name] = id;
  return id;
}

Result<void, Failure> irp_node::refresh() {
  if (!store_.retired() && !store_.grown()) {
    return {};
  }
  auto store = attach(name_, access_);
  if (!store) {
    return std::move(store).error();
  }
  for (Found& one : found_) {
    auto item = indurop::operate::find(*store, one.item.name);
    if (item && item->name == one.item.name && schema::canonical(item->place.type) == one.texts.layout) {
      one.item = std::move(item).value();
    } else {
      one.item.entry = nullptr;
      one.item.place.variable = nullptr;
    }
  }
  store_ = std::move(store).value();
  list_names();
  return {};
}

Result<void, Failure> irp_node::running() const {
  if (store_.retired()) {
    return changed();
  }
  if (!vars::is_running(name_, store_.header())) {
    return Failure{IRP_GONE, fmt::format("node '{}' has ended", name_)};
  }
  return {};
}

irp_code irp_open(const char* name, irp_access access, irp_node** node) {
  return indurop::c::guarded([&]() -> Result<void, Failure> {
    if (node == nullptr || (access != IRP_READ && access != IRP_WRITE)) {
      return Failure{IRP_INVALID, "irp_open: node is null, or access is neither IRP_READ nor IRP_WRITE"};
    }
    *node = nullptr;
    auto opened = irp_node::open(name == nullptr ? "" : name, access);
    if (!opened) {
      return std::move(opened).error();
    }
    *node = *opened;
    return {};
  });
}

void irp_close(irp_node* node) {
  const std::unique_ptr<irp_node> closed(node);
}

const char* irp_node_name(const irp_node* node) {
  return node == nullptr ? "" : node->name().c_str();
}

irp_code irp_running(const irp_node* node) {
  return indurop::c::guarded([&]() -> Result<void, Failure> {
    return node == nullptr ? Failure{IRP_INVALID, "irp_running: node is null"} : node->running();
  });
}

irp_code irp_refresh(irp_node* node) {
  return indurop::c::guarded([&]() -> Result<void, Failure> {
    return node == nullptr ? Failure{IRP_INVALID, "irp_refresh: node is null"} : node->refresh();
  });
}

size_t irp_count(const irp_node* node) {
  return node == nullptr ? 0 : node->names().size();
}

const char* irp_name(const irp_node* node, size_t index) {
  return index < irp_count(node) ? node->names()[index].c_str() : nullptr;
}
