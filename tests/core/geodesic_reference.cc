#include "geodesic_reference.hh"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace layout_embedding::test {

namespace {

/// Angles this little below pi count as straight.
constexpr double kStraight = 1e-7;

Index next(Index h)
{
    return h % 3 == 2 ? h - 2 : h + 1;
}

/// The barycentric subdivision as triangles with edge lengths, whose edges can be flipped.
class IntrinsicMesh {
public:
    IntrinsicMesh(const TriangleMesh& mesh, const PathGraph& graph)
    {
        for (Index f = 0; f < mesh.face_count(); ++f) {
            const Index centre = graph.node_of_face(f);
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                const Index middle = graph.node_of_edge(mesh.edge(h));
                add(graph, {graph.node_of_vertex(mesh.tail(h)), middle, centre});
                add(graph, {middle, graph.node_of_vertex(mesh.head(h)), centre});
            }
        }
        for (Index h = 0; h < tails_.size(); ++h) {
            halfedges_[{tails_[h], head(h)}] = h;
        }
        twins_.assign(tails_.size(), kNone);
        for (const auto& [ends, h] : halfedges_) {
            if (const auto twin = halfedges_.find({ends.second, ends.first});
                twin != halfedges_.end()) {
                twins_[h] = twin->second;
            }
        }
    }

    Index tail(Index h) const { return tails_[h]; }
    Index head(Index h) const { return tails_[next(h)]; }
    Index twin(Index h) const { return twins_[h]; }
    double length(Index h) const { return lengths_[h]; }
    /// The halfedge of an edge of the subdivision as it was made; on a boundary its only one.
    Index between(Index from, Index to) const
    {
        const auto found = halfedges_.find({from, to});
        return found == halfedges_.end() ? kNone : found->second;
    }
    /// At the tail of h, in its triangle.
    double angle(Index h) const
    {
        const double a = lengths_[h];
        const double b = lengths_[next(next(h))];
        const double c = lengths_[next(h)];
        return std::acos(std::clamp((a * a + b * b - c * c) / (2 * a * b), -1.0, 1.0));
    }
    /// The next outgoing halfedge counter-clockwise around the tail.
    Index rotated(Index h) const { return twins_[next(next(h))]; }

    void flip(Index h)
    {
        // h = a b in a b c, t = b a in b a d; becomes d c in d c a, and c d in c d b.
        const Index t = twins_[h];
        const Index bc = next(h);
        const Index ca = next(bc);
        const Index ad = next(t);
        const Index db = next(ad);
        const double theta = angle(bc) + angle(t);  // at b
        const double p = lengths_[bc];
        const double q = lengths_[db];
        const double diagonal =
            std::sqrt(std::max(0.0, p * p + q * q - 2 * p * q * std::cos(theta)));
        const Index c = tails_[ca];
        const Index d = tails_[db];
        const std::pair<Index, double> outer[4] = {{twins_[ca], lengths_[ca]},
                                                   {twins_[ad], lengths_[ad]},
                                                   {twins_[db], lengths_[db]},
                                                   {twins_[bc], lengths_[bc]}};
        const Index inner[4] = {ca, ad, db, bc};
        // Triangle of h: d c, c a, a d; triangle of t: c d, d b, b c. The halfedges of ca and db
        // stay; those of ad and bc change places.
        const Index a = tails_[h];
        const Index b = tails_[t];
        const auto set = [&](Index place, Index tail, double size) {
            tails_[place] = tail;
            lengths_[place] = size;
        };
        moved_.clear();
        const auto put = [&](Index place, Index tail, int which) {
            set(place, tail, outer[which].second);
            moved_.push_back({inner[which], place});
        };
        set(h, d, diagonal);
        put(next(h), c, 0);
        put(next(next(h)), a, 1);
        set(t, c, diagonal);
        put(next(t), d, 2);
        put(next(next(t)), b, 3);
        // Twins, which may lie in the same two triangles.
        const auto moved = [&](Index old) {
            for (const auto& [from, to] : moved_) {
                if (from == old) {
                    return to;
                }
            }
            return old;
        };
        for (int i = 0; i < 4; ++i) {
            const Index place = moved(inner[i]);
            const Index other = outer[i].first == kNone ? kNone : moved(outer[i].first);
            twins_[place] = other;
            if (other != kNone) {
                twins_[other] = place;
            }
        }
        twins_[h] = t;
        twins_[t] = h;
    }
    /// Where the halfedges of the last flip's quadrilateral went.
    const std::vector<std::pair<Index, Index>>& moved() const { return moved_; }

private:
    void add(const PathGraph& graph, const std::array<Index, 3>& corners)
    {
        for (int i = 0; i < 3; ++i) {
            tails_.push_back(corners[i]);
            lengths_.push_back(
                (graph.position(corners[i]) - graph.position(corners[(i + 1) % 3])).norm());
        }
    }

    std::vector<Index> tails_;
    std::vector<Index> twins_;
    std::vector<double> lengths_;
    std::map<std::pair<Index, Index>, Index> halfedges_;
    std::vector<std::pair<Index, Index>> moved_;
};

enum class Side { any, left, right };

/// A step of the path, and on which side of its start the path really runs if that is a landmark.
struct Step {
    Index halfedge;
    Side side = Side::any;
};

class FlipPath {
public:
    FlipPath(IntrinsicMesh mesh, std::vector<bool> is_landmark, std::vector<Step> steps)
        : mesh_(std::move(mesh)), is_landmark_(std::move(is_landmark)), steps_(std::move(steps))
    {}

