// The sections $Nodes, $Elements and $Entities of both Gmsh formats. Stream is GmshText or GmshBinary.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "mesh/gmsh_mesh.hpp"
#include "mesh/gmsh_stream.hpp"

namespace carom {

/// Physical tags of each entity (dimension, tag), from $Entities of format 4.1.
using GmshEntities = std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::int64_t>>;

/// Format 2.2. The cursor stands after the section's name, and is left before its end.
template <class Stream>
void read_nodes_2(Stream& in, GmshMesh& mesh);
void read_elements_2(GmshText& in, GmshMesh& mesh);
void read_elements_2(GmshBinary& in, GmshMesh& mesh);

/// Format 4.1.
template <class Stream>
GmshEntities read_entities_4(Stream& in);
template <class Stream>
void read_nodes_4(Stream& in, GmshMesh& mesh);
template <class Stream>
void read_elements_4(Stream& in, const GmshEntities& entities, GmshMesh& mesh);

}  // namespace carom
