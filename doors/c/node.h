// SPDX-License-Identifier: Apache-2.0
// A node as a C program sees it: its store, and variables found by name, which have numbers.

#pragma once

#include <indurop/c.h>
#include <indurop/result.h>

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "doors/c/describe.h"
#include "doors/c/failure.h"
#include "store/operate/item.h"
#include "store/vars/store.h"

namespace indurop::c {

// A variable that was found. Its texts are what irp_describe() points to.
struct Found {
  operate::Item item;  // its entry is null if the variable is gone
  Texts texts;
};

}  // namespace indurop::c

struct irp_node {
 public:
  static indurop::Result<irp_node*, indurop::c::Failure> open(const std::string& name, irp_access access);

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] irp_access access() const noexcept { return access_; }
  [[nodiscard]] const indurop::vars::Store& store() const noexcept { return store_; }
  [[nodiscard]] indurop::vars::Store& store() noexcept { return store_; }
  [[nodiscard]] const std::vector<std::string>& names() const noexcept { return names_; }

  // Returns the variable of an id. Errors: IRP_NOT_FOUND, IRP_CHANGED.
  indurop::Result<const indurop::c::Found*, indurop::c::Failure> found(std::uint32_t id) const;
  indurop::Result<std::uint32_t, indurop::c::Failure> find(const std::string& name);
  indurop::Result<void, indurop::c::Failure> refresh();
  // IRP_CHANGED, as an error.
  [[nodiscard]] indurop::c::Failure changed() const;
  // Errors: IRP_GONE, IRP_CHANGED.
  [[nodiscard]] indurop::Result<void, indurop::c::Failure> running() const;

 private:
  irp_node(std::string name, irp_access access, indurop::vars::Store store);
  void list_names();

  std::string name_;
  irp_access access_;
  indurop::vars::Store store_;
  std::vector<std::string> names_;
  std::deque<indurop::c::Found> found_;  // by id; elements stay where they are
  std::map<std::string, std::uint32_t> ids_;
};
