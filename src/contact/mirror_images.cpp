#include "contact/mirror_images.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <utility>

#include "contact/row_maker.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/skin.hpp"
#include "model/bodies.hpp"
#include "parallel/threads.hpp"

namespace carom {
namespace {

constexpr double in_plane = 1e-9;  // of the model's size: above the round-off of any writer

bool meets(const Vec3& x, const SymmetryPlane& plane) {
  return std::abs(x[plane.component] - plane.position) <= plane.tolerance;
}

/// A facet of which an edge, or the end of a segment, is in the plane, and that is not itself in it.
bool ends_at(const Facet& facet, const std::vector<bool>& is_in_plane) {
  const auto count =
      std::count_if(facet.begin(), facet.end(), [&](Index n) { return is_in_plane[static_cast<std::size_t>(n)]; });
  return facet.size > 1 && count >= (facet.size == 2 ? 1 : 2) && count < facet.size;
}

bool ends_at(const Surface& surface, const std::vector<bool>& is_in_plane) {
  return std::ranges::any_of(surface.facets, [&](const Facet& facet) { return ends_at(facet, is_in_plane); });
}

bool touches_at(const PairContact& pair, const std::vector<bool>& is_in_plane, const std::vector<Index>& bodies) {
  if (!pair.self) return ends_at(pair.slave, is_in_plane) && ends_at(pair.master, is_in_plane);
  std::set<Index> there;
  for (const Facet& facet : pair.slave.facets)
    if (ends_at(facet, is_in_plane)) there.insert(bodies[static_cast<std::size_t>(facet[0])]);
  return there.size() > 1;
}

/// The nodes of cells, and the box around them.
struct Extent {
  std::vector<bool> has_cell;
  Vec3 low{}, high{};
  double size = 0.0;
  bool turns = false;  ///< a model of revolution

  explicit Extent(const Model& model) : has_cell(model.mesh->node_count()) {
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    for (const Part& part : model.parts) {
      turns = turns || part.section == Section::axisymmetric;
      for (const Index cell : part.cells)
        for (const Index n : model.mesh->block(part.type)->nodes(cell)) has_cell[static_cast<std::size_t>(n)] = true;
    }
    for (std::size_t n = 0; n < has_cell.size(); ++n) {
      if (!has_cell[n]) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], model.mesh->coordinates[n][c]);
        high[c] = std::max(high[c], model.mesh->coordinates[n][c]);
      }
    }
    for (std::size_t c = 0; c < 3; ++c) size = std::max(size, high[c] - low[c]);
  }
  double tolerance() const { return in_plane * size; }
  bool is_flat(std::size_t c) const { return high[c] - low[c] <= tolerance(); }
};

/// All nodes in the plane are held across it, and one at least may move in it.
bool is_symmetry(const Model& model, const Extent& extent, const std::vector<std::array<bool, 3>>& held,
                 const SymmetryPlane& plane) {
  bool moves = false;
  for (std::size_t n = 0; n < held.size(); ++n) {
    if (!extent.has_cell[n] || !meets(model.mesh->coordinates[n], plane)) continue;
    if (!held[n][plane.component]) return false;
    for (std::size_t c = 0; c < 3; ++c) moves = moves || (c != plane.component && !extent.is_flat(c) && !held[n][c]);
  }
  return moves;
}

std::vector<bool> nodes_in(const Model& model, const SymmetryPlane& plane) {
  std::vector<bool> in;
  for (const Vec3& x : model.mesh->coordinates) in.push_back(meets(x, plane));
  return in;
}

Facet reflected(Facet facet) {
  std::reverse(facet.node.begin() + (facet.size == 2 ? 0 : 1), facet.node.begin() + facet.size);
  return facet;
}

bool is_odd(unsigned planes) {
  bool odd = false;
  for (; planes != 0; planes &= planes - 1) odd = !odd;
  return odd;
}

}  // namespace

