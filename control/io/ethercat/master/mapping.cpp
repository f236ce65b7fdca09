// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/mapping.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace indurop::io::ethercat {

namespace {

using Wanted = std::span<const WantedObject>;
using Failure = std::optional<Unmapped>;

constexpr std::size_t kLeastCapacity = 8;  // objects that any PDO can take
constexpr int kMaxTries = 10'000;          // of sets of PDOs

bool has(const Pdo& pdo, const WantedObject& object) {
  return find_entry(pdo, object.index, object.subindex) != nullptr;
}

bool is_mandatory(const Pdo& pdo) {
  return (pdo.flags & kPdoMandatory) != 0;
}

bool excludes(const Pdo& a, const Pdo& b) {
  return std::find(a.excludes.begin(), a.excludes.end(), b.index) != a.excludes.end();
}

bool share_an_object(const Pdo& a, const Pdo& b) {
  return std::any_of(a.entries.begin(), a.entries.end(), [&b](const PdoEntry& entry) {
    return entry.index != 0 && find_entry(b, entry.index, entry.subindex) != nullptr;
  });
}

// Maps one direction of a slave.
class Mapper {
 public:
  // `whole`: PDOs that have to be assigned as they are.
  Mapper(const Sii& sii, std::vector<Pdo>& pdos, SyncManagerUse use, std::span<const std::uint16_t> whole)
      : sii_(sii), pdos_(pdos), use_(use), first_manager_(first_manager(sii, use)), whole_(whole) {}

  Failure map(Wanted wanted) {
    std::vector<Pdo*> assigned;
    for (Pdo& pdo : pdos_) {
      if (pdo.sync_manager != kNotAssigned) {
        assigned.push_back(&pdo);
      }
    }
    const WantedObject* const missing = first_missing(assigned, wanted);
    const Pdo* const unassigned = first_unassigned();
    if (missing == nullptr && unassigned == nullptr) {
      return std::nullopt;
    }
    if (!may_assign(sii_) || first_manager_ == kNotAssigned) {
      return missing == nullptr
                 ? failure({unassigned->index}, "the slave does not let its master assign this PDO")
                 : failure(*missing, is_anywhere(*missing) ? "a PDO that is not assigned has it, and the slave does "
                                                             "not let its master assign PDOs"
                                                           : kNowhere);
    }
    if (auto unchosen = choose_first()) {
      return unchosen;
    }
    for (std::size_t most = chosen_.size(); most <= pdos_.size() && tries_ > 0; ++most) {
      if (choose(wanted, most)) {
        assign();
        return std::nullopt;
      }
    }
    return fill(wanted);
  }

 private:
  static constexpr const char* kNowhere = "no PDO of the slave has it, and what they contain is fixed";

  Failure failure(const WantedObject& object, std::string reason) const {
    return Unmapped{object, use_ == SyncManagerUse::Outputs, std::move(reason)};
  }

  [[nodiscard]] bool is_whole(const Pdo& pdo) const {
    return std::find(whole_.begin(), whole_.end(), pdo.index) != whole_.end();
  }

  [[nodiscard]] const Pdo* first_unassigned() const {
    const auto found = std::find_if(pdos_.begin(), pdos_.end(), [this](const Pdo& pdo) {
      return is_whole(pdo) && pdo.sync_manager == kNotAssigned;
    });
    return found == pdos_.end() ? nullptr : &*found;
  }

  // Chooses what is assigned in any case.
  Failure choose_first() {
    for (Pdo& pdo : pdos_) {
      if (is_mandatory(pdo)) {
        chosen_.push_back(&pdo);
      }
    }
    for (Pdo& pdo : pdos_) {
      if (!is_whole(pdo) || is_mandatory(pdo)) {
        continue;
      }
      if (!goes_with_chosen(pdo)) {
        return failure({pdo.index}, "this PDO may not be assigned together with the others");
      }
      chosen_.push_back(&pdo);
    }
    return std::nullopt;
  }

  static const WantedObject* first_missing(const std::vector<Pdo*>& pdos, Wanted wanted) {
    const auto found = std::find_if(wanted.begin(), wanted.end(), [&pdos](const WantedObject& object) {
      return std::none_of(pdos.begin(), pdos.end(), [&object](const Pdo* pdo) { return has(*pdo, object); });
    });
    return found == wanted.end() ? nullptr : &*found;
  }

  [[nodiscard]] bool is_anywhere(const WantedObject& object) const {
    return std::any_of(pdos_.begin(), pdos_.end(), [&object](const Pdo& pdo) { return has(pdo, object); });
  }

  [[nodiscard]] bool goes_with_chosen(const Pdo& pdo) const {
    return std::none_of(chosen_.begin(), chosen_.end(), [&pdo](const Pdo* other) {
      return other == &pdo || share_an_object(*other, pdo) || excludes(*other, pdo) || excludes(pdo, *other);
    });
  }

