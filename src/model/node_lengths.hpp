// The cells at a node, as a length.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "model/model.hpp"

namespace carom {

/// Least length (cell_length of mesh/cell_size.hpp) of the parts' cells at each node, in the reference position;
/// infinity at nodes of none. Those that the model has, or else made.
std::shared_ptr<const std::vector<double>> node_lengths(const Model& model);

/// The least of them at some nodes; infinity for none.
double least_length(std::span<const double> node_lengths, std::span<const Index> nodes);

}  // namespace carom
