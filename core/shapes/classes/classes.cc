#include "shapes/classes/classes.hh"

namespace layout_embedding::shapes {

std::vector<ShapeClass> all_classes()
{
    return {hands(), cut_hands()};
}

}  // namespace layout_embedding::shapes
