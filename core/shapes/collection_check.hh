#pragma once

#include <vector>

#include "base/types.hh"
#include "shapes/shape.hh"

namespace layout_embedding::shapes {

struct CollectionCheckOptions {
    /// As in ShapeOptions.
    Index vertices = 2000;
    std::uint64_t seed = 0;
    /// Into how many other members of its class each member's template is embedded: the next ones
    /// in the order of the class. kNone for all.
    Index others = kNone;
    /// Also embed the mirror image of each template, and each template with two landmarks
    /// exchanged, and count what is said of them.
    bool doubts = false;
    /// check_maps_of_collection(): not quad meshes alone, maps as well.
    bool maps = false;
};

/// Embeds the template layout of every member of the given classes in other members, by the exact
/// method with its own limits and by the four heuristics, and prints a line for each: gap, CPU
/// seconds, and what the heuristics cost over the best embedding known. Every embedding is realised
/// in each path shape and goes through the checker. Then how many were embedded and proved, and on
/// how many a heuristic ended clearly above the best. False if an embedding is missing, or one of
/// its shapes.
bool check_collection(const std::vector<const ShapeClass*>& classes,
                      const CollectionCheckOptions& options);

}  // namespace layout_embedding::shapes
