// SPDX-License-Identifier: Apache-2.0

#include "store/runtime/attachment.h"

#include <cstring>
#include <utility>

namespace indurop::runtime {
namespace {

std::string name_in(const vars::BlockHeader& header) {
  return {header.node_name, strnlen(header.node_name, sizeof header.node_name)};
}

}  // namespace

Result<Attachment> Attachment::open(const std::string& node) {
  auto store = vars::Store::attach(node, vars::Mode::ReadWrite);
  if (!store) {
    return store.error();
  }
  return Attachment(std::move(store).value());
}

Attachment::Attachment(vars::Store& store)
    : borrowed_(&store), node_(name_in(store.header())), calls_(store.header()) {}

Attachment::Attachment(vars::Store&& store)
    : owned_(std::move(store)), node_(name_in(owned_->header())), calls_(owned_->header()) {}

}  // namespace indurop::runtime