std::vector<std::array<bool, 3>> held_nodes(const Model& model) {
  std::vector<std::array<bool, 3>> held(model.mesh->node_count());
  for (const PrescribedMotion& motion : model.motions) {
    const bool says_where = motion.kind == MotionKind::displacement || motion.kind == MotionKind::velocity;
    const bool rests = says_where && !motion.function.called && is_zero(motion.function.value);
    if (!rests) continue;
    for (const Index n : motion.nodes)
      held[static_cast<std::size_t>(n)][static_cast<std::size_t>(motion.component)] = true;
  }
  return held;
}

std::vector<SymmetryPlane> symmetry_planes(const Model& model) {
  std::vector<const PairContact*> pairs;
  for (const ContactDefinition& contact : model.contacts)
    if (MirrorImages::has_images(contact)) pairs.push_back(&std::get<PairContact>(contact));
  const bool may_change = !model.erosion.empty() || model.is_eroded || !model.rigid_bodies.empty() ||
                          !model.turning_bodies.empty() || !model.embedding.empty();
  if (pairs.empty() || model.motions.empty() || may_change) return {};
  const Extent extent(model);
  const std::vector<std::array<bool, 3>> held = held_nodes(model);
  const std::vector<Index> bodies = bodies_of_nodes(model);
  std::vector<SymmetryPlane> planes;
  for (std::size_t c = extent.turns ? 1 : 0; c < 3; ++c) {
    if (extent.is_flat(c)) continue;
    std::vector<SymmetryPlane> of_component;
    for (const SymmetryPlane& plane : {SymmetryPlane{c, extent.low[c], false, extent.tolerance()},
                                       SymmetryPlane{c, extent.high[c], true, extent.tolerance()}})
      if (is_symmetry(model, extent, held, plane)) of_component.push_back(plane);
    if (of_component.size() != 1) continue;
    const std::vector<bool> in = nodes_in(model, of_component[0]);
    if (std::ranges::any_of(pairs, [&](const PairContact* pair) { return touches_at(*pair, in, bodies); }))
      planes.push_back(of_component[0]);
  }
  return planes;
}

void leave_out_cuts(Model& model) {
  for (const SymmetryPlane& plane : symmetry_planes(model)) {
    const std::vector<bool> in = nodes_in(model, plane);
    const auto is_cut = [&](const Facet& facet) {
      return std::all_of(facet.begin(), facet.end(), [&](Index n) { return in[static_cast<std::size_t>(n)]; });
    };
    for (ContactDefinition& contact : model.contacts) {
      if (!MirrorImages::has_images(contact)) continue;
      auto& pair = std::get<PairContact>(contact);
      for (Surface* surface : {&pair.slave, &pair.master})
        if (!std::ranges::all_of(surface->facets, is_cut)) std::erase_if(surface->facets, is_cut);
    }
  }
}

bool MirrorImages::has_images(const ContactDefinition& contact) {
  const auto* pair = std::get_if<PairContact>(&contact);
  const auto is_of_facets = [](const Surface& surface) {
    return !surface.facets.empty() && surface.facets.front().size > 1;
  };
  return pair != nullptr && pair->slave_bars.empty() && pair->master_bars.empty() && is_of_facets(pair->slave) &&
         (pair->self || is_of_facets(pair->master));
}

MirrorImages::MirrorImages(const Model& model) : model_(model), planes_(symmetry_planes(model)) {
  if (empty()) return;
  in_.assign(model.mesh->node_count(), 0);
  for (std::size_t p = 0; p < planes_.size(); ++p) {
    share_of_all_ *= 0.5;
    for (std::size_t n = 0; n < in_.size(); ++n)
      if (meets(model.mesh->coordinates[n], planes_[p])) in_[n] |= static_cast<Planes>(1U << p);
  }
  std::vector<bool> is_on_surface(in_.size());
  for (const ContactDefinition& contact : model.contacts) {
    if (!has_images(contact)) continue;
    const auto& pair = std::get<PairContact>(contact);
    for (const Surface* surface : {&pair.slave, &pair.master})
      for (const Facet& facet : surface->facets)
        for (const Index n : facet) is_on_surface[static_cast<std::size_t>(n)] = true;
  }
  whole_ = model;
  auto mesh = std::make_shared<Mesh>(*model.mesh);
  add_images(*mesh, is_on_surface);
  whole_.mesh = std::move(mesh);
  whole_.outer_facets = std::make_shared<const std::vector<OuterFacet>>(outer_facets(*whole_.mesh));
  whole_.node_lengths = nullptr;
  for (ContactDefinition& contact : whole_.contacts) {
    if (!has_images(contact)) continue;
    auto& pair = std::get<PairContact>(contact);
    pair.slave = with_images(pair.slave);
    pair.master = pair.self ? pair.slave : with_images(pair.master);
  }
}

