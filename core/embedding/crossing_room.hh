#pragma once

#include <array>
#include <vector>

#include "embedding/normal_form.hh"
#include "embedding/wanted_angles.hh"

namespace layout_embedding {

/// The distances, as parameters, that crossings are to keep from their neighbours on an edge and
/// from its ends.
///
/// `spacing` of an edge, below 1, is divided equally among them; with spacing 1 nothing could move.
/// Where strands come straight from the vertex opposite to the edge, their gaps are at least so
/// wide that they leave it at the wanted angles to each other and to the edges there, as far as
/// there is room.
class CrossingGaps {
public:
    /// Equal ones for `angles` = nullptr. Keeps the pointer.
    explicit CrossingGaps(double spacing, const WantedAngles* angles = nullptr)
        : spacing_(spacing), angles_(angles)
    {}

    /// From the edge's tail to its first crossing, from there to the next, and so on to its head.
    /// O(crossings of the edge).
    void gather(const NormalForm& form, Index edge, std::vector<double>& gaps) const;

    /// Remembers the gaps of all edges for around(), for as long as no crossing comes or goes.
    /// O(elements).
    void prepare(const NormalForm& form);
    /// The gaps on either side of a crossing, towards the tail and the head of its edge. Equal ones
    /// need no preparation. O(1).
    std::array<double, 2> around(const NormalForm& form, Index crossing) const;

    /// Asks for a wider gap on one side of a crossing.
    void raise(Index crossing, bool towards_tail, double gap);

private:
    bool are_equal() const { return angles_ == nullptr && raised_.empty(); }

    double spacing_;
    const WantedAngles* angles_;
    std::vector<std::array<double, 2>> raised_;  // per element: towards tail and head
    std::vector<std::array<double, 2>> around_;  // likewise
};

/// The equal distance for `spacing` of an edge.
inline double gap_on_edge(const NormalForm& form, Index edge, double spacing)
{
    return spacing / (form.crossing_count(edge) + 1.0);
}

/// The part of its edge that a crossing may be on while all others stay where they are.
struct Room {
    double low;
    double high;
};

/// Neighbours keep the gaps on either side of the crossing; where there is no room for that, the
/// crossing has only one place between them. From a crossing of its own strand, which may move at
/// the same time, it keeps half of the room.
Room room_of(const NormalForm& form, Index crossing, double low_gap, double high_gap);

/// Moves the crossings of every edge apart until they keep their gaps: to the nearest such places
/// by the sum of squares. O(elements).
void keep_gaps(NormalForm& form, const CrossingGaps& gaps);

}  // namespace layout_embedding
