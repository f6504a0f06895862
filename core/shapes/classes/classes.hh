#pragma once

#include <vector>

#include "shapes/shape.hh"

namespace layout_embedding::shapes {

// One function per kind of shape, each in a file of its own.
ShapeClass hands();
ShapeClass cut_hands();

/// All of them, in the order of a gallery.
std::vector<ShapeClass> all_classes();

}  // namespace layout_embedding::shapes
