#include "embedding/checker_homotopy.hh"

#include <optional>

#include "embedding/checker_words.hh"

namespace layout_embedding::checker {

namespace {

/// Words for crossing the edges of the target, in a free basis of the fundamental group(oid) of the
/// target punctured at landmarks and holes.
///
/// A spanning tree of the dual graph makes a disk of all faces; crossing one of its edges gives the
/// empty word, and every other interior edge is a generator. Around each vertex that is no puncture
/// the letters multiply to 1. To solve these relations, take a spanning tree, rooted at a puncture,
/// of the graph of generator edges, each hole drawn together to one node, and let every such vertex
/// eliminate one tree edge at it:
/// - a vertex without a puncture in its subtree the edge to its parent (from the leaves upwards; on
///   a sphere all these words are empty),
/// - any other the edge to the child with the fewest punctures below (from the root downwards).
/// What is left is free, of rank 2 g + landmarks inside + holes - 1. Since the number of punctures
/// below at least halves with each eliminated child edge of a branching vertex, words stay short.
class CutSystem {
public:
    CutSystem(const Surface& target, const std::vector<bool>& is_landmark)
        : target_(target), is_landmark_(is_landmark)
    {
        words_.emplace_back();
        find_generators();
        span();
        count_punctures();
        eliminate_upwards();
        eliminate_downwards();
    }

    /// Multiplies `word` by the word of crossing the edge of h from its left to its right.
    void cross(Index h, Word& word) const
    {
        const std::int32_t id = edge_words_[target_.edge(h)];
        const bool inverted = (id < 0) != (target_.edge(h) != h);
        const Word& letters = words_[static_cast<std::size_t>(id < 0 ? -id : id)];
        if (inverted) {
            for (std::size_t i = letters.size(); i-- > 0;) {
                multiply(word, -letters[i]);
            }
        } else {
            multiply(word, letters);
        }
    }

private:
    Index node_count() const { return target_.vertex_count + target_.cap_count; }
    Index node(Index vertex) const
    {
        const Index face = target_.faces[target_.outgoing[vertex]];
        return target_.is_cap(face) ? target_.vertex_count + (face - target_.polygon_count)
                                    : vertex;
    }
    bool is_puncture(Index node) const
    {
        return node >= target_.vertex_count || is_landmark_[node];
    }
    bool is_tree_edge(Index h) const
    {
        return parents_[node(target_.tails[h])] == h ||
               parents_[node(target_.head(h))] == target_.twins[h];
    }

    /// Edges not crossed by a breadth-first spanning tree of the faces.
    void find_generators()
    {
        generator_.assign(target_.corner_count, false);
        for (Index h = 0; h < target_.corner_count; ++h) {
            generator_[h] = target_.twins[h] < target_.corner_count;
        }
        std::vector<bool> reached(target_.polygon_count, false);
        std::vector<Index> queue{0};
        queue.reserve(target_.polygon_count);
        reached[0] = true;
        for (std::size_t i = 0; i < queue.size(); ++i) {
            for (Index h = 3 * queue[i]; h < 3 * queue[i] + 3; ++h) {
                const Index face = target_.faces[target_.twins[h]];
                if (!target_.is_cap(face) && !reached[face]) {
                    reached[face] = true;
                    queue.push_back(face);
                    generator_[h] = false;
                    generator_[target_.twins[h]] = false;
                }
            }
        }
    }
    bool is_generator(Index h) const { return h < target_.corner_count && generator_[h]; }

    /// Calls visit(h) for every generator halfedge that leaves the node, clockwise at a vertex.
    template <typename Visit>
    void for_each_generator(Index node, const Visit& visit) const
    {
        const auto around = [&](Index vertex) {
            const Index start = target_.outgoing[vertex];
            Index h = start;
            do {
                if (is_generator(h)) {
                    visit(h);
                }
                h = target_.clockwise(h);
            } while (h != start);
        };
        if (node < target_.vertex_count) {
            around(node);
            return;
        }
        const Index start =
            target_.face_halfedges[target_.polygon_count + (node - target_.vertex_count)];
        Index h = start;
        do {
            around(target_.tails[h]);
            h = target_.nexts[h];
        } while (h != start);
    }

    /// Breadth-first spanning tree of the nodes along generator edges.
    void span()
    {
        parents_.assign(node_count(), kNone);
        Index root = kNone;
        for (Index n = 0; n < node_count() && root == kNone; ++n) {
            // The places of boundary vertices are no nodes.
            if (is_puncture(n) && (n >= target_.vertex_count || node(n) == n)) {
                root = n;
            }
        }
        if (root == kNone) {
            return;
        }
        order_.push_back(root);
        for (std::size_t i = 0; i < order_.size(); ++i) {
            for_each_generator(order_[i], [&](Index h) {
                const Index child = node(target_.head(h));
                if (child != root && parents_[child] == kNone) {
                    parents_[child] = target_.twins[h];
                    order_.push_back(child);
                }
            });
        }
    }

