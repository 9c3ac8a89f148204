#include "contact/interface_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "contact/contact_kind.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"

namespace carom {
namespace {

/// The two faces of an interface cell: node lower[a] stands opposite to upper[a].
struct InterfaceFaces {
  std::array<Index, 4> lower, upper;
};

/// Opposite faces of a HEXA8 in local node numbers, the first one's right-hand normal pointing to the second.
constexpr std::array<std::array<std::array<int, 4>, 2>, 3> opposite_faces{{
    {{{0, 1, 2, 3}, {4, 5, 6, 7}}},
    {{{0, 3, 7, 4}, {1, 2, 6, 5}}},
    {{{0, 4, 5, 1}, {3, 7, 6, 2}}},
}};

std::optional<InterfaceFaces> coincident_faces(const Mesh& mesh, const Index* cell) {
  const auto x = [&](int local) { return mesh.coordinates[static_cast<std::size_t>(cell[local])]; };
  double size = 0.0;
  for (int a = 1; a < 8; ++a) size = std::max(size, norm(subtract(x(a), x(0))));
  for (const auto& pair : opposite_faces) {
    double distance = 0.0;
    for (std::size_t a = 0; a < 4; ++a) distance = std::max(distance, norm(subtract(x(pair[1][a]), x(pair[0][a]))));
    if (distance > 1e-6 * size) continue;  // relative to the cell: coordinates of meshes often come in single precision
    InterfaceFaces faces{};
    for (std::size_t a = 0; a < 4; ++a) {
      faces.lower[a] = cell[pair[0][a]];
      faces.upper[a] = cell[pair[1][a]];
    }
    return faces;
  }
  return std::nullopt;
}

/// One Gauss point of a QUAD4 face: shape functions, position, unit normal and area weight.
struct MidFacePoint {
  std::array<double, 4> N;
  Vec3 position;
  Vec3 normal;
  double area;
};

std::array<MidFacePoint, 4> face_points(const Mesh& mesh, const std::array<Index, 4>& nodes) {
  constexpr std::array<std::array<double, 2>, 4> corner{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  const double s = 1.0 / std::sqrt(3.0);
  std::array<MidFacePoint, 4> points{};
  for (std::size_t p = 0; p < 4; ++p) {
    const double xi = s * corner[p][0], eta = s * corner[p][1];
    Vec3 along_xi{}, along_eta{};
    for (std::size_t a = 0; a < 4; ++a) {
      const Vec3& x = mesh.coordinates[static_cast<std::size_t>(nodes[a])];
      points[p].N[a] = 0.25 * (1 + corner[a][0] * xi) * (1 + corner[a][1] * eta);
      for (std::size_t c = 0; c < 3; ++c) {
        points[p].position[c] += points[p].N[a] * x[c];
        along_xi[c] += 0.25 * corner[a][0] * (1 + corner[a][1] * eta) * x[c];
        along_eta[c] += 0.25 * corner[a][1] * (1 + corner[a][0] * xi) * x[c];
      }
    }
    const Vec3 n = cross(along_xi, along_eta);
    points[p].area = norm(n);
    points[p].normal = normalized(n);
  }
  return points;
}

/// Centroid of a solid cell of a part that holds all four nodes, if there is one.
class HexaCentroids {
 public:
  explicit HexaCentroids(const Model& model) : mesh_(*model.mesh) {
    const CellBlock* hexas = mesh_.block(CellType::hexa8);
    if (hexas == nullptr) return;
    connectivity_ = hexas->connectivity.data();
    for (const Part& part : model.parts) {
      for (const Index cell : part.cells) {
        for (int a = 0; a < 8; ++a) cells_of_[connectivity_[8 * cell + a]].push_back(cell);
      }
    }
  }

  std::optional<Vec3> centroid_at(const std::array<Index, 4>& nodes) const {
    const auto found = cells_of_.find(nodes[0]);
    if (found == cells_of_.end()) return std::nullopt;
    for (const Index cell : found->second) {
      const Index* first = connectivity_ + 8 * cell;
      const auto holds = [&](Index n) { return std::find(first, first + 8, n) != first + 8; };
      if (!std::all_of(nodes.begin(), nodes.end(), holds)) continue;
      Vec3 centre{};
      for (int a = 0; a < 8; ++a) {
        const Vec3& x = mesh_.coordinates[static_cast<std::size_t>(first[a])];
        for (std::size_t c = 0; c < 3; ++c) centre[c] += x[c] / 8;
      }
      return centre;
    }
    return std::nullopt;
  }

 private:
  const Mesh& mesh_;
  const Index* connectivity_ = nullptr;
  std::map<Index, std::vector<Index>> cells_of_;
};

/// Makes the face that a part holds the upper one, so that the forces of the rows are those on the body.
void put_part_above(const HexaCentroids& centroids, InterfaceFaces& faces) {
  if (!centroids.centroid_at(faces.upper) && centroids.centroid_at(faces.lower)) std::swap(faces.lower, faces.upper);
}

/// True when the part above says that the normal must be turned.
bool normal_is_inverted(const HexaCentroids& centroids, const InterfaceFaces& faces, const MidFacePoint& point) {
  const auto above = centroids.centroid_at(faces.upper);
  return above && dot(subtract(*above, point.position), point.normal) < 0;
}

void add_interface_cell(ConstraintRows& rows, const Mesh& mesh, const InterfaceFaces& faces, bool turn,
                        const ContactLaw& law, Index source) {
  for (const MidFacePoint& point : face_points(mesh, faces.lower)) {
    rows.add_row(0.0, turn ? scaled(point.normal, -1.0) : point.normal, point.position, point.area,
                 row_law(law, point.area), source);
    for (std::size_t a = 0; a < 4; ++a) rows.add_node(faces.upper[a], point.N[a]);
    for (std::size_t a = 0; a < 4; ++a) rows.add_node(faces.lower[a], -point.N[a]);
    rows.behind.back() = 4;
  }
}

}  // namespace

std::unique_ptr<RowMaker> interface_rows(const Model& model, const InterfaceContact& contact, Index source,
                                         std::vector<std::string>& notes) {
  const Mesh& mesh = *model.mesh;
  const CellBlock& hexas = *mesh.block(CellType::hexa8);
  const HexaCentroids centroids(model);
  ConstraintRows rows;
  std::size_t turned = 0;
  for (const Index cell : contact.cells) {
    auto faces = coincident_faces(mesh, hexas.connectivity.data() + 8 * static_cast<std::size_t>(cell));
    if (!faces) {
      throw std::invalid_argument(fmt::format(
          "contact \"{}\": cell {} is not of zero thickness; the two opposite faces of an interface cell coincide",
          contact.name, mesh.cell_label(hexas.file_numbers[static_cast<std::size_t>(cell)])));
    }
    put_part_above(centroids, *faces);
    const bool turn = normal_is_inverted(centroids, *faces, face_points(mesh, faces->lower)[0]);
    if (turn) ++turned;
    add_interface_cell(rows, mesh, *faces, turn, contact.law, source);
  }
  if (turned > 0) {
    notes.push_back(fmt::format("contact \"{}\": the normal of {} interface cell(s) was turned towards the part",
                                contact.name, turned));
  }
  return std::make_unique<FixedRows>(std::move(rows));
}

namespace {

/// The sides are told apart by softness, cell by cell: which face of an interface comes first means nothing.
StiffnessChoice interface_stiffness(const PartCells& cells, const ContactDefinition& definition) {
  const auto& contact = std::get<InterfaceContact>(definition);
  const CellBlock& hexas = *cells.model().mesh->block(CellType::hexa8);
  Side softer, stiffer;
  for (const Index cell : contact.cells) {
    const std::span<const Index> nodes = hexas.nodes(cell);
    std::vector<Backing> found;
    for (const CellFace& face : cell_faces(CellType::hexa8)) {
      Facet facet{{}, 4};
      for (std::size_t a = 0; a < 4; ++a) facet.node[a] = nodes[static_cast<std::size_t>(face.node[a])];
      if (const auto backing = cells.behind(facet)) found.push_back(*backing);
    }
    std::ranges::sort(found, {}, &Backing::stiffness);
    if (!found.empty()) softer.add(found.front());
    if (found.size() > 1) stiffer.add(found.back());
  }
  if (!(softer.measure > 0.0)) refuse_choice(contact.name);
  if (stiffer.measure > 0.0) return {{softer, stiffer}};
  return {{softer}};
}

}  // namespace

ContactKind interface_contact_row() {
  return {.name = "interface",
          .rows =
              [](const Model& model, const ContactDefinition& contact, Index source, std::vector<std::string>& notes) {
                return interface_rows(model, std::get<InterfaceContact>(contact), source, notes);
              },
          .stiffness = interface_stiffness,
          .shared = [](const ContactDefinition& a,
                       const ContactDefinition& b) { return shared_numbers(parts_of(a).cells, parts_of(b).cells); }};
}

}  // namespace carom
