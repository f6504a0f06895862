#include "surface/stretch.hh"

namespace layout_embedding {

bool stretch_crosses(const PathGraph& graph, const std::vector<Index>& a, Index i,
                     const std::vector<Index>& b, Index j)
{
    // The darts by which a walk leaves its inner node k, back to where it came from and on.
    const auto back = [&](const std::vector<Index>& walk, Index k) { return graph.twin(walk[k]); };
    const auto on = [](const std::vector<Index>& walk, Index k) { return walk[k + 1]; };
    const Index a_back = back(a, i);
    Index a_on = on(a, i);
    const Index b_back = back(b, j);
    const Index b_on = on(b, j);
    if (b_back == a_back || b_on == a_back) {
        return false;  // not where the stretch begins
    }
    if (b_back != a_on && b_on != a_on) {
        // They share this node only.
        return is_before(a_back, b_back, a_on) != is_before(a_back, b_on, a_on);
    }
    const bool forward = b_on == a_on;
    const bool begins_right = is_before(a_back, forward ? b_back : b_on, a_on);
    for (;;) {
        if (i + 2 == a.size() || (forward ? j + 2 == b.size() : j == 0)) {
            return false;  // ends at a landmark
        }
        ++i;
        j = forward ? j + 1 : j - 1;
        a_on = on(a, i);
        const Index b_ahead = forward ? on(b, j) : back(b, j);
        if (b_ahead != a_on) {
            return begins_right != is_before(back(a, i), b_ahead, a_on);
        }
    }
}

}  // namespace layout_embedding
