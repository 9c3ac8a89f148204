// Feeds arbitrary bytes to the MED reader: as an HDF5 file, read in a child process, when they have its signature, and
// as the stream that this process sends back otherwise. Whatever they are, a mesh comes out or CaseError.
#include <pthread.h>
#include <sanitizer/common_interface_defs.h>

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/errors.hpp"
#include "mesh/finish_mesh.hpp"
#include "mesh/hdf5_tree.hpp"
#include "mesh/med_mesh.hpp"
#include "mesh/mesh_summary.hpp"
#include "mesh/read_med.hpp"

/// Faults of libhdf5 in the child process are expected there; only those of this process are findings.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  pthread_atfork(nullptr, nullptr, [] { __sanitizer_set_death_callback(nullptr); });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    const bool is_hdf5 = bytes.starts_with("\x89HDF\r\n\x1a\n");
    const carom::Mesh mesh =
        is_hdf5 ? carom::read_med(bytes, "fuzz.med")
                : carom::finished(carom::med_mesh(carom::decode_hdf5_tree(bytes, "fuzz.med"), "fuzz.med"));
    carom::mesh_summary(mesh);
  } catch (const carom::CaseError&) {  // NOLINT(bugprone-empty-catch): a refusal is a good end
  }
  return 0;
}
