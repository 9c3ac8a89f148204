#include "model/outer_facets.hpp"

namespace carom {

std::shared_ptr<const std::vector<OuterFacet>> outer_facets(const Model& model) {
  if (model.outer_facets) return model.outer_facets;
  return std::make_shared<const std::vector<OuterFacet>>(outer_facets(*model.mesh));
}

}  // namespace carom
