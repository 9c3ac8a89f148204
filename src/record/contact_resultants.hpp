// Resultants of contact: on the body of a contact's group, or between the parts that a surface in self-contact holds.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/model.hpp"
#include "rows/response.hpp"
#include "solid/cohesive_zones.hpp"

namespace carom {

/// Force, and its moment about a point (force x length), in the deformed configuration.
struct ContactResultant {
  Vec3 force{}, moment{};
};

/// What a resultant is of: a contact on the body of its group, or, where one surface touches itself, the part
/// parts.second acting on parts.first (positions in Model::parts, ascending).
struct ResultantPlace {
  std::string name;  ///< of the contact; "<contact>.<second>_on_<first>" of two parts
  std::size_t contact = 0;
  std::optional<std::pair<Index, Index>> parts{};
  bool is_ring = false;  ///< on axisymmetric parts
};

/// The resultants of all contacts. A contact of a surface with itself has one for each pair of parts of that surface
/// (none where the surface is of one part: action and reaction are both on it); every other contact has one.
/// The rows of axisymmetric parts carry the force on the whole circumference: force_x is then the sum of radial forces,
/// whose vectors cancel, and the moment is that of the axial force on the axis.
class ContactResultants {
 public:
  /// moment_points: one per contact. Where there is none, moments are about the centre of an obstacle that is led to
  /// turn, wherever it is, and else about the origin.
  ContactResultants(const Model& model, std::vector<std::optional<Vec3>> moment_points);

  /// Those of one contact follow each other, in the order of the contacts.
  const std::vector<ResultantPlace>& places() const { return places_; }
  /// One per place, at the displacement u.
  std::vector<ContactResultant> of(const ContactResponse& response, std::span<const double> u) const;
  /// Adds what ties that tear pass to the body of the group at displacement u, `history` being that of the points.
  void add_cohesive(const CohesiveZones& zones, std::span<const double> u, std::span<const double> history,
                    std::vector<ContactResultant>& to) const;

 private:
  void add_between_parts(const ContactResponse& response, std::size_t r, std::span<const double> u,
                         std::vector<ContactResultant>& out) const;
  void add(const ContactResponse& response, std::size_t r, std::size_t entry, double sign, std::size_t place,
           std::span<const double> u, ContactResultant& sum) const;
  std::size_t place_of(std::size_t contact, std::pair<Index, Index> parts) const;
  Index part_of_side(std::span<const Index> nodes) const;
  Index part_of_node(Index node, Index preferred) const;

  Vec3 moment_point(std::size_t contact, std::span<const double> u) const;

  const Model& model_;
  const Mesh& mesh_;
  std::vector<std::optional<Vec3>> moment_points_;
  std::vector<std::vector<Index>> parts_of_node_;  ///< ascending; of all nodes, empty without self-contact
  std::vector<ResultantPlace> places_;
  std::vector<std::size_t> first_place_;  ///< of each contact, and the number of all
};

}  // namespace carom