    std::optional<double> run()
    {
        for (;;) {
            std::size_t best = 0;
            Side best_side = Side::any;
            double best_angle = std::numbers::pi - kStraight;
            for (std::size_t i = 1; i < steps_.size(); ++i) {
                for (const Side side : {Side::left, Side::right}) {
                    if (steps_[i].side != Side::any && steps_[i].side != side) {
                        continue;
                    }
                    const double wedge = angle(i, side);
                    if (wedge < best_angle && is_clear()) {
                        best = i;
                        best_side = side;
                        best_angle = wedge;
                    }
                }
            }
            if (best == 0) {
                break;
            }
            if (!shorten(best, best_side)) {
                return std::nullopt;
            }
        }
        for (std::size_t i = 1; i < steps_.size(); ++i) {
            for (const Side side : {Side::left, Side::right}) {
                if ((steps_[i].side == Side::any || steps_[i].side == side) &&
                    angle(i, side) < std::numbers::pi - kStraight) {
                    return std::nullopt;  // in its own way
                }
            }
        }
        double sum = 0;
        for (const Step& step : steps_) {
            sum += mesh_.length(step.halfedge);
        }
        return sum;
    }

private:
    /// The angle at the start of step i on one side; sets fan_ to the outgoing halfedges there,
    /// counter-clockwise, both steps' own included. Infinite across a boundary.
    double angle(std::size_t i, Side side)
    {
        const Index back = mesh_.twin(steps_[i - 1].halfedge);
        const Index forth = steps_[i].halfedge;
        const Index from = side == Side::left ? forth : back;
        const Index to = side == Side::left ? back : forth;
        fan_.assign(1, from);
        double sum = 0;
        for (Index h = from; h != to;) {
            if (h == kNone) {
                return std::numeric_limits<double>::infinity();
            }
            sum += mesh_.angle(h);
            h = mesh_.rotated(h);
            if (h == kNone) {
                return std::numeric_limits<double>::infinity();
            }
            fan_.push_back(h);
        }
        return sum;
    }

    bool on_path(Index h) const
    {
        return std::any_of(steps_.begin(), steps_.end(), [&](const Step& step) {
            return step.halfedge == h || mesh_.twin(step.halfedge) == h;
        });
    }

    /// Whether no part of the path runs inside fan_.
    bool is_clear() const
    {
        for (std::size_t j = 1; j + 1 < fan_.size(); ++j) {
            if (on_path(fan_[j])) {
                return false;
            }
        }
        return true;
    }

    void flip(Index h)
    {
        mesh_.flip(h);
        const auto moved = mesh_.moved();
        for (Step& step : steps_) {
            for (const auto& [from, to] : moved) {
                if (step.halfedge == from) {
                    step.halfedge = to;
                    break;
                }
            }
        }
    }

    bool shorten(std::size_t i, Side side)
    {
        if (steps_[i].halfedge == mesh_.twin(steps_[i - 1].halfedge)) {
            if (is_landmark_[mesh_.tail(steps_[i].halfedge)] || steps_.size() <= 2) {
                return false;
            }
            steps_.erase(steps_.begin() + static_cast<long>(i) - 1,
                         steps_.begin() + static_cast<long>(i) + 1);
            return true;
        }
        for (bool flipped = true; flipped;) {
            flipped = false;
            angle(i, side);
            for (std::size_t j = 1; j + 1 < fan_.size(); ++j) {
                const Index h = fan_[j];
                const Index twin = mesh_.twin(h);
                if (twin == kNone) {
                    return false;
                }
                // The angles at its head on both sides.
                const double outer = mesh_.angle(next(h)) + mesh_.angle(twin);
                if (outer < std::numbers::pi - 1e-12) {
                    flip(h);
                    flipped = true;
                    break;
                }
            }
        }
        angle(i, side);
        std::vector<Step> outside;
        for (std::size_t j = 0; j + 1 < fan_.size(); ++j) {
            outside.push_back({next(fan_[j])});
        }
        if (side == Side::left) {
            std::reverse(outside.begin(), outside.end());
            for (Step& step : outside) {
                step.halfedge = mesh_.twin(step.halfedge);
                if (step.halfedge == kNone) {
                    return false;
                }
            }
        }
        for (std::size_t j = 1; j < outside.size(); ++j) {
            if (is_landmark_[mesh_.tail(outside[j].halfedge)]) {
                outside[j].side = side == Side::left ? Side::right : Side::left;
            }
        }
        outside[0].side = steps_[i - 1].side;
        const auto place = steps_.begin() + static_cast<long>(i);
        steps_.erase(place - 1, place + 1);
        steps_.insert(steps_.begin() + static_cast<long>(i) - 1, outside.begin(), outside.end());
        return true;
    }

    IntrinsicMesh mesh_;
    std::vector<bool> is_landmark_;
    std::vector<Step> steps_;
    std::vector<Index> fan_;
};

}  // namespace

std::optional<double> geodesic_length(const EmbeddingProblem& problem, const PathGraph& graph,
                                      const std::vector<Index>& darts)
{
    IntrinsicMesh mesh(*problem.target, graph);
    std::vector<bool> is_landmark(graph.node_count(), false);
    for (const Index vertex : problem.landmarks) {
        is_landmark[graph.node_of_vertex(vertex)] = true;
    }
    std::vector<Step> steps;
    for (const Index dart : darts) {
        steps.push_back({mesh.between(graph.tail(dart), graph.head(dart))});
        if (steps.back().halfedge == kNone) {
            return std::nullopt;  // along the boundary with the hole on its left
        }
    }
    return FlipPath(std::move(mesh), std::move(is_landmark), std::move(steps)).run();
}

}  // namespace layout_embedding::test