    void count_punctures()
    {
        // A landmark stops the elimination on its way down, so that it counts as one whatever is
        // below it.
        punctures_.assign(node_count(), 0);
        for (std::size_t i = order_.size(); i-- > 0;) {
            const Index n = order_[i];
            if (is_puncture(n)) {
                punctures_[n] = 1;
            }
            if (i > 0) {
                punctures_[node(target_.head(parents_[n]))] += punctures_[n];
            }
        }
    }

    /// Gives the edge of h the word `word` for crossing it from left to right.
    void set_word(Index h, std::int32_t id)
    {
        edge_words_[target_.edge(h)] = target_.edge(h) == h ? id : -id;
    }
    void set_free(Index h)
    {
        words_.push_back({++letters_});
        set_word(h, static_cast<std::int32_t>(words_.size() - 1));
    }

    /// Solves the relation around vertex v for the edge of its outgoing halfedge `unknown`.
    void solve(Index unknown)
    {
        // Clockwise from `unknown` on, the crossings multiply to 1; so the others, in order, are
        // the inverse of crossing `unknown`.
        Word word;
        std::int32_t only = 0;
        int factors = 0;
        for (Index h = target_.clockwise(unknown); h != unknown; h = target_.clockwise(h)) {
            const std::int32_t id = edge_words_[target_.edge(h)];
            if (id != 0) {
                cross(h, word);
                only = target_.edge(h) == h ? id : -id;
                ++factors;
            }
        }
        if (factors == 1) {
            set_word(target_.twins[unknown], only);
        } else if (!word.empty()) {
            words_.push_back(std::move(word));
            set_word(target_.twins[unknown], static_cast<std::int32_t>(words_.size() - 1));
        }
    }

    void eliminate_upwards()
    {
        edge_words_.assign(target_.corner_count, 0);
        for (Index h = 0; h < target_.corner_count; ++h) {
            if (target_.edge(h) == h && generator_[h] && !is_tree_edge(h)) {
                set_free(h);
            }
        }
        for (std::size_t i = order_.size(); i-- > 1;) {
            if (punctures_[order_[i]] == 0) {
                solve(parents_[order_[i]]);
            }
        }
    }

    void eliminate_downwards()
    {
        for (const Index n : order_) {
            Index lightest = kNone;
            for_each_generator(n, [&](Index h) {
                const Index child = node(target_.head(h));
                if (parents_[child] != target_.twins[h] || punctures_[child] == 0) {
                    return;
                }
                // The lightest child's edge is solved for, unless n is a puncture.
                if (is_puncture(n)) {
                    set_free(h);
                } else if (lightest == kNone) {
                    lightest = h;
                } else if (punctures_[child] < punctures_[node(target_.head(lightest))]) {
                    set_free(lightest);
                    lightest = h;
                } else {
                    set_free(h);
                }
            });
            if (lightest != kNone) {
                solve(lightest);
            }
        }
    }

    const Surface& target_;
    const std::vector<bool>& is_landmark_;
    std::vector<bool> generator_;   // per halfedge of a polygon
    std::vector<Index> order_;      // nodes, root first
    std::vector<Index> parents_;    // per node: the halfedge from it to its parent
    std::vector<Index> punctures_;  // per node: how many are in its subtree
    /// words_[0] is empty; an edge has the number of its word for Surface::edge(), negative for the
    /// inverse.
    std::vector<Word> words_;
    std::vector<std::int32_t> edge_words_;  // per halfedge of a polygon, only at Surface::edge()
    std::int32_t letters_ = 0;
};

/// A curve on the target: points and, for each segment between two of them, the face it runs in.
struct Curve {
    std::vector<Carrier> points;
    std::vector<Index> faces;

    void clear()
    {
        points.clear();
        faces.clear();
    }
};

class HomotopyCheck {
public:
    HomotopyCheck(const CheckInput& input, const Surface& target, const Surface& surface,
                  const std::vector<Carrier>& carriers, Violations& violations)
        : input_(input),
          target_(target),
          surface_(surface),
          carriers_(carriers),
          violations_(violations),
          is_landmark_(landmark_flags(input, target)),
          cuts_(target, is_landmark_)
    {}

