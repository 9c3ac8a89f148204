// Feeds arbitrary bytes to the Gmsh reader: whatever they are, it returns a mesh or throws CaseError.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/errors.hpp"
#include "mesh/mesh_summary.hpp"
#include "mesh/read_gmsh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const carom::Mesh mesh = carom::read_gmsh({reinterpret_cast<const char*>(data), size}, "fuzz.msh");
    carom::mesh_summary(mesh);
  } catch (const carom::CaseError&) {  // NOLINT(bugprone-empty-catch): a refusal is a good end
  }
  return 0;
}
