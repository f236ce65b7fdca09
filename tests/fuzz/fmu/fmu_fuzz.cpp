// SPDX-License-Identifier: Apache-2.0
// Whatever bytes an FMU holds: it is read, or refused with a reason, and what is read can be looked up. Bytes that
// begin with '<' are a description, others an archive.

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "control/io/fmu/fmu_file.h"

namespace {

using namespace indurop::io::fmu;

void look_up(const Description& description) {
  for (const Variable& variable : description.variables) {
    for (std::size_t i = 0; i < variable.size() && i < 100; ++i) {
      const auto place = find_place(description, element_name(variable, i));
      // A variable whose name is that of an element goes first.
      if (!place) {
        std::abort();
      }
    }
    for (const std::string& start : variable.start) {
      (void)read_numbers(variable, start);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (bytes.starts_with('<')) {
    const ReadDescription read = read_description(bytes, "x.xml");
    if (!indurop::base::has_error(read.diagnostics)) {
      look_up(read.description);
    }
    return 0;
  }
  const int file = ::memfd_create("fmu", MFD_CLOEXEC);
  if (file < 0 || ::write(file, data, size) != static_cast<ssize_t>(size)) {
    std::abort();
  }
  const FmuFile fmu = read_fmu("/proc/self/fd/" + std::to_string(file));
  if (fmu.ok()) {
    look_up(fmu.description);
  }
  ::close(file);
  return 0;
}
