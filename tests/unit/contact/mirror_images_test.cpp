// Planes of symmetry: which there are, and that the contact of a half or a quarter is that of the whole.
#include "contact/mirror_images.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "contact_rows_fixture.hpp"
#include "mesh/skin.hpp"

namespace carom::contact_mirror_images_test {
namespace {

using namespace test;

/// Boxes of HEXA8, each a part; those on the far side of a plane are left out.
struct Boxes {
  Model model;
  std::vector<std::vector<Facet>> skins;

  struct Box {
    Vec3 low, high;
    std::array<int, 3> cells;
  };

  /// cuts: how many of the planes x = 0 and y = 0 cut the boxes, whose nodes in them are held.
  Boxes(std::span<const Box> boxes, std::size_t cuts) {
    Mesh mesh;
    mesh.blocks.push_back({CellType::hexa8, {}, {}});
    for (const Box& box : boxes) add(mesh, box, cuts);
    model.mesh = std::make_shared<const Mesh>(mesh);
    skins.resize(boxes.size());
    for (const OuterFacet& outer : outer_facets(mesh))
      for (std::size_t b = 0; b < boxes.size(); ++b)
        if (std::ranges::count(model.parts[b].cells, outer.cell.cell) > 0) skins[b].push_back(outer.facet);
    for (std::size_t c = 0; c < cuts; ++c) hold(c, nodes_at(c, 0.0));
  }

  void hold(std::size_t component, const std::vector<Index>& nodes) {
    model.motions.push_back({"cut", nodes, static_cast<int>(component), MotionKind::velocity, {{0.0}, {0.0}}});
  }
  std::vector<Index> nodes_at(std::size_t component, double x) const {
    std::vector<Index> nodes;
    for (std::size_t n = 0; n < model.mesh->node_count(); ++n)
      if (model.mesh->coordinates[n][component] == x) nodes.push_back(static_cast<Index>(n));
    return nodes;
  }
  /// The first two boxes touch, or all of them as one surface.
  Model& touch(PairMethod method, bool as_one) {
    PairContact pair;
    pair.name = "touch";
    pair.method = method;
    pair.law.eps_N = 1.0;
    pair.self = as_one;
    for (const auto& skin : skins) pair.slave.facets.insert(pair.slave.facets.end(), skin.begin(), skin.end());
    if (!as_one) pair.slave.facets = skins[1];
    pair.master.facets = as_one ? pair.slave.facets : skins[0];
    model.contacts = {pair};
    leave_out_cuts(model);
    return model;
  }