    void run()
    {
        Curve chain;
        Curve weak;
        for (Index c = 0; c < input_.refined.chains.size(); ++c) {
            if (!read_weak_path(c, weak)) {
                continue;
            }
            read_chain(c, chain);
            const std::optional<Word> chain_word = word(chain);
            const std::optional<Word> weak_word = word(weak);
            if (!chain_word || !weak_word || !homotopic(c, *chain_word, *weak_word)) {
                violations_.add("homotopyClass", "Chain ", c, " of the layout edge ",
                                input_.layout_edges[c][0], "-", input_.layout_edges[c][1],
                                " is not in the homotopy class of its weak path.");
            }
        }
    }

private:
    static std::vector<bool> landmark_flags(const CheckInput& input, const Surface& target)
    {
        std::vector<bool> flags(target.vertex_count, false);
        for (const Index landmark : input.landmarks) {
            flags[landmark] = true;
        }
        return flags;
    }

    /// The chains have been found sound.
    void read_chain(Index c, Curve& curve) const
    {
        const std::vector<Index>& chain = input_.refined.chains[c];
        curve.clear();
        for (std::size_t i = 0; i < chain.size(); ++i) {
            curve.points.push_back(carriers_[chain[i]]);
            if (i > 0) {
                const Index h = surface_.edge(surface_.find(chain[i - 1], chain[i]));
                curve.faces.push_back(input_.refined.triangle_faces[surface_.faces[h]]);
            }
        }
    }

    /// The element of the target a weak point stands for.
    std::optional<Carrier> element(const WeakPoint& point) const
    {
        const Index n = target_.vertex_count;
        if (point[0] >= n || (point[1] == kNone && point[2] != kNone)) {
            return std::nullopt;
        }
        if (point[1] == kNone) {
            return Carrier{Carrier::Kind::vertex, point[0]};
        }
        const Index h = point[1] < n ? target_.find(point[0], point[1]) : kNone;
        if (h == kNone) {
            return std::nullopt;
        }
        if (point[2] == kNone) {
            return Carrier{Carrier::Kind::edge, target_.edge(h)};
        }
        for (const Index side : {h, target_.twins[h]}) {
            const Index face = target_.faces[side];
            if (!target_.is_cap(face) && target_.head(target_.nexts[side]) == point[2]) {
                return Carrier{Carrier::Kind::face, face};
            }
        }
        return std::nullopt;
    }

    /// A face that holds the segment between two incident elements, kNone if they are not incident.
    Index segment_face(const Carrier& a, const Carrier& b) const
    {
        if (a.kind > b.kind) {
            return segment_face(b, a);
        }
        if (a.kind == b.kind) {
            return kNone;
        }
        if (b.kind == Carrier::Kind::edge) {
            const bool incident = target_.tails[b.id] == a.id || target_.head(b.id) == a.id;
            return incident ? target_.faces[b.id] : kNone;
        }
        for (Index h = 3 * b.id; h < 3 * b.id + 3; ++h) {
            if (a.kind == Carrier::Kind::vertex ? target_.tails[h] == a.id
                                                : target_.edge(h) == a.id) {
                return b.id;
            }
        }
        return kNone;
    }

    bool read_weak_path(Index c, Curve& curve)
    {
        const std::vector<WeakPoint>& path = input_.weak_paths[c];
        const Index start = input_.landmarks[input_.layout_edges[c][0]];
        const Index end = input_.landmarks[input_.layout_edges[c][1]];
        curve.clear();
        for (std::size_t i = 0; i < path.size(); ++i) {
            const Index place = static_cast<Index>(i);
            const std::optional<Carrier> point = element(path[i]);
            if (!point) {
                violations_.add("weakPathPoint", "Point ", place, " of weak path ", c,
                                " is no vertex, edge or face of the target.");
                return false;
            }
            if (i > 0) {
                const Index face = segment_face(curve.points.back(), *point);
                if (face == kNone) {
                    violations_.add("weakPathStep", "Point ", place, " of weak path ", c,
                                    " is not next to the point before.");
                    return false;
                }
                curve.faces.push_back(face);
            }
            curve.points.push_back(*point);
        }
        const auto is_vertex = [](const Carrier& point, Index v) {
            return point.kind == Carrier::Kind::vertex && point.id == v;
        };
        if (path.size() < 2 || !is_vertex(curve.points.front(), start) ||
            !is_vertex(curve.points.back(), end)) {
            violations_.add("weakPathEnds", "Weak path ", c, " does not run from vertex ", start,
                            " to vertex ", end, ", the landmarks of its layout edge.");
            return false;
        }
        for (std::size_t i = 1; i + 1 < curve.points.size(); ++i) {
            const Carrier& point = curve.points[i];
            if (point.kind == Carrier::Kind::vertex && is_landmark_[point.id]) {
                violations_.add("weakPathThroughLandmark", "Weak path ", c, " passes vertex ",
                                point.id, ", a landmark.");
                return false;
            }
        }
        return true;
    }