std::string MirrorImages::note() const {
  std::vector<std::string> planes;
  for (const SymmetryPlane& plane : planes_)
    planes.push_back(fmt::format("{} = {:.6g}", "xyz"[plane.component], plane.position));
  return fmt::format("contact sees the images of the bodies beyond {}, where {} held as in a plane of symmetry",
                     fmt::join(planes, " and "), planes.size() == 1 ? "their nodes are" : "the nodes of each are");
}

Index MirrorImages::image(Index node, Planes planes) const {
  const auto n = static_cast<std::size_t>(node);
  const auto by = static_cast<std::size_t>(planes & ~in_[n]);
  return by == 0 ? node : image_of_[by][n];
}

/// Of the cells at the surfaces alone, which give all that rows ask for: skin, sharp edges, how bodies hang together.
void MirrorImages::add_images(Mesh& mesh, const std::vector<bool>& is_on_surface) {
  const auto is_asked_for = [&](Index n) { return is_on_surface[static_cast<std::size_t>(n)]; };
  std::vector<std::vector<Index>> cells;  // by part
  std::vector<bool> has_image(in_.size());
  for (const Part& part : model_.parts) {
    std::vector<Index>& of_part = cells.emplace_back();
    for (const Index cell : part.cells) {
      const std::span<const Index> nodes = model_.mesh->block(part.type)->nodes(cell);
      if (std::ranges::none_of(nodes, is_asked_for)) continue;
      of_part.push_back(cell);
      for (const Index n : nodes) has_image[static_cast<std::size_t>(n)] = true;
    }
  }
  add_nodes(mesh, has_image);
  for (std::size_t k = 0; k < cells.size(); ++k) add_cells(mesh, k, cells[k]);
}

void MirrorImages::add_nodes(Mesh& mesh, const std::vector<bool>& has_image) {
  const std::size_t subsets = std::size_t{1} << planes_.size();
  image_of_.assign(subsets, std::vector<Index>(in_.size(), -1));
  for (std::size_t by = 1; by < subsets; ++by) {
    for (std::size_t n = 0; n < in_.size(); ++n) {
      if (!has_image[n] || (in_[n] & by) != 0) continue;
      Vec3 x = mesh.coordinates[n];
      for (std::size_t p = 0; p < planes_.size(); ++p)
        if (((by >> p) & 1U) != 0) x[planes_[p].component] = 2.0 * planes_[p].position - x[planes_[p].component];
      image_of_[by][n] = static_cast<Index>(mesh.coordinates.size());
      mesh.coordinates.push_back(x);
      mesh.node_numbers.push_back(mesh.node_numbers[n]);
      of_.push_back(static_cast<Index>(n));
      by_.push_back(static_cast<Planes>(by));
    }
  }
}

void MirrorImages::add_cells(Mesh& mesh, std::size_t part, std::span<const Index> cells) {
  const CellType type = model_.parts[part].type;
  const CellBlock& from = *model_.mesh->block(type);
  CellBlock& to = *std::ranges::find(mesh.blocks, type, &CellBlock::type);
  const std::span<const LocalNode> order = mirrored_order(type);
  for (std::size_t by = 1; by < image_of_.size(); ++by) {
    const bool is_turned = is_odd(static_cast<unsigned>(by)) && !order.empty();  // bars have no order
    for (const Index cell : cells) {
      const std::span<const Index> nodes = from.nodes(cell);
      whole_.parts[part].cells.push_back(static_cast<Index>(to.size()));
      for (std::size_t a = 0; a < nodes.size(); ++a)
        to.connectivity.push_back(image(nodes[is_turned ? order[a] : a], static_cast<Planes>(by)));
      to.file_numbers.push_back(from.file_numbers[static_cast<std::size_t>(cell)]);
    }
  }
}

