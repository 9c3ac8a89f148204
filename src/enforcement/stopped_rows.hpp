// Which rows impulses stop before they have closed.
#pragma once

#include "contact/contact_geometry.hpp"

namespace carom {

/// The published schemes act on closed rows only. An open row may therefore be penetrated at the end of the step, by as
/// much as it moves in one step, and stays so. On a fixed row it never becomes more. Where rows move, each row that
/// opens and closes again can leave its bodies deeper; so there an open row may close within the step, and no further:
///   0 <= U_n + g / h  perpendicular to  r_n >= 0
/// (Anitescu and Potra, Nonlinear Dynamics 14, 1997). Rows with restitution are left out, since that needs the whole
/// speed of approach.
inline bool is_stopped_before(const ContactGeometry& contact, const RowLaw& law) {
  return !contact.is_fixed() && law.restitution == 0.0;
}

}  // namespace carom
