#include "contact/equation_rows.hpp"

#include <utility>

#include "math/vec3.hpp"

namespace carom {

std::unique_ptr<RowMaker> equation_rows(const Model& model) {
  ConstraintRows rows;
  for (std::size_t k = 0; k < model.equations.size(); ++k) {
    const std::vector<LinearEquation::Term>& terms = model.equations[k].terms;
    const LinearEquation::Term& first = terms.front();
    RowLaw law;
    law.set = AdmissibleSet::equation;
    Vec3 axis{};
    axis[static_cast<std::size_t>(first.component)] = 1.0;
    rows.add_row(0.0, axis, model.mesh->coordinates[static_cast<std::size_t>(first.node)], 1.0, law,
                 static_cast<Index>(-1) - static_cast<Index>(k));
    rows.reach.back() = 0.0;  // it sees displacements, no places
    RowBlocks blocks;
    for (const LinearEquation::Term& term : terms) {
      Vec3 coefficient{};
      coefficient[static_cast<std::size_t>(term.component)] = term.coefficient / first.coefficient;
      blocks.add(term.node, coefficient, {}, {});
    }
    blocks.append_to(rows);
    rows.behind.back() = static_cast<Index>(blocks.size() - 1);
  }
  return std::make_unique<FixedRows>(std::move(rows));
}

}  // namespace carom