Surface MirrorImages::with_images(const Surface& surface) const {
  Surface all = surface;
  for (std::size_t by = 1; by < image_of_.size(); ++by)
    for (Facet facet : surface.facets) {
      for (int a = 0; a < facet.size; ++a)
        facet.node[static_cast<std::size_t>(a)] = image(facet[static_cast<std::size_t>(a)], static_cast<Planes>(by));
      all.facets.push_back(is_odd(static_cast<unsigned>(by)) ? reflected(facet) : facet);
    }
  return all;
}

void MirrorImages::spread(std::vector<double>& values) const {
  if (empty()) return;
  values.resize(3 * (in_.size() + of_.size()));
  parallel_each(of_.size(), [&](std::size_t i) {
    const auto from = 3 * static_cast<std::size_t>(of_[i]), to = 3 * (in_.size() + i);
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(from), 3,
                values.begin() + static_cast<std::ptrdiff_t>(to));
    for (std::size_t p = 0; p < planes_.size(); ++p)
      if (((by_[i] >> p) & 1U) != 0) values[to + planes_[p].component] *= -1.0;
  });
}

double MirrorImages::share(const NodeKey& nodes, const Vec3& x) const {
  const bool is_edge = std::ranges::count_if(nodes, [](Index n) { return n >= 0; }) == 2;
  const auto n = static_cast<std::size_t>(nodes.back());  // the only one, else
  if (!is_edge && n >= in_.size()) return 0.0;
  double share = 1.0;
  for (std::size_t p = 0; p < planes_.size(); ++p) {
    const double beyond = planes_[p].is_high ? x[planes_[p].component] - planes_[p].position
                                             : planes_[p].position - x[planes_[p].component];
    if (is_edge && beyond > planes_[p].tolerance) return 0.0;
    if (is_edge ? beyond > -planes_[p].tolerance : ((in_[n] >> p) & 1U) != 0) share *= 0.5;
  }
  return share;
}

void MirrorImages::fold(const ConstraintRows& seen, std::size_t r, double share, ConstraintRows& rows) const {
  if (share == 0.0) return;
  append_row(rows, seen, r);
  rows.measure.back() *= share;
  RowLaw& law = rows.law.back();
  law.eps_N *= share;
  law.own.measure *= share;
  law.eps_T *= share;
  law.damping *= share;
  const auto first = static_cast<std::size_t>(rows.begin[rows.size() - 1]);
  const std::size_t count = rows.node.size() - first,
                    of_own_side = count - static_cast<std::size_t>(rows.behind.back());
  std::size_t kept = first;
  for (std::size_t k = first; k < first + count; ++k) {
    Index node = rows.node[k];
    RowBlock block = rows.block[k];
    if (const auto n = static_cast<std::size_t>(node); n >= in_.size()) {
      const std::size_t i = n - in_.size();
      node = of_[i];
      for (std::size_t p = 0; p < planes_.size(); ++p)
        if (((by_[i] >> p) & 1U) != 0)
          for (Vec3& direction : block) direction[planes_[p].component] *= -1.0;
    }
    const auto begin = rows.node.begin() + static_cast<std::ptrdiff_t>(first);
    const auto found = std::find(begin, rows.node.begin() + static_cast<std::ptrdiff_t>(kept), node);
    const auto to = static_cast<std::size_t>(found - rows.node.begin());
    if (to < kept) {
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t c = 0; c < 3; ++c) rows.block[to][i][c] += block[i][c];
      if (k - first >= of_own_side) --rows.behind.back();
    } else {
      rows.node[kept] = node;
      rows.block[kept] = block;
      ++kept;
    }
  }
  rows.node.resize(kept);
  rows.block.resize(kept);
  rows.begin.back() = static_cast<Index>(kept);
}

}  // namespace carom
