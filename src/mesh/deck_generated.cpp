#include "mesh/deck_generated.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "math/vec3.hpp"

namespace carom {

namespace {

constexpr std::int64_t highest = 2'000'000'000, most_of_a_line = 20'000'000;

/// A number, 1 where the field is empty.
std::int64_t one_or(DeckCursor& at, std::string_view what) {
  DeckCursor ahead = at;
  if (!ahead.field().empty()) return at.integer(what);
  at.field();
  return 1;
}

}  // namespace

void DeckGenerator::add_nodes(const Statement& s, std::int64_t offset, std::int64_t& largest) {
  if (s.keyword->has("LINE"))
    s.keyword->fail("LINE=" + s.keyword->required("LINE"), "nodes on straight lines",
                    "Write the nodes of curves with their coordinates, by *NODE.");
  std::vector<Index> members;
  for (DeckCursor at(*s.keyword); at.next_line();) {
    const std::int64_t first = at.integer("the number of the first node"), last = at.integer("that of the last node");
    const std::int64_t step = one_or(at, "the increment of the numbers");
    at.end_line("first node, last node and increment");
    if (step < 1 || first < 1 || last <= first || last > highest || (last - first) % step != 0 ||
        (last - first) / step > most_of_a_line)
      at.fail(fmt::format("{}, {}, {}", first, last, step),
              "first, last and an increment that leads from one to the other");
    const Index a = node_sets_.find(s.scope, first), b = node_sets_.find(s.scope, last);
    for (const auto& [node, number] : {std::pair{a, first}, {b, last}})
      if (node < 0)
        at.fail(fmt::format("node {}, which is not there", number), "two nodes of a *NODE before this line");
    const Vec3 from = mesh_.coordinates[carom::at(a)], to = mesh_.coordinates[carom::at(b)];
    members.insert(members.end(), {a, b});
    for (std::int64_t number = first + step; number < last; number += step) {
      const auto index = static_cast<Index>(mesh_.coordinates.size());
      if (!node_sets_.insert(s.scope, number, index))
        at.fail(fmt::format("node {} a second time", number), "every node once", "Renumber the nodes.");
      const double share = static_cast<double>(number - first) / static_cast<double>(last - first);
      mesh_.coordinates.push_back(add(scaled(from, 1.0 - share), scaled(to, share)));
      mesh_.node_numbers.push_back(offset + number);
      members.push_back(index);
    }
    largest = std::max(largest, offset + last);
  }
  if (s.keyword->has("NSET")) {
    std::vector<Index>& set = node_sets_.set(statements_.scopes[at(s.scope)].prefix + s.keyword->required("NSET"));
    set.insert(set.end(), members.begin(), members.end());
  }
}

DeckGenerator::Copies DeckGenerator::copies_of(DeckCursor& at, const char* what) {
  Copies copies{one_or(at, what), one_or(at, "the increment of the nodes"),
                one_or(at, "the increment of the elements")};
  if (copies.count < 1 || copies.count > most_of_a_line)
    at.fail(fmt::format("{} {}", copies.count, what), fmt::format("from 1 to {}", most_of_a_line));
  for (const std::int64_t increment : {copies.nodes, copies.elements})
    if (increment < -highest || increment > highest)
      at.fail(fmt::format("the increment {}", increment), fmt::format("from -{0} to {0}", highest));
  return copies;
}

void DeckGenerator::add_elements(const Statement& s, std::int64_t offset, std::int64_t& largest,
                                 std::vector<DeckCells>& read) {
  std::vector<Index> members;
  for (DeckCursor at(*s.keyword); at.next_line();) {
    const std::int64_t number = at.integer("the number of the element that is repeated");
    const Copies row = copies_of(at, "elements in a row"), layer = copies_of(at, "rows in a layer"),
                 body = copies_of(at, "layers");
    at.end_line("an element, and three times a count with the increments of nodes and elements");
    const Index found = element_sets_.find(s.scope, number);
    if (found < 0)
      at.fail(fmt::format("element {}, which is not there", number), "an element of an *ELEMENT before this line");
    const DeckElement master = elements_[carom::at(found)];
    if (master.type->kind != DeckElementType::Kind::cell)
      at.fail(fmt::format("element {} of type {}", number, master.type->name), "a cell");
    if (row.count * layer.count > most_of_a_line || row.count * layer.count * body.count > most_of_a_line)
      at.fail(fmt::format("{} x {} x {} elements", row.count, layer.count, body.count),
              fmt::format("at most {}", most_of_a_line));
    members.push_back(found);
    const CellBlock& block = mesh_.blocks[carom::at(master.cell.block)];
    const CellRef begin{master.cell.block, static_cast<Index>(block.size())};
    for (std::int64_t k = 0; k < body.count; ++k)
      for (std::int64_t j = 0; j < layer.count; ++j)
        for (std::int64_t i = 0; i < row.count; ++i) {
          if (i == 0 && j == 0 && k == 0) continue;
          const std::int64_t own = number + i * row.elements + j * layer.elements + k * body.elements;
          members.push_back(static_cast<Index>(elements_.size()));
          add_copy(at, s, master, own, i * row.nodes + j * layer.nodes + k * body.nodes, offset);
          largest = std::max(largest, offset + own);
        }
    read.push_back({s.keyword, s.scope, begin, static_cast<Index>(block.size())});
  }
  if (s.keyword->has("ELSET")) {
    std::vector<Index>& set = element_sets_.set(statements_.scopes[at(s.scope)].prefix + s.keyword->required("ELSET"));
    set.insert(set.end(), members.begin(), members.end());
  }
}

void DeckGenerator::add_copy(DeckCursor& at, const Statement& s, const DeckElement& master, std::int64_t number,
                             std::int64_t nodes, std::int64_t offset) {
  if (number < 1 || number > highest)
    at.fail(fmt::format("element {}", number), fmt::format("numbers from 1 to {}", highest));
  CellBlock& block = mesh_.blocks[carom::at(master.cell.block)];
  DeckElement copy{master.type, {master.cell.block, static_cast<Index>(block.size())}, {}, number};
  if (!element_sets_.insert(s.scope, number, static_cast<Index>(elements_.size())))
    at.fail(fmt::format("element {} a second time", number), "every element once", "Renumber the elements.");
  const std::vector<Index> of_master(block.nodes(master.cell.cell).begin(), block.nodes(master.cell.cell).end());
  for (const Index n : of_master) {
    const std::int64_t node = mesh_.node_numbers[carom::at(n)] - node_offset(s.scope) + nodes;
    const Index found = node_sets_.find(s.scope, node);
    if (found < 0)
      at.fail(fmt::format("node {} of element {}, which is not there", node, number), "nodes for all elements",
              "Are the increments of the nodes right?");
    block.connectivity.push_back(found);
  }
  block.file_numbers.push_back(offset + number);
  elements_.push_back(copy);
}

}  // namespace carom
