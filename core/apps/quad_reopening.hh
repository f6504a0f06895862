#pragma once

#include <cstddef>

#include "apps/movable_quads.hh"

namespace layout_embedding {

struct ReopeningAttempt;

/// Places neighbourhoods of flipped quads anew, in one way after the other, from narrow ones to
/// wide ones, and keeps what leaves fewer flipped ones.
class QuadReopening {
public:
    /// Ends once more than `moves` vertices have been moved. `quads` must outlive this.
    QuadReopening(MovableQuads& quads, std::size_t moves) : quads_(quads), most_moves_(moves) {}

    /// Does so with the next flipped quad; false once nothing is flipped or no way is left.
    bool step();

private:
    bool reopen(Index quad, const ReopeningAttempt& attempt);
    Index inner_fixed_vertex(Index quad) const;
    void centre_on(Index centre, int rings);

    MovableQuads& quads_;
    std::size_t most_moves_;
    std::size_t moves_ = 0;
    // The next quad, in which way, and whether this way has helped with one before it.
    Index quad_ = 0;
    std::size_t attempt_ = 0;
    bool has_helped_ = false;
};

}  // namespace layout_embedding
