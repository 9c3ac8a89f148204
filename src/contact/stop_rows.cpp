#include "contact/contact_kind.hpp"
#include "math/vec3.hpp"

namespace carom {

namespace {

/// One row per node of a discrete stop, with measure 1, the same at every displacement.
class StopRows : public RowMaker {
 public:
  StopRows(const Model& model, const StopContact& contact, Index source)
      : X_(model.mesh->coordinates), contact_(contact), source_(source) {
    law_.eps_N = contact.stiffness;
    law_.damping = contact.damping;
    law_.damper_acts = contact.damper_acts;
  }
  std::size_t slots() const override { return contact_.nodes.size(); }
  void append_keys(SlotKeys& keys) const override {
    for (const Index n : contact_.nodes) keys.add({&n, 1});
    keys.meet({});
  }
  bool is_fixed() const override { return true; }
  void append(const ContactMotion& /*motion*/, Index first_slot, ConstraintRows& rows) const override {
    for (const Index n : contact_.nodes) {
      rows.add_row(contact_.gap, contact_.direction, X_[n], 1.0, law_, source_);
      rows.add_node(n, 1.0);
      rows.slot.back() = first_slot++;
    }
  }

 private:
  std::span<const Vec3> X_;
  StopContact contact_;
  RowLaw law_;
  Index source_;
};

std::size_t shared_nodes(const ContactDefinition& first, const ContactDefinition& second) {
  const auto &a = std::get<StopContact>(first), &b = std::get<StopContact>(second);
  return is_near(a.direction, b.direction) && a.gap == b.gap ? shared_numbers(a.nodes, b.nodes) : 0;
}

}  // namespace

ContactKind stop_contact_row() {
  return {.name = "stop",
          .rows = [](const Model& model, const ContactDefinition& contact, Index source,
                     std::vector<std::string>&) -> std::unique_ptr<RowMaker> {
            return std::make_unique<StopRows>(model, std::get<StopContact>(contact), source);
          },
          .shared = shared_nodes};
}

}  // namespace carom
