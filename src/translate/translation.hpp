// What the parts of a translation share.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "casefile/document.hpp"
#include "deck/deck_cursor.hpp"
#include "deck/statements.hpp"
#include "mesh/deck_mesh.hpp"
#include "translate/findings.hpp"
#include "translate/rigid_body.hpp"

namespace carom {

/// One *STEP: what it says stands between two indices of the statements.
struct DeckStep {
  enum class Kind : std::uint8_t { statics, implicit_dynamics, explicit_dynamics };
  Kind kind{};
  const DeckKeyword* step = nullptr;
  const DeckKeyword* procedure = nullptr;
  std::size_t begin = 0, end = 0;  ///< statements
  double start = 0.0, period = 1.0;
  std::optional<double> increment;
  std::optional<double> smallest;   ///< increment
  std::optional<double> mass_step;  ///< stable step that cells are made heavier for
  bool says_masses = false;         ///< by *FIXED or *VARIABLE MASS SCALING
  double alpha = -0.05;             ///< of implicit dynamics, where the deck gives no number
  bool is_finite = false;           ///< finite rotations
  bool ramps = false;               ///< loads without an amplitude grow with the time of the step

  double finish() const { return start + period; }
  /// CalculiX writes EXPLICIT=1; Abaqus' explicit program knows no value. It follows finite rotations unless told
  /// otherwise, has bulk viscosity, and takes overlaps away before the first step without straining the bodies.
  bool is_explicit_abaqus() const;
  /// Are temperatures computed?
  bool is_coupled() const;
  /// Does plastic work heat?
  bool heats() const;
};

/// The deck, what is known of it, and the tree that grows.
struct Translation {
  const Statements& statements;
  const DeckMesh& mesh;
  Findings& findings;
  CaseErrors& errors;  ///< what is wrong; the rest is translated all the same
  std::vector<DeckStep> steps;
  std::vector<DeckRigidBody> rigid_bodies;
  bool leaves_faces = false;  ///< faces of rigid bodies that look away from general contact
  Table root;
  std::vector<std::string> materials{};  ///< the NAMEs of all *MATERIAL of the deck

  const DeckScope& scope(const Statement& s) const { return statements.scopes[at(s.scope)]; }
  /// Is the body to be followed through finite rotations?
  bool is_finite() const;
  /// Is there a step in which plastic work heats?
  bool heats() const;
  /// Is there a step of Abaqus' explicit program?
  bool is_explicit_abaqus() const;
  /// The cells that parts are made of.
  std::set<CellRef> body_cells() const;
  /// Elements by their numbers, the first of many: "7, 8 and 2 more", with the instance of the first.
  std::string numbers_of(const std::vector<CellRef>& cells) const;
  /// Appends to the list `section` of the case.
  void append(const std::string& section, Node entry);
  /// Adds a member to the table `section` of the case.
  void define(const std::string& section, const std::string& name, Node entry);
  /// The node group of a set or node number; CaseError at the cursor.
  std::string node_group(const DeckCursor& at, const Statement& s, std::string_view text) const;
};

/// Each keyword and parameter that is not understood, as a note or a refusal.
void survey(Translation& t);
/// The steps of the deck in their order.
void find_steps(Translation& t);
/// [scheme], [time] and [[stage]].
void translate_steps(Translation& t);
/// [materials] and [[part]].
void translate_bodies(Translation& t);
/// [[support]], [[load]] and their functions.
void translate_actions(Translation& t);
/// [[rigid_body]], behind what acts.
void translate_rigid_parts(Translation& t);
/// [[contact]].
void translate_contacts(Translation& t);
/// [[equation]].
void translate_equations(Translation& t);
/// [[initial]], [[point_mass]], [[spring]].
void translate_discrete(Translation& t);
/// [[probe]].
void translate_probes(Translation& t);

}  // namespace carom
