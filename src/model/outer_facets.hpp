// The skin of a model's mesh.
#pragma once

#include <memory>
#include <vector>

#include "mesh/skin.hpp"
#include "model/model.hpp"

namespace carom {

/// outer_facets of the mesh: those that the model has, or else made.
std::shared_ptr<const std::vector<OuterFacet>> outer_facets(const Model& model);
/// These facets alone.
std::vector<Facet> skin(const Model& model);

}  // namespace carom
