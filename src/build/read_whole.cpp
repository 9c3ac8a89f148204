#include "build/read_whole.hpp"

#include <algorithm>

#include "build/build_mesh.hpp"
#include "build/group_names.hpp"
#include "build/simulation.hpp"

namespace carom {

namespace {

bool is_of_mesh(const CaseError& error) {
  return error.key().starts_with("mesh");
}

void look_at_groups(const Case& given, CaseErrors& errors) {
  if (std::any_of(errors.all().begin(), errors.all().end(), is_of_mesh)) return;
  errors.attempt([&] { check_group_names(given, written_mesh(given), errors); });
}

}  // namespace

ReadCase read_whole(const std::string& path, const std::vector<std::string>& accepted) {
  return read_case_or_deck(path, accepted, {look_at_groups, [](const Case& given) { const Simulation made(given); }});
}

}  // namespace carom
