// The interface at which an explicit step meets contact: springs, impulses, or forward-increment multipliers.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "enforcement/contact_work.hpp"
#include "system/system.hpp"

namespace carom {

/// All that is known at the end of a step before contact has answered. From displacement u and velocity v the next step
/// goes on with v_next = v + weight a and u_next = u + h v_next.
struct ExplicitPoint {
  double h = 0.0, weight = 0.0;
  std::span<const double> u_begin, u, v;
  std::span<const double> a;  ///< holds the accelerations of the prescribed dofs
  ContactPast past;
};

/// The contact force at the end of an explicit step, and its books. Bonds hold exactly whatever else contact does
/// (BondedMass).
class ExplicitContact {
 public:
  virtual ~ExplicitContact() = default;
  /// Fills forces.rows and forces.contact; internal and external forces are there. Returns why no force was found, ""
  /// when one was.
  virtual std::string respond(const ExplicitPoint& at, Forces& forces) = 0;
  /// Fills all forces of a step of length h whose end is at end.q and has the velocity v. Returns what respond()
  /// returns.
  std::string evaluate(const System& system, const State& begin, double h, std::span<const double> v, State& end);
  /// Fills all forces of a state that a run begins with; shared: of the nodes that this rank holds, where ranks share
  /// them out. Throws std::runtime_error when contact finds none.
  void start(const System& system, double dt, double weight, State& state, const Holding* shared = nullptr);
  /// Says where the work of the contact forces over the step went, as ContactPort::work does; the caller fills `total`.
  virtual ContactWork work(const State& begin, const State& end) const = 0;
  /// True where it asks for nothing but nodes of contact, which all ranks hold (Solid::shared_nodes).
  virtual bool is_local() const { return false; }
};

/// Penalty springs: c = c(u, v).
std::unique_ptr<ExplicitContact> penalty_contact(const System& system);

/// CD-Lagrange (Fekak, Brun, Gravouil and Depale, Computational Mechanics 60, 2017): on rows with g(u) <= 0, with
/// U = G v_next and e Newton's coefficient of restitution,
///   0 <= U_n + e min(0, (G v)_n)  perpendicular to  r_n >= 0,   U_t in Coulomb's cone with r_t,
/// where r / weight is the contact force. Symplectic between impacts. Rows that have closed stay where they are: a
/// fixed row may keep a penetration of at most one step's motion, which nothing pushes out; rows that move do not come
/// to one (stopped_rows.hpp).
std::unique_ptr<ExplicitContact> impulse_contact(const System& system);

/// Forward-increment Lagrange multipliers (Carpenter, Taylor and Katona, Int. J. Numer. Methods Eng. 32, 1991):
///   0 <= g(u_next)  perpendicular to  lambda_n >= 0,   slip increments h G_t v_next in Coulomb's cone with lambda_t,
/// the rows being those at u. The gap is closed exactly (to first order where rows move).
std::unique_ptr<ExplicitContact> forward_increment_contact(const System& system);

}  // namespace carom
