#include "translate/convert_deck.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "casefile/read_case.hpp"
#include "casefile/write_toml.hpp"
#include "mesh/deck_mesh.hpp"
#include "mesh/write_gmsh.hpp"
#include "output/file_writer.hpp"
#include "translate/translate_deck.hpp"

namespace carom {

namespace {

void refuse_existing(const std::string& path) {
  std::error_code error;
  if (std::filesystem::exists(path, error))
    throw CaseError({path, 0, 0}, "", "a file that is there already", "a new name",
                    "Remove it, or name another by -o.");
}

/// "# deck.inp:12", the file without its folders.
std::string comment_of(const Node& section) {
  if (section.where.line == 0) return {};
  return fmt::format("# {}:{}\n", std::filesystem::path(section.where.file).filename().string(), section.where.line);
}

Mesh mesh_of(const std::string& path) {
  const Deck deck = read_deck(read_included(path, {path, 0, 0}), path, read_included);
  return deck_mesh(statements_of(deck), path).mesh;
}

}  // namespace

ConvertedDeck convert_deck(const std::string& deck, const std::string& case_file,
                           const std::vector<std::string>& accepted) {
  namespace fs = std::filesystem;
  const std::string mesh_file = fs::path(case_file).replace_extension(".msh").string();
  refuse_existing(case_file);
  refuse_existing(mesh_file);
  TranslatedDeck translated = translate_deck(deck, accepted);
  case_of(translated.tree, deck);  // refuses what a run would refuse, in terms of the deck
  for (Member& member : std::get<Table>(translated.tree.value).members)
    if (member.key == "mesh")
      std::get<Table>(member.value.value).members.front().value.value = fs::path(mesh_file).filename().string();
  std::string text = fmt::format("# From {} by carom convert; the lines named are those of the deck.\n",
                                 fs::path(deck).filename().string());
  for (const std::string& note : translated.notes) text += "# " + note + "\n";
  write_file(mesh_file, gmsh_text(mesh_of(deck)));
  write_file(case_file, text + "\n" + write_toml(translated.tree, comment_of));
  return {case_file, mesh_file, std::move(translated.notes)};
}

}  // namespace carom
