#include "casefile/contact_keys.hpp"

namespace carom {

namespace {

template <class Kind>
void add_method_and_law(SectionSchema<Kind>& s) {
  s.key_by(
      "method", [](auto& kind) -> auto& { return kind.method; },
      "Where the gap is measured: at the nodes of one side, of both, or over the overlaps of the faces. With faces "
      "pressure is exact across meshes that match or not, of first and second order, and what lies between nodes is "
      "seen: springs integrate the penetration from both sides, and hold corners and sharp edges by their nodes; the "
      "other enforcements hold mean gaps over the finer side, and nodes of both sides that have sunk in by a hundredth "
      "of a face. Both sides' nodes (two_pass) sink nowhere, and cost a quarter as much where surfaces slide on each "
      "other; surface_to_surface has the mean gaps of the group's side alone: a coarse curved face sinks in by part of "
      "its rise.",
      {.choices = {"node_to_surface", "two_pass", "surface_to_surface", "faces"},
       .default_phrase = "faces; two_pass with smooth = true"});
  s.key_by(
      "smooth", [](auto& kind) -> auto& { return kind.smooth; },
      "See facets of linear cells that approximate a smooth surface, whose normals turn by less than 30 degrees from "
      "one to the next, as that surface: the gap is that between the curved surfaces, and is integrated over them. "
      "For the methods faces and two_pass, and the penalty alone. Flat faces stay as they are. By default where no "
      "edge within "
      "the surfaces turns by more, as of balls; beside sharp edges implicit steps may make energy with true.",
      {.default_phrase = "where no edge is sharp, with method = \"faces\" or \"two_pass\" and penalty in every stage"});
  add_law(s);
  s.finish = [](Kind& given, const Node& node, const ReadContext& at) { check_law(given.law, node, at); };
}

}  // namespace

SectionSchema<CasePair> contact_keys(std::type_identity<CasePair>) {
  SectionSchema<CasePair> s("two deformable surfaces");
  add_group(s);
  s.key("master", &CasePair::master, "Group of faces, or of bars, of the other body; the coarser or stiffer one.",
        {.need = KeyOptions::Need::required});
  add_bar_radius(s);
  add_method_and_law(s);
  return s;
}

SectionSchema<CaseSelf> contact_keys(std::type_identity<CaseSelf>) {
  SectionSchema<CaseSelf> s("one surface with itself");
  add_group(s);
  add_bar_radius(s);
  add_method_and_law(s);
  return s;
}

SectionSchema<CaseAll> contact_keys(std::type_identity<CaseAll>) {
  SectionSchema<CaseAll> s("all exterior surfaces with each other");
  s.key("exclude", &CaseAll::exclude, "Groups whose faces take no part.");
  add_method_and_law(s);
  return s;
}

}  // namespace carom
