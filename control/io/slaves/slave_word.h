// SPDX-License-Identifier: Apache-2.0
// What a word of the command line stands for: a drive, or the device of an EEPROM or of an ESI file, and its place on
// the cable.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "control/io/ethercat/simulator/segment.h"

namespace indurop::io::slaves {

struct SlaveModel {
  ethercat::SlaveConfig config;
  // Called once, when the slave is there; it lives until the end.
  std::function<void(ethercat::Slave&)> attach;
  // The application of the slave, up to this time.
  std::function<void(ethercat::Bytes outputs, std::span<std::uint8_t> inputs, ethercat::Time now)> compute;
  std::optional<ethercat::Segment::Outlet> outlet = std::nullopt;  // nothing: behind the slave before
};

// "drive", "drive:start=-20,speed=220", "el2004.bin", "terminals.xml", "terminals.xml:EL2004", and "drive@1.3", which
// is linked to port 3 of slave 1; relative names of files start at the folder. Errors: what is wrong with the word, or
// with the file.
Result<SlaveModel, std::string> read_slave_word(const std::string& word, const std::filesystem::path& folder = {});

// Adds a slave to a cable; `now` is the time up to which its application is computed. Returns what is wrong with its
// place, empty: nothing.
std::string add_slave(ethercat::Segment& segment, SlaveModel model, std::function<ethercat::Time()> now);

}  // namespace indurop::io::slaves
