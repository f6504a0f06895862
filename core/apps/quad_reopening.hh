#pragma once

#include <cstddef>

#include "apps/movable_quads.hh"

namespace layout_embedding {

struct ReopeningAttempt;

/// Which quads are bad, and how their neighbourhoods are placed anew.
struct ReopeningGoal {
    /// Those whose scaled Jacobian is not above this.
    double floor = 0;
    /// Only in ways that take little time.
    bool is_brief = false;
    /// That of quad_normal(): quads that stand on edge are seen from the surface, where they are
    /// flat, and not from their own normal.
    double least_cosine = 0;
    /// Ends once more vertices have been moved.
    std::size_t most_moves = 0;
};

/// Places neighbourhoods of bad quads anew, in one way after the other, from narrow ones to wide
/// ones, and keeps what leaves fewer bad ones; with a floor above 0 also what makes the worst one
/// better, and nothing that makes it worse.
class QuadReopening {
public:
    /// `quads` must outlive this.
    QuadReopening(MovableQuads& quads, const ReopeningGoal& goal) : quads_(quads), goal_(goal) {}

    /// Does so with the next bad quad; false once nothing is bad or no way is left.
    bool step();

private:
    bool is_bad(Index quad) const { return !(quads_.jacobian(quad) > goal_.floor); }
    bool reopen(Index quad, const ReopeningAttempt& attempt);
    Index inner_fixed_vertex(Index quad) const;
    void centre_on(Index centre, int rings);

    MovableQuads& quads_;
    ReopeningGoal goal_;
    std::size_t moves_ = 0;
    // The next quad, in which way, and whether this way has helped with one before it.
    Index quad_ = 0;
    std::size_t attempt_ = 0;
    bool has_helped_ = false;
};

}  // namespace layout_embedding
