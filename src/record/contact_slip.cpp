#include "record/contact_slip.hpp"

#include <algorithm>
#include <utility>

namespace carom {

namespace {

bool asks_for_slip(const Simulation& simulation) {
  const Case& given = simulation.given();
  const auto is_it = [](const Located<std::string>& name) { return *name == "contact_slip"; };
  return !given.contacts.empty() && (std::ranges::any_of(given.output.fields, is_it) ||
                                     std::ranges::any_of(given.probes, [&](const CaseProbe& probe) {
                                       return std::ranges::any_of(probe.quantities, is_it);
                                     }));
}

}  // namespace

ContactSlip::ContactSlip(const Simulation& simulation) : is_wanted_(asks_for_slip(simulation)) {
  if (!is_wanted_) return;
  path_.resize(simulation.mesh().node_count());
  rate_.resize(path_.size());
}

void ContactSlip::sample(FieldsNow& now) {
  if (!is_wanted_) return;
  const NodalContact& contact = now.contact();
  std::vector<double> rate = contact.at_all(contact.slip_rate, path_.size());
  if (now.view.step > 0)
    for (std::size_t n = 0; n < path_.size(); ++n) path_[n] += 0.5 * now.view.dt * (rate_[n] + rate[n]);
  rate_ = std::move(rate);
}

}  // namespace carom
