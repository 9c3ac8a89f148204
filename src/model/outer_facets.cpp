#include "model/outer_facets.hpp"

namespace carom {

std::shared_ptr<const std::vector<OuterFacet>> outer_facets(const Model& model) {
  if (model.outer_facets) return model.outer_facets;
  return std::make_shared<const std::vector<OuterFacet>>(outer_facets(*model.mesh));
}

std::vector<Facet> skin(const Model& model) {
  const auto all = outer_facets(model);
  std::vector<Facet> facets;
  for (const OuterFacet& outer : *all) facets.push_back(outer.facet);
  return facets;
}

}  // namespace carom