 private:
  void add(Mesh& mesh, const Box& box, std::size_t cuts) {
    std::map<std::array<int, 3>, Index> number;
    const auto at = [&](const std::array<int, 3>& i) {
      Vec3 x{};
      for (std::size_t c = 0; c < 3; ++c) x[c] = box.low[c] + (box.high[c] - box.low[c]) * i[c] / box.cells[c];
      return x;
    };
    const auto node = [&](const std::array<int, 3>& i) {
      const auto [entry, is_new] = number.try_emplace(i, static_cast<Index>(mesh.coordinates.size()));
      if (is_new) {
        mesh.coordinates.push_back(at(i));
        mesh.node_numbers.push_back(static_cast<std::int64_t>(mesh.coordinates.size()));
      }
      return entry->second;
    };
    CellBlock& block = mesh.blocks.front();
    Part part;
    for (int i = 0; i < box.cells[0]; ++i)
      for (int j = 0; j < box.cells[1]; ++j)
        for (int k = 0; k < box.cells[2]; ++k) {
          const Vec3 low = at({i, j, k});
          bool is_beyond = false;
          for (std::size_t c = 0; c < cuts; ++c) is_beyond = is_beyond || low[c] < 0.0;
          if (is_beyond) continue;
          part.cells.push_back(static_cast<Index>(block.size()));
          block.file_numbers.push_back(static_cast<std::int64_t>(block.size()) + 1);
          for (const auto& [a, b, c] :
               {std::array{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}})
            block.connectivity.push_back(node({i + a, j + b, k + c}));
        }
    model.parts.push_back(part);
  }
};

/// The upper one dips into the lower one by 0.05 and stands over its sides along y.
constexpr std::array<Boxes::Box, 2> lower_and_upper{Boxes::Box{{-1, -0.5, 0}, {1, 0.5, 1}, {4, 4, 2}},
                                                    Boxes::Box{{-0.6, -1, 0.95}, {0.6, 1, 1.6}, {4, 6, 2}}};

/// A displacement that is symmetric about both planes.
std::vector<double> symmetric(const Mesh& mesh) {
  std::vector<double> u;
  for (const Vec3& x : mesh.coordinates) {
    const double a = std::sin(7.0 * x[0] * x[0] + 3.0 * x[2]), b = std::cos(5.0 * x[1] * x[1] - 2.0 * x[2]);
    u.insert(u.end(), {0.02 * a * x[0], 0.03 * b * x[1], 0.02 * a * b});
  }
  return u;
}

// Of k planes, the energy is 1 / 2^k of the whole's, and so are the forces on nodes in k of them. To the round-off of
// sums in another order.
TEST(MirrorImages, GiveTheContactOfTheWhole) {
  for (const PairMethod method : {PairMethod::two_pass, PairMethod::node_to_surface, PairMethod::faces}) {
    for (const bool as_one : {false, true}) {
      Boxes whole(lower_and_upper, 0);
      const ContactGeometry of_whole(whole.touch(method, as_one));
      const std::vector<double> u = symmetric(*whole.model.mesh), f = forces(of_whole, u);
      std::map<Vec3, std::size_t> node_at;
      for (std::size_t n = 0; n < whole.model.mesh->node_count(); ++n) node_at[whole.model.mesh->coordinates[n]] = n;
      for (const std::size_t cuts : {1U, 2U}) {
        Boxes cut(lower_and_upper, cuts);
        const ContactGeometry of_cut(cut.touch(method, as_one));
        const std::vector<double> u_cut = symmetric(*cut.model.mesh), f_cut = forces(of_cut, u_cut);
        const double expected = std::ldexp(energy(of_whole, u), -static_cast<int>(cuts));
        ASSERT_GT(expected, 0.0);
        EXPECT_NEAR(energy(of_cut, u_cut), expected, 1e-13 * expected) << static_cast<int>(method) << as_one << cuts;
        for (std::size_t n = 0; n < cut.model.mesh->node_count(); ++n) {
          const Vec3& x = cut.model.mesh->coordinates[n];
          double share = 1.0;
          for (std::size_t c = 0; c < cuts; ++c) share *= x[c] == 0.0 ? 0.5 : 1.0;
          for (std::size_t c = 0; c < 3; ++c) {
            if (c < cuts && x[c] == 0.0) continue;  // held
            EXPECT_NEAR(f_cut[3 * n + c], share * f[3 * node_at.at(x) + c], 1e-15)
                << x[0] << " " << x[1] << " " << x[2];
          }
        }
      }
    }
  }
}

// Planes where both boxes end and all nodes are held across, and nothing is beyond.
TEST(MirrorImages, AreThoseAtPlanesOfSymmetry) {
  const auto planes = [](Boxes& boxes) { return symmetry_planes(boxes.touch(PairMethod::two_pass, false)); };
  Boxes quarter(lower_and_upper, 2);
  const std::vector<SymmetryPlane> found = planes(quarter);
  ASSERT_EQ(found.size(), 2U);
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_EQ(found[c].component, c);
    EXPECT_EQ(found[c].position, 0.0);
    EXPECT_FALSE(found[c].is_high);
  }
  Boxes whole(lower_and_upper, 0);
  EXPECT_TRUE(planes(whole).empty());
}

TEST(MirrorImages, AreNoneWhereNodesAreHeldOtherwise) {
  const auto is_plane = [](auto&& hold) {
    Boxes half(lower_and_upper, 1);
    half.model.motions.clear();
    hold(half, half.nodes_at(0, 0.0));
    return symmetry_planes(half.touch(PairMethod::two_pass, false)).size() == 1;
  };
  EXPECT_TRUE(is_plane([](Boxes& half, const std::vector<Index>& in) { half.hold(0, in); }));
  EXPECT_FALSE(is_plane([](Boxes& half, std::vector<Index> in) {  // one is free
    in.pop_back();
    half.hold(0, in);
  }));
  EXPECT_FALSE(is_plane([](Boxes& half, const std::vector<Index>& in) {  // clamped
    for (std::size_t c = 0; c < 3; ++c) half.hold(c, in);
  }));
  EXPECT_FALSE(is_plane([](Boxes& half, const std::vector<Index>& in) {  // moved
    half.hold(0, in);
    half.model.motions.back().function.value = {1.0};
  }));
  EXPECT_FALSE(is_plane([](Boxes& half, const std::vector<Index>& in) {  // as fast as at the start
    half.hold(0, in);
    half.model.motions.back().kind = MotionKind::acceleration;
  }));
  EXPECT_FALSE(is_plane([](Boxes& half, const std::vector<Index>& in) {  // cells may go
    half.hold(0, in);
    half.model.erosion.emplace_back();
  }));
}

// A box on its own beyond the plane, and a plane that the upper box does not reach.
TEST(MirrorImages, AreNoneWhereTheModelGoesOnOrOneBodyEndsAlone) {
  const std::array<Boxes::Box, 3> with_third{lower_and_upper[0], lower_and_upper[1],
                                             Boxes::Box{{-9, 0, 0}, {-8, 1, 1}, {1, 1, 1}}};
  Boxes third(with_third, 0);
  third.hold(0, third.nodes_at(0, 0.0));
  EXPECT_TRUE(symmetry_planes(third.touch(PairMethod::two_pass, false)).empty());
  Boxes alone(lower_and_upper, 0);
  alone.hold(0, alone.nodes_at(0, -1.0));
  EXPECT_TRUE(symmetry_planes(alone.touch(PairMethod::two_pass, false)).empty());
}

}  // namespace
}  // namespace carom::contact_mirror_images_test
