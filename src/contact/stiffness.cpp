#include "contact/stiffness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <variant>

#include "base/types.hpp"
#include "contact/contact_kind.hpp"
#include "contact/mirror_images.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"
#include "model/node_lengths.hpp"
#include "model/outer_facets.hpp"
#include "model/wave_modulus.hpp"

namespace carom {

namespace {

/// The depth down to which springs that are chosen are linear; infinite where all bodies are of small strain.
class LinearDepth {
 public:
  explicit LinearDepth(const Model& model) : mesh_(*model.mesh) {
    const auto is_finite = [](const Part& part) { return part.material.law->measure != Measure::small_strain; };
    if (std::any_of(model.parts.begin(), model.parts.end(), is_finite)) length_ = node_lengths(model);
  }

  double operator()(const ContactDefinition& contact) const {
    if (!length_) return infinity;
    const ContactParts parts = parts_of(contact);
    double least = infinity;
    for (const Index cell : parts.cells) least = std::min(least, shortest(mesh_.block(CellType::hexa8)->nodes(cell)));
    for (const Surface* surface : {parts.own, parts.other})
      if (surface != nullptr) least = std::min(least, shortest(*surface));
    for (const std::span<const BarSide> bars : {parts.bars, parts.other_bars})
      for (const BarSide& bar : bars) least = std::min(least, shortest(bar.node));
    return share * std::min(least, shortest(parts.nodes));
  }

 private:
  static constexpr double share = 0.0075;

  double shortest(std::span<const Index> nodes) const { return least_length(*length_, nodes); }
  double shortest(const Surface& surface) const {
    double least = infinity;
    for (const Facet& facet : surface.facets) least = std::min(least, shortest({facet.begin(), facet.end()}));
    return least;
  }

  const Mesh& mesh_;
  std::shared_ptr<const std::vector<double>> length_;  ///< by node; null: not asked for
};

std::string sentence(const std::string& contact, double stiffness, const StiffnessChoice& choice, double factor) {
  std::string text = fmt::format("contact \"{}\": stiffness {:.4g} chosen", contact, stiffness);
  const char* join = " from";
  for (const Side& side : choice.sides) {
    text += fmt::format("{} modulus {:.4g} over cell height {:.4g}", join, side.mean_modulus(), side.mean_height());
    join = " and";
  }
  if (choice.node_measure != 1.0) text += fmt::format(", times {:.4g} {}", choice.node_measure, choice.per);
  if (factor != 1.0) text += fmt::format(", times the factor {:.4g}", factor);
  return text;
}

/// Chooses for the contacts of some natures, `stiffer` times as stiff as their cells are.
template <class Takes>
std::vector<std::string> choose(Model& model, double stiffer, const Takes& takes) {
  std::vector<std::string> notes;
  std::optional<PartCells> cells;  // made when first needed
  const LinearDepth linear_depth(model);
  const MirrorImages images(model);
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    ContactDefinition& contact = model.contacts[i];
    const ContactKind& kind = kind_of(contact);
    if (kind.stiffness == nullptr || !takes(parts_of(contact).nature)) continue;
    ContactLaw& law = *law_of(contact);
    if (!law.eps_N) {
      if (!cells) cells.emplace(images.whole());
      const StiffnessChoice choice = kind.stiffness(*cells, images.whole().contacts[i]);
      const double factor = stiffer * law.stiffness_factor;
      law.eps_N = factor * choice.stiffness();
      if (stiffer == 1.0) law.linear_depth = linear_depth(contact);
      notes.push_back(sentence(name_of(contact), *law.eps_N, choice, factor));
    }
    if (!law.eps_T && law.mu > 0.0) law.eps_T = law.eps_N;
  }
  return notes;
}

}  // namespace

std::vector<std::string> choose_tie_stiffness(Model& model) {
  constexpr double stiffer = 1000.0;
  return choose(model, stiffer, [](ContactNature nature) { return nature == ContactNature::bonds; });
}

std::vector<std::string> choose_cohesive_stiffness(Model& model) {
  constexpr double stiffer = 10.0, steepest = 5.0;
  std::vector<std::string> notes;
  std::optional<PartCells> cells;
  for (CohesiveZone& zone : model.cohesive) {
    CohesiveLaw& law = zone.law;
    if (law.stiffness > 0.0) continue;
    if (!cells) cells.emplace(model);
    const ContactDefinition& pair = model.contacts[zone.contact];
    const StiffnessChoice choice = kind_of(pair).stiffness(*cells, pair);
    const double factor = stiffer * zone.stiffness_factor;
    law.stiffness = factor * choice.stiffness();
    notes.push_back(sentence(zone.name, law.stiffness, choice, factor));
    const double least = steepest * std::max(law.normal_strength * law.normal_strength / law.normal_energy,
                                             law.shear_strength * law.shear_strength / law.shear_energy);
    if (law.stiffness >= least) continue;
    notes.push_back(fmt::format(
        "contact \"{}\": raised to {:.4g}, or its surfaces would not soften as its energy asks; the cells beside it "
        "are too large for its strength: finer ones, or a lower strength with the same energy, tear more smoothly",
        zone.name, least));
    law.stiffness = least;
  }
  return notes;
}

std::vector<std::string> choose_stiffness(Model& model) {
  return choose(model, 1.0, [](ContactNature nature) { return nature == ContactNature::touches; });
}

}  // namespace carom
