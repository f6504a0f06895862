#include "shapes/classes/classes.hh"

namespace layout_embedding::shapes {

std::vector<ShapeClass> all_classes()
{
    return {quadrupeds(), hands(), people(),        birds(),   fish(),  octopuses(),
            planes(),     busts(), machine_parts(), vases(),   faces(), cut_hands(),
            cups(),       rings(), spectacles(),    pretzels()};
}

}  // namespace layout_embedding::shapes
