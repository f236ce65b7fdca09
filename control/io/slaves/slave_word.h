// SPDX-License-Identifier: Apache-2.0
// What a word of the command line stands for: a drive, or the device of an EEPROM or of an ESI file.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <functional>
#include <string>

#include "control/io/ethercat/simulator/slave.h"

namespace indurop::io::slaves {

struct SlaveModel {
  ethercat::SlaveConfig config;
  // Called once, when the slave is there; it lives until the end.
  std::function<void(ethercat::Slave&)> attach;
  // The application of the slave, up to this time.
  std::function<void(ethercat::Bytes outputs, std::span<std::uint8_t> inputs, ethercat::Time now)> compute;
};

// "drive", "drive:start=-20,speed=220", "el2004.bin", "terminals.xml", "terminals.xml:EL2004"; relative names of files
// start at the folder. Errors: what is wrong with the word, or with the file.
Result<SlaveModel, std::string> read_slave_word(const std::string& word, const std::filesystem::path& folder = {});

}  // namespace indurop::io::slaves
