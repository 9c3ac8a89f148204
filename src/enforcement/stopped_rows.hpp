// Which rows impulses stop before they have closed.
#pragma once

#include "contact/contact_geometry.hpp"

namespace carom {

/// The published schemes act on rows that are closed: what is open may be behind after the next step, by its motion in
/// one step, and stays there. On a row that never moves it comes to no more than that. Where rows move, each that opens
/// and closes again can leave its bodies deeper; there an open row may close within the step and no more,
///   0 <= U_n + g / h  perpendicular to  r_n >= 0
/// (Anitescu and Potra, Nonlinear Dynamics 14, 1997). Not under restitution, which needs the speed of approach whole.
inline bool is_stopped_before(const ContactGeometry& contact, const RowLaw& law) {
  return !contact.is_fixed() && law.restitution == 0.0;
}

}  // namespace carom
