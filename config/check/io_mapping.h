// SPDX-License-Identifier: Apache-2.0
// What the points and copies of an EtherCAT device need of its slave, and whether the slave can exchange it, as far as
// the maker's description (ESI) says.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "config/check/io_binding.h"
#include "control/io/esi/esi_file.h"
#include "control/io/ethercat/master/block.h"
#include "control/io/ethercat/master/mapping.h"

namespace indurop::config {

// What the slave of a device exchanges in one direction: for points of this direction, and for what is copied.
std::vector<IoBlock> wanted_outputs(std::span<const IoPoint> points, const IoSlave& slave);
std::vector<IoBlock> wanted_inputs(std::span<const IoPoint> points, const IoSlave& slave);

struct Unexchangeable {
  bool output = false;
  std::size_t block = 0;  // of those of its direction
  std::string reason;     // "no PDO of the slave has it, and what they contain is fixed"
};
// Returns the slave with PDOs assigned that have all blocks. Errors: the first one that it cannot exchange, or whose
// outputs another one writes, too. Not real-time safe.
Result<io::ethercat::Sii, Unexchangeable> map_blocks(io::ethercat::Sii sii, std::span<const IoBlock> outputs,
                                                     std::span<const IoBlock> inputs);
io::ethercat::Block block_of(const IoBlock& block) noexcept;

// Returns what keeps slaves that are mapped from this copy; empty: nothing, or one of them does not exchange its end.
std::string problem_of_copy(const IoCopy& copy, const io::ethercat::Sii& source, const io::ethercat::Sii& target);

// The device of the description, by the identity in the file. Errors: those of the description, or that it has no such
// device; `file` is the ioconfig.xml. Not real-time safe.
Result<io::esi::Device, std::vector<base::Diagnostic>> described_slave(const IoDevice& device,
                                                                       const std::filesystem::path& file);

// Adds an error for each point and each end of a copy that the described slaves of these devices cannot exchange, and
// for copies between two of them whose ends differ in size.
void check_mappings(std::span<const BoundDevice* const> devices, const std::filesystem::path& file,
                    std::vector<base::Diagnostic>& diagnostics);

}  // namespace indurop::config
