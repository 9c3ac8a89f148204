#include "march/penetration_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "mesh/cell_topology.hpp"
#include "model/node_lengths.hpp"
#include "rows/admissible.hpp"
#include "solid/cell_strain.hpp"

namespace carom {

namespace {

constexpr double least_depth = 0.05, most_depth = 0.25, share_of_shortening = 0.5;

std::span<const Index> nodes_of(const Mesh& mesh, const Part& part, Index cell) {
  const auto size = static_cast<std::size_t>(node_count(part.type));
  return std::span(mesh.block(part.type)->connectivity).subspan(size * static_cast<std::size_t>(cell), size);
}

}  // namespace

double PenetrationWatch::Place::limit() const {
  return std::clamp(share_of_shortening * shortening, least_depth, most_depth);
}

PenetrationWatch::PenetrationWatch(const Model& model)
    : model_(model),
      node_length_(node_lengths(model)),
      smallest_(*std::min_element(node_length_->begin(), node_length_->end())) {
  for (const ContactDefinition& contact : model.contacts)
    is_spring_.push_back(parts_of(contact).nature == ContactNature::springs ? 1 : 0);
}

/// The cells of parts at each node.
void PenetrationWatch::find_cells() {
  const auto each = [this](auto&& visit) {
    for (const Part& part : model_.parts)
      for (const Index cell : part.cells)
        for (const Index n : nodes_of(*model_.mesh, part, cell)) visit(static_cast<std::size_t>(n), part, cell);
  };
  begin_.assign(model_.mesh->node_count() + 1, 0);
  each([this](std::size_t n, const Part&, Index) { ++begin_[n + 1]; });
  for (std::size_t n = 1; n < begin_.size(); ++n) begin_[n] += begin_[n - 1];
  cells_.resize(begin_.back());
  std::vector<std::size_t> next = begin_;
  each([&](std::size_t n, const Part& part, Index cell) { cells_[next[n]++] = {&part, cell}; });
}

double PenetrationWatch::cell_at(const ConstraintRows& rows, std::size_t r) const {
  const auto first = static_cast<std::size_t>(rows.begin[r]), last = static_cast<std::size_t>(rows.begin[r + 1]);
  const double least = least_length(*node_length_, std::span(rows.node).subspan(first, last - first));
  return std::isfinite(least) ? least : smallest_;  // nodes of no part, which may be those of an interface
}

/// Of the cell that gives way by the greatest length.
double PenetrationWatch::shortening(const ConstraintRows& rows, std::size_t r, std::span<const double> u) {
  if (begin_.empty()) find_cells();
  double largest = 0.0;
  for (auto k = static_cast<std::size_t>(rows.begin[r]); k < static_cast<std::size_t>(rows.begin[r + 1]); ++k) {
    const auto n = static_cast<std::size_t>(rows.node[k]);
    for (std::size_t c = begin_[n]; c < begin_[n + 1]; ++c) {
      const auto& [part, cell] = cells_[c];
      largest = std::max(largest, cell_shortening(*model_.mesh, *part, cell, rows.normal[r], u));
    }
  }
  return largest;
}

void PenetrationWatch::look(const ContactResponse& response, std::span<const double> u) {
  const ConstraintRows& rows = *response.rows;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (response.status[r] == RowStatus::open || is_bond(rows.law[r])) continue;
    if (is_spring_[static_cast<std::size_t>(rows.source[r])] != 0) continue;
    const auto slot = static_cast<std::size_t>(rows.slot[r]);
    if (slot >= places_.size()) places_.resize(slot + 1);
    Place& place = places_[slot];
    const double length = cell_at(rows, r);
    place.depth = std::max(place.depth, -rows.gap_at(r, u) / length);
    if (place.depth > least_depth) place.shortening = std::max(place.shortening, shortening(rows, r, u) / length);
  }
}

VerdictItem PenetrationWatch::item() const {
  Place worst;
  for (const Place& place : places_)
    if (place.depth * worst.limit() > worst.depth * place.limit()) worst = place;
  return {
      "penetration", worst.depth, worst.limit(), worst.depth <= worst.limit(),
      "penetration relative to the smallest cell there, where it is worst; the limit is 5 %, or half of what the "
      "cells there are shortened by, but never more than a quarter: is the penalty stiff enough "
      "(contact.stiffness, contact.stiffness_factor), or the step short enough, where impulses stop velocities alone "
      "(time.safety, time.step)?"};
}

}  // namespace carom
