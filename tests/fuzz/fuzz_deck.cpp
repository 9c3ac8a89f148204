// Feeds arbitrary bytes to the readers of decks: whatever they are, a mesh and a case come out or CaseError.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/errors.hpp"
#include "casefile/read_case.hpp"
#include "mesh/deck_mesh.hpp"
#include "mesh/mesh_summary.hpp"
#include "translate/translate_deck.hpp"

namespace {

std::string no_file(const std::string& path, const carom::Location& where) {
  throw carom::CaseError(where, "*INCLUDE", path, "no file");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  try {
    carom::mesh_summary(carom::read_deck_mesh(bytes, "fuzz.inp", no_file));
  } catch (const carom::CaseError&) {  // NOLINT(bugprone-empty-catch): a refusal is a good end
  }
  try {
    carom::case_of(carom::translate_deck(bytes, "fuzz.inp", {"TIE", "DAMPING"}, no_file).tree, "fuzz.inp");
  } catch (const carom::CaseError&) {  // NOLINT(bugprone-empty-catch): a refusal is a good end
  }
  return 0;
}
