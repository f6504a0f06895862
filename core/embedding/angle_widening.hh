#pragma once

#include <span>
#include <vector>

#include "embedding/crossing_room.hh"
#include "embedding/normal_form.hh"
#include "embedding/vertex_moves.hh"

namespace layout_embedding {

// What paths themselves leave of thin triangles: small angles between two strands or a strand and
// an edge at a vertex, and where a strand crosses an edge. Vertices added later
// (embedding/angle_refinement.hh) cannot make these larger.

/// Where more strands leave a vertex through the face than fit between its edges at the wanted
/// angles, the outermost ones are put on the other vertices of the face if these are free, so that
/// they leave along its edges; a strand that does so already goes on into the next face, if that
/// has room. Returns whether any was moved. O(elements * log).
bool relieve_fans(NormalForm& form, VertexMoves& moves, const WantedAngles& angles);

/// Moves crossings along their edges until strands make the wanted angles with edges and with each
/// other, as far as there is room between neighbours, which keep the gaps of `spacing`. A few
/// rounds; what makes the total longer than `most_length` is taken back. O(elements * rounds).
void widen_angles(NormalForm& form, const WantedAngles& angles, double spacing, double most_length);

/// Both, for a form as it is: crossings move only as far as angles and gaps ask for. The landmarks
/// are those of all strands; none leaves an edge of `edge_costs` below 1 (StraighteningOptions).
/// O(#F + elements * log).
void open_angles(NormalForm& form, const std::vector<Index>& landmarks, double spacing,
                 std::span<const double> edge_costs = {});

}  // namespace layout_embedding
