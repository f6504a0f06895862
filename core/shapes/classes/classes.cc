#include "shapes/classes/classes.hh"

namespace layout_embedding::shapes {

std::vector<ShapeClass> all_classes()
{
    return {quadrupeds(), hands(), people(), birds(), fish(), octopuses(), planes(), busts(), faces(), cut_hands()};
}

}  // namespace layout_embedding::shapes
