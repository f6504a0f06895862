#pragma once

#include "embedding/normal_form.hh"

namespace layout_embedding {

/// The distance that neighbours on an edge, and crossings and the edge's ends, are to keep, as a
/// parameter: `spacing` of an edge is divided among the gaps between its crossings. With spacing 1
/// nothing could move.
inline double gap_on_edge(const NormalForm& form, Index edge, double spacing)
{
    return spacing / (form.crossing_count(edge) + 1.0);
}

/// The part of its edge that a crossing may be on while all others stay where they are.
struct Room {
    double low;
    double high;
};

/// Neighbours keep `gap`; where there is no room for that, a crossing has only the middle between
/// them. From a crossing of its own strand, which may move at the same time, it keeps half of the
/// room.
Room room_of(const NormalForm& form, Index crossing, double gap);

/// Moves the crossings of every edge apart until they keep their gaps: to the nearest such places
/// by the sum of squares. O(elements).
void keep_gaps(NormalForm& form, double spacing);

}  // namespace layout_embedding