    /// The outgoing halfedge of the vertex with the face on its left, kNone if there is none.
    Index corner(Index vertex, Index face) const
    {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            if (target_.tails[h] == vertex) {
                return h;
            }
        }
        return kNone;
    }

    /// Turns clockwise around a vertex from the face left of h to `face`, multiplying `word` on the
    /// way. False if a hole comes first.
    bool turn(Index h, Index face, Word& word) const
    {
        while (target_.faces[h] != face) {
            const Index next = target_.clockwise(h);
            if (target_.is_cap(target_.faces[next])) {
                return false;
            }
            cuts_.cross(h, word);
            h = next;
        }
        return true;
    }

    /// Turns around a vertex, either way but not across a hole. False if a face is not at the
    /// vertex.
    bool turn_between(Index vertex, Index from, Index to, Word& word) const
    {
        const Index h = corner(vertex, from);
        const Index g = corner(vertex, to);
        if (h == kNone || g == kNone) {
            return false;
        }
        Word clockwise;
        if (turn(h, to, clockwise)) {
            multiply(word, clockwise);
            return true;
        }
        Word back;
        if (!turn(g, from, back)) {
            return false;
        }
        multiply(word, inverse(back));
        return true;
    }

    /// The face at a vertex where curves that end there are taken to start: on a boundary the first
    /// one clockwise, so that all others are reached without crossing the hole.
    Index first_face(Index vertex) const
    {
        const Index h = target_.outgoing[vertex];
        return target_.faces[target_.is_boundary_vertex(vertex) ? target_.clockwise(h) : h];
    }

    /// The word of a curve, from the first face at its start to the first face at its end.
    std::optional<Word> word(const Curve& curve) const
    {
        Word result;
        const Index start = curve.points.front().id;
        const Index end = curve.points.back().id;
        if (!turn_between(start, first_face(start), curve.faces.front(), result)) {
            return std::nullopt;
        }
        for (std::size_t i = 1; i < curve.faces.size(); ++i) {
            const Index from = curve.faces[i - 1];
            const Index to = curve.faces[i];
            const Carrier& point = curve.points[i];
            if (from == to) {
                continue;
            }
            if (point.kind == Carrier::Kind::vertex) {
                if (!turn_between(point.id, from, to, result)) {
                    return std::nullopt;
                }
                continue;
            }
            if (point.kind == Carrier::Kind::face) {
                return std::nullopt;
            }
            const Index h = target_.faces[point.id] == from ? point.id : target_.twins[point.id];
            if (target_.faces[h] != from || target_.faces[target_.twins[h]] != to) {
                return std::nullopt;
            }
            cuts_.cross(h, result);
        }
        if (!turn_between(end, curve.faces.back(), first_face(end), result)) {
            return std::nullopt;
        }
        return result;
    }

    /// The word of turning once around a landmark; empty on a boundary, where nothing can turn.
    Word rotation(Index landmark) const
    {
        Word result;
        if (!target_.is_boundary_vertex(landmark)) {
            const Index start = target_.outgoing[landmark];
            Index h = start;
            do {
                cuts_.cross(h, result);
                h = target_.clockwise(h);
            } while (h != start);
        }
        return result;
    }

    bool homotopic(Index c, const Word& chain, const Word& weak) const
    {
        // chain = x^a weak y^b for the rotations x, y at the ends, that is
        // chain weak^-1 = x^a (weak y weak^-1)^b.
        const Word weak_back = inverse(weak);
        Word difference = chain;
        multiply(difference, weak_back);
        if (difference.empty()) {
            return true;
        }
        Word conjugate = weak;
        multiply(conjugate, rotation(input_.landmarks[input_.layout_edges[c][1]]));
        multiply(conjugate, weak_back);
        return is_product_of_powers(rotation(input_.landmarks[input_.layout_edges[c][0]]),
                                    conjugate, difference);
    }

    const CheckInput& input_;
    const Surface& target_;
    const Surface& surface_;
    const std::vector<Carrier>& carriers_;
    Violations& violations_;
    std::vector<bool> is_landmark_;
    CutSystem cuts_;
};

}  // namespace

void check_homotopy(const CheckInput& input, const Surface& target, const Surface& surface,
                    const std::vector<Carrier>& carriers, Violations& violations)
{
    if (input.weak_paths.empty()) {
        return;
    }
    if (input.weak_paths.size() != input.refined.chains.size()) {
        violations.add("weakPathCount", "There are ", static_cast<Index>(input.weak_paths.size()),
                       " weak paths for ", static_cast<Index>(input.refined.chains.size()),
                       " chains.");
        return;
    }
    HomotopyCheck(input, target, surface, carriers, violations).run();
}

}  // namespace layout_embedding::checker
