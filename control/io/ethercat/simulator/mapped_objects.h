// SPDX-License-Identifier: Apache-2.0
// The process data of a simulated slave as its mapping is now: outputs become values of objects, and values inputs.

#pragma once

#include <vector>

#include "control/io/ethercat/sii.h"
#include "control/io/ethercat/simulator/object_dictionary.h"

namespace indurop::io::ethercat {

class MappedObjects {
 public:
  // The mapping is that of the EEPROM if the dictionary has none. Borrows the dictionary until the end.
  MappedObjects(ObjectDictionary& objects, Sii sii) : objects_(objects), sii_(std::move(sii)) {}

  // Bytes beyond the mapping are not used, nor objects beyond the bytes.
  void take(Bytes outputs);
  void give(std::span<std::uint8_t> inputs);

 private:
  struct Place {
    std::span<std::uint8_t> value;
    std::size_t bit = 0;  // in the process data
    std::size_t bits = 0;
  };
  void refresh();
  [[nodiscard]] std::vector<Place> places(SyncManagerUse use) const;

  ObjectDictionary& objects_;
  Sii sii_;
  std::vector<Place> outputs_;
  std::vector<Place> inputs_;
  std::uint64_t changes_ = ~std::uint64_t{0};  // of the dictionary, when the places were found
};

}  // namespace indurop::io::ethercat
