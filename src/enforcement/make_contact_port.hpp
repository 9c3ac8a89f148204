// Chooses the way in which contact is enforced in implicit steps.
#pragma once

#include <memory>

#include "enforcement/contact_port.hpp"

namespace carom {

/// The port of settings.enforcement.
std::unique_ptr<ContactPort> make_contact_port(const System& system, const ImplicitSettings& settings);

}  // namespace carom
