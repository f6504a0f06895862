#pragma once

#include <vector>

#include "shapes/shape.hh"

namespace layout_embedding::shapes {

// Each in a file of its own, apart from pairs that differ in the cut alone.
ShapeClass quadrupeds();
ShapeClass hands();
ShapeClass people();
ShapeClass birds();
ShapeClass fish();
ShapeClass octopuses();
ShapeClass planes();
ShapeClass busts();
ShapeClass machine_parts();
ShapeClass vases();
ShapeClass faces();
ShapeClass cut_hands();
ShapeClass cups();
ShapeClass rings();
ShapeClass spectacles();
ShapeClass pretzels();

/// All of them, in the order of a gallery.
std::vector<ShapeClass> all_classes();

}  // namespace layout_embedding::shapes