  // Adds PDOs, up to this many, until all objects are there. Those that are assigned at first are tried first.
  bool choose(Wanted wanted, std::size_t most) {
    const WantedObject* const missing = first_missing(chosen_, wanted);
    if (missing == nullptr || chosen_.size() == most) {
      return missing == nullptr;
    }
    for (const bool at_first : {true, false}) {
      for (Pdo& pdo : pdos_) {
        if ((pdo.sync_manager != kNotAssigned) != at_first || !has(pdo, *missing) || !goes_with_chosen(pdo) ||
            --tries_ < 0) {
          continue;
        }
        chosen_.push_back(&pdo);
        if (choose(wanted, most)) {
          return true;
        }
        chosen_.pop_back();
      }
    }
    return false;
  }

  [[nodiscard]] Failure refuse(Wanted wanted) const {
    const auto nowhere =
        std::find_if(wanted.begin(), wanted.end(), [this](const WantedObject& object) { return !is_anywhere(object); });
    return nowhere != wanted.end() ? failure(*nowhere, kNowhere)
                                   : failure(*first_missing(chosen_, wanted),
                                             "no set of PDOs that may be assigned together has it and the others");
  }

  // Fills PDOs with what the mandatory fixed ones do not have.
  Failure fill(Wanted wanted) {
    const auto free = free_pdos();
    if (free.empty()) {
      return refuse(wanted);
    }
    std::erase_if(chosen_, [this](const Pdo* pdo) { return may_fill(sii_, *pdo) && !is_whole(*pdo); });
    Pdo all;
    for (const WantedObject& object : wanted) {
      if (has(all, object) || first_missing(chosen_, {&object, 1}) == nullptr) {
        continue;
      }
      auto entry = entry_of(object);
      if (entry.bits == 0) {
        return failure(object, "no PDO of the slave has it, and its type is not known; give it: type=\"int16\"");
      }
      all.entries.push_back(std::move(entry));
    }
    fill(free, std::move(all.entries));
    return std::nullopt;
  }

  void fill(const std::vector<Pdo*>& free, std::vector<PdoEntry> rest) {
    std::size_t capacity = kLeastCapacity;
    for (const Pdo* const pdo : free) {
      capacity = std::max(capacity, pdo->entries.size());
    }
    for (Pdo* const pdo : free) {
      const std::size_t count = pdo == free.back() ? rest.size() : std::min(capacity, rest.size());
      const auto end = rest.begin() + static_cast<std::ptrdiff_t>(count);
      if (count > 0 || is_mandatory(*pdo)) {
        pdo->entries.assign(rest.begin(), end);
        chosen_.push_back(pdo);
      }
      rest.erase(rest.begin(), end);
    }
    assign();
  }

  // As a PDO of the slave has it, else as it is wanted.
  [[nodiscard]] PdoEntry entry_of(const WantedObject& object) const {
    for (const Pdo& pdo : pdos_) {
      if (const PdoEntry* const entry = find_entry(pdo, object.index, object.subindex)) {
        return *entry;
      }
    }
    return {object.index, object.subindex, object.bits, object.type, {}};
  }

  // Those that may be filled, in the order in which they are.
  [[nodiscard]] std::vector<Pdo*> free_pdos() const {
    std::vector<Pdo*> free;
    for (Pdo& pdo : pdos_) {
      if (may_fill(sii_, pdo) && !is_whole(pdo)) {
        free.push_back(&pdo);
      }
    }
    std::stable_sort(free.begin(), free.end(), [](const Pdo* a, const Pdo* b) {
      const auto rank = [](const Pdo& pdo) { return is_mandatory(pdo) ? 0 : pdo.sync_manager != kNotAssigned ? 1 : 2; };
      return rank(*a) < rank(*b);
    });
    return free;
  }

  void assign() {
    for (Pdo& pdo : pdos_) {
      const bool is_chosen = std::find(chosen_.begin(), chosen_.end(), &pdo) != chosen_.end();
      const std::uint8_t own = pdo.sync_manager != kNotAssigned ? pdo.sync_manager : first_manager_;
      pdo.sync_manager = is_chosen ? own : kNotAssigned;
    }
  }

  const Sii& sii_;
  std::vector<Pdo>& pdos_;
  SyncManagerUse use_;
  std::uint8_t first_manager_;
  std::span<const std::uint16_t> whole_;
  std::vector<Pdo*> chosen_;
  int tries_ = kMaxTries;
};

}  // namespace

Result<Sii, Unmapped> map_objects(Sii sii, Wanted outputs, Wanted inputs, std::span<const std::uint16_t> pdos) {
  if (auto failure = Mapper(sii, sii.outputs, SyncManagerUse::Outputs, pdos).map(outputs)) {
    return std::move(*failure);
  }
  if (auto failure = Mapper(sii, sii.inputs, SyncManagerUse::Inputs, pdos).map(inputs)) {
    return std::move(*failure);
  }
  return sii;
}

}  // namespace indurop::io::ethercat
