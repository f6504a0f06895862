#pragma once

#include <vector>

#include "shapes/collection_check.hh"
#include "shapes/shape.hh"

namespace layout_embedding::shapes {

/// Embeds the quad template of members (`templates`; empty: the first one of each class) in
/// themselves and in other members of their classes (CollectionCheckOptions::others), makes quad
/// meshes of the same connectivity, and, with CollectionCheckOptions::maps, maps the members onto
/// each other; prints a line for each member and pair. False if an embedding, a quad mesh or a map
/// is missing or not what it should be; each went through the checks of its own.
bool check_maps_of_collection(const std::vector<const ShapeClass*>& classes,
                              const std::vector<Index>& templates,
                              const CollectionCheckOptions& options);

}  // namespace layout_embedding::shapes
