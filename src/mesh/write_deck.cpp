#include "mesh/write_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <span>

#include "base/errors.hpp"
#include "mesh/deck_elements.hpp"

namespace carom {

namespace {

[[noreturn]] void refuse_type(const Mesh& mesh, CellType type) {
  throw CaseError({mesh.report.source, 0, 0}, "", fmt::format("cells of type {}", name(type)),
                  "cells that decks of Abaqus and CalculiX have", "Write the mesh as .msh or .vtu.");
}

/// The first element of this type; of plane cells beside solids the first that needs no section.
const DeckElementType& element_of(const Mesh& mesh, CellType type, bool has_solids) {
  const auto fits = [&](const DeckElementType& e) {
    return e.kind == DeckElementType::Kind::cell && e.type == type &&
           (dimension(type) != 2 || e.section.empty() == has_solids);
  };
  const std::span<const DeckElementType> all = deck_element_types();
  const auto found = std::find_if(all.begin(), all.end(), fits);
  if (found == all.end()) refuse_type(mesh, type);
  return *found;
}

std::string quoted(const Mesh& mesh, const std::string& name) {
  if (name.find_first_of("\"\n") != std::string::npos || name.empty())
    throw CaseError({mesh.report.source, 0, 0}, "", fmt::format("a group named '{}'", name), "a name without quotes",
                    "Rename the group.");
  const bool is_plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return is_plain ? name : fmt::format("\"{}\"", name);
}

/// Sixteen numbers a line, as many as both programs read.
template <class Numbers>
void write_numbers(const Numbers& numbers, std::string& text) {
  constexpr std::size_t in_a_line = 16;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const bool ends = i + 1 == numbers.size() || (i + 1) % in_a_line == 0;
    fmt::format_to(std::back_inserter(text), "{}{}", numbers[i],
                   ends ? (i + 1 == numbers.size() ? "\n" : ",\n") : ", ");
  }
}

void write_block(const Mesh& mesh, const CellBlock& block, const DeckElementType& element, std::string& text) {
  fmt::format_to(std::back_inserter(text), "*ELEMENT, TYPE={}\n", element.name);
  std::vector<std::int64_t> line;
  for (std::size_t c = 0; c < block.size(); ++c) {
    const std::span<const Index> nodes = block.nodes(static_cast<Index>(c));
    line.assign(nodes.size() + 1, block.file_numbers[c]);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      line[1 + (element.order.empty() ? i : element.order[i])] = mesh.node_numbers[at(nodes[i])];
    write_numbers(line, text);
  }
}

/// Numbers of cells as the deck has them: each once. Meshes whose blocks count anew are numbered through.
bool numbers_are_unique(const Mesh& mesh) {
  std::vector<std::int64_t> all;
  for (const CellBlock& block : mesh.blocks)
    all.insert(all.end(), block.file_numbers.begin(), block.file_numbers.end());
  std::sort(all.begin(), all.end());
  return std::adjacent_find(all.begin(), all.end()) == all.end();
}

void number_through(Mesh& mesh) {
  std::int64_t next = 0;
  for (CellBlock& block : mesh.blocks)
    for (std::int64_t& number : block.file_numbers) number = ++next;
}

}  // namespace

std::string deck_text(const Mesh& given) {
  Mesh mesh = given;
  if (!numbers_are_unique(mesh)) number_through(mesh);
  const bool has_solids = std::any_of(mesh.blocks.begin(), mesh.blocks.end(),
                                      [](const CellBlock& block) { return dimension(block.type) == 3; });
  std::string text = "*NODE\n";
  for (std::size_t n = 0; n < mesh.node_count(); ++n) {
    const Vec3& x = mesh.coordinates[n];
    fmt::format_to(std::back_inserter(text), "{}, {}, {}, {}\n", mesh.node_numbers[n], x[0], x[1], x[2]);
  }
  for (const CellBlock& block : mesh.blocks)
    if (dimension(block.type) > 0) write_block(mesh, block, element_of(mesh, block.type, has_solids), text);
  std::vector<std::int64_t> numbers;
  for (const auto& [name, nodes] : mesh.node_groups) {
    numbers.clear();
    for (const Index n : nodes) numbers.push_back(mesh.node_numbers[at(n)]);
    text += fmt::format("*NSET, NSET={}\n", quoted(mesh, name));
    write_numbers(numbers, text);
  }
  for (const auto& [name, cells] : mesh.cell_groups) {
    numbers.clear();
    for (const CellRef& cell : cells) {
      const CellBlock& block = mesh.blocks[at(cell.block)];
      if (dimension(block.type) > 0) numbers.push_back(block.file_numbers[at(cell.cell)]);
    }
    if (numbers.empty()) continue;
    text += fmt::format("*ELSET, ELSET={}\n", quoted(mesh, name));
    write_numbers(numbers, text);
  }
  return text;
}

}  // namespace carom
